#include "models/measure/mesh_defects.h"
#include "models/procedural/procedural_models.h"
#include "models/simplify/paper_simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <utility>

using namespace octant::models::simplify;
using namespace octant::models;
using namespace octant::tests;
using namespace octant::models::procedural;

namespace {

Point6 at(double x, double y, double z) { return {x, y, z}; }

/// Right angle at (2, 1), legs 4 and 3, in the plane z = 5.
const Corners triangle{at(2, 1, 5), at(6, 1, 5), at(2, 4, 5)};

} // namespace

TEST_CASE("a point over the inside of a triangle is as far as its foot") {
    const Foot foot = foot_on(triangle, at(3, 2, 7));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0));
}

TEST_CASE("a point beside an edge is as far as the edge") {
    const Foot below = foot_on(triangle, at(4, -1, 6));
    CHECK_FALSE(below.inside);
    CHECK(below.distance2 == Approx(4.0 + 1.0));
    // The long edge: 3 x + 4 y = 22, and (3, 4) / 5 its normal; 10 beyond it.
    const Foot beyond = foot_on(triangle, at(4 + 6, 2.5 + 8, 5));
    CHECK_FALSE(beyond.inside);
    CHECK(beyond.distance2 == Approx(100.0));
}

TEST_CASE("a point beyond a corner is as far as the corner") {
    const Foot foot = foot_on(triangle, at(1, 0, 5));
    CHECK_FALSE(foot.inside);
    CHECK(foot.distance2 == Approx(2.0));
}

TEST_CASE("beyond a corner the opposite edge does not count, though it lies between its planes") {
    // The long edge is 2.4 away from the corner (2, 1), the corner 1.41 from the point.
    CHECK(foot_on(triangle, at(1, 0, 5)).distance2 < 2.4 * 2.4);
}

TEST_CASE("corners and points of an edge count as outside, at distance 0") {
    for (const Point6& point : {at(2, 1, 5), at(6, 1, 5), at(2, 4, 5), at(4, 1, 5), at(4, 2.5, 5)}) {
        const Foot foot = foot_on(triangle, point);
        CHECK_FALSE(foot.inside);
        CHECK(foot.distance2 == 0.0);
    }
}

TEST_CASE("a triangle whose plane holds the origin is like any other") {
    const Corners through_origin{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0)};
    const Foot foot = foot_on(through_origin, at(0.25, 0.25, 2));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0));
}

TEST_CASE("a collapsed triangle has no inside and is as far as what is left of it") {
    const Corners edge{at(0, 0, 0), at(2, 0, 0), at(2, 0, 0)};
    CHECK_FALSE(foot_on(edge, at(1, 3, 0)).inside);
    CHECK(foot_on(edge, at(1, 3, 0)).distance2 == Approx(9.0));
    const Corners line{at(0, 0, 0), at(1, 0, 0), at(3, 0, 0)};
    CHECK(foot_on(line, at(2, 0, 4)).distance2 == Approx(16.0));
    const Corners point{at(1, 1, 1), at(1, 1, 1), at(1, 1, 1)};
    CHECK_FALSE(foot_on(point, at(1, 1, 3)).inside);
    CHECK(foot_on(point, at(1, 1, 3)).distance2 == Approx(4.0));
}

TEST_CASE("colour counts like another direction") {
    Corners red = triangle;
    for (Point6& corner : red) { corner[3] = 1.0; }
    const Foot foot = foot_on(red, at(3, 2, 7));
    CHECK(foot.inside);
    CHECK(foot.distance2 == Approx(4.0 + 1.0));
}

namespace {

Corners level_triangle(double z) { return {Point6{0, 0, z}, Point6{3, 0, z}, Point6{0, 2, z}}; }

} // namespace

TEST_CASE("a quadric gives the squared distance to its plane, inside the triangle or not") {
    const PlaneQuadric quadric = PlaneQuadric::of_plane(level_triangle(1.0));
    CHECK(quadric.at(Point6{1, 0.5, 3}) == Approx(4.0));
    CHECK(quadric.at(Point6{50, -70, 3}) == Approx(4.0));
    CHECK(quadric.at(Point6{8, 8, 1}) == Approx(0.0).margin(1e-12));
}

TEST_CASE("added quadrics give the sum of the distances") {
    PlaneQuadric sum = PlaneQuadric::of_plane(level_triangle(0.0));
    sum.add(PlaneQuadric::of_plane(level_triangle(1.0)));
    CHECK(sum.at(Point6{7, 7, 3}) == Approx(9.0 + 4.0));
}

