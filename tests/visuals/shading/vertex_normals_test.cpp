#include "models/procedural/procedural_models.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

using namespace octant;
using namespace octant::visuals::shading;

namespace {

/// Two unit squares that share the edge from (0, 0, 0) to (0, 1, 0): a level one, front upwards, and one that goes down
/// at `fold_rad` from it, with vertices of its own.
models::polygons::PolygonModel folded(double fold_rad) {
    const double x = -std::cos(fold_rad);
    const double z = -std::sin(fold_rad);
    models::polygons::PolygonModel model;
    model.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {x, 1, z}, {x, 0, z}};
    model.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
    model.polygons = {{.first_corner = 0, .corner_count = 4}, {.first_corner = 4, .corner_count = 4}};
    model.materials.emplace_back();
    model.parts = {"fixed"};
    return model;
}

bool near(const glm::vec3& one, const glm::vec3& other) { return glm::distance(one, other) < 1e-6F; }

} // namespace

TEST_CASE("across a soft edge corners in one place share the mean normal, others keep their own") {
    const double fold_rad = rad_from_deg(30.0);
    const auto normals = corner_normals(folded(fold_rad), rad_from_deg(40.0));
    const glm::vec3 mean(-static_cast<float>(std::sin(fold_rad / 2)), 0.0F, static_cast<float>(std::cos(fold_rad / 2)));
    REQUIRE(normals.size() == 8);
    CHECK(near(normals[0], mean));
    CHECK(near(normals[3], mean));
    CHECK(normals[4] == normals[0]); // to the bit
    CHECK(near(normals[1], {0.0F, 0.0F, 1.0F}));
}

TEST_CASE("an edge sharper than the crease angle stays") {
    const auto normals = corner_normals(folded(rad_from_deg(50.0)), rad_from_deg(40.0));
    for (std::size_t corner = 0; corner < 4; ++corner) { CHECK(near(normals[corner], {0.0F, 0.0F, 1.0F})); }
}

TEST_CASE("a part that turns does not mix with a fixed one") {
    models::polygons::PolygonModel model = folded(rad_from_deg(20.0));
    model.parts.emplace_back("rotor");
    model.polygons[1].part = 1;
    CHECK_FALSE(near(corner_normals(model)[0], {0.0F, 0.0F, 1.0F}));
    model.pivots.push_back({.part = 1});
    CHECK(near(corner_normals(model)[0], {0.0F, 0.0F, 1.0F}));
}

TEST_CASE("a face counts by its angle, not by the pieces it is cut into") {
    // Around (0, 0, 0): the level quarter in one piece or in two, then a slope.
    models::TriangleMesh whole;
    whole.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, -0.3}, {1, 1, 0}};
    whole.triangles = {{0, 1, 2}, {0, 2, 3}};
    models::TriangleMesh cut = whole;
    cut.triangles = {{0, 1, 4}, {0, 4, 2}, {0, 2, 3}};
    CHECK(near(corner_normals(whole)[0], corner_normals(cut)[0]));
}

TEST_CASE("faces that touch only at a vertex do not mix") {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0.2}, {-1, -1, 0.2}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    CHECK(near(corner_normals(mesh)[0], {0.0F, 0.0F, 1.0F}));
}

TEST_CASE("a triangle without area changes nobody's normal") {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    const auto normals = corner_normals(mesh);
    REQUIRE(normals.size() == 6);
    CHECK(near(normals[0], {0.0F, 0.0F, 1.0F}));
    CHECK(near(normals[3], {0.0F, 0.0F, 1.0F}));
}

TEST_CASE("normals of the torus point away from the middle of its tube") {
    const models::polygons::PolygonModel torus = models::procedural::torus();
    const auto normals = corner_normals(torus, rad_from_deg(60.0));
    for (std::size_t corner = 0; corner < normals.size(); ++corner) {
        const glm::dvec3& at_m = torus.vertices_m[torus.corner_vertices[corner]];
        const glm::dvec3 tube_m = glm::normalize(glm::dvec3(at_m.x, at_m.y, 0.0));
        CHECK(glm::dot(glm::dvec3(normals[corner]), glm::normalize(at_m - tube_m)) > 0.995);
    }
}

namespace {

models::polygons::PolygonModel model_of(
    std::vector<glm::dvec3> vertices_m, const std::vector<std::vector<std::uint32_t>>& polygons) {
    models::polygons::PolygonModel model;
    model.vertices_m = std::move(vertices_m);
    for (const auto& corners : polygons) {
        model.polygons.push_back({.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size()),
            .corner_count = static_cast<std::uint32_t>(corners.size())});
        model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
    }
    model.materials.emplace_back();
    model.parts = {"all"};
    return model;
}

