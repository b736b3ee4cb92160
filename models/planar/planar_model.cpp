#include "models/planar/planar_model.h"

#include "models/planar/incidences.h"
#include "models/polygons/polygon_model.h"
#include "models/polygons/polygon_outlines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::planar {

namespace {

using polygons::PolygonModel;
using Outline = std::vector<std::uint32_t>; ///< vertices of a polygon, in order

/// A corner within the reach of a side and the side itself may both have been moved since, when their polygons were
/// made planar.
constexpr double in_reaches = 2.0;

/// The corners of one turning part, or of all that stands still.
struct PartCorners {
    std::vector<std::uint32_t> vertices; ///< each once
    std::vector<glm::dvec3> places_m;
};

std::vector<PartCorners> corners_of_parts(const PolygonModel& model) {
    std::vector<PartCorners> parts(model.pivots.size() + 1);
    std::vector<std::size_t> last_part(model.vertices_m.size(), parts.size());
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto pivot = polygons::pivot_of(model, i);
        const std::size_t part = pivot ? *pivot + 1 : 0;
        for (const std::uint32_t vertex : model.corners(i)) {
            if (std::exchange(last_part[vertex], part) != part) {
                parts[part].vertices.push_back(vertex);
                parts[part].places_m.push_back(model.vertices_m[vertex]);
            }
        }
    }
    return parts;
}

/// Half the diagonal of the box around all corners.
double radius_m_of(const PolygonModel& model) {
    glm::dvec3 min_m(std::numeric_limits<double>::max());
    glm::dvec3 max_m(std::numeric_limits<double>::lowest());
    for (const std::uint32_t vertex : model.corner_vertices) {
        min_m = glm::min(min_m, model.vertices_m[vertex]);
        max_m = glm::max(max_m, model.vertices_m[vertex]);
    }
    return model.corner_vertices.empty() ? 0.0 : glm::distance(min_m, max_m) / 2.0;
}

/// Finds the corners that lie on sides of other polygons.
class Search {
public:
    explicit Search(const PolygonModel& model)
        : model_(model), reach_m_(in_reaches * touching_reach * radius_m_of(model)), parts_(corners_of_parts(model)) {
        for (const PartCorners& part : parts_) { near_.emplace_back(part.places_m); }
    }

    std::vector<TJunction> all() {
        for (std::size_t i = 0; i < model_.polygons.size(); ++i) {
            const auto pivot = polygons::pivot_of(model_, i);
            const polygons::Polygon& polygon = model_.polygons[i];
            for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
                const std::uint32_t next = k + 1 < polygon.corner_count ? k + 1 : 0;
                add_on_side(
                    pivot ? *pivot + 1 : 0, model_.corners(i), polygon.first_corner + k, polygon.first_corner + next);
            }
        }
        return std::move(found_);
    }

private:
    const glm::dvec3& place_m(std::uint32_t vertex) const { return model_.vertices_m[vertex]; }

    /// Whether a place is as good as that of one of a polygon's own corners.
    bool is_own(std::span<const std::uint32_t> corners, const glm::dvec3& at_m) const {
        return std::ranges::any_of(
            corners, [&](std::uint32_t vertex) { return glm::distance(place_m(vertex), at_m) <= reach_m_; });
    }

    void add_on_side(std::size_t part, std::span<const std::uint32_t> own, std::size_t from, std::size_t to) {
        const glm::dvec3& from_m = place_m(model_.corner_vertices[from]);
        const glm::dvec3& to_m = place_m(model_.corner_vertices[to]);
        const glm::dvec3 along_m = to_m - from_m;
        const double length2 = glm::dot(along_m, along_m);
        if (length2 == 0.0) { return; }
        boxed_.clear();
        near_[part].append_near_segment(from_m, to_m, reach_m_, boxed_);
        const std::size_t first = found_.size();
        for (const std::uint32_t number : boxed_) {
            const std::uint32_t vertex = parts_[part].vertices[number];
            const glm::dvec3& at_m = place_m(vertex);
            const double share = glm::dot(at_m - from_m, along_m) / length2;
            if (share > 0.0 && share < 1.0 && glm::distance(at_m, from_m + along_m * share) <= reach_m_ &&
                !is_own(own, at_m)) {
                found_.push_back({from, vertex, share});
            }
        }
        const auto begin = found_.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, found_.end(), [](const TJunction& a, const TJunction& b) {
            return std::pair(a.share, a.vertex) < std::pair(b.share, b.vertex);
        });
        const auto in_one_place = [&](const TJunction& a, const TJunction& b) {
            return place_m(a.vertex) == place_m(b.vertex);
        };
        found_.erase(std::unique(begin, found_.end(), in_one_place), found_.end());
    }

    const PolygonModel& model_;
    double reach_m_;
    std::vector<PartCorners> parts_;
    std::vector<VertexGrid> near_; ///< of each part
    std::vector<std::uint32_t> boxed_;
    std::vector<TJunction> found_;
};

} // namespace