TEST_CASE("a triangle without area has no plane") {
    const Corners line{Point6{0, 0, 0}, Point6{1, 0, 0}, Point6{2, 0, 0}};
    CHECK(PlaneQuadric::of_plane(line).at(Point6{5, 5, 5}) == 0.0);
    CHECK(PlaneQuadric::of_coloured_plane(line).at(Point6{5, 5, 5}) == 0.0);
}

TEST_CASE("over a triangle of one colour a coloured quadric adds the distance in colour") {
    const PlaneQuadric quadric = PlaneQuadric::of_coloured_plane(level_triangle(1.0));
    CHECK(quadric.at(Point6{9, 9, 3, 0.5, 0, 0}) == Approx(4.0 + 0.25));
}

TEST_CASE("a coloured quadric follows the slope of the colour") {
    Corners sloping = level_triangle(0.0);
    sloping[1][3] = 3.0;
    const PlaneQuadric quadric = PlaneQuadric::of_coloured_plane(sloping);
    CHECK(quadric.at(Point6{2, 0, 0, 2, 0, 0}) == Approx(0.0).margin(1e-12));
    // Off the slope by 1 in the plane of x and red, which rises at 45 degrees: half of it squared.
    CHECK(quadric.at(Point6{2, 0, 0, 1, 0, 0}) == Approx(0.5));
}

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

namespace {

PaperResult simplified_globe(PaperMeasure measure) {
    PaperOptions options;
    options.measure = measure;
    options.goal.vertices = 5000;
    options.colour_weight = 0.12;
    return paper_simplified(globe(), options);
}

/// Colour of the vertex nearest to a place.
glm::vec3 colour_at(const TriangleMesh& mesh, double north_deg, double east_deg) {
    const auto ring = static_cast<std::size_t>((90.0 - north_deg) / 180.0 * 193.0 - 0.5);
    const auto meridian = static_cast<std::size_t>((east_deg + 180.0) / 360.0 * 192.0 + 0.5);
    return mesh.colours[1 + ring * 192 + meridian];
}

} // namespace

TEST_CASE("the globe has the paper's numbers of vertices and faces, and is a closed ball") {
    const TriangleMesh mesh = globe();
    CHECK(mesh.vertices_m.size() == 36866);
    CHECK(mesh.triangles.size() == 73728);
    CHECK(mesh.colours.size() == mesh.vertices_m.size());
    CHECK(is_manifold(mesh));
    CHECK(euler_number(mesh) == 2);
    CHECK(boundary_edges(mesh) == 0);
    CHECK(volume_m3(mesh) == Approx(4.18879).epsilon(0.001));
}

TEST_CASE("land lies where it does on the earth") {
    const TriangleMesh mesh = globe();
    const glm::vec3 sea = colour_at(mesh, 0.0, -30.0);
    for (const auto& [north_deg, east_deg] :
        {std::pair(0.0, 160.0), {-40.0, 80.0}, {45.0, -40.0}, {85.0, 0.0}, {35.0, 18.0}}) {
        CHECK(colour_at(mesh, north_deg, east_deg) == sea);
    }
    for (const auto& [north_deg, east_deg] : {std::pair(0.0, 25.0), {-25.0, 135.0}, {50.0, 30.0}, {40.0, -100.0},
             {-10.0, -55.0}, {-80.0, 60.0}, {72.0, -40.0}, {20.0, 78.0}}) {
        CHECK(colour_at(mesh, north_deg, east_deg) != sea);
    }
}

TEST_CASE("the globe of 5000 vertices: triangles cost less than planes, by both directions") {
    const PaperResult plane = simplified_globe(PaperMeasure::Plane);
    const PaperResult triangle = simplified_globe(PaperMeasure::Triangle);
    const PaperResult both = simplified_globe(PaperMeasure::Bidirectional);
    for (const PaperResult* result : {&plane, &triangle, &both}) {
        CHECK(result->counted_vertices == 5000);
        CHECK(result->mesh.triangles.size() <= 9996);
    }
    const double one_way = triangle.sums.triangle_m2 / plane.sums.triangle_m2;
    CHECK(one_way <= 0.82);
    CHECK(both.sums.bidirectional_m2 / plane.sums.bidirectional_m2 <= one_way);
    const double outside = static_cast<double>(both.feet_outside) / static_cast<double>(both.feet);
    CHECK(outside >= 0.85);
    CHECK(outside <= 0.97);
}
