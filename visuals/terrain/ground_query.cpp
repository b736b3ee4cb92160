// Lines against the full-resolution ground: line of sight and height above terrain.
//
// The line is cut at the grid's lines. Over one cell both the bilinear ground and the earth's curvature along the line
// are quadratic in the distance travelled, and so is the line's height above them: its minimum and its first zero are
// exact.

#include "visuals/terrain/ground_query.h"

#include "models/heights/height_field.h"
#include "visuals/terrain/frustum.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

/// A line that is at least this far below the ground is below it.
constexpr double clearance_tolerance_m = 1e-6;

/// A cell of the grid and a position in it, 0 to 1.
struct CellPosition {
    int column;
    int row;
    double east;
    double north;
};

CellPosition cell_at(const GroundSamples& ground, const glm::dvec2& grid) {
    const int column = std::clamp(static_cast<int>(std::floor(grid.x)), 0, ground.columns() - 2);
    const int row = std::clamp(static_cast<int>(std::floor(grid.y)), 0, ground.rows() - 2);
    return {column, row, grid.x - column, grid.y - row};
}

/// A part of a line, in shares of its length.
struct LineInterval {
    double first = 0.0;
    double last = 1.0;
};

/// Cuts a part to where one coordinate lies between two bounds.
void clip_interval(LineInterval& part, double start, double delta, double min, double max) {
    if (delta == 0.0) {
        if (start < min || start > max) { part.last = -1.0; }
        return;
    }
    const double a = (min - start) / delta;
    const double b = (max - start) / delta;
    part.first = std::max(part.first, std::min(a, b));
    part.last = std::min(part.last, std::max(a, b));
}

/// The height of a line above the ground over one cell: constant + linear t + square t^2, with t from 0.
struct ClearanceCurve {
    double constant;
    double linear;
    double square;

    double at(double t) const { return constant + t * (linear + t * square); }

    /// The t in 0 to `last` at which the gap is least.
    double argmin(double last) const {
        const double turn = square > 0.0 ? std::clamp(-linear / (2.0 * square), 0.0, last) : 0.0;
        const double ends = at(last) < at(0.0) ? last : 0.0;
        return at(turn) < at(ends) ? turn : ends;
    }

    /// The first zero in 0 to `last` of a gap that goes below zero there.
    double first_zero(double last) const {
        if (constant <= 0.0) { return 0.0; }
        const double root = std::sqrt(std::max(linear * linear - 4.0 * square * constant, 0.0));
        const double zero = 2.0 * constant / (root - linear);
        return root - linear > 0.0 ? std::min(zero, last) : last;
    }
};

/// A line in grid coordinates and height, with the curvature as seen from its start.
struct Line {
    glm::dvec2 start;
    glm::dvec2 delta;
    double start_m;
    double climb_m;
    double drop_m; ///< At its end.
};

/// The gap over a cell, from the point at `share` of the line on.
ClearanceCurve clearance_over(const GroundSamples& ground, const Line& line, const CellPosition& cell, double share) {
    const double south_west_m = ground.height_m(cell.column, cell.row);
    const double east_m = ground.height_m(cell.column + 1, cell.row) - south_west_m;
    const double north_m = ground.height_m(cell.column, cell.row + 1) - south_west_m;
    const double twist_m = ground.height_m(cell.column + 1, cell.row + 1) - south_west_m - east_m - north_m;
    const double u = cell.east;
    const double v = cell.north;
    const double line_m = line.start_m + share * line.climb_m;
    return {line_m + share * share * line.drop_m - (south_west_m + u * east_m + v * north_m + u * v * twist_m),
        line.climb_m + 2.0 * share * line.drop_m -
            (line.delta.x * (east_m + v * twist_m) + line.delta.y * (north_m + u * twist_m)),
        line.drop_m - line.delta.x * line.delta.y * twist_m};
}

