// Finds defects by sorting. All sides of all triangles are sorted by their vertices, so that the sides of one edge are
// neighbours in the list. Two union-find structures follow: one joins corners at the same vertex across edges (a vertex
// with more than one set of corners is not a manifold), the other joins triangles (each set is a shell). The genus of a
// closed oriented manifold follows from Euler's formula V - E + F = 2 (shells - genus).
#include "models/measure/mesh_defects.h"

#include "models/mesh_edges.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::measure {

namespace {

bool repeats_vertex(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return a == b || b == c || c == a;
}

bool is_flat(const TriangleMesh& mesh, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = mesh.vertices_m[b] - mesh.vertices_m[a];
    const glm::dvec3 ac = mesh.vertices_m[c] - mesh.vertices_m[a];
    const glm::dvec3 bc = ac - ab;
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    return !(glm::length(glm::cross(ab, ac)) > 1e-14 * longest2);
}

template <typename Value>
std::size_t count_distinct(std::vector<Value>& values) {
    std::ranges::sort(values);
    return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

/// Counts defects along edges and at vertices of triangles that repeat no vertex.
void count_along_edges(std::span<const Triangle> faces, std::size_t vertices, MeshDefects& found) {
    DisjointSets fans(faces.size() * 3); // Corners, numbered 3 * triangle + corner, across edges.
    DisjointSets shells(faces.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary; // The corners of its edges.
    long edges = 0;
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(faces);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        const TriangleEdge& first = edge[0];
        const std::uint32_t min_corner = 3 * first.triangle + first.min_corner();
        const std::uint32_t max_corner = 3 * first.triangle + first.max_corner();
        for (const TriangleEdge& side : edge.subspan(1)) {
            fans.join(min_corner, 3 * side.triangle + side.min_corner());
            fans.join(max_corner, 3 * side.triangle + side.max_corner());
            shells.join(first.triangle, side.triangle);
        }
        if (edge.size() == 1) { boundary.emplace_back(min_corner, max_corner); }
        ++edges;
        found.non_manifold_edges += edge.size() > 2 ? 1U : 0U;
        found.turned_edges += edge.size() == 2 && first.rises == edge[1].rises ? 1U : 0U;
    });
    std::vector<std::size_t> fans_at(vertices, 0);
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
        found.shells += shells.group_of(face) == face ? 1U : 0U;
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t number = 3 * face + corner;
            fans_at[faces[face][corner]] += fans.group_of(number) == number ? 1U : 0U;
        }
    }
    const auto used = static_cast<long>(vertices) - std::ranges::count(fans_at, 0U);
    found.non_manifold_vertices =
        static_cast<std::size_t>(std::ranges::count_if(fans_at, [](std::size_t count) { return count > 1; }));
    found.euler_characteristic = used - edges + static_cast<long>(faces.size());
    found.boundary_edges = boundary.size();
    // Two boundary edges belong to the same loop where they end in the same fan of corners.
    DisjointSets rims(faces.size() * 3);
    std::vector<std::uint32_t> loops;
    for (const auto& [one, other] : boundary) { rims.join(fans.group_of(one), fans.group_of(other)); }
    for (const auto& [one, other] : boundary) { loops.push_back(rims.group_of(fans.group_of(one))); }
    found.boundary_loops = count_distinct(loops);
}

} // namespace

MeshDefects defects(const TriangleMesh& mesh) {
    MeshDefects found;
    std::vector<bool> is_used(mesh.vertices_m.size(), false);
    std::vector<Triangle> faces;
    faces.reserve(mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) {
        const bool repeats = repeats_vertex(triangle);
        found.degenerate_faces += repeats || is_flat(mesh, triangle) ? 1U : 0U;
        if (!repeats) { faces.push_back(triangle); }
        for (const std::uint32_t vertex : triangle) { is_used[vertex] = true; }
    }
    found.unreferenced_vertices = static_cast<std::size_t>(std::ranges::count(is_used, false));
    count_along_edges(faces, mesh.vertices_m.size(), found);
    for (Triangle& triangle : faces) { std::ranges::sort(triangle); }
    found.duplicate_faces = faces.size() - count_distinct(faces);
    if (found.shells > 0 &&
        found.boundary_edges + found.non_manifold_edges + found.non_manifold_vertices + found.turned_edges == 0) {
        found.genus = static_cast<long>(found.shells) - found.euler_characteristic / 2;
    }
    return found;
}

} // namespace octant::models::measure