std::vector<TJunction> t_junctions(const PolygonModel& model) { return Search(model).all(); }

// Moves points into planes by successive projections (S. Kaczmarz, "Angenaeherte Aufloesung von Systemen linearer
// Gleichungen", 1937; here the planes follow the points): for one polygon after the other, all its points are projected
// onto its plane, until no point moves. A model of quadrangles has more unknowns than conditions, so a planar solution
// exists nearby. Where none exists, polygons lose their plane and the iteration restarts. Among a failing polygon and
// those that share a point with it, the one that was least flat in the input loses its plane. This keeps polygons that
// are planar in the file planar, and decals in one plane with them, next to bent neighbours.

namespace {

constexpr int max_sweeps = 2'000;
constexpr std::size_t max_visits = 1'000'000; ///< projections onto polygons in one round
constexpr std::size_t max_visits_in_all = 4 * max_visits;
constexpr int max_rounds = 8;
/// A polygon loses its plane at once if a corner is farther from it than this many times the largest move.
constexpr double hopeless_moves = 2.0;
constexpr double at_rest = 1e-14; ///< smaller moves are ignored

/// One run of planarize().
class Planarizing {
public:
    Planarizing(std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move)
        : points_(points), given_(points), incidences_(incidences), max_move_(max_move), bent_(incidences.size()),
          alone_(incidences.size()) {
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
            if (!give_up()) { return bent_; }
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
        if (corners.size() < 3) { return level; }
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
        for (const std::uint32_t point : points) { most = std::max(most, std::abs(level.height(points_[point]))); }
        return most;
    }

    /// The largest distance of a corner from its polygon's plane.
    double unevenness(std::size_t polygon) const { return max_height(polygon, incidences_[polygon].corners); }

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
        if (!level.is_plane) { return false; }
        if (incidences_[polygon].corners.size() > 3 && unevenness(polygon) > at_rest) {
            std::ranges::for_each(incidences_[polygon].corners, project);
        }
        if (!alone_[polygon]) { std::ranges::for_each(incidences_[polygon].touching, project); }
        return any;
    }

