// Distances between surfaces do not tell where their materials end. Borders are compared as lines:
// each edge is a triangle without area to the tree that finds nearest points.
#include "models/simplify/material_borders.h"

#include "models/measure/triangle_bvh.h"
#include "models/simplify/collapsible_mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace octant::models::simplify {

namespace {

/// About so many samples lie along the borders of a mesh.
constexpr double border_samples = 4'000.0;
/// In the mean no distance counts as more than this share of the diagonal: borders vanish with what
/// is too small for the goal, and that should not hide where the others are.
constexpr double most_counted = 0.004;

/// The edges between triangles of different materials, as triangles whose last corners are one.
std::vector<Triangle> border_lines(const TriangleMesh& mesh) {
    if (!has_material_borders(mesh)) {
        return {};
    }
    const CollapsibleMesh edges(mesh.vertices_m.size(), mesh.triangles);
    const std::vector<std::uint32_t>& materials = mesh.triangle_materials;
    std::vector<Triangle> lines;
    for (HalfEdge h = 0; h < 3 * mesh.triangles.size(); ++h) {
        const HalfEdge twin = edges.twin(h);
        if (twin != none && h < twin && materials[face_of(h)] != materials[face_of(twin)]) {
            lines.push_back({edges.origin(h), edges.target(h), edges.target(h)});
        }
    }
    return lines;
}

/// One way, from evenly spread samples of each line.
BorderDistance one_way(
    const TriangleMesh& mesh,
    const std::vector<Triangle>& lines,
    const measure::TriangleBvh& tree,
    double most_counted_m) {
    const auto& at = mesh.vertices_m;
    double length_m = 0.0;
    for (const auto& [start, end, again] : lines) {
        length_m += glm::distance(at[start], at[end]);
    }
    double sum = 0.0;
    double most2 = 0.0;
    for (const auto& [start, end, again] : lines) {
        const double line_m = glm::distance(at[start], at[end]);
        const double wanted = length_m > 0.0 ? border_samples * line_m / length_m : 0.0;
        const auto count = 1 + static_cast<std::size_t>(wanted);
        for (std::size_t i = 0; i < count; ++i) {
            const double along = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
            const double distance2 =
                tree.nearest(at[start] + along * (at[end] - at[start])).distance2;
            sum += line_m / static_cast<double>(count) *
                   std::min(distance2, most_counted_m * most_counted_m);
            most2 = std::max(most2, distance2);
        }
    }
    return {std::sqrt(most2), length_m > 0.0 ? std::sqrt(sum / length_m) : 0.0};
}

} // namespace

bool BorderDistance::keeps(const BorderDistance& other) const {
    constexpr double hardly = 1.05;
    return most_m <= hardly * other.most_m && rms_m <= hardly * other.rms_m;
}

bool has_material_borders(const TriangleMesh& mesh) {
    return std::ranges::adjacent_find(mesh.triangle_materials, std::ranges::not_equal_to()) !=
           mesh.triangle_materials.end();
}

BorderDistance material_border_distance(const TriangleMesh& mesh, const TriangleMesh& original) {
    const std::vector<Triangle> lines = border_lines(mesh);
    const std::vector<Triangle> original_lines = border_lines(original);
    if (lines.empty() || original_lines.empty()) {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        return lines.empty() && original_lines.empty() ? BorderDistance{}
                                                       : BorderDistance{infinite, infinite};
    }
    const double most_counted_m = most_counted * diagonal_m(original);
    const measure::TriangleBvh tree(mesh.vertices_m, lines);
    const measure::TriangleBvh original_tree(original.vertices_m, original_lines);
    const BorderDistance there = one_way(original, original_lines, tree, most_counted_m);
    BorderDistance found = one_way(mesh, lines, original_tree, most_counted_m);
    found.rms_m = std::max(found.rms_m, there.rms_m);
    return found;
}

} // namespace octant::models::simplify
