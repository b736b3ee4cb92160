// Points into planes by successive projections (S. Kaczmarz, "Angenaeherte Aufloesung von Systemen
// linearer Gleichungen", 1937, here with planes that follow the points): polygon after polygon, all
// that must lie on its plane is moved there, until nothing moves any more. A model of quadrangles
// has more unknowns than conditions, so that nearby planar shapes exist; where they do not, the
// polygons that would have to move too far give up and the rest begins again.
#include "models/planar/planarize.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::models::planar {

namespace {

constexpr int most_sweeps = 400;
constexpr std::size_t most_visits = 3'000'000; ///< Of polygons, in one round.
constexpr int most_rounds = 6;
constexpr double at_rest = 1e-14; ///< Smaller moves count as none.

/// One run of planarize().
class Planarizing {
public:
    Planarizing(
        std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double most_move)
        : points_(points)
        , given_(points)
        , incidences_(incidences)
        , most_move_(most_move)
        , bent_(incidences.size())
        , alone_(incidences.size()) {}

    std::vector<bool> run() {
        for (int round = 0; round < most_rounds; ++round) {
            points_ = given_;
            sweep_to_rest();
            if (!give_up()) {
                return bent_;
            }
        }
        points_ = given_;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            bent_[i] = bent_[i] || unevenness(i) > planar_noise;
        }
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

    /// The largest distance of a corner from its polygon's plane.
    double unevenness(std::size_t polygon) const {
        const Level level = level_of(polygon);
        double most = 0.0;
        for (const std::uint32_t corner : incidences_[polygon].corners) {
            most = std::max(most, std::abs(level.height(points_[corner])));
        }
        return most;
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
        for (int sweep = 0; sweep < most_sweeps && moves && clock_ < most_visits; ++sweep) {
            moves = false;
            for (const std::size_t polygon : working) {
                if (is_stirred(polygon)) {
                    moves = flatten(polygon) || moves;
                }
            }
        }
    }

    bool moved_too_far(std::uint32_t point) const {
        return glm::distance(points_[point], given_[point]) > most_move_;
    }

    /// Lets polygons give up that are not planar yet or have moved a point too far; says whether
    /// there were any.
    bool give_up() {
        bool any = false;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (!has_work(i)) {
                continue;
            }
            const auto too_far = [&](std::uint32_t point) { return moved_too_far(point); };
            const Level level = level_of(i);
            const auto off = [&](std::uint32_t point) {
                return std::abs(level.height(points_[point])) > planar_noise;
            };
            const auto& [corners, touching] = incidences_[i];
            if (!alone_[i] &&
                (std::ranges::any_of(touching, too_far) || std::ranges::any_of(touching, off))) {
                alone_[i] = any = true;
            } else if (
                corners.size() > 3 &&
                (std::ranges::any_of(corners, too_far) || std::ranges::any_of(corners, off))) {
                bool gives = alone_[i] || touching.empty();
                alone_[i] = true;
                bent_[i] = bent_[i] || gives;
                any = true;
            }
        }
        return any;
    }

    std::vector<glm::dvec3>& points_;
    const std::vector<glm::dvec3> given_;
    std::span<const Incidence> incidences_;
    double most_move_;
    std::vector<bool> bent_;  ///< Has given up its plane.
    std::vector<bool> alone_; ///< Has given up what touches it.
    /// Times in polygons flattened: when each point was moved last and each polygon flattened last.
    std::vector<std::size_t> moved_;
    std::vector<std::size_t> flattened_;
    std::size_t clock_ = 0;
};

} // namespace

std::vector<bool> planarize(
    std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double most_move) {
    return Planarizing(points, incidences, most_move).run();
}

} // namespace octant::models::planar
