#include "models/measure/mesh_defects.h"
#include "models/simplify/paper_simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// Four triangles in the plane z = 0. Its shortest edge is from vertex 0 to vertex 1; two triangles are at that edge,
/// two more at vertex 1 only.
TriangleMesh arrow() {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0.5, 2, 0}, {0.5, -2, 0}, {3, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {1, 4, 2}, {1, 3, 4}};
    return mesh;
}

PaperResult once(PaperMeasure measure) {
    PaperOptions options;
    options.measure = measure;
    options.goal.vertices = 4;
    return paper_simplified(arrow(), options);
}

} // namespace

// A point 1 m along the x axis from an arrow's end is sqrt(16 / 17) m from its slanted edges.
TEST_CASE("planes see no difference between three places in a plane, and the first end is taken") {
    const PaperResult result = once(PaperMeasure::Plane);
    CHECK(result.mesh.vertices_m[0] == glm::dvec3(0, 0, 0));
    CHECK(result.sums.plane_m2 == Approx(0.0).margin(1e-12));
    CHECK(result.sums.triangle_m2 == Approx(32.0 / 17.0));
    CHECK(result.sums.bidirectional_m2 == Approx(32.0 / 17.0));
    CHECK(result.feet == 0);
}

TEST_CASE("distances to triangles take the end that lies on all of them") {
    const PaperResult result = once(PaperMeasure::Triangle);
    CHECK(result.mesh.vertices_m[0] == glm::dvec3(1, 0, 0));
    CHECK(result.sums.triangle_m2 == Approx(0.0).margin(1e-12));
    CHECK(result.sums.bidirectional_m2 == Approx(64.0 / 17.0));
    CHECK(result.feet == 3 * 4);
    CHECK(result.feet_outside == 3 * 4);
}

TEST_CASE("distances both ways take the middle") {
    const PaperResult result = once(PaperMeasure::Bidirectional);
    CHECK(result.mesh.vertices_m[0] == glm::dvec3(0.5, 0, 0));
    CHECK(result.sums.triangle_m2 == Approx(8.0 / 17.0));
    CHECK(result.sums.bidirectional_m2 == Approx(1.5));
    CHECK(result.feet == 3 * 3 * 4);
    CHECK(result.contractions == 1);
    CHECK(result.mesh.triangles == std::vector<Triangle>{{0, 3, 1}, {0, 2, 3}});
}

TEST_CASE("vertices that no triangle uses are counted, whether the mesh still has them or not") {
    TriangleMesh mesh = arrow();
    PaperOptions options;
    options.goal.vertices = 6;
    options.uncounted = 2;
    CHECK(paper_simplified(mesh, options).contractions == 1);
    mesh.vertices_m.resize(7);
    options.uncounted = 0;
    const PaperResult result = paper_simplified(mesh, options);
    CHECK(result.contractions == 1);
    CHECK(result.counted_vertices == 6);
    CHECK(result.mesh.vertices_m.size() == 4);
}

TEST_CASE("nothing keeps a manifold: a tetrahedron becomes two triangles on each other") {
    PaperOptions options;
    options.goal.vertices = 3;
    const PaperResult result = paper_simplified(tetrahedron(), options);
    CHECK(result.mesh.triangles.size() == 2);
    CHECK(measure::defects(result.mesh).duplicate_faces == 1);
}

TEST_CASE("colour alone can decide where a vertex goes") {
    TriangleMesh mesh = arrow();
    mesh.colours.assign(5, glm::vec3(0.0F));
    mesh.colours[1] = glm::vec3(1.0F, 0.0F, 0.0F);
    PaperOptions options;
    options.measure = PaperMeasure::Plane;
    options.goal.vertices = 4;
    CHECK(paper_simplified(mesh, options).mesh.colours[0].x == 0.0F);
    options.measure = PaperMeasure::Triangle;
    options.colour_weight = 1.0;
    CHECK(paper_simplified(mesh, options).mesh.colours[0].x == 1.0F);
}

TEST_CASE("colour in the length of edges puts off an edge between two colours") {
    TriangleMesh mesh = arrow();
    mesh.colours.assign(5, glm::vec3(0.0F));
    mesh.colours[0] = glm::vec3(1.0F);
    PaperOptions options;
    options.goal.vertices = 4;
    options.colour_weight = 10.0;
    CHECK(paper_simplified(mesh, options).mesh.triangles.size() == 2);
    options.colour_in_edge_length = true;
    // Vertices 1 and 4 are 2 m apart, and of one colour.
    const TriangleMesh left = paper_simplified(mesh, options).mesh;
    CHECK(left.triangles.size() == 2);
    CHECK(left.colours[0] == glm::vec3(1.0F));
}

TEST_CASE("edges run out before vertices do") {
    PaperOptions options;
    options.goal.vertices = 0;
    const PaperResult result = paper_simplified(cube(2), options);
    CHECK(result.mesh.triangles.empty());
    CHECK(result.counted_vertices > 0);
}

TEST_CASE("a goal of faces is kept too") {
    PaperOptions options;
    options.goal.faces = 100;
    const PaperResult result = paper_simplified(ball(16), options);
    CHECK(result.mesh.triangles.size() <= 100);
    CHECK(result.mesh.triangles.size() >= 96);
}
