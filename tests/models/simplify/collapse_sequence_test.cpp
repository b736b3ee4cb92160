#include "models/collapse_sequence.h"
#include "models/measure/mesh_defects.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <cstddef>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

SimplifyOptions fast_to_40_faces() {
    SimplifyOptions options;
    options.goal.faces = 40;
    return options;
}

} // namespace

TEST_CASE("a sequence leads to the mesh before the optimization") {
    for (const TriangleMesh& fine : {ball(16), ring(16, 12), strip(8, 12), machined_part(6)}) {
        const Simplified result = simplified(fine, fast_to_40_faces());
        const TriangleMesh end = mesh_after(result.sequence, result.sequence.collapses.size());
        CHECK(result.mesh.triangles.size() == end.triangles.size());
    }
}

TEST_CASE("each collapse of a sequence takes out what it says") {
    for (const TriangleMesh& fine : {ball(16), ring(16, 12), strip(8, 12), machined_part(6)}) {
        const SimplifyOptions options = fast_to_40_faces();
        for (const CollapseSequence& sequence : {fast_sequence(fine, options), simplified(fine, options).sequence}) {
            std::size_t faces = fine.triangles.size();
            double error_m = 0.0;
            for (std::size_t i = 0; i < sequence.collapses.size(); ++i) {
                const Collapse& collapse = sequence.collapses[i];
                REQUIRE(collapse.first < fine.vertices_m.size() + i);
                REQUIRE(collapse.second < fine.vertices_m.size() + i);
                REQUIRE(collapse.left != none);
                CHECK(collapse.error_m >= error_m);
                error_m = collapse.error_m;
                faces -= collapse.right == none ? 1 : 2;
                if (i % 25 == 0) {
                    const TriangleMesh state = mesh_after(sequence, i + 1);
                    REQUIRE(state.triangles.size() == faces);
                    REQUIRE(is_manifold(state));
                    REQUIRE(boundary_edges(state) <= boundary_edges(fine));
                }
            }
        }
    }
}

TEST_CASE("left of a collapse lies left of the edge from first to second") {
    const TriangleMesh fine = octahedron();
    SimplifyOptions options;
    options.goal.faces = 6;
    const Simplified result = simplified(fine, options);
    REQUIRE(result.sequence.collapses.size() == 1);
    const Collapse& collapse = result.sequence.collapses[0];
    const Triangle& left = fine.triangles[collapse.left];
    const Triangle& right = fine.triangles[collapse.right];
    bool runs = false;
    bool runs_back = false;
    for (std::size_t i = 0; i < 3; ++i) {
        runs = runs || (left[i] == collapse.first && left[(i + 1) % 3] == collapse.second);
        runs_back = runs_back || (right[i] == collapse.second && right[(i + 1) % 3] == collapse.first);
    }
    CHECK(runs);
    CHECK(runs_back);
}
