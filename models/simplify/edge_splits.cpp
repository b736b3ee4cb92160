// Edge splits, the opposite of collapses: H. Hoppe, T. DeRose, T. Duchamp, J. McDonald,
// W. Stuetzle, "Mesh Optimization", 1993, section 4.2, where they are tried at random.
//
// Deviation: split are the longest edges of the triangles that are farthest off.
#include "models/simplify/edge_splits.h"

#include "models/simplify/ring_heights.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace octant::models::simplify {

namespace {

/// The corner at which a triangle's longest edge starts.
std::uint32_t longest_edge(const TriangleMesh& mesh, const Triangle& triangle) {
    std::uint32_t longest = 0;
    double most2 = -1.0;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const glm::dvec3 side =
            mesh.vertices_m[triangle[(corner + 1) % 3]] - mesh.vertices_m[triangle[corner]];
        const double length2 = glm::dot(side, side);
        if (length2 > most2) {
            most2 = length2;
            longest = corner;
        }
    }
    return longest;
}

/// Lets the edge that a half-edge belongs to run to a new vertex, and adds the triangle behind it.
void split_side(TriangleMesh& mesh, HalfEdge h, std::uint32_t middle) {
    const std::uint32_t face = face_of(h);
    Triangle rest = mesh.triangles[face];
    rest[h % 3] = middle;
    mesh.triangles[face][(h + 1 - 3 * face) % 3] = middle;
    mesh.triangles.push_back(rest);
    if (!mesh.triangle_materials.empty()) {
        mesh.triangle_materials.push_back(mesh.triangle_materials[face]);
    }
}

std::uint32_t add_middle(TriangleMesh& mesh, std::uint32_t one, std::uint32_t other) {
    const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(0.5 * (mesh.vertices_m[one] + mesh.vertices_m[other]));
    if (!mesh.colours.empty()) {
        mesh.colours.push_back(0.5F * (mesh.colours[one] + mesh.colours[other]));
    }
    return middle;
}

} // namespace

std::vector<double> split_needs(
    const WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    SplitBy split_by) {
    RingHeights around(surface, points, target);
    std::vector<double> needs(surface.mesh.face_slots());
    for (std::uint32_t face = 0; face < needs.size(); ++face) {
        around.take_face(face);
        const Heights heights = around.seen({});
        needs[face] = split_by == SplitBy::Peaks ? heights.most2 : heights.squares;
    }
    return needs;
}

TriangleMesh
with_split_edges(const TriangleMesh& mesh, std::span<const double> needs, std::size_t count) {
    TriangleMesh split = mesh;
    split.normals.clear();
    split.corner_normals.clear();
    const CollapsibleMesh edges(mesh.vertices_m.size(), mesh.triangles);
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(
        order, [&](std::uint32_t one, std::uint32_t other) { return needs[one] > needs[other]; });
    std::vector<bool> is_split(mesh.triangles.size(), false);
    for (const std::uint32_t face : order) {
        const HalfEdge h = 3 * face + longest_edge(mesh, mesh.triangles[face]);
        const HalfEdge twin = edges.twin(h);
        if (count == 0 || !(needs[face] > 0.0)) {
            break;
        }
        if (is_split[face] || (twin != none && is_split[face_of(twin)])) {
            continue;
        }
        const std::uint32_t middle = add_middle(split, edges.origin(h), edges.target(h));
        for (const HalfEdge side : {h, twin}) {
            if (side != none) {
                is_split[face_of(side)] = true;
                split_side(split, side, middle);
            }
        }
        --count;
    }
    return split;
}

} // namespace octant::models::simplify
