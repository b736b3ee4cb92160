#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/conformity.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

struct Changed {
    explicit Changed(const GroundMesh& mesh)
        : vertices(mesh.vertices.begin(), mesh.vertices.end()), indices(mesh.indices.begin(), mesh.indices.end()) {}

    GroundMesh mesh() const {
        GroundMesh mesh;
        mesh.vertices = vertices;
        mesh.indices = indices;
        return mesh;
    }

    std::vector<octant::models::ColourVertex> vertices;
    std::vector<std::uint32_t> indices;
};

} // namespace

TEST_CASE("edge matching finds nothing wrong with meshes of the quadtree") {
    Ground ground(rough_field(65, 40, 5));
    ConformityCheck check{GroundSamples(ground.field)};
    Numbers numbers(11);
    for (int k = 0; k < 300; ++k) {
        const MeshView view = random_view(numbers, ground.field);
        const GroundMesh mesh =
            ground.mesher.mesh(view, {numbers.between(2.0, 20.0), numbers.between(0.0, 5.0), FanKind::Partial});
        const Conformity found = check.check(mesh, view);
        INFO(k << ": " << found.text());
        REQUIRE(found.is_conforming());
    }
}

TEST_CASE("edge matching sees each fault by its name") {
    Ground ground(rough_field(33, 33, 5));
    ConformityCheck check{GroundSamples(ground.field)};
    MeshView view;
    view.eye_m = {1.0, 2.0, 30.0};
    const GroundMesh whole = ground.mesher.mesh(view, {4.0, 2.0, FanKind::Partial});
    REQUIRE(whole.counters.triangles > 50);

    SECTION("a missing triangle leaves its inner edges open") {
        Changed changed(whole);
        changed.indices.erase(changed.indices.begin() + 30, changed.indices.begin() + 33);
        const Conformity found = check.check(changed.mesh(), view);
        CHECK(found.open_edges >= 1);
        CHECK(found.open_edges <= 3);
    }
    SECTION("a triangle twice crowds its edges") {
        Changed changed(whole);
        changed.indices.insert(changed.indices.end(), changed.indices.begin() + 30, changed.indices.begin() + 33);
        CHECK(check.check(changed.mesh(), view).overlapping_edges == 3);
    }
    SECTION("a turned triangle") {
        Changed changed(whole);
        std::swap(changed.indices[30], changed.indices[31]);
        CHECK(check.check(changed.mesh(), view).inverted_triangles == 1);
    }
    SECTION("a vertex twice in one place opens the edges there") {
        Changed changed(whole);
        changed.vertices.push_back(changed.vertices[changed.indices[30]]);
        changed.indices[30] = static_cast<std::uint32_t>(changed.vertices.size() - 1);
        const Conformity found = check.check(changed.mesh(), view);
        CHECK(found.duplicate_vertices == 1);
        CHECK(found.open_edges > 0);
    }
}

TEST_CASE("the printed propagation is caught with corners on edges") {
    int caught = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        QuadtreeOptions options;
        options.propagation = RoughnessPropagation::Printed;
        Ground ground(rough_field(65, 65, seed), options);
        MeshView view;
        view.eye_m = {5.0, 3.0, 2.0};
        const GroundMesh mesh = ground.mesher.mesh(view, {4.0, 5.0, FanKind::Partial});
        const Conformity found = ConformityCheck(GroundSamples(ground.field)).check(mesh, view);
        const GroundCheck other = checked_ground(sample_triangles(mesh, ground.field, view.eye_m), ground.field);
        CHECK(found.is_conforming() == (other.unmatched_edges == 0));
        CHECK((found.t_junctions > 0) == (found.open_edges > 0));
        caught += found.t_junctions > 0 ? 1 : 0;
    }
    CHECK(caught > 3);
}
