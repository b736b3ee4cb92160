#include "models/procedural/procedural_models.h"
#include "visuals/shading/piece_normals.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <utility>

using namespace octant;
using namespace octant::visuals::shading;

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

bool near(const glm::vec3& one, const glm::vec3& other) { return glm::distance(one, other) < 1e-6F; }

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
