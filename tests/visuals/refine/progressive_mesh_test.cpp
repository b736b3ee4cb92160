#include "tests/visuals/refine/made_sequence.h"
#include "visuals/refine/progressive_mesh.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

using namespace octant;
using namespace octant::visuals::refine;
using namespace octant::visuals::refine::test;

TEST_CASE("a strip of two triangles collapses once, and its cut vertices are its ends") {
    // 3--2
    // | /|   collapse of the diagonal 0-2 takes both triangles away
    // 0--1
    models::CollapseSequence sequence;
    sequence.original.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sequence.original.triangles = {{0, 1, 2}, {0, 2, 3}};
    sequence.collapses = {
        {.first = 0, .second = 2, .position_m = {0.5, 0.5, 0}, .left = 1, .right = 0, .error_m = 0.25}};
    const ProgressiveMesh mesh(sequence);
    REQUIRE(mesh.leaf_count() == 4);
    REQUIRE(mesh.node_count() == 5);
    CHECK(mesh.roots().size() == 3);
    CHECK(mesh.sequence_number(mesh.split_of(4).first) == 0);
    CHECK(mesh.sequence_number(mesh.split_of(4).second) == 2);
    CHECK(mesh.sequence_number(mesh.split_of(4).left_cut) == 3);
    CHECK(mesh.sequence_number(mesh.split_of(4).right_cut) == 1);
    CHECK(mesh.error_m(4) == 0.25F);
    CHECK(mesh.position_m(4) == glm::vec3(0.5F, 0.5F, 0.0F));
    CHECK(glm::distance(mesh.normal(4), glm::vec3(0.0F, 0.0F, 1.0F)) < 1e-4F);
    CHECK(mesh.cone_rad(4) < 0.001F);
    CHECK(packed_rgba8(mesh.packed_colour(4)) == 0xffffffffU);
    // 0.707 to a child and sqrt(2) from there to the farthest corner of its faces.
    CHECK(mesh.radius_m(4) == Approx(1.5 * std::numbers::sqrt2).epsilon(1e-4));
}

TEST_CASE("leaves below a node follow one another") {
    const models::CollapseSequence sequence = collapsed(made_sphere(3));
    const ProgressiveMesh mesh(sequence);
    std::vector<std::uint32_t> sizes(mesh.node_count(), 1);
    for (auto node = static_cast<std::uint32_t>(mesh.leaf_count()); node < mesh.node_count(); ++node) {
        const VertexSplit split = mesh.split_of(node);
        sizes[node] = sizes[split.first] + sizes[split.second];
        CHECK(mesh.first_leaf(split.first) == mesh.first_leaf(node));
        CHECK(mesh.first_leaf(split.second) == mesh.first_leaf(node) + sizes[split.first]);
        CHECK(mesh.parent(split.first) == node);
    }
}

TEST_CASE("spheres, cones and errors of parents hold those of their children") {
    for (const auto& made : {made_sphere(3), made_ground(20, 3)}) {
        const ProgressiveMesh mesh(collapsed(made));
        for (std::uint32_t node = 0; node < mesh.node_count(); ++node) {
            const std::uint32_t parent = mesh.parent(node);
            if (parent == none) { continue; }
            CHECK(mesh.error_m(parent) >= mesh.error_m(node));
            CHECK(glm::distance(mesh.position_m(parent), mesh.position_m(node)) + mesh.radius_m(node) <=
                  mesh.radius_m(parent) * (1.0F + 1e-6F));
            const float angle = std::acos(glm::clamp(glm::dot(mesh.normal(parent), mesh.normal(node)), -1.0F, 1.0F));
            CHECK(mesh.cone_rad(parent) >= std::min(angle + mesh.cone_rad(node), std::numbers::pi_v<float>) - 1e-5F);
        }
    }
}

TEST_CASE("a hierarchy of a coloured mesh with materials fits into 140 bytes a vertex") {
    const ProgressiveMesh mesh(collapsed(made_ground(60, 5)));
    CHECK(mesh.bytes() <= 140 * mesh.leaf_count());
}

TEST_CASE("packed normals and colours come back") {
    for (const glm::vec3 vector :
        {glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0.3F, -0.5F, -0.2F), glm::vec3(-0.1F, -0.9F, 0.4F)}) {
        const glm::vec3 unit = glm::normalize(vector);
        CHECK(glm::distance(unpacked(packed(unit)), unit) < 1e-4F);
    }
    CHECK(unpacked(packed(glm::vec3(0.0F))) == glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(unpacked(packed_rgb16(glm::vec3(0.0F, 1.0F, 2.0F))) == glm::vec3(0.0F, 1.0F, 1.0F));
}