    void sweep_to_rest() {
        clock_ = 0;
        moved_.assign(points_.size(), 1);
        flattened_.assign(incidences_.size(), 0);
        std::vector<std::size_t> working;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (has_work(i)) { working.push_back(i); }
        }
        bool moves = true;
        for (int sweep = 0; sweep < max_sweeps && moves && clock_ < max_visits; ++sweep) {
            moves = false;
            for (const std::size_t polygon : working) {
                if (is_stirred(polygon)) { moves = flatten(polygon) || moves; }
            }
        }
    }

    bool moved_too_far(std::uint32_t point) const { return glm::distance(points_[point], given_[point]) > max_move_; }

    /// Whether points of a polygon are off its plane or have moved too far.
    bool fails(std::size_t polygon, std::span<const std::uint32_t> points) const {
        return std::ranges::any_of(points, [&](std::uint32_t point) { return moved_too_far(point); }) ||
               max_height(polygon, points) > planar_noise;
    }

    bool fails(std::size_t polygon) const {
        const auto& [corners, touching] = incidences_[polygon];
        return (!alone_[polygon] && fails(polygon, touching)) || (corners.size() > 3 && fails(polygon, corners));
    }

    /// How far from flat a polygon was as given, with what still has to lie on it.
    double misfit(std::size_t polygon) const {
        return alone_[polygon] ? misfits_[polygon].of_corners : misfits_[polygon].of_all;
    }

    /// Whether a polygon was less flat than another in the input, by more than rounding. The margin makes the choice
    /// between mirrored polygons independent of the model's attitude.
    bool is_less_flat(std::size_t polygon, std::size_t other) const {
        constexpr double alike = 1e-6;
        return misfit(polygon) > misfit(other) * (1.0 + alike) + planar_noise * alike;
    }

    template <class Visit>
    void for_each_point(std::size_t polygon, Visit visit) const {
        std::ranges::for_each(incidences_[polygon].corners, visit);
        if (!alone_[polygon]) { std::ranges::for_each(incidences_[polygon].touching, visit); }
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

    /// For each polygon the nearest one that was not flat as given, along points that have moved; its own number where
    /// there is none.
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
                if (points_[point] == given_[point]) { return; }
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
            for (const std::size_t other : polygons_of[point]) { worst = is_less_flat(other, worst) ? other : worst; }
        });
        return worst;
    }

    /// Removes conditions where polygons are not planar or moved a point too far: first the touching points of a
    /// polygon, then its plane. Returns whether any were removed.
    bool give_up() {
        const PolygonsOfPoints polygons_of = polygons_of_points();
        const std::vector<std::size_t> by = stirred_by(polygons_of);
        std::set<std::size_t> giving;
        for (std::size_t i = 0; i < incidences_.size(); ++i) {
            if (has_work(i) && fails(i)) { giving.insert(was_flat(i) ? by[i] : worst_around(i, polygons_of)); }
        }
        for (const std::size_t polygon : giving) {
            bent_[polygon] = alone_[polygon] || incidences_[polygon].touching.empty();
            alone_[polygon] = true;
        }
        return !giving.empty();
    }

    /// Ends without all of them planar: those that are not keep their corners as they have come. Points that have moved
    /// too far go back.
    void settle() {
        for (std::uint32_t point = 0; point < points_.size(); ++point) {
            if (moved_too_far(point)) { points_[point] = given_[point]; }
        }
        for (std::size_t i = 0; i < incidences_.size(); ++i) { bent_[i] = bent_[i] || unevenness(i) > planar_noise; }
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

std::vector<bool> planarize(std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move) {
    return Planarizing(points, incidences, max_move).run();
}

namespace {

// Which way a model lies. Whatever looks along axes later on, at boxes or for planes across them, then gives the same
// for a model and the same model turned.

/// Of more sides only so many are looked at, evenly spread.
constexpr std::size_t max_sides = 4'000;
/// So many are tried as axes: the longest, and as many spread over all.
constexpr std::size_t max_tried = 64;
constexpr double right_angle = 1e-8; ///< A smaller cosine is none; so is a smaller sine.
constexpr double rounding = 1e-9;

struct Side {
    glm::dvec3 along{0.0};
    double length = 0.0;
};

std::vector<Side> sides_of(const PolygonModel& model, std::span<const glm::dvec3> points) {
    std::vector<Side> sides;
    const std::size_t step = model.corner_vertices.size() / max_sides + 1;
    std::size_t number = 0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        const bool turns = polygons::pivot_of(model, i).has_value();
        for (std::size_t k = 0; k < corners.size(); ++k, ++number) {
            const glm::dvec3 side = points[corners[(k + 1) % corners.size()]] - points[corners[k]];
            const double length = glm::length(side);
            if (!turns && number % step == 0 && length > 0.0) { sides.push_back({side / length, length}); }
        }
    }
    return sides;
}

/// The sides that are tried, in their order. Rounding does not decide which of many that are equally long are among
/// them.
std::vector<Side> tried_of(const std::vector<Side>& sides) {
    std::vector<double> lengths;
    for (const Side& side : sides) { lengths.push_back(side.length); }
    const std::size_t last = std::min(max_tried, lengths.size()) - 1;
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(last), std::greater());
    const double least = lengths[last] * (1.0 - rounding);
    const std::size_t step = sides.size() / max_tried + 1;
    std::vector<Side> tried;
    std::size_t long_ones = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool is_long = sides[i].length >= least && long_ones < 4 * max_tried;
        long_ones += is_long ? 1 : 0;
        if (is_long || i % step == 0) { tried.push_back(sides[i]); }
    }
    return tried;
}

