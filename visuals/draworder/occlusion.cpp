// The exact hiding test; its derivation stands at OcclusionTest. It replaces steps 2 to 4 of the 1989 paper
// (paper_rule.cpp), which compare two polygons as seen from one viewpoint, by a test that is right for every eye of a
// region.
#include "visuals/draworder/occlusion.h"

#include "visuals/separation/convex_separation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::draworder {

namespace {

constexpr double rounding = 1e-12;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Whether the sine of the angle from one vector to another, which make a negative cross product, is so by more than
/// rounding, given the square of the length of one of them; the other is a unit.
bool is_clear(double product, double square) {
    return square > rounding * rounding && product * product > rounding * rounding * square;
}

/// An angular sector of at most half a turn, counter-clockwise from `low` to `high`.
class Sector {
public:
    Sector(const glm::dvec2& low, const glm::dvec2& high) : lowlink_(low), high_(high) {}

    /// Widens the sector to contain a direction; false when it would exceed half a turn.
    bool take(const glm::dvec2& direction) {
        const double past_low = cross(lowlink_, direction);
        const double past_high = cross(direction, high_);
        if (past_low >= 0.0 && past_high >= 0.0) { return true; }
        const double square = glm::dot(direction, direction);
        const bool below = past_low < 0.0 && is_clear(past_low, square);
        const bool above = past_high < 0.0 && is_clear(past_high, square);
        if (below && above) { return false; }
        if (below) {
            lowlink_ = direction / std::sqrt(square);
        } else if (above) {
            high_ = direction / std::sqrt(square);
        }
        return true;
    }

private:
    glm::dvec2 lowlink_;
    glm::dvec2 high_;
};

} // namespace

bool OcclusionTest::possible(const Face& b, const Face& a) const {
    if (a.plane && behind_or_on(b, *a.plane, tolerances_.on_plane)) { return false; }
    if (!b.plane) { return true; }
    const Plane back{-b.plane->normal, -b.plane->offset_m};
    return !behind_or_on(a, back, tolerances_.on_plane);
}

bool OcclusionTest::occludes(const Face& b, const Face& a, std::span<const glm::dvec4> eyes) {
    if (!a.plane || !b.plane) { return !separation::separable(b.corners, a.corners, eyes); }
    find_crossings(b, a, eyes);
    if (crossings_.empty()) { return false; }
    for (std::size_t corner = 0; corner < b.flat.size(); ++corner) {
        if (is_separated_at(b, corner)) { return false; }
    }
    return true;
}

void OcclusionTest::find_crossings(const Face& b, const Face& a, std::span<const glm::dvec4> eyes) {
    behind_.clear();
    crossings_.clear();
    const auto flat_of = [&](const glm::dvec3& at) { return glm::dvec2(glm::dot(at, b.right), glm::dot(at, b.up)); };
    const double limit = -tolerances_.on_plane;
    glm::dvec3 last = a.corners.back();
    double last_height = distance_m(*b.plane, last);
    for (const glm::dvec3& corner : a.corners) {
        const double height = distance_m(*b.plane, corner);
        if ((height < limit) != (last_height < limit)) {
            const double share = (limit - last_height) / (height - last_height);
            behind_.emplace_back(flat_of(last + (corner - last) * share), -limit);
        }
        if (height < limit) { behind_.emplace_back(flat_of(corner), -height); }
        last = corner;
        last_height = height;
    }
    for (const glm::dvec4& eye : eyes) {
        const glm::dvec3 at(eye.x, eye.y, eye.z);
        const double raw = glm::dot(b.plane->normal, at) + b.plane->offset_m * eye.w;
        const double height = raw < 1e-10 ? 0.0 : raw;
        const glm::dvec2 flat = flat_of(at);
        for (const glm::dvec3& corner : behind_) {
            const double depth = corner.z;
            const double scale = 1.0 / (height + depth);
            crossings_.emplace_back(
                (glm::dvec2(corner) * height + flat * depth) * scale, (height + depth * eye.w) * scale);
        }
    }
}

bool OcclusionTest::is_separated_at(const Face& b, std::size_t corner) const {
    const glm::dvec2 at = b.flat[corner];
    const glm::dvec2 to_next = b.edge_directions[corner];
    const glm::dvec2 from_last = b.edge_directions[(corner == 0 ? b.edge_directions.size() : corner) - 1];
    if (cross(from_last, to_next) < 0.0) {
        return false; // dented by rounding: lines past its neighbours serve as well
    }
    Sector sector(-to_next, from_last);
    return std::ranges::all_of(
        crossings_, [&](const glm::dvec3& point) { return sector.take(glm::dvec2(point.x, point.y) - at * point.z); });
}

} // namespace octant::visuals::draworder
