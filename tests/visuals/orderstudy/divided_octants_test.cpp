#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "tests/order_shapes.h"
#include "tests/paper_example.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/orderfile/cell_orders.h"
#include "visuals/orderfile/order_check.h"
#include "visuals/orderfile/random_ray_test.h"
#include "visuals/orderstudy/divided_octants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::visuals::draworder;
using namespace octant::visuals::orderfile;
using namespace octant::visuals::orderstudy;
using models::polygons::PolygonModel;

namespace {

/// A model that comes with the program, by its file's name without ending.
PolygonModel shipped(const std::string& name) {
    return models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/" + name + ".obj");
}

/// Rays from eyes at all angles of turning parts, from inside the model outwards.
long wrong_rays(const OrderedModel& found, RaySampling samples) {
    long wrong = 0;
    for (int step = 0; step < (found.model.pivots.empty() ? 1 : 8); ++step) {
        samples.turn_rad = 0.7 * step;
        const RayTestCounts count = count_wrong_rays(found.model, found.order, samples);
        CHECK(count.hits > samples.eyes);
        wrong += count.wrong;
    }
    return wrong;
}

} // namespace

TEST_CASE("divided octants keep the precedences that the paper's example needs") {
    const OrderedModel found = ordered_by_cells(tests::paper_example());
    CHECK(tests::keeps_table_4([&](const glm::dvec3& signs) {
        return found.order.polygons_of(found.order.cell_of(found.centre_m + signs * 400.0));
    }));
}

TEST_CASE(
    "octant paths give right lists from twice the radius outwards, at every angle of the rotors, and are proved") {
    const std::vector<std::pair<PolygonModel, int>> models{{tests::paper_example(), 8}, {shipped("f15"), 32},
        {shipped("500md"), 24}, {tests::plate_between_boxes(), 40}, {tests::three_bars(), 80}};
    for (const auto& [model, max_cells] : models) {
        INFO(model.name);
        const OrderedModel found = ordered_by_cells(model);
        CHECK(found.order.cell_count() <= max_cells);
        REQUIRE(found.cells.size() == static_cast<std::size_t>(found.order.cell_count()));
        CHECK(found.ray_test.is_proof_complete);
        CHECK(found.ray_test.unproved == 0);
        const double min_radii =
            (found.min_distance_m + glm::length(found.centre_m)) / models::polygons::radius_m(model);
        CHECK(wrong_rays(found, {.eyes = 1000, .rays_per_eye = 30, .min_distance_radii = min_radii}) == 0);
    }
}

TEST_CASE("an eye lies in front of all planes of its cell, and the cell's path is its octant's") {
    const OrderedModel found = ordered_by_cells(shipped("f15"));
    RandomGenerator dice(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 from_centre_m = dice.direction() * dice.between(25.0, 80.0);
        const glm::dvec3 eye_m = found.centre_m + from_centre_m;
        const OrderCell& cell = found.cells[static_cast<std::size_t>(found.order.cell_of(eye_m))];
        for (const Plane& plane : cell.planes) { CHECK(distance_m(plane, eye_m) > -1e-6); }
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(cell.path[static_cast<std::size_t>(axis)] == (from_centre_m[axis] < 0.0 ? '-' : '+'));
        }
    }
}

TEST_CASE("cells of all kinds of shapes are certified") {
    for (const auto& model : {tests::u_channel(), tests::plate_between_boxes(), tests::three_bars(),
             tests::fig_14(true), tests::pile(3, 4)}) {
        const OrderedModel found = ordered_by_cells(model);
        INFO(model.name);
        CHECK(check_order(found.model, cell_orders(found)).good());
    }
}

TEST_CASE("an order limited to eyes from a distance on paints nearer ones nothing and others the same") {
    const OrderedModel found = ordered_by_cells(shipped("f15"));
    const DrawOrder limited = with_min_distance(found.order, found.centre_m, found.min_distance_m);
    RandomGenerator dice(7);
    DrawOrder::Walk walk;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from_centre_m = dice.direction() * (found.min_distance_m * dice.between(0.3, 1.5));
        const glm::dvec3 size_m = glm::abs(from_centre_m);
        std::vector<std::uint32_t> near;
        std::vector<std::uint32_t> all;
        limited.append_painted(found.centre_m + from_centre_m, walk, near);
        found.order.append_painted(found.centre_m + from_centre_m, walk, all);
        CHECK(near == (size_m.x + size_m.y + size_m.z < found.min_distance_m ? std::vector<std::uint32_t>{} : all));
    }
}

TEST_CASE("split polygons order crossing bars, cycles and rotors for every eye") {
    for (const auto& model : {tests::three_bars(), tests::fig_14(true), tests::pile(1989, 25), tests::torus(416),
             shipped("f15"), shipped("500md")}) {
        INFO(model.name);
        const OrderedModel found = ordered_by_splitting(model);
        CHECK(found.found_by == OrderSource::Parts);
        CHECK(found.notes.empty());
        CHECK(found.ray_test.wrong == 0);
        CHECK(wrong_rays(found, {.eyes = 300, .rays_per_eye = 30, .min_distance_radii = 0.05}) == 0);
    }
}

TEST_CASE("an order by a few parts has cells, which hold the same orders") {
    const OrderedModel found = ordered_by_splitting(tests::three_bars());
    const auto cells = bsp_cells(found.model, found.order);
    REQUIRE(cells);
    RandomGenerator dice(4);
    DrawOrder::Walk walk;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 eye_m = dice.direction() * dice.between(0.1, 9.0);
        const auto in = std::ranges::find_if(*cells, [&](const auto& cell) {
            return std::ranges::all_of(
                cell.planes, [&](const Plane& plane) { return distance_m(plane, eye_m) >= 0.0; });
        });
        REQUIRE(in != cells->end());
        std::vector<std::uint32_t> painted;
        found.order.append_painted(eye_m, walk, painted);
        CHECK(in->list == painted);
    }
}