/// The length of the sides that lie along a direction or across it.
double support_of(const glm::dvec3& direction, const std::vector<Side>& sides) {
    double support = 0.0;
    for (const Side& side : sides) {
        const double cosine = glm::dot(side.along, direction);
        const glm::dvec3 sine = glm::cross(side.along, direction);
        if (std::abs(cosine) < right_angle || glm::dot(sine, sine) < right_angle * right_angle) {
            support += side.length;
        }
    }
    return support;
}

/// The direction with the most support, the first one among equals; nothing of nothing.
glm::dvec3 best_of(const std::vector<glm::dvec3>& directions, const std::vector<Side>& sides) {
    glm::dvec3 best(0.0);
    double most = 0.0;
    for (const glm::dvec3& direction : directions) {
        const double support = support_of(direction, sides);
        if (support > most * (1.0 + rounding)) {
            best = direction;
            most = support;
        }
    }
    return best;
}

/// The directions of the sides perpendicular to an axis, or of all sides if there are none, without their components
/// along the axis.
std::vector<glm::dvec3> across(const glm::dvec3& axis, const std::vector<Side>& tried) {
    std::vector<glm::dvec3> exactly;
    std::vector<glm::dvec3> about;
    for (const Side& side : tried) {
        const double cosine = glm::dot(side.along, axis);
        const glm::dvec3 rest = side.along - axis * cosine;
        const double length = glm::length(rest);
        if (std::abs(cosine) < right_angle) {
            exactly.push_back(rest / length);
        } else if (length > right_angle) {
            about.push_back(rest / length);
        }
    }
    return exactly.empty() ? about : exactly;
}

/// Axes that turn with a model, as the columns of a rotation: the first is the side of a polygon along or across which
/// most of the length of all sides lies, the second the best one across it. Of a model that is built along its file's
/// axes they are these, in some order. What turns is left out. `points` are the vertices in any unit.
glm::dmat3 own_axes(const PolygonModel& model, std::span<const glm::dvec3> points) {
    const std::vector<Side> sides = sides_of(model, points);
    if (sides.empty()) { return glm::dmat3(1.0); }
    const std::vector<Side> tried = tried_of(sides);
    std::vector<glm::dvec3> directions;
    for (const Side& side : tried) { directions.push_back(side.along); }
    const glm::dvec3 first = best_of(directions, sides);
    const glm::dvec3 second = best_of(across(first, tried), sides);
    if (second == glm::dvec3(0.0)) {
        return glm::dmat3(1.0); // all on one line
    }
    return {first, second, glm::cross(first, second)};
}

/// What reading a decimal, moving or scaling it, and looking at it here may round off a number, as a share of it. (Each
/// of these steps rounds by at most half an epsilon.)
constexpr double rounding_share = 2.5 * std::numeric_limits<double>::epsilon();
/// Decimal steps finer than so many of these, of the largest coordinate, are not told from noise: of numbers without a
/// grid one in eight lies that near to a multiple.
constexpr double min_roundings = 16.0;

/// Whether a number is a multiple of 10 to some power but for rounding. Powers above 1 are exact, their inverses are
/// not.
bool is_multiple(double value, int power) {
    const double scale = std::pow(10.0, std::abs(power));
    const double nearest = power < 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
    return std::abs(value - nearest) <= rounding_share * std::abs(value);
}

} // namespace

double decimal_grid(std::span<const glm::dvec3> points) {
    double most = 0.0;
    std::vector<double> values;
    for (const glm::dvec3& point : points) {
        for (const double value : {point.x, point.y, point.z}) {
            most = std::max(most, std::abs(value));
            values.push_back(value);
        }
    }
    if (most == 0.0) { return 0.0; }
    const double least = min_roundings * rounding_share * most;
    for (int power = static_cast<int>(std::floor(std::log10(most)));; --power) {
        const double step = std::pow(10.0, power);
        if (step <= least) { return 0.0; }
        if (std::ranges::all_of(values, [&](double value) { return is_multiple(value, power); })) { return step; }
    }
}

