#include "models/polygons/polygon_model.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

std::array<int, 3> step_of(const glm::vec3& colour) {
    constexpr float steps = 31.0F;
    return {static_cast<int>(colour.x * steps + 0.5F), static_cast<int>(colour.y * steps + 0.5F),
        static_cast<int>(colour.z * steps + 0.5F)};
}

} // namespace

PolygonModel polygons_from_mesh(const TriangleMesh& mesh) {
    PolygonModel model;
    model.name = mesh.name;
    model.vertices_m = mesh.vertices_m;
    model.parts = {"default"};
    std::map<std::pair<std::array<int, 3>, float>, std::uint32_t> materials;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 colour = mean_colour(mesh, t);
        const std::uint32_t material = mesh.materials.empty() ? invalid_index : mesh.triangle_materials[t];
        const float opacity = material < mesh.materials.size() ? mesh.materials[material].opacity : 1.0F;
        const auto [place, is_new] =
            materials.try_emplace({step_of(colour), opacity}, static_cast<std::uint32_t>(model.materials.size()));
        if (is_new) {
            model.materials.push_back(
                {.name = fmt::format("colour-{}", place->second + 1), .colour = colour, .opacity = opacity});
        }
        const auto first = static_cast<std::uint32_t>(model.corner_vertices.size());
        model.corner_vertices.insert(model.corner_vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
        model.polygons.push_back({first, 3, place->second, 0});
    }
    return model;
}

void append_polygons(PolygonModel& to, const PolygonModel& from, std::uint32_t part) {
    const auto first_vertex = static_cast<std::uint32_t>(to.vertices_m.size());
    const auto first_corner = static_cast<std::uint32_t>(to.corner_vertices.size());
    const auto first_material = static_cast<std::uint32_t>(to.materials.size());
    to.vertices_m.insert(to.vertices_m.end(), from.vertices_m.begin(), from.vertices_m.end());
    to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
    for (const std::uint32_t vertex : from.corner_vertices) { to.corner_vertices.push_back(first_vertex + vertex); }
    for (Polygon polygon : from.polygons) {
        polygon.first_corner += first_corner;
        polygon.material += first_material;
        polygon.part = part;
        to.polygons.push_back(polygon);
    }
}

TriangleMesh mesh_from_polygons(const PolygonModel& polygons) {
    TriangleMesh mesh;
    mesh.name = polygons.name;
    mesh.vertices_m = polygons.vertices_m;
    for (std::size_t p = 0; p < polygons.polygons.size(); ++p) {
        const auto corners = polygons.corners(p);
        for (std::size_t k = 2; k < corners.size(); ++k) {
            mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
        }
    }
    return mesh;
}

namespace {

/// What two polygons have in common where one repeats the other: the part that turns them, and the places of their
/// corners from the least one on.
struct Key {
    std::uint32_t turns_with = 0; ///< 0: nothing
    std::vector<std::array<double, 3>> places;

    auto operator<=>(const Key&) const = default;
};

Key key_of(const PolygonModel& model, std::size_t polygon) {
    Key key;
    const auto pivot = pivot_of(model, polygon);
    key.turns_with = pivot ? *pivot + 1 : 0;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const glm::dvec3& at = model.vertices_m[vertex];
        key.places.push_back({at.x + 0.0, at.y + 0.0, at.z + 0.0}); // no negative zeros
    }
    std::rotate(key.places.begin(), std::ranges::min_element(key.places), key.places.end());
    return key;
}

} // namespace

std::vector<std::uint32_t> distinct_polygons(const PolygonModel& model) {
    std::map<Key, std::uint32_t> last;
    for (std::uint32_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
        last.insert_or_assign(key_of(model, polygon), polygon);
    }
    std::vector<std::uint32_t> kept;
    for (const auto& [key, polygon] : last) { kept.push_back(polygon); }
    std::ranges::sort(kept);
    return kept;
}

namespace {

constexpr double flatness = 1e-4;

/// Area over squared extent below which a polygon is a line.
constexpr double min_area_share = 1e-9;

using Corners = std::span<const glm::dvec3>;

std::vector<glm::dvec3> corners_of(const PolygonModel& model, std::size_t polygon) {
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t vertex : model.corners(polygon)) { corners.push_back(model.vertices_m[vertex]); }
    return corners;
}

std::optional<std::string> repeated_corner(Corners corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            if (corners[i] == corners[j]) {
                return fmt::format("expected corners in different places, got corners {} and {} in one", i + 1, j + 1);
            }
        }
    }
    return std::nullopt;
}

glm::dvec3 double_area_vector(Corners corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

/// The mean of some points.
glm::dvec3 middle_of(Corners corners) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : corners) {
        sum += corner - corners[0]; // far from the origin, no digits are lost
    }
    return corners[0] + sum / static_cast<double>(corners.size());
}