/// Calls visit(gap, share, length) for the cells below a part of the line, in order, until it returns true.
template <class Visit>
void for_each_cell(const GroundSamples& ground, const Line& line, const LineInterval& part, const Visit& visit) {
    double share = part.first;
    const auto next_line = [](double at, double delta) {
        if (delta == 0.0) { return std::numeric_limits<double>::infinity(); }
        const double whole = delta > 0.0 ? std::floor(at) + 1.0 : std::ceil(at) - 1.0;
        return (whole - at) / delta;
    };
    constexpr double min_step = 1e-12;
    while (share < part.last) {
        const glm::dvec2 at = line.start + line.delta * share;
        const double step = std::max(std::min(next_line(at.x, line.delta.x), next_line(at.y, line.delta.y)), min_step);
        const double length = std::min(step, part.last - share);
        CellPosition cell = cell_at(ground, at + line.delta * (0.5 * length));
        cell.east = at.x - cell.column;
        cell.north = at.y - cell.row;
        if (visit(clearance_over(ground, line, cell, share), share, length)) { return; }
        share += length;
    }
}

/// The part of a line that has ground below it.
LineInterval interval_over_ground(const GroundSamples& ground, const Line& line) {
    LineInterval part;
    clip_interval(part, line.start.x, line.delta.x, 0.0, ground.columns() - 1);
    clip_interval(part, line.start.y, line.delta.y, 0.0, ground.rows() - 1);
    return part;
}

/// The point of the ground below a point of a line.
glm::dvec3 ground_point(const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double share) {
    const glm::dvec3 at_m = from_m + (to_m - from_m) * share;
    const glm::dvec2 half_m = ground.half_extent_m();
    const double x_m = std::clamp(at_m.x, -half_m.x, half_m.x);
    const double y_m = std::clamp(at_m.y, -half_m.y, half_m.y);
    return {x_m, y_m, ground_height_m(ground, x_m, y_m).value_or(0.0)};
}

/// The line from `from_m` to `to_m`, where `to_m` is lowered by curvature already.
Line line_between(const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m) {
    const glm::dvec2 start = ground.grid_from_world(from_m.x, from_m.y);
    const glm::dvec2 level_m = glm::dvec2(to_m) - glm::dvec2(from_m);
    return {start, level_m / ground.spacing_m(), from_m.z, to_m.z - from_m.z,
        curvature_drop_m(glm::dot(level_m, level_m), radius_m)};
}

} // namespace

std::optional<double> ground_height_m(const GroundSamples& ground, double x_m, double y_m) {
    return models::heights::bilinear_height_m(ground, x_m, y_m);
}

LineOfSight line_of_sight(
    const GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m) {
    glm::dvec3 lowered_m = to_m;
    const glm::dvec2 level_m = glm::dvec2(to_m) - glm::dvec2(from_m);
    lowered_m.z -= curvature_drop_m(glm::dot(level_m, level_m), radius_m);
    const Line line = line_between(ground, from_m, lowered_m, radius_m);
    LineOfSight sight;
    sight.clearance_m = std::numeric_limits<double>::infinity();
    double argmin = 0.0;
    for_each_cell(
        ground, line, interval_over_ground(ground, line), [&](const ClearanceCurve& gap, double share, double length) {
            const double t = gap.argmin(length);
            if (gap.at(t) < sight.clearance_m) {
                sight.clearance_m = gap.at(t);
                argmin = share + t;
            }
            if (gap.at(t) < -clearance_tolerance_m && !sight.blocked_at_m) {
                sight.visible = false;
                sight.blocked_at_m = ground_point(ground, from_m, to_m, share + gap.first_zero(length));
            }
            return false;
        });
    if (std::isfinite(sight.clearance_m)) { sight.min_clearance_at_m = ground_point(ground, from_m, to_m, argmin); }
    return sight;
}

std::optional<glm::dvec3> intersect_ground(const GroundSamples& ground, const glm::dvec3& from_m,
    const glm::dvec3& direction, double reach_m, double radius_m) {
    const glm::dvec3 to_m = from_m + direction * reach_m;
    const Line line = line_between(ground, from_m, to_m, radius_m);
    LineInterval part = interval_over_ground(ground, line);
    // Above the highest sample there is nothing to meet, because curvature only lowers the ground.
    clip_interval(part, line.start_m, line.climb_m, -std::numeric_limits<double>::infinity(), ground.highest_m());
    std::optional<glm::dvec3> hit_m;
    for_each_cell(ground, line, part, [&](const ClearanceCurve& gap, double share, double length) {
        if (gap.at(gap.argmin(length)) >= -clearance_tolerance_m) { return false; }
        hit_m = ground_point(ground, from_m, to_m, share + gap.first_zero(length));
        return true;
    });
    return hit_m;
}

} // namespace octant::visuals::terrain