namespace {

/// No point moves farther than so many times the reach.
constexpr double moves_in_reaches = 4.0;
/// A polygon whose height over its longest side is less has no area.
constexpr double min_height = planar_tolerance;

/// A point in steps of the decimals of its file, where it has a grid of them. Far from the origin, and in any unit,
/// that gives the decimals that were written without what rounding has added.
glm::dvec3 in_steps(const PlanarModel& frame, const glm::dvec3& point_m) {
    return frame.grid_m > 0.0 ? glm::round(point_m / frame.grid_m) : point_m;
}

/// A point in own axes from the base of the frame, in steps.
glm::dvec3 from_base(const PlanarModel& frame, const glm::dvec3& point_m) {
    return (in_steps(frame, point_m) - frame.base_steps) * frame.axes; // by the transpose
}

/// The axes, the middle of the box around all corners along them, and the distance of the farthest corner from it.
void find_frame(const PolygonModel& model, Attitude attitude, PlanarModel& out) {
    out.grid_m = decimal_grid(model.vertices_m);
    if (model.corner_vertices.empty()) { return; }
    Box given;
    for (const std::uint32_t vertex : model.corner_vertices) { given.add(in_steps(out, model.vertices_m[vertex])); }
    out.base_steps = given.middle();
    if (attitude == Attitude::Own) {
        std::vector<glm::dvec3> points;
        for (const glm::dvec3& vertex_m : model.vertices_m) { points.push_back(from_base(out, vertex_m)); }
        out.axes = own_axes(model, points);
    }
    Box own;
    for (const std::uint32_t vertex : model.corner_vertices) { own.add(from_base(out, model.vertices_m[vertex])); }
    out.centre_steps = own.middle();
    double farthest = 0.0;
    for (const std::uint32_t vertex : model.corner_vertices) {
        const glm::dvec3 at = from_base(out, model.vertices_m[vertex]);
        farthest = std::max(farthest, glm::distance(at, out.centre_steps));
    }
    out.radius_steps = farthest > 0.0 ? farthest : 1.0;
    out.radius_m = out.radius_steps * out.step_m();
}

glm::dvec3 in_radii(const PlanarModel& frame, const glm::dvec3& point_m) {
    return (from_base(frame, point_m) - frame.centre_steps) / frame.radius_steps;
}

/// For each vertex which part it turns with: 0 for what stands still, and for vertices without a polygon.
std::vector<std::uint32_t> pivots_of_vertices(const PolygonModel& model) {
    std::vector<std::uint32_t> kind(model.vertices_m.size(), 0);
    for (std::size_t i = 0; i < model.polygons.size() && !model.pivots.empty(); ++i) {
        const auto pivot = polygons::pivot_of(model, i);
        for (const std::uint32_t vertex : model.corners(i)) { kind[vertex] = pivot ? *pivot + 1 : 0; }
    }
    return kind;
}

/// Moves the vertices, in radii, and tells which polygons stay bent.
std::vector<bool> move_vertices(PolygonModel& model) {
    const auto kind = pivots_of_vertices(model);
    const auto places = one_place(model.vertices_m, kind, touching_reach);
    const auto incidences = incidences_of(model, model.vertices_m, places, kind, touching_reach);
    auto bent = planarize(model.vertices_m, incidences, moves_in_reaches * touching_reach);
    for (std::size_t i = 0; i < places.size(); ++i) { model.vertices_m[i] = model.vertices_m[places[i]]; }
    return bent;
}

/// The corners of a polygon without those in the place of the one before.
Outline different_corners(const PolygonModel& model, std::size_t polygon) {
    Outline out;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        if (out.empty() || model.vertices_m[out.back()] != model.vertices_m[vertex]) { out.push_back(vertex); }
    }
    while (out.size() > 1 && model.vertices_m[out.back()] == model.vertices_m[out.front()]) { out.pop_back(); }
    return out;
}

std::vector<glm::dvec3> places_of(const PolygonModel& model, const Outline& outline) {
    std::vector<glm::dvec3> places;
    for (const std::uint32_t vertex : outline) { places.push_back(model.vertices_m[vertex]); }
    return places;
}

