// Corner normals by crease angle (models/smooth_normals.h). Kim and Park's hybrid rendering model (2008) takes vertex
// normals for given; Gouraud shading needs them, and a model file need not bring any.
//
// Deviations: the paper counts 4 operations for a plain average of the faces around a vertex; here the average is
// weighted by angles, and edges sharper than the crease angle stay sharp.
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>

namespace octant::visuals::shading {

// Normals inside polygons by mean value coordinates: M. S. Floater, "Mean value coordinates", Computer Aided Geometric
// Design 20 (1), 2003, equation (2.1).
//
// Gouraud shading interpolates between a polygon's corners. When the 1989 paper's painting order needs a polygon cut in
// two (section IV, figure 14), new corners appear, and normals computed from the pieces would show the cut. So each new
// corner takes its normal from the uncut polygon: weight of corner i = (tan(a_(i-1) / 2) + tan(a_i / 2)) / |corner i -
// point|, where a_i is the angle under which the point sees the side from corner i to corner i + 1.
//
// Deviations: at corners and on sides, where the equation divides by 0, its limit is taken.

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

namespace {

/// Calls set(corner, value, polygon) for each corner of `pieces`: the mixture of the values at the corners of its
/// polygon of `whole`, whose index is `polygon`.
template <class Set>
void for_each_piece_corner(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> values,
    const models::polygons::PolygonModel& pieces, const Set& set) {
    assert(values.size() == whole.corner_vertices.size());
    std::unordered_map<std::uint32_t, std::vector<std::size_t>> of_parent;
    for (std::size_t i = 0; i < whole.polygons.size(); ++i) { of_parent[whole.parent_of(i)].push_back(i); }
    for (std::size_t i = 0; i < pieces.polygons.size(); ++i) {
        const auto candidates = of_parent.find(pieces.parent_of(i));
        assert(candidates != of_parent.end());
        const std::size_t polygon = polygon_around(whole, candidates->second, middle_of(pieces, i));
        const Outline outline = outline_of(whole, polygon, values);
        std::size_t corner = pieces.polygons[i].first_corner;
        for (const std::uint32_t vertex : pieces.corners(i)) {
            set(corner++, normal_at(outline, pieces.vertices_m[vertex]), polygon);
        }
    }
}

} // namespace

std::vector<glm::vec3> piece_normals(const models::polygons::PolygonModel& whole, std::span<const glm::vec3> normals,
    const models::polygons::PolygonModel& pieces) {
    std::vector<glm::vec3> made(pieces.corner_vertices.size());
    for_each_piece_corner(
        whole, normals, pieces, [&](std::size_t corner, const glm::dvec3& normal, std::size_t polygon) {
            const double length = glm::length(normal);
            made[corner] = glm::vec3(length > 0.0 ? normal / length : models::polygons::normal_of(whole, polygon));
        });
    return made;
}

std::vector<glm::vec2> piece_texture_coordinates(
    const models::polygons::PolygonModel& whole, const models::polygons::PolygonModel& pieces) {
    assert(whole.corner_texture_coordinates.size() == whole.corner_vertices.size());
    std::vector<glm::vec3> values; // the third part counts the weights
    for (const glm::vec2& place : whole.corner_texture_coordinates) { values.emplace_back(place.x, place.y, 1.0F); }
    std::vector<glm::vec2> made(pieces.corner_vertices.size());
    for_each_piece_corner(whole, values, pieces, [&](std::size_t corner, const glm::dvec3& sum, std::size_t) {
        made[corner] = glm::vec2(glm::dvec2(sum.x, sum.y) / sum.z);
    });
    return made;
}

namespace {

/// For each vertex the lowest number of a vertex at exactly the same position.
std::vector<std::uint32_t> places_of(std::span<const glm::dvec3> vertices_m) {
    std::vector<std::uint32_t> sorted(vertices_m.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    const auto key = [&](std::uint32_t v) { return std::tuple(vertices_m[v].x, vertices_m[v].y, vertices_m[v].z, v); };
    std::ranges::sort(sorted, {}, key);
    std::vector<std::uint32_t> places(vertices_m.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool again = i > 0 && vertices_m[sorted[i]] == vertices_m[sorted[i - 1]];
        places[sorted[i]] = again ? places[sorted[i - 1]] : sorted[i];
    }
    return places;
}

/// The group of faces that do not turn. Those of the first pivot have the next one, and so on.
constexpr std::uint32_t fixed = models::Smoothing::flat + 1;

} // namespace

std::vector<glm::vec3> corner_normals(const models::polygons::PolygonModel& model, double crease_rad) {
    assert(crease_rad >= 0.0 && crease_rad <= pi);
    const std::vector<std::uint32_t> places = places_of(model.vertices_m);
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t vertex : model.corner_vertices) { corners.push_back(places[vertex]); }
    std::vector<models::SmoothFace> faces;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const models::polygons::Polygon& polygon = model.polygons[i];
        const auto pivot = models::polygons::pivot_of(model, i);
        faces.push_back({std::span(corners).subspan(polygon.first_corner, polygon.corner_count),
            models::polygons::normal_of(model, i),
            {pivot ? fixed + 1 + static_cast<std::uint32_t>(*pivot) : fixed, static_cast<float>(crease_rad)}});
    }
    std::vector<glm::vec3> normals = models::smooth_normals(faces, model.vertices_m);
    if (model.corner_normals.size() != normals.size()) { return normals; } // pieces of a model have none
    for (std::size_t corner = 0; corner < normals.size(); ++corner) {
        if (model.corner_normals[corner] != glm::vec3(0.0F)) { normals[corner] = model.corner_normals[corner]; }
    }
    return normals;
}

std::vector<glm::vec3> corner_normals(const models::TriangleMesh& mesh, double crease_rad) {
    assert(crease_rad >= 0.0 && crease_rad <= pi);
    const std::vector<std::uint32_t> places = places_of(mesh.vertices_m);
    std::vector<models::Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles) { triangles.push_back({places[a], places[b], places[c]}); }
    std::vector<models::SmoothFace> faces;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        faces.push_back(
            {triangles[t], models::normal_of(mesh, mesh.triangles[t]), {fixed, static_cast<float>(crease_rad)}});
    }
    return models::smooth_normals(faces, mesh.vertices_m);
}

} // namespace octant::visuals::shading
