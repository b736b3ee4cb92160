#include "models/polygons/polygon_model.h"
#include "sim/base/random_generator.h"
#include "tests/order_shapes.h"
#include "visuals/draworder/order_ray_test.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/cell_orders.h"
#include "visuals/orderfile/random_ray_test.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

#include "tried_models.h"

using namespace octant::visuals::draworder;
using octant::RandomGenerator;
using octant::models::polygons::PolygonModel;
using octant::tests::all_eyes;
using octant::tests::by;
using octant::tests::shipped;
using octant::visuals::orderfile::count_wrong_rays;
using octant::visuals::orderfile::RaySampling;

namespace {

PolygonModel crossing_rotors() {
    PolygonModel model;
    model.name = "crossing_rotors";
    model.materials.emplace_back();
    model.parts = {"across", "along"};
    model.vertices_m = {
        {-2, -0.1, 0}, {2, -0.1, 0}, {2, 0.1, 0}, {-2, 0.1, 0}, {0, -0.1, -2}, {0, 0.1, -2}, {0, 0.1, 2}, {0, -0.1, 2}};
    model.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
    for (std::uint32_t part = 0; part < 2; ++part) {
        octant::models::polygons::Polygon blade;
        blade.first_corner = 4 * part;
        blade.corner_count = 4;
        blade.part = part;
        model.polygons.push_back(blade);
    }
    model.pivots = {
        {.part = 0, .point_m = {0, 0, 0}, .axis = {0, 0, 1}}, {.part = 1, .point_m = {0, 0, 0}, .axis = {1, 0, 0}}};
    return model;
}

} // namespace

TEST_CASE("turning parts that meet are left unsplit, and a note tells of them") {
    const OrderedModel found = by(OrderMethod::Tree, crossing_rotors());
    CHECK(found.splits == 0);
    REQUIRE(found.notes.size() == 1);
    CHECK(found.notes[0] == "across and along meet as they turn; no order is right for them");
}

TEST_CASE("rings of bars and polygons that pass through one another are split") {
    const OrderedModel bars = by(OrderMethod::Tree, octant::tests::three_bars());
    CHECK(bars.splits >= 2);
    CHECK(bars.splits <= 4);
    CHECK(bars.model.polygons.size() == 6 + static_cast<std::size_t>(bars.splits));
    CHECK(count_wrong_rays(bars.model, bars.order, all_eyes(2000)).wrong == 0);
    const OrderedModel crossed = by(OrderMethod::Tree, octant::tests::fig_14(true));
    CHECK(crossed.splits >= 2);
    CHECK(count_wrong_rays(crossed.model, crossed.order, all_eyes(2000)).wrong == 0);
}

TEST_CASE("a model whose rings no cut resolves is drawn by parts") {
    PolygonModel model;
    model.materials.emplace_back();
    model.parts = {"all"};
    model.vertices_m = {{-0.985746, 0.859528, 1.75496}, {-0.311808, 0.775657, 1.758152},
        {-0.623282, 0.800776, 1.756676}, {-0.617095, 0.896428, 1.756709}, {-0.311808, 0.908202, 1.758152}};
    model.corner_vertices = {0, 3, 2, 4, 1, 2, 3};
    model.polygons = {{0, 3, 0, 0}, {3, 4, 0, 0}};
    const OrderedModel found = by(OrderMethod::Tree, model);
    CHECK(count_wrong_rays(found.model, found.order, all_eyes(300)).wrong == 0);
    CHECK(found.ray_test.rays > 1000);
    CHECK(found.ray_test.wrong == 0);
}

TEST_CASE("a search that has no time left is replaced by parts, and a note tells of it") {
    const PolygonModel pile = octant::tests::pile(7, 12);
    OrderOptions options;
    options.seconds = 0.001;
    const OrderedModel found = ordered(pile, options);
    CHECK(found.found_by == OrderSource::Parts);
    CHECK(found.cells.empty());
    REQUIRE(found.notes.size() == 1);
    CHECK(found.notes[0] == "drawn by parts, not by cells: the search for cells took more than 0.001 s");
    CHECK(count_wrong_rays(found.model, found.order, all_eyes(600)).wrong == 0);
    const OrderedModel again = ordered(pile, options);
    CHECK(std::ranges::equal(again.order.polygons(), found.order.polygons()));
}

TEST_CASE("cells that were found before the time was spent are kept, and the others are parted") {
    int kept = 0;
    for (const auto& model : {shipped("f15"), shipped("500md"), octant::tests::pile(7, 12)}) {
        for (const double seconds : {0.01, 0.03, 0.1, 0.3}) {
            OrderOptions options;
            options.seconds = seconds;
            const OrderedModel found = ordered(model, options);
            INFO(model.name << " " << seconds);
            CHECK(found.ray_test.wrong == 0);
            CHECK(count_wrong_rays(found.model, found.order, all_eyes(200)).wrong == 0);
            kept += found.found_by == OrderSource::TreeAndSplitPolygons ? 1 : 0;
        }
    }
    CHECK(kept >= 1);
}

TEST_CASE("parts and single polygons order crossing bars, rings and rotors for every eye") {
    for (const auto& model : {octant::tests::three_bars(), octant::tests::fig_14(true), octant::tests::pile(1989, 25),
             octant::tests::torus(416), shipped("f15")}) {
        INFO(model.name);
        const OrderedModel found = by(OrderMethod::Bsp, model);
        CHECK(found.notes.empty());
        CHECK(count_wrong_rays(found.model, found.order, all_eyes(400)).wrong == 0);
        const BspOrder single = bsp_order(model, BspLeaves::Single);
        CHECK(count_wrong_rays(single.model, single.order, all_eyes(400)).wrong == 0);
    }
    const OrderedModel turning = by(OrderMethod::Bsp, shipped("500md"));
    CHECK(turning.ray_test.wrong == 0);
    for (int step = 0; step < 8; ++step) {
        RaySampling eyes = all_eyes(200);
        eyes.turn_rad = 0.7 * step;
        CHECK(count_wrong_rays(turning.model, turning.order, eyes).wrong == 0);
    }
}