/// Whether corners are on one line: twice the area over the longest side is a height.
bool has_no_area(const std::vector<glm::dvec3>& places) {
    glm::dvec3 sum(0.0);
    double longest = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3& next = places[(i + 1) % places.size()];
        sum += glm::cross(places[i] - places[0], next - places[0]);
        longest = std::max(longest, glm::distance(places[i], next));
    }
    return glm::length(sum) <= min_height * longest;
}

/// All triangles of a fan, for an outline that could not be cut otherwise.
std::vector<Outline> fan_of(const Outline& outline) {
    std::vector<Outline> pieces;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) { pieces.push_back({outline[0], outline[i], outline[i + 1]}); }
    return pieces;
}

/// Convex planar pieces of an outline, most often the outline itself.
std::vector<Outline> pieces_of(const PolygonModel& model, const Outline& outline, bool bent) {
    const auto places = places_of(model, outline);
    if (outline.size() == 3 || (!bent && !polygons::corners_fault(places, planar_tolerance))) { return {outline}; }
    const auto convex = polygons::convex_pieces(places, planar_noise);
    if (convex.pieces.empty()) { return fan_of(outline); }
    std::vector<Outline> pieces;
    for (const auto& corners : convex.pieces) {
        Outline& piece = pieces.emplace_back();
        for (const std::size_t corner : corners) { piece.push_back(outline[corner]); }
    }
    return pieces;
}

/// Replaces bent and concave polygons by pieces and leaves out those without an area.
void triangulated_polygons(PlanarModel& planar, const std::vector<bool>& bent) {
    PolygonModel& model = planar.model;
    PolygonModel out;
    std::vector<std::uint32_t> parents;
    bool is_changed = !model.parents.empty();
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Outline whole = different_corners(model, i);
        std::vector<Outline> pieces;
        if (whole.size() >= 3 && !has_no_area(places_of(model, whole))) { pieces = pieces_of(model, whole, bent[i]); }
        std::erase_if(pieces, [&](const Outline& piece) { return has_no_area(places_of(model, piece)); });
        const bool is_faulty = pieces.size() > 1 && polygons::corners_fault(places_of(model, whole), touching_reach);
        planar.triangulated_polygons += is_faulty ? 1 : 0;
        planar.dropped_polygons += pieces.empty() ? 1 : 0;
        is_changed = is_changed || pieces.size() != 1;
        for (const Outline& piece : pieces) {
            polygons::Polygon polygon = model.polygons[i];
            polygon.first_corner = static_cast<std::uint32_t>(out.corner_vertices.size());
            polygon.corner_count = static_cast<std::uint32_t>(piece.size());
            out.polygons.push_back(polygon);
            out.corner_vertices.insert(out.corner_vertices.end(), piece.begin(), piece.end());
            parents.push_back(model.parent_of(i));
        }
    }
    if (is_changed) { model.parents = std::move(parents); }
    model.polygons = std::move(out.polygons);
    model.corner_vertices = std::move(out.corner_vertices);
}

} // namespace

PlanarModel planar_model(const PolygonModel& model, Attitude attitude) {
    PlanarModel planar;
    planar.model = model;
    if (model.vertices_m.empty()) { return planar; }
    find_frame(model, attitude, planar);
    for (glm::dvec3& vertex : planar.model.vertices_m) { vertex = in_radii(planar, vertex); }
    for (polygons::Pivot& pivot : planar.model.pivots) {
        const glm::dvec3 point_steps = pivot.point_m / planar.step_m() - planar.base_steps;
        pivot.point_m = (point_steps * planar.axes - planar.centre_steps) / planar.radius_steps;
        pivot.axis = pivot.axis * planar.axes;
    }
    triangulated_polygons(planar, move_vertices(planar.model));
    return planar;
}

PolygonModel in_model_frame(PolygonModel changed, const PlanarModel& planar, const PolygonModel& given) {
    for (std::size_t i = 0; i < changed.vertices_m.size(); ++i) {
        glm::dvec3& vertex = changed.vertices_m[i];
        const bool is_still = i < given.vertices_m.size() && vertex == in_radii(planar, given.vertices_m[i]);
        vertex = is_still ? given.vertices_m[i] : planar.to_model_frame(vertex);
    }
    changed.pivots = given.pivots;
    return changed;
}

} // namespace octant::models::planar
