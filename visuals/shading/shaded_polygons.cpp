// Prepares polygons for selection, once when a model is loaded. Kim and Park's hybrid rendering model (2008), section
// 3, asks two things of a polygon: its size, which is the sum of its edge lengths, and its corners with their vertex
// normals.
//
// Deviations: areas, centroids and triangle fans are kept as well, for the rule Error; polygons with more than three
// corners stay whole and keep all their edges in the sum.
#include "visuals/shading/shaded_polygons.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace octant::visuals::shading {

namespace {

float sum_of(const glm::vec3& colour) { return colour.x + colour.y + colour.z; }

auto sort_key(const ShadingPoint& point) {
    return std::tuple(point.place_m.x, point.place_m.y, point.place_m.z, point.normal.x, point.normal.y, point.normal.z,
        point.colour_sum);
}

/// Merges corners that are equal in position, normal and colour into one ShadingPoint each, numbered in the order in
/// which they first occur, and fills `shaded.points` and `corner_points`.
void share_points(std::span<const ShadingPoint> corners, ShadedPolygons& shaded) {
    std::vector<std::uint32_t> sorted(corners.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::sort(sorted, {}, [&](std::uint32_t c) { return std::tuple(sort_key(corners[c]), c); });
    std::vector<std::uint32_t> first(corners.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool again = i > 0 && sort_key(corners[sorted[i]]) == sort_key(corners[sorted[i - 1]]);
        first[sorted[i]] = again ? first[sorted[i - 1]] : sorted[i];
    }
    shaded.corner_points.resize(corners.size());
    for (std::uint32_t c = 0; c < corners.size(); ++c) {
        if (first[c] == c) {
            shaded.corner_points[c] = static_cast<std::uint32_t>(shaded.points.size());
            shaded.points.push_back(corners[c]);
        } else {
            shaded.corner_points[c] = shaded.corner_points[first[c]];
        }
    }
}

/// Computes perimeter, area, centroid, mean colour and triangle fan of one polygon from its corners.
void measure(ShadedPolygon& polygon, std::span<const ShadingPoint> corners, std::span<float> fan_m2) {
    const glm::vec3& first_m = corners.front().place_m;
    glm::vec3 weighted(0.0F);
    glm::vec3 mean(0.0F);
    float colour = 0.0F;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3& here_m = corners[i].place_m;
        const glm::vec3& next_m = corners[(i + 1) % corners.size()].place_m;
        polygon.perimeter_m += glm::distance(here_m, next_m);
        colour += corners[i].colour_sum;
        mean += here_m;
        fan_m2[i] = 0.5F * glm::length(glm::cross(here_m - first_m, next_m - first_m));
        polygon.area_m2 += fan_m2[i];
        weighted += fan_m2[i] / 3.0F * (first_m + here_m + next_m);
    }
    const auto count = static_cast<float>(corners.size());
    polygon.colour_sum = colour / count;
    polygon.centre_m = polygon.area_m2 > 0.0F ? weighted / polygon.area_m2 : mean / count;
}

/// Sets the centre and the radius of a sphere around all points.
void compute_bounds(ShadedPolygons& shaded) {
    if (shaded.points.empty()) { return; }
    glm::vec3 min_m(std::numeric_limits<float>::max());
    glm::vec3 max_m = -min_m;
    for (const ShadingPoint& point : shaded.points) {
        min_m = glm::min(min_m, point.place_m);
        max_m = glm::max(max_m, point.place_m);
    }
    shaded.centre_m = 0.5F * (min_m + max_m);
    for (const ShadingPoint& point : shaded.points) {
        shaded.radius_m = std::max(shaded.radius_m, glm::distance(point.place_m, shaded.centre_m));
    }
}

/// Completes `shaded`, whose polygons have only their normal, first_corner and corner_count so far.
ShadedPolygons normalised(ShadedPolygons shaded, std::span<const ShadingPoint> corners) {
    shaded.fan_m2.resize(corners.size());
    double perimeters_m = 0.0;
    for (ShadedPolygon& polygon : shaded.polygons) {
        measure(polygon, corners.subspan(polygon.first_corner, polygon.corner_count),
            std::span(shaded.fan_m2).subspan(polygon.first_corner, polygon.corner_count));
        perimeters_m += polygon.perimeter_m;
    }
    if (shaded.size() > 0) { shaded.mean_perimeter_m = perimeters_m / static_cast<double>(shaded.size()); }
    share_points(corners, shaded);
    compute_bounds(shaded);
    return shaded;
}

float colour_sum(const models::TriangleMesh& mesh, std::size_t triangle, std::uint32_t vertex) {
    return sum_of(mesh.colours.empty() ? models::material_colour(mesh, triangle) : mesh.colours[vertex]);
}

} // namespace

ShadedPolygons shaded_polygons(const models::polygons::PolygonModel& model, std::span<const glm::vec3> corner_normals) {
    assert(corner_normals.size() == model.corner_vertices.size());
    ShadedPolygons shaded;
    std::vector<ShadingPoint> corners(model.corner_vertices.size());
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const models::polygons::Polygon& polygon = model.polygons[i];
        shaded.polygons.push_back({.normal = glm::vec3(models::polygons::normal_of(model, i)),
            .first_corner = polygon.first_corner,
            .corner_count = polygon.corner_count});
        for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
            const std::uint32_t corner = polygon.first_corner + k;
            corners[corner] = {glm::vec3(model.vertices_m[model.corner_vertices[corner]]), corner_normals[corner],
                sum_of(model.materials[polygon.material].colour)};
        }
    }
    return normalised(std::move(shaded), corners);
}

ShadedPolygons shaded_polygons(const models::TriangleMesh& mesh, std::span<const glm::vec3> corner_normals) {
    assert(corner_normals.size() == 3 * mesh.triangles.size());
    ShadedPolygons shaded;
    std::vector<ShadingPoint> corners;
    corners.reserve(corner_normals.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const models::Triangle& triangle = mesh.triangles[i];
        shaded.polygons.push_back({.normal = glm::vec3(models::normal_of(mesh, triangle, {0.0, 0.0, 1.0})),
            .first_corner = static_cast<std::uint32_t>(corners.size()),
            .corner_count = 3});
        for (const std::uint32_t vertex : triangle) {
            corners.push_back(
                {glm::vec3(mesh.vertices_m[vertex]), corner_normals[corners.size()], colour_sum(mesh, i, vertex)});
        }
    }
    return normalised(std::move(shaded), corners);
}

} // namespace octant::visuals::shading
