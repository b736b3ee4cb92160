#include "tests/visuals/refine/made_sequence.h"
#include "visuals/refine/mesh_creases.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace octant;
using namespace octant::visuals::refine;
using namespace octant::visuals::refine::test;

namespace {

/// Gives each triangle its own normal, or all triangles at z > 0 that of their sphere.
models::TriangleMesh with_normals(models::TriangleMesh mesh, bool upper_half_is_smooth) {
    mesh.normals.clear();
    mesh.corner_normals.clear();
    for (const models::Triangle& triangle : mesh.triangles) {
        models::Triangle corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& at_m = mesh.vertices_m[triangle.at(k)];
            const bool smooth = upper_half_is_smooth && at_m.z > 1e-6;
            corners.at(k) = static_cast<std::uint32_t>(mesh.normals.size());
            mesh.normals.emplace_back(smooth ? glm::normalize(at_m) : models::normal_of(mesh, triangle));
        }
        mesh.corner_normals.push_back(corners);
    }
    return mesh;
}

} // namespace

TEST_CASE("a mesh whose vertices have one normal each has no creases") {
    const models::TriangleMesh plain = made_sphere(2);
    CHECK(creased_normals(plain).empty());
    models::TriangleMesh smooth = plain;
    for (const glm::dvec3& at_m : smooth.vertices_m) { smooth.normals.emplace_back(glm::normalize(at_m)); }
    smooth.corner_normals = smooth.triangles;
    CHECK(creased_normals(smooth).empty());
    CHECK(mesh_creases(ProgressiveMesh(collapsed(plain)), {}) == nullptr);
}

TEST_CASE("faces keep their own normals at creases, and nodes above a crease are creased") {
    const models::TriangleMesh flat = with_normals(made_sphere(2), true);
    const std::vector<CornerNormals> normals = creased_normals(flat);
    REQUIRE(normals.size() == flat.triangles.size());
    const ProgressiveMesh mesh(collapsed(flat));
    const auto creases = mesh_creases(mesh, normals);
    REQUIRE(creases != nullptr);
    REQUIRE(creases->is_creased.size() == mesh.node_count());
    std::size_t creased_leaves = 0;
    for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
        const glm::dvec3& at_m = flat.vertices_m[mesh.parts().original_vertices[leaf]];
        CHECK(creases->is_creased[leaf] == (at_m.z <= 1e-6));
        creased_leaves += creases->is_creased[leaf] ? 1U : 0U;
    }
    CHECK(creased_leaves > 0);
    for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
        const VertexSplit split = mesh.split_of(node);
        CHECK(creases->is_creased[node] == (creases->is_creased[split.first] || creases->is_creased[split.second]));
    }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const models::Triangle& original = flat.triangles[mesh.original_face(face)];
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(mesh.parts().original_vertices[mesh.faces()[face].at(k)] == original.at(k));
            const glm::vec3& own = flat.normals[flat.corner_normals[mesh.original_face(face)].at(k)];
            CHECK(glm::distance(unpacked(creases->corner_normals[face].at(k)), own) < 1e-3F);
        }
    }
    CHECK(mesh_creases(mesh, std::vector<CornerNormals>(3)) == nullptr);
}
