// Points into planes by successive projections (S. Kaczmarz, "Angenaeherte Aufloesung von Systemen
// linearer Gleichungen", 1937, here with planes that follow the points): polygon after polygon, all
// that must lie on its plane is moved there, until nothing moves any more. A model of quadrangles
// has more unknowns than conditions, so that nearby planar shapes exist; where they do not,
// polygons give up and the rest begins again. It is not those that fail that give up: among a
// failing one and those that share a point with it, it is the one that was least flat as given. So
// what is planar in the file stays so, decals in one plane with it, beside neighbours that are
// bent.
#include "models/planar/planarize.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

namespace octant::models::planar {

namespace {

constexpr int max_sweeps = 2'000;
constexpr std::size_t max_visits = 1'000'000; ///< Of polygons, in one round.
constexpr std::size_t max_visits_in_all = 4 * max_visits;
constexpr int max_rounds = 8;
/// A polygon whose corners lie farther from their plane than they may move, so many times, gives up
/// at once.
constexpr double hopeless_moves = 2.0;
constexpr double at_rest = 1e-14; ///< Smaller moves count as none.

/// One run of planarize().
class Planarizing {
public:
    Planarizing(
        std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move)
        : points_(points)
        , given_(points)
        , incidences_(incidences)
        , max_move_(max_move)
        , bent_(incidences.size())
        , alone_(incidences.size()) {
        for (std::size_t i = 0; i < incidences.size(); ++i) {
            const auto& [corners, touching] = incidences[i];
            const double uneven = max_height(i, corners);
            misfits_.push_back({uneven, std::max(uneven, max_height(i, touching))});
            bent_[i] = alone_[i] = uneven > hopeless_moves * max_move;
        }
    }

    std::vector<bool> run() {
        std::size_t visits = 0;
        for (int round = 0; round < max_rounds && visits < max_visits_in_all; ++round) {
            points_ = given_;
            sweep_to_rest();
            visits += clock_;
            if (!give_up()) {
                return bent_;
            }
        }
        settle();
        return bent_;
    }

private:
    struct Level {
        glm::dvec3 normal{0.0};
        glm::dvec3 middle{0.0};
        bool is_plane = false;

        double height(const glm::dvec3& point) const { return glm::dot(point - middle, normal); }
    };

    Level level_of(std::size_t polygon) const {
        const auto& corners = incidences_[polygon].corners;
        Level level;
        if (corners.size() < 3) {
            return level;
        }
        const glm::dvec3& first = points_[corners[0]];
        glm::dvec3 sum(0.0);
        glm::dvec3 from_first(0.0);
        for (std::size_t i = 1; i < corners.size(); ++i) {
            from_first += points_[corners[i]] - first;
            if (i + 1 < corners.size()) {
                sum += glm::cross(points_[corners[i]] - first, points_[corners[i + 1]] - first);
            }
        }
        const double area = glm::length(sum);
        level.is_plane = area > 0.0;
        level.normal = level.is_plane ? sum / area : sum;
        level.middle = first + from_first / static_cast<double>(corners.size());
        return level;
    }

    /// How far points are from a polygon's plane at most.
    double max_height(std::size_t polygon, std::span<const std::uint32_t> points) const {
        const Level level = level_of(polygon);
        double most = 0.0;
        for (const std::uint32_t point : points) {
            most = std::max(most, std::abs(level.height(points_[point])));
        }
        return most;
    }

    /// The largest distance of a corner from its polygon's plane.
    double unevenness(std::size_t polygon) const {
        return max_height(polygon, incidences_[polygon].corners);
    }

    bool has_work(std::size_t polygon) const {
        return !bent_[polygon] && (incidences_[polygon].corners.size() > 3 ||
                                   (!alone_[polygon] && !incidences_[polygon].touching.empty()));
    }

    /// Whether a point of a polygon has moved since the polygon was flattened.
    bool is_stirred(std::size_t polygon) const {
        const auto moved = [&](std::uint32_t point) { return moved_[point] > flattened_[polygon]; };
        return std::ranges::any_of(incidences_[polygon].corners, moved) ||
               (!alone_[polygon] && std::ranges::any_of(incidences_[polygon].touching, moved));
    }

    /// Moves all that lies on a polygon to its plane and says whether anything moved.
    bool flatten(std::size_t polygon) {
        const Level level = level_of(polygon);
        flattened_[polygon] = ++clock_;
        bool any = false;
        const auto project = [&](std::uint32_t point) {
            const double height = level.height(points_[point]);
            if (std::abs(height) > at_rest) {
                points_[point] -= level.normal * height;
                moved_[point] = clock_;
                any = true;
            }
        };
        if (!level.is_plane) {
            return false;
        }
        if (incidences_[polygon].corners.size() > 3 && unevenness(polygon) > at_rest) {
            std::ranges::for_each(incidences_[polygon].corners, project);
        }
        if (!alone_[polygon]) {
            std::ranges::for_each(incidences_[polygon].touching, project);
        }
        return any;
    }

    void sweep_to_rest() {
        clock_ = 0;
        moved_.assign(points_.size(), 1);
        flattened_.assign(incidences_.size(), 0);
        std::vector<std::size_t> working;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (has_work(i)) {
                working.push_back(i);
            }
        }
        bool moves = true;
        for (int sweep = 0; sweep < max_sweeps && moves && clock_ < max_visits; ++sweep) {
            moves = false;
            for (const std::size_t polygon : working) {
                if (is_stirred(polygon)) {
                    moves = flatten(polygon) || moves;
                }
            }
        }
    }

