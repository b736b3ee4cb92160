#include "tests/visuals/ordercache/small_models.h"

#include "models/polygons/obj_reader.h"
#include "visuals/ordercache/order_cache.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace octant::tests {

using models::polygons::PolygonModel;

PolygonModel shipped_model(const std::string& name) {
    return models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/" + name + ".obj");
}

PolygonModel crossing_plates() {
    PolygonModel model;
    model.name = "plates";
    model.vertices_m = {
        {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-0.5, 0, -1}, {0.5, 0, -1}, {0.5, 0.1, 1}, {-0.5, 0.1, 1}};
    model.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
    model.polygons = {{0, 4, 0, 0}, {4, 4, 1, 1}};
    model.materials = {{"red", {1, 0, 0}}, {"blue", {0, 0, 1}}};
    model.parts = {"flat", "upright"};
    return model;
}

void check_same(const visuals::draworder::OrderedModel& one, const visuals::draworder::OrderedModel& other) {
    using visuals::ordercache::encode_order;
    CHECK(encode_order(one) == encode_order(other));
    CHECK(std::ranges::equal(one.order.polygons(), other.order.polygons()));
    CHECK(one.order.list_count() == other.order.list_count());
    CHECK(one.order.has_one_cell_per_eye() == other.order.has_one_cell_per_eye());
    CHECK(one.notes == other.notes);
    CHECK(one.model.name == other.model.name);
    CHECK(one.model.parts == other.model.parts);
    CHECK(one.model.notes == other.model.notes);
    const auto same_material = [](const models::Material& a, const models::Material& b) {
        return a.name == b.name && a.colour == b.colour;
    };
    CHECK(std::ranges::equal(one.model.materials, other.model.materials, same_material));
    const auto same_pivot = [](const models::polygons::Pivot& a, const models::polygons::Pivot& b) {
        return a.part == b.part && a.point_m == b.point_m && a.axis == b.axis && a.turns_per_s == b.turns_per_s;
    };
    CHECK(std::ranges::equal(one.model.pivots, other.model.pivots, same_pivot));
}

} // namespace octant::tests
