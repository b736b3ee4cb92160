#include "models/polygons/polygon_model.h"
#include "tests/fuzz/painting_check.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/ordered_model.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <utility>
#include <vector>

using namespace octant::tests::fuzz;
using octant::models::polygons::PolygonModel;
using octant::visuals::draworder::DrawOrder;
using octant::visuals::draworder::OrderedModel;

namespace {

/// Adds a square of half the side `half` at height z, seen from above.
void add_square(PolygonModel& model, double half, double z) {
    const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
    model.polygons.push_back({static_cast<std::uint32_t>(model.corner_vertices.size()), 4, 0, 0});
    for (std::uint32_t i = 0; i < 4; ++i) { model.corner_vertices.push_back(first + i); }
    model.vertices_m.insert(
        model.vertices_m.end(), {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
}

/// Two squares one above the other, the higher one first in the file.
PolygonModel two_squares(double upper_z = 1.0) {
    PolygonModel model;
    model.materials.emplace_back();
    model.parts.emplace_back("default");
    add_square(model, 1.0, upper_z);
    add_square(model, 1.0, 0.0);
    return model;
}

PaintingCounts checked(const PolygonModel& given, std::vector<std::uint32_t> list) {
    const OrderedModel ordered{.model = given, .order = DrawOrder(std::move(list)), .cells = {}, .notes = {}};
    return check_painting(given, ordered, {2000, 1});
}

} // namespace

TEST_CASE("the judge finds nothing wrong where the farther square is painted first") {
    const PaintingCounts counts = checked(two_squares(), {1, 0});
    CHECK(counts.hits > 500);
    CHECK(counts.wrong_order + counts.wrong_picture + counts.wrong_decal == 0);
    CHECK(counts.first.empty());
}

TEST_CASE("the judge finds the farther square painted last, and a square that is left out") {
    CHECK(checked(two_squares(), {0, 1}).wrong_order > 100);
    CHECK(checked(two_squares(), {1}).wrong_order > 100);
    CHECK(checked(two_squares(), {}).wrong_order > 100);
}

TEST_CASE("the judge finds depths that differ by a little more than the margin") {
    CHECK(checked(two_squares(1e-8), {0, 1}).wrong_order > 100);
    CHECK(checked(two_squares(1e-10), {0, 1}).wrong_order == 0);
}

TEST_CASE("the judge wants the later one of two polygons in one plane") {
    CHECK(checked(two_squares(0.0), {1, 0}).wrong_decal > 100);
    CHECK(checked(two_squares(0.0), {0, 1}).wrong_decal == 0);
}

TEST_CASE("the judge finds a polygon repeated in the sequence, and one that is not there") {
    CHECK(checked(two_squares(), {1, 0, 1}).bad_sequences > 50);
    CHECK(checked(two_squares(), {1, 0, 2}).bad_sequences > 50);
}

TEST_CASE("the judge finds pieces that are not where their polygon was, or belong to another") {
    const PolygonModel given = two_squares();
    OrderedModel ordered{
        .model = given, .order = DrawOrder(std::vector<std::uint32_t>{1, 0}), .cells = {}, .notes = {}};
    ordered.model.parents = {1, 1};
    CHECK(check_painting(given, ordered, {2000, 1}).wrong_picture > 100);
    ordered.model.parents = {0, 1};
    CHECK(check_painting(given, ordered, {2000, 1}).wrong_picture == 0);
    ordered.model.vertices_m[0].x += 1.0; // a corner of the upper square is gone
    CHECK(check_painting(given, ordered, {2000, 1}).wrong_picture > 10);
}

TEST_CASE("the judge sees a square of which one corner is two, a rounding apart") {
    PolygonModel model = two_squares();
    const glm::dvec3 away_m(7e5, -6e5, 4e5);
    for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m += away_m; }
    const double rounding_m = 1.2e-10;
    model.vertices_m.push_back(model.vertices_m[2] + glm::dvec3(rounding_m, rounding_m, 0.0));
    model.corner_vertices = {0, 1, 2, 8, 3, 4, 5, 6, 7};
    model.polygons[0].corner_count = 5;
    model.polygons[1].first_corner = 5;
    const PaintingCounts counts = checked(model, {1, 0});
    CHECK(counts.wrong_order + counts.wrong_picture == 0);
    CHECK(counts.hits > 500);
    CHECK(checked(model, {0, 1}).wrong_order > 100);
    CHECK(checked(model, {1}).wrong_order > 100);
}