TEST_CASE("an order by a few parts has cells, which hold the same orders") {
    const OrderedModel found = by(OrderMethod::Bsp, octant::tests::three_bars());
    const auto cells = octant::visuals::orderfile::bsp_cells(found.model, found.order);
    REQUIRE(cells);
    RandomGenerator dice(4);
    DrawOrder::Walk walk;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 eye_m = dice.direction() * dice.between(0.1, 9.0);
        const auto in = std::ranges::find_if(*cells, [&](const auto& cell) {
            return std::ranges::all_of(
                cell.planes, [&](const octant::Plane& plane) { return octant::distance_m(plane, eye_m) >= 0.0; });
        });
        REQUIRE(in != cells->end());
        std::vector<std::uint32_t> painted;
        found.order.append_painted(eye_m, walk, painted);
        CHECK(in->list == painted);
    }
}

TEST_CASE("a trial allows for rays that graze what lies within the tolerance of an order") {
    const auto wrong_at = [](double gap_m) {
        PolygonModel model;
        model.materials.emplace_back();
        model.parts = {"plates"};
        for (const double height_m : {0.0, gap_m}) {
            model.polygons.push_back({.first_corner = model.polygons.empty() ? 0U : 4U});
            model.polygons.back().corner_count = 4;
            for (const glm::dvec2& at_m : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                model.corner_vertices.push_back(std::uint32_t(model.vertices_m.size()));
                model.vertices_m.emplace_back(at_m, height_m);
            }
        }
        return ray_test_order(model, DrawOrder(std::vector<std::uint32_t>{1, 0}), {}).wrong;
    };
    CHECK(wrong_at(2e-9) == 0);
    CHECK(wrong_at(2e-8) > 0);
}

TEST_CASE("a trial sees what is painted too early, off the origin and as a decal too") {
    PolygonModel model = octant::tests::plate_between_boxes();
    OrderedModel found = by(OrderMethod::Tree, model);
    CHECK(ray_test_order(found.model, found.order, {}).wrong == 0);
    CHECK(ray_test_order(model, file_order(model), {}).wrong > 0);
    for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m += glm::dvec3(1e6, -1e6, 0.0); }
    const RayTestResult far = ray_test_order(model, file_order(model), {});
    CHECK(far.rays > 1000);
    CHECK(far.wrong > 0);
    PolygonModel decal = octant::tests::fig_14();
    decal.polygons.push_back(decal.polygons[0]);
    CHECK(ray_test_order(decal, DrawOrder(std::vector<std::uint32_t>{2, 1, 0}), {}).wrong > 0);
}

TEST_CASE("orders are proved before they are used, by every exact method") {
    for (const OrderMethod method : {OrderMethod::Cells, OrderMethod::Tree, OrderMethod::Bsp}) {
        for (const auto& model : {shipped("f15"), shipped("500md"), shipped("concave"), octant::tests::three_bars()}) {
            const OrderedModel found = by(method, model);
            INFO(model.name << " by method " << static_cast<int>(method));
            CHECK(found.ray_test.is_proof_complete);
            CHECK(found.ray_test.unproved == 0);
        }
    }
}

TEST_CASE("what rays see of polygons that changed places the proof sees too, and more") {
    const OrderedModel found = by(OrderMethod::Tree, shipped("500md"));
    std::vector<std::vector<std::uint32_t>> lists;
    for (int cell = 0; cell < found.order.cell_count(); ++cell) {
        const auto list = found.order.polygons_of(cell);
        lists.emplace_back(list.begin(), list.end());
    }
    int seen = 0;
    int unproved = 0;
    RandomGenerator dice(3);
    for (int i = 0; i < 40; ++i) {
        auto changed = lists;
        auto& list = changed[static_cast<std::size_t>(dice.between(0, double(lists.size())))];
        const auto at = static_cast<std::size_t>(dice.between(0, double(list.size()) - 4.0));
        std::swap(list[at], list[at + 3]);
        const auto nodes = found.order.nodes();
        const DrawOrder order({nodes.begin(), nodes.end()}, changed);
        const bool is_open = prove_order(found.model, order, 10.0).unproved > 0;
        const bool is_wrong = ray_test_order(found.model, order, {.proof_s = 0.0}).wrong > 0;
        unproved += is_open ? 1 : 0;
        seen += is_wrong ? 1 : 0;
        CHECK((is_open || !is_wrong));
        if (is_open) { // rays aimed at the open pairs
            CHECK(ray_test_order(found.model, order, {.proof_s = 10.0}).unproved > 0);
        }
    }
    CHECK(seen > 0);
    CHECK(unproved >= seen);
}

TEST_CASE("a proof ends when its work is spent, the same each time") {
    const OrderedModel found = by(OrderMethod::Tree, octant::tests::torus(416));
    CHECK(prove_order(found.model, found.order, 10.0).is_complete);
    CHECK_FALSE(prove_order(found.model, found.order, 1e-5).is_complete);
    CHECK(ray_test_order(found.model, found.order, {.proof_s = 1e-5}).wrong == 0);
    OrderOptions options;
    options.seconds = 0.3;
    const OrderedModel once = ordered(shipped("f15"), options);
    const OrderedModel again = ordered(shipped("f15"), options);
    CHECK(once.ray_test.is_proof_complete == again.ray_test.is_proof_complete);
    CHECK(once.ray_test.unproved == again.ray_test.unproved);
}
