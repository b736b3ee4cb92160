#include "models/simplify/vertex_quadrics.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// What the planes at both ends of the first edge weigh together.
double weight_at_first_edge(const TriangleMesh& mesh, const EdgeWeights& weights) {
    const WorkingSurface surface(mesh, WorkingUnits::of(mesh, 0.1));
    return VertexQuadrics(surface, weights).placement(surface, 0).weight;
}

TriangleMesh stretched(TriangleMesh mesh) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) {
        vertex_m.x *= 10.0;
    }
    return mesh;
}

} // namespace

TEST_CASE("planes that count alike weigh one each, whatever the areas of their triangles") {
    INFO("three triangles meet at each end of an edge");
    CHECK(weight_at_first_edge(tetrahedron(), alike_weights) == Approx(6.0));
    CHECK(weight_at_first_edge(stretched(tetrahedron()), alike_weights) == Approx(6.0));
    CHECK(weight_at_first_edge(tetrahedron(), {}) < 3.0);
}

TEST_CASE("a boundary weighs as much as a hundred planes that count alike") {
    TriangleMesh one;
    one.vertices_m = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    one.triangles = {{0, 1, 2}};
    INFO("one plane and two sides at each end");
    CHECK(weight_at_first_edge(one, alike_weights) == Approx(2.0 + 4.0 * 100.0));
}
