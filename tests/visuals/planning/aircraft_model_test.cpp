#include "models/collapse_sequence.h"
#include "models/planar/planar_model.h"
#include "models/polygons/obj_reader.h"
#include "tests/visuals/planning/small_world.h"
#include "visuals/planning/aircraft_model.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>

using namespace octant;

namespace {

/// The polygons that the vertices of a model as drawn make.
models::polygons::PolygonModel as_drawn(const visuals::planning::AircraftModel& aircraft) {
    models::polygons::PolygonModel drawn = aircraft.polygons;
    drawn.vertices_m.clear();
    drawn.corner_vertices.clear();
    for (const auto& vertex : aircraft.buffers.vertices) {
        drawn.corner_vertices.push_back(static_cast<std::uint32_t>(drawn.vertices_m.size()));
        drawn.vertices_m.emplace_back(vertex.position_m);
    }
    for (std::size_t i = 0; i < drawn.polygons.size(); ++i) {
        drawn.polygons[i].first_corner = aircraft.first_vertices[i];
        drawn.polygons[i].corner_count = aircraft.first_vertices[i + 1] - aircraft.first_vertices[i];
    }
    return drawn;
}

} // namespace

TEST_CASE("what touches a side of a polygon is a corner of it as it is drawn") {
    models::polygons::PolygonModel model = tests::box_model(glm::dvec3(1.0));
    model.vertices_m.insert(model.vertices_m.end(), {{1.0, 0.25, 1.0}, {2.0, 0, 1}, {2.0, 1, 1}});
    model.polygons.push_back({24, 3, 0, 0});
    model.corner_vertices.insert(model.corner_vertices.end(), {24, 25, 26});
    const visuals::planning::AircraftModel aircraft = tests::convex_aircraft(model);
    int with_five = 0;
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) { with_five += aircraft.index_count_of(i) == 9 ? 1 : 0; }
    CHECK(with_five == 2); // the sides of two squares meet there
    CHECK(models::planar::t_junctions(as_drawn(aircraft)).empty());
    CHECK(aircraft.polygons.corner_vertices == model.corner_vertices); // that the order speaks of
    CHECK(aircraft.buffers.vertices.size() == 6 * 4 + 2 + 3);
    CHECK(aircraft.file_order.index_count == 3 * (2 * 3 + 4 * 2 + 1));
    CHECK(aircraft.first_indices.back() == aircraft.file_order.index_count);
}

TEST_CASE("each side of a polygon as it is drawn knows the polygon beyond it, where there is one") {
    for (const bool is_open : {false, true}) {
        models::polygons::PolygonModel model = tests::box_model(glm::dvec3(1.0));
        if (is_open) {
            model.polygons.pop_back();
            model.corner_vertices.resize(20);
        }
        const auto aircraft = tests::convex_aircraft(model);
        REQUIRE(aircraft.neighbours.size() == aircraft.first_vertices.back());
        int without = 0;
        std::size_t neighbours = 0;
        for (std::uint32_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
            std::set<std::uint32_t> others;
            for (std::uint32_t i = aircraft.first_vertices[polygon]; i < aircraft.first_vertices[polygon + 1]; ++i) {
                if (aircraft.neighbours[i] == models::none) {
                    ++without;
                } else {
                    others.insert(aircraft.neighbours[i]);
                }
            }
            neighbours += others.size();
            CHECK(!others.contains(polygon));
        }
        CHECK(without == (is_open ? 4 : 0));
        CHECK(neighbours == (is_open ? 16U : 24U));
    }
}

TEST_CASE("no corner of the F-15 as it is drawn lies on a side without one") {
    const auto given = models::polygons::read_obj(std::filesystem::path(OCTANT_SOURCE_DIR) / "models" / "f15.obj");
    REQUIRE(models::planar::t_junctions(given).size() == 6);
    const auto aircraft = tests::convex_aircraft(given);
    CHECK(aircraft.polygons.polygons.size() == given.polygons.size());
    CHECK(models::planar::t_junctions(as_drawn(aircraft)).empty());
}

TEST_CASE("no triangle of a polygon with several corners on one side is a sliver") {
    models::polygons::PolygonModel model = tests::box_model(glm::dvec3(1.0));
    model.vertices_m.insert(model.vertices_m.end(), {{1.0, 0.25, 1.0}, {1.0, 0.5, 1.0}, {2.0, 0, 1}, {2.0, 1, 1}});
    model.polygons.push_back({24, 4, 0, 0});
    model.corner_vertices.insert(model.corner_vertices.end(), {24, 26, 27, 25});
    const visuals::planning::AircraftModel aircraft = tests::convex_aircraft(model);
    const auto& buffers = aircraft.buffers;
    REQUIRE(!buffers.indices.empty());
    for (std::size_t i = 0; i < buffers.indices.size(); i += 3) {
        const auto at_m = [&](std::size_t k) { return buffers.vertices[buffers.indices[i + k]].position_m; };
        CHECK(glm::length(glm::cross(at_m(1) - at_m(0), at_m(2) - at_m(0))) > 0.01F);
    }
}
