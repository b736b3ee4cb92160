#include "models/triangle_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace octant::models {

namespace {

/// The bits of a number below 2^21, each followed by two zeros.
std::uint64_t spread_bits(std::uint64_t number) {
    constexpr std::pair<int, std::uint64_t> steps[] = {{32, 0x001f00000000ffffU}, {16, 0x001f0000ff0000ffU},
        {8, 0x100f00f00f00f00fU}, {4, 0x10c30c30c30c30c3U}, {2, 0x1249249249249249U}};
    for (const auto& [shift, mask] : steps) { number = (number | number << shift) & mask; }
    return number;
}

/// The place of each vertex on a Morton curve through the bounding box.
std::vector<std::uint64_t> morton_places(const TriangleMesh& mesh) {
    constexpr double cells = (1U << 21U) - 1;
    const BoundingBox bounds = bounds_of(mesh);
    const glm::dvec3 size_m = bounds.max_m - bounds.min_m;
    const double longest_m = std::max({size_m.x, size_m.y, size_m.z, 1e-300});
    std::vector<std::uint64_t> places;
    places.reserve(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        std::uint64_t place = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double share = (vertex_m[axis] - bounds.min_m[axis]) / longest_m;
            const double cell = share > 0.0 ? std::min(share, 1.0) * cells : 0.0; // Also if no number.
            place |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
        }
        places.push_back(place);
    }
    return places;
}

/// The numbers from 0 on, in the order of `keys`; equal keys stay in order.
template <typename Key>
std::vector<std::uint32_t> order_of(const std::vector<Key>& keys) {
    std::vector<std::pair<Key, std::uint32_t>> sorted;
    sorted.reserve(keys.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) { sorted.emplace_back(keys[i], i); }
    std::ranges::sort(sorted);
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const auto& [key, number] : sorted) { order.push_back(number); }
    return order;
}

template <typename Item>
void reorder(std::vector<Item>& items, const std::vector<std::uint32_t>& order) {
    if (items.empty()) { return; }
    std::vector<Item> sorted;
    sorted.reserve(items.size());
    for (const std::uint32_t number : order) { sorted.push_back(items[number]); }
    items = std::move(sorted);
}

} // namespace

BoundingBox bounds_of(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) { return {}; }
    const glm::dvec3& first_m = mesh.vertices_m[mesh.triangles.front()[0]];
    BoundingBox bounds{first_m, first_m};
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            bounds.min_m = glm::min(bounds.min_m, mesh.vertices_m[vertex]);
            bounds.max_m = glm::max(bounds.max_m, mesh.vertices_m[vertex]);
        }
    }
    return bounds;
}

double diagonal_m(const TriangleMesh& mesh) {
    const BoundingBox bounds = bounds_of(mesh);
    return glm::distance(bounds.min_m, bounds.max_m);
}

void sort_spatially(TriangleMesh& mesh) {
    const std::vector<std::uint32_t> order = order_of(morton_places(mesh));
    reorder(mesh.vertices_m, order);
    reorder(mesh.colours, order);
    std::vector<std::uint32_t> numbers(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) { numbers[order[i]] = i; }
    std::vector<std::uint32_t> firsts;
    firsts.reserve(mesh.triangles.size());
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle) { corner = numbers[corner]; }
        firsts.push_back(*std::ranges::min_element(triangle));
    }
    const std::vector<std::uint32_t> triangles = order_of(firsts);
    reorder(mesh.triangles, triangles);
    reorder(mesh.corner_normals, triangles);
    reorder(mesh.corner_texture_coordinates, triangles);
    reorder(mesh.triangle_materials, triangles);
}

glm::dvec3 area_vector(const TriangleMesh& mesh, const Triangle& triangle) {
    const glm::dvec3& first_m = mesh.vertices_m[triangle[0]];
    return glm::cross(mesh.vertices_m[triangle[1]] - first_m, mesh.vertices_m[triangle[2]] - first_m);
}

glm::dvec3 normal_of(const TriangleMesh& mesh, const Triangle& triangle, const glm::dvec3& degenerate_normal) {
    const glm::dvec3 across = area_vector(mesh, triangle);
    const double length = glm::length(across);
    return length > 0.0 ? across / length : degenerate_normal;
}

glm::vec3 material_colour(const TriangleMesh& mesh, std::size_t triangle) {
    return mesh.triangle_materials.empty() ? Material().colour
                                           : mesh.materials[mesh.triangle_materials[triangle]].colour;
}

glm::vec3 mean_colour(const TriangleMesh& mesh, std::size_t triangle) {
    if (mesh.colours.empty()) { return material_colour(mesh, triangle); }
    const Triangle& corners = mesh.triangles[triangle];
    return (mesh.colours[corners[0]] + mesh.colours[corners[1]] + mesh.colours[corners[2]]) / 3.0F;
}

} // namespace octant::models
