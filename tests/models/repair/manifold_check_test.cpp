#include "tests/sample_meshes.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace octant::models;
using namespace octant::tests;

TEST_CASE("the tests' own manifold check knows a manifold and each way to be none") {
    CHECK(manifold_fault(cube()).empty());
    CHECK(manifold_fault(tetrahedron()).empty());
    TriangleMesh open = tetrahedron();
    open.triangles.pop_back();
    CHECK(manifold_fault(open).empty());
    TriangleMesh turned = tetrahedron();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    CHECK_THAT(manifold_fault(turned), Catch::Contains("comes twice"));
    TriangleMesh bow_tie;
    bow_tie.vertices_m.resize(5);
    bow_tie.triangles = {{0, 1, 2}, {0, 3, 4}};
    CHECK(manifold_fault(bow_tie) == "vertex 0 has several fans");
    bow_tie.triangles.pop_back();
    CHECK(manifold_fault(bow_tie) == "vertex 3 has no triangle");
}
