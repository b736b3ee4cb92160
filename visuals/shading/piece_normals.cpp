// Normals inside polygons by mean value coordinates: M. S. Floater, "Mean value coordinates", Computer Aided Geometric
// Design 20 (1), 2003, equation (2.1).
//
// Gouraud shading interpolates between a polygon's corners. When the 1989 paper's painting order needs a polygon cut in
// two (section IV, figure 14), new corners appear, and normals computed from the pieces would show the cut. So each new
// corner takes its normal from the uncut polygon: weight of corner i = (tan(a_(i-1) / 2) + tan(a_i / 2)) / |corner i -
// point|, where a_i is the angle under which the point sees the side from corner i to corner i + 1.
//
// Deviations: at corners and on sides, where the equation divides by 0, its limit is taken.
#include "visuals/shading/piece_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace octant::visuals::shading {

namespace {

/// Two points closer than this share of the side's length are the same point.
constexpr double same_place = 1e-9;

/// The corners of one uncut polygon in order, with a unit normal for each.
struct Outline {
    std::vector<glm::dvec3> places_m;
    std::vector<glm::dvec3> normals;
};

/// How far a point lies outside a polygon, metres: the larger of its distance from the plane and its distance beyond
/// any side. 0 for a point inside.
double outside_m(const models::polygons::PolygonModel& model, std::size_t polygon, const glm::dvec3& point_m) {
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const auto corners = model.corners(polygon);
    double max_m = std::abs(distance_m(models::polygons::plane_of(model, polygon), point_m));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& here_m = model.vertices_m[corners[i]];
        const glm::dvec3& next_m = model.vertices_m[corners[(i + 1) % corners.size()]];
        const glm::dvec3 outwards = glm::normalize(glm::cross(next_m - here_m, normal));
        max_m = std::max(max_m, glm::dot(outwards, point_m - here_m));
    }
    return max_m;
}

/// The index of that candidate polygon of `whole` in which a point lies, or which is nearest to it. Several candidates
/// occur when the file's polygon had already been cut into convex parts.
std::size_t polygon_around(
    const models::polygons::PolygonModel& whole, std::span<const std::size_t> candidates, const glm::dvec3& point_m) {
    std::size_t best = candidates.front();
    double min_m = std::numeric_limits<double>::max();
    for (const std::size_t candidate : candidates) {
        const double outside = outside_m(whole, candidate, point_m);
        if (outside < min_m) {
            min_m = outside;
            best = candidate;
        }
    }
    return best;
}

/// The tangent of half the angle between two vectors. Returns -1 where they point in opposite directions, that is,
/// where the point lies on the side between their ends.
double half_tangent(const glm::dvec3& one, const glm::dvec3& other) {
    const double lengths = glm::length(one) * glm::length(other);
    const double sine = glm::length(glm::cross(one, other));
    const double below = lengths + glm::dot(one, other);
    return below <= same_place * lengths ? -1.0 : sine / below;
}

/// Equation (2.1) for a point inside an outline. The result is not yet of unit length.
glm::dvec3 normal_at(const Outline& outline, const glm::dvec3& point_m) {
    const std::size_t count = outline.places_m.size();
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const glm::dvec3 here_m = outline.places_m[i] - point_m;
        const glm::dvec3 next_m = outline.places_m[next] - point_m;
        const double here_away_m = glm::length(here_m);
        const double next_away_m = glm::length(next_m);
        const double side_m = glm::distance(here_m, next_m);
        if (here_away_m <= same_place * side_m) { return outline.normals[i]; }
        if (next_away_m <= same_place * side_m) { return outline.normals[next]; }
        const double tangent = half_tangent(here_m, next_m);
        if (tangent < 0.0) { return (next_away_m * outline.normals[i] + here_away_m * outline.normals[next]) / side_m; }
        sum += tangent * (outline.normals[i] / here_away_m + outline.normals[next] / next_away_m);
    }
    return sum;
}

Outline outline_of(
    const models::polygons::PolygonModel& model, std::size_t polygon, std::span<const glm::vec3> normals) {
    Outline outline;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const std::size_t corner = model.polygons[polygon].first_corner + outline.places_m.size();
        outline.places_m.push_back(model.vertices_m[vertex]);
        outline.normals.emplace_back(normals[corner]);
    }
    return outline;
}

glm::dvec3 middle_of(const models::polygons::PolygonModel& model, std::size_t polygon) {
    glm::dvec3 sum_m(0.0);
    const auto corners = model.corners(polygon);
    for (const std::uint32_t vertex : corners) { sum_m += model.vertices_m[vertex]; }
    return sum_m / static_cast<double>(corners.size());
}

} // namespace

std::vector<glm::vec3> piece_normals(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> normals,
    const models::polygons::PolygonModel& pieces) {
    assert(normals.size() == whole.corner_vertices.size());
    std::unordered_map<std::uint32_t, std::vector<std::size_t>> of_parent;
    for (std::size_t i = 0; i < whole.polygons.size(); ++i) { of_parent[whole.parent_of(i)].push_back(i); }
    std::vector<glm::vec3> made(pieces.corner_vertices.size());
    for (std::size_t i = 0; i < pieces.polygons.size(); ++i) {
        const auto candidates = of_parent.find(pieces.parent_of(i));
        assert(candidates != of_parent.end());
        const std::size_t polygon = polygon_around(whole, candidates->second, middle_of(pieces, i));
        const Outline outline = outline_of(whole, polygon, normals);
        std::size_t corner = pieces.polygons[i].first_corner;
        for (const std::uint32_t vertex : pieces.corners(i)) {
            const glm::dvec3 normal = normal_at(outline, pieces.vertices_m[vertex]);
            const double length = glm::length(normal);
            made[corner++] = glm::vec3(length > 0.0 ? normal / length : models::polygons::normal_of(whole, polygon));
        }
    }
    return made;
}

} // namespace octant::visuals::shading
