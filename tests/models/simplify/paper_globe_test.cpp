#include "models/procedural/globe.h"
#include "models/simplify/paper_simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <utility>

using namespace octant::models;
using namespace octant::models::procedural;
using namespace octant::models::simplify;
using namespace octant::tests;

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