    bool moved_too_far(std::uint32_t point) const {
        return glm::distance(points_[point], given_[point]) > max_move_;
    }

    /// Whether points of a polygon are off its plane or have moved too far.
    bool fails(std::size_t polygon, std::span<const std::uint32_t> points) const {
        return std::ranges::any_of(
                   points, [&](std::uint32_t point) { return moved_too_far(point); }) ||
               max_height(polygon, points) > planar_noise;
    }

    bool fails(std::size_t polygon) const {
        const auto& [corners, touching] = incidences_[polygon];
        return (!alone_[polygon] && fails(polygon, touching)) ||
               (corners.size() > 3 && fails(polygon, corners));
    }

    /// How far from flat a polygon was as given, with what still has to lie on it.
    double misfit(std::size_t polygon) const {
        return alone_[polygon] ? misfits_[polygon].of_corners : misfits_[polygon].of_all;
    }

    /// Whether a polygon was less flat than another as given, by more than rounding: of mirrored
    /// ones, which are alike, the same gives up however the model is turned.
    bool is_less_flat(std::size_t polygon, std::size_t other) const {
        constexpr double alike = 1e-6;
        return misfit(polygon) > misfit(other) * (1.0 + alike) + planar_noise * alike;
    }

    template <class Visit>
    void for_each_point(std::size_t polygon, Visit visit) const {
        std::ranges::for_each(incidences_[polygon].corners, visit);
        if (!alone_[polygon]) {
            std::ranges::for_each(incidences_[polygon].touching, visit);
        }
    }

    /// For each point the polygons on whose plane it has to lie.
    using PolygonsOfPoints = std::vector<std::vector<std::size_t>>;

    PolygonsOfPoints polygons_of_points() const {
        PolygonsOfPoints polygons(points_.size());
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (has_work(i)) {
                for_each_point(i, [&](std::uint32_t point) { polygons[point].push_back(i); });
            }
        }
        return polygons;
    }

    /// Whether nothing had to move for a polygon as given.
    bool was_flat(std::size_t polygon) const { return misfit(polygon) <= planar_noise; }

    /// For each polygon the nearest one that was not flat as given, along points that have moved;
    /// its own number where there is none.
    std::vector<std::size_t> stirred_by(const PolygonsOfPoints& polygons_of) const {
        std::vector<std::size_t> by(incidences_.size());
        std::vector<std::size_t> reached;
        std::vector<bool> known(incidences_.size());
        for (std::size_t i = 0; i < by.size(); ++i) {
            by[i] = i;
            if (has_work(i) && !was_flat(i)) {
                known[i] = true;
                reached.push_back(i);
            }
        }
        for (std::size_t next = 0; next < reached.size(); ++next) {
            const std::size_t from = reached[next];
            for_each_point(from, [&](std::uint32_t point) {
                if (points_[point] == given_[point]) {
                    return;
                }
                for (const std::size_t other : polygons_of[point]) {
                    if (!known[other]) {
                        known[other] = true;
                        by[other] = by[from];
                        reached.push_back(other);
                    }
                }
            });
        }
        return by;
    }

    /// The least flat of a polygon and those that share a point with it, as given.
    std::size_t worst_around(std::size_t polygon, const PolygonsOfPoints& polygons_of) const {
        std::size_t worst = polygon;
        for_each_point(polygon, [&](std::uint32_t point) {
            for (const std::size_t other : polygons_of[point]) {
                worst = is_less_flat(other, worst) ? other : worst;
            }
        });
        return worst;
    }

    /// Lets polygons give up where some are not planar yet or have moved a point too far; says
    /// whether there were any. What touches a polygon is given up first, then its own plane.
    bool give_up() {
        const PolygonsOfPoints polygons_of = polygons_of_points();
        const std::vector<std::size_t> by = stirred_by(polygons_of);
        std::set<std::size_t> giving;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (has_work(i) && fails(i)) {
                giving.insert(was_flat(i) ? by[i] : worst_around(i, polygons_of));
            }
        }
        for (const std::size_t polygon : giving) {
            bent_[polygon] = alone_[polygon] || incidences_[polygon].touching.empty();
            alone_[polygon] = true;
        }
        return !giving.empty();
    }

    /// Ends without all of them planar: those that are not keep their corners as they have come.
    /// Points that have moved too far go back.
    void settle() {
        for (std::uint32_t point = 0; point < points_.size(); ++point) {
            if (moved_too_far(point)) {
                points_[point] = given_[point];
            }
        }
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            bent_[i] = bent_[i] || unevenness(i) > planar_noise;
        }
    }

    /// How far points of a polygon were from its plane as given.
    struct Misfit {
        double of_corners = 0.0;
        double of_all = 0.0; ///< With what touches it.
    };

    std::vector<glm::dvec3>& points_;
    const std::vector<glm::dvec3> given_;
    std::span<const Incidence> incidences_;
    double max_move_;
    std::vector<Misfit> misfits_;
    std::vector<bool> bent_;  ///< Has given up its plane.
    std::vector<bool> alone_; ///< Has given up what touches it.
    /// Times in polygons flattened: when each point was moved last and each polygon flattened last.
    std::vector<std::size_t> moved_;
    std::vector<std::size_t> flattened_;
    std::size_t clock_ = 0;
};

} // namespace

std::vector<bool> planarize(
    std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move) {
    return Planarizing(points, incidences, max_move).run();
}

} // namespace octant::models::planar