/// The diameter of the sphere about the mean of some points that holds all of them: the same whichever way they are
/// turned, as the box around them is not.
double extent_of(Corners corners) {
    const glm::dvec3 middle = middle_of(corners);
    double farthest_m = 0.0;
    for (const glm::dvec3& corner : corners) { farthest_m = std::max(farthest_m, glm::distance(corner, middle)); }
    return 2.0 * farthest_m;
}

std::optional<std::string> bent(Corners corners, const glm::dvec3& normal, double tolerance_m) {
    const glm::dvec3 middle = middle_of(corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double off_m = std::abs(glm::dot(corners[i] - middle, normal));
        if (off_m > tolerance_m) {
            return fmt::format("expected a planar polygon (within {:.3g} m), got corner {} {:.3g} m off the plane",
                tolerance_m, i + 1, off_m);
        }
    }
    return std::nullopt;
}

/// With every corner on the inner side of every edge's line the outline turns one way, once.
std::optional<std::string> dented(Corners corners, const glm::dvec3& normal, double tolerance_m) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = (i + 1) % corners.size();
        const glm::dvec3 inward = glm::cross(normal, glm::normalize(corners[next] - corners[i]));
        for (std::size_t j = 0; j < corners.size(); ++j) {
            const double outside_m = -glm::dot(corners[j] - corners[i], inward);
            if (outside_m > tolerance_m) {
                return fmt::format("expected a convex polygon, got corner {} {:.3g} m outside the edge from "
                                   "corner {} to {}",
                    j + 1, outside_m, i + 1, next + 1);
            }
        }
    }
    return std::nullopt;
}

} // namespace

double flatness_tolerance_m(const PolygonModel& model) {
    return model.vertices_m.empty() ? 0.0 : flatness * extent_of(model.vertices_m);
}

std::optional<std::string> outline_fault(std::span<const glm::dvec3> corners_m) {
    assert(corners_m.size() >= 3);
    if (auto fault = repeated_corner(corners_m)) { return fault; }
    if (is_line(corners_m)) { return "expected a polygon with an area, got corners on one line"; }
    return std::nullopt;
}

bool is_line(std::span<const glm::dvec3> corners_m) {
    const double extent_m = extent_of(corners_m);
    return glm::length(double_area_vector(corners_m)) * 0.5 <= min_area_share * extent_m * extent_m;
}

bool is_planar(std::span<const glm::dvec3> corners_m, double tolerance_m) {
    return !bent(corners_m, glm::normalize(double_area_vector(corners_m)), tolerance_m);
}

std::optional<std::string> corners_fault(std::span<const glm::dvec3> corners_m, double tolerance_m) {
    if (auto fault = outline_fault(corners_m)) { return fault; }
    const glm::dvec3 normal = glm::normalize(double_area_vector(corners_m));
    if (auto fault = bent(corners_m, normal, tolerance_m)) { return fault; }
    return dented(corners_m, normal, tolerance_m);
}

std::optional<std::string> polygon_fault(const PolygonModel& model, std::size_t polygon, double tolerance_m) {
    return corners_fault(corners_of(model, polygon), tolerance_m);
}

glm::dvec3 normal_of(const PolygonModel& model, std::size_t polygon) {
    const auto corners = model.corners(polygon);
    assert(corners.size() >= 3);
    // Taken from the first corner, so that a small polygon far from the origin keeps its digits.
    const glm::dvec3& origin_m = model.vertices_m[corners[0]];
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(model.vertices_m[corners[i]] - origin_m, model.vertices_m[corners[i + 1]] - origin_m);
    }
    return glm::normalize(sum);
}

Plane plane_of(const PolygonModel& model, std::size_t polygon) {
    const glm::dvec3 normal = normal_of(model, polygon);
    glm::dvec3 middle_m(0.0);
    for (const std::uint32_t vertex : model.corners(polygon)) { middle_m += model.vertices_m[vertex]; }
    middle_m /= static_cast<double>(model.corners(polygon).size());
    return {normal, -glm::dot(normal, middle_m)};
}

std::optional<std::uint32_t> pivot_of(const PolygonModel& model, std::size_t polygon) {
    for (std::size_t i = 0; i < model.pivots.size(); ++i) {
        if (model.pivots[i].part == model.polygons[polygon].part) { return static_cast<std::uint32_t>(i); }
    }
    return std::nullopt;
}

glm::dvec3 turned(const Pivot& pivot, const glm::dvec3& point_m, double angle_rad) {
    return pivot.point_m + glm::angleAxis(angle_rad, pivot.axis) * (point_m - pivot.point_m);
}

double radius_m(const PolygonModel& model) {
    double largest = 0.0;
    for (const glm::dvec3& vertex_m : model.vertices_m) { largest = std::max(largest, glm::dot(vertex_m, vertex_m)); }
    return std::sqrt(largest);
}

} // namespace octant::models::polygons
