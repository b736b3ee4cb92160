#include "tests/sample_meshes.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace octant::tests {

using models::Triangle;
using models::TriangleMesh;

TriangleMesh cube() {
    TriangleMesh mesh;
    mesh.name = "cube";
    for (int v = 0; v < 8; ++v) { mesh.vertices_m.emplace_back(v & 1, (v >> 1) & 1, (v >> 2) & 1); }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, // z = 0
        {4, 5, 7}, {4, 7, 6},               // z = 1
        {0, 1, 5}, {0, 5, 4},               // y = 0
        {2, 6, 7}, {2, 7, 3},               // y = 1
        {0, 4, 6}, {0, 6, 2},               // x = 0
        {1, 3, 7}, {1, 7, 5}};              // x = 1
    return mesh;
}

TriangleMesh coloured_cube() {
    TriangleMesh mesh = cube();
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        mesh.colours.push_back(glm::vec3((glm::dvec3(10.0) + 200.0 * vertex_m + glm::dvec3(0.0, 1.0, 2.0)) / 255.0));
    }
    mesh.normals = {{0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, -1.0F, 0.0F}, {0.0F, 1.0F, 0.0F},
        {-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
    mesh.materials = {{"hull", {0.25F, 0.5F, 0.75F}}, {"deck plate", {0.1F, 0.2F, 1.0F}}};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        mesh.corner_normals.push_back({t / 2, t / 2, t / 2});
        mesh.triangle_materials.push_back(t < 8 ? 0 : 1);
    }
    return mesh;
}

TriangleMesh tetrahedron() {
    TriangleMesh mesh;
    mesh.name = "tetrahedron";
    mesh.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

std::string index_fault(const TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    if (!mesh.colours.empty() && mesh.colours.size() != mesh.vertices_m.size()) {
        return "colours and vertices differ in number";
    }
    if (mesh.corner_normals.size() != (mesh.normals.empty() ? 0 : count) ||
        mesh.triangle_materials.size() != (mesh.materials.empty() ? 0 : count)) {
        return "corner normals or materials differ from the triangles in number";
    }
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (mesh.triangles[t][k] >= mesh.vertices_m.size()) {
                return fmt::format("triangle {} has vertex {}", t, mesh.triangles[t][k]);
            }
            if (!mesh.normals.empty() && mesh.corner_normals[t][k] >= mesh.normals.size()) {
                return fmt::format("triangle {} has normal {}", t, mesh.corner_normals[t][k]);
            }
        }
        if (!mesh.materials.empty() && mesh.triangle_materials[t] >= mesh.materials.size()) {
            return fmt::format("triangle {} has material {}", t, mesh.triangle_materials[t]);
        }
    }
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        if (!std::isfinite(vertex_m.x + vertex_m.y + vertex_m.z)) { return "a vertex that is not finite"; }
    }
    for (const glm::vec3& normal : mesh.normals) {
        if (!(std::abs(glm::length(normal) - 1.0F) < 1e-3F)) { return "a normal that is no unit vector"; }
    }
    return {};
}

std::string manifold_fault(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    std::vector<std::map<std::uint32_t, std::uint32_t>> next(mesh.vertices_m.size());
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle[k];
            const std::uint32_t b = triangle[(k + 1) % 3];
            if (a == b) { return fmt::format("a triangle has vertex {} twice", a); }
            if (++sides[{a, b}] > 1) { return fmt::format("side {} to {} comes twice", a, b); }
            next[a][b] = triangle[(k + 2) % 3];
        }
    }
    for (std::size_t v = 0; v < next.size(); ++v) {
        if (next[v].empty()) { return fmt::format("vertex {} has no triangle", v); }
        std::set<std::uint32_t> ends;
        for (const auto& [from, to] : next[v]) { ends.insert(to); }
        std::uint32_t walk = next[v].begin()->first;
        for (const auto& [from, to] : next[v]) {
            walk = ends.contains(from) ? walk : from; // the open side of a fan, if it has one
        }
        // Of several fans only one is walked.
        std::set<std::uint32_t> seen;
        while (next[v].contains(walk) && seen.insert(walk).second) { walk = next[v].at(walk); }
        if (seen.size() != next[v].size()) { return fmt::format("vertex {} has several fans", v); }
    }
    return {};
}

} // namespace octant::tests
