#include "models/procedural/procedural_models.h"
#include "visuals/shading/shaded_polygons.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant;
using namespace octant::visuals::shading;

namespace {

/// A rectangle of 3 m x 4 m and a triangle that share two vertices, all level.
models::polygons::PolygonModel two_polygons() {
    models::polygons::PolygonModel model;
    model.vertices_m = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}, {6, 0, 0}};
    model.corner_vertices = {0, 1, 2, 3, 1, 4, 2};
    model.polygons = {{.first_corner = 0, .corner_count = 4}, {.first_corner = 4, .corner_count = 3}};
    model.materials.push_back({.name = "", .colour = {0.5F, 0.25F, 0.25F}});
    model.parts = {"all"};
    return model;
}

} // namespace

TEST_CASE("a 3 by 4 rectangle and half of one are measured") {
    const models::polygons::PolygonModel model = two_polygons();
    const ShadedPolygons shaded = shaded_polygons(model, corner_normals(model));
    REQUIRE(shaded.size() == 2);
    CHECK(shaded.polygons[0].perimeter_m == Approx(14.0));
    CHECK(shaded.polygons[0].area_m2 == Approx(12.0));
    CHECK(shaded.polygons[0].centre_m == glm::vec3(1.5F, 2.0F, 0.0F));
    CHECK(shaded.polygons[0].normal == glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(shaded.polygons[0].colour_sum == Approx(1.0));
    CHECK(shaded.polygons[1].perimeter_m == Approx(12.0));
    CHECK(shaded.polygons[1].area_m2 == Approx(6.0));
    CHECK(shaded.mean_perimeter_m == Approx(13.0));
    const std::vector<float> fan_m2{0.0F, 6.0F, 6.0F, 0.0F, 0.0F, 6.0F, 0.0F};
    CHECK(shaded.fan_m2 == fan_m2);
}

TEST_CASE("corners that look the same share a point, in the order in which they come") {
    const models::polygons::PolygonModel model = two_polygons();
    const ShadedPolygons shaded = shaded_polygons(model, corner_normals(model));
    CHECK(shaded.corner_points == std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 2});
    CHECK(shaded.points.size() == 5);
    CHECK(shaded.centre_m == glm::vec3(3.0F, 2.0F, 0.0F));
    CHECK(shaded.radius_m == Approx(std::sqrt(13.0)));
}

TEST_CASE("the torus has 416 polygons and 416 points to light") {
    const models::polygons::PolygonModel torus = models::procedural::torus();
    const ShadedPolygons shaded = shaded_polygons(torus, corner_normals(torus, rad_from_deg(60.0)));
    CHECK(shaded.size() == 416);
    CHECK(shaded.points.size() == 416);
}

TEST_CASE("a mesh with colours takes them from its vertices, one without anything is grey") {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    CHECK(shaded_polygons(mesh, corner_normals(mesh)).points[1].colour_sum == Approx(2.1));
    mesh.colours = {{1, 0, 0}, {1, 1, 0}, {0, 0, 0}};
    const ShadedPolygons shaded = shaded_polygons(mesh, corner_normals(mesh));
    CHECK(shaded.points[1].colour_sum == Approx(2.0));
    CHECK(shaded.polygons[0].colour_sum == Approx(1.0));
}