const std::vector<glm::dvec3> square_m{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
const glm::vec3 left(-0.6F, 0.0F, 0.8F);
const glm::vec3 right(0.6F, 0.0F, 0.8F);

} // namespace

TEST_CASE("the halves of a cut square keep its normals and have the middle one at the cut") {
    const models::polygons::PolygonModel whole = model_of(square_m, {{0, 1, 2, 3}});
    const std::vector normals{left, right, right, left};
    models::polygons::PolygonModel pieces =
        model_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}, {1, 2, 0}}, {{0, 4, 5, 3}, {4, 1, 2, 5}});
    pieces.parents = {0, 0};
    const auto made = piece_normals(whole, normals, pieces);
    const glm::vec3 up(0.0F, 0.0F, 1.0F);
    const std::vector expected{left, up, up, left, up, right, right, up};
    REQUIRE(made.size() == expected.size());
    for (std::size_t corner = 0; corner < made.size(); ++corner) { CHECK(near(made[corner], expected[corner])); }
}

TEST_CASE("a quarter of the way along a side the normal is a quarter of the way too") {
    const models::polygons::PolygonModel whole = model_of(square_m, {{0, 1, 2, 3}});
    models::polygons::PolygonModel pieces = model_of({{0.5, 0, 0}, {2, 0, 0}, {2, 2, 0}}, {{0, 1, 2}});
    const auto made = piece_normals(whole, std::vector{left, right, right, left}, pieces);
    CHECK(near(made[0], glm::normalize(0.75F * left + 0.25F * right)));
}

TEST_CASE("in the middle of a square all corners count the same") {
    const models::polygons::PolygonModel whole = model_of(square_m, {{0, 1, 2, 3}});
    const models::polygons::PolygonModel piece = model_of({{1, 1, 0}, {2, 0, 0}, {2, 2, 0}}, {{0, 1, 2}});
    const auto made = piece_normals(whole, std::vector{left, right, right, left}, piece);
    CHECK(near(made[0], {0.0F, 0.0F, 1.0F}));
    CHECK(near(made[1], right));
}

TEST_CASE("a piece belongs to the polygon around it where two have the same parent") {
    models::polygons::PolygonModel whole =
        model_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
    whole.parents = {7, 7};
    models::polygons::PolygonModel piece = model_of({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}}, {{0, 1, 2}});
    piece.parents = {7};
    const std::vector normals{left, left, left, left, right, right, right, right};
    CHECK(near(piece_normals(whole, normals, piece)[0], right));
}

TEST_CASE("a model that was not cut keeps its normals") {
    const models::polygons::PolygonModel torus = models::procedural::torus();
    const auto normals = corner_normals(torus);
    const auto made = piece_normals(torus, normals, torus);
    for (std::size_t corner = 0; corner < made.size(); ++corner) { CHECK(near(made[corner], normals[corner])); }
}

TEST_CASE("pieces of a polygon lie on its picture where the polygon does, and one without a picture has no place") {
    models::polygons::PolygonModel whole = folded(1.0);
    const float none = std::nanf("");
    whole.corner_texture_coordinates = {
        {0.0F, 0.0F}, {2.0F, 0.0F}, {2.0F, 3.0F}, {0.0F, 3.0F}, {none, none}, {none, none}, {none, none}, {none, none}};
    models::polygons::PolygonModel pieces = whole;
    pieces.corner_texture_coordinates.clear();
    pieces.vertices_m.insert(pieces.vertices_m.end(), {{0.25, 0, 0}, {0.75, 1, 0}, {0.5, 0.5, 0}});
    pieces.corner_vertices = {0, 8, 10, 9, 3, 8, 1, 2, 9, 10, 4, 5, 6, 7};
    pieces.polygons = {{.first_corner = 0, .corner_count = 5}, {.first_corner = 5, .corner_count = 5},
        {.first_corner = 10, .corner_count = 4}};
    pieces.parents = {0, 0, 1};
    const auto made = piece_texture_coordinates(whole, pieces);
    REQUIRE(made.size() == pieces.corner_vertices.size());
    for (std::size_t corner = 0; corner < 10; ++corner) {
        const glm::dvec3& at = pieces.vertices_m[pieces.corner_vertices[corner]];
        CHECK(made[corner].x == Approx(2.0 * at.x).margin(1e-6));
        CHECK(made[corner].y == Approx(3.0 * at.y).margin(1e-6));
    }
    CHECK(std::isnan(made[10].x));
}
