#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "tests/order_shapes.h"
#include "tests/paper_example.h"
#include "visuals/draworder/order_ray_test.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/cell_orders.h"
#include "visuals/orderfile/random_ray_test.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

using namespace octant::visuals::draworder;
using octant::RandomGenerator;
using octant::models::polygons::PolygonModel;
using octant::tests::paper_example;
using octant::visuals::orderfile::count_wrong_rays;
using octant::visuals::orderfile::RaySampling;

namespace {

/// A model that comes with the program, by its file's name without ending.
PolygonModel shipped(const std::string& name) {
    return octant::models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/" + name + ".obj");
}

OrderedModel by(OrderMethod method, PolygonModel model) { return ordered(std::move(model), {.method = method}); }

/// From inside the model outwards.
RaySampling all_eyes(int eyes) { return {.eyes = eyes, .rays_per_eye = 30, .min_distance_radii = 0.05}; }

/// Orders a model, which must be right for every eye and proved; returns how many polygons were split.
int check_tree(const PolygonModel& model, int eyes, int max_cells) {
    INFO(model.name);
    const OrderedModel found = by(OrderMethod::Exact, model);
    const auto count = count_wrong_rays(found.model, found.order, all_eyes(eyes));
    CHECK(count.hits > eyes);
    CHECK(count.wrong == 0);
    CHECK(found.order.cell_count() <= max_cells);
    CHECK(found.cyclic_cells == 0);
    CHECK(found.cells.size() == static_cast<std::size_t>(found.order.cell_count()));
    if (model.polygons.size() < 100) { // larger ones are not proved to the end
        CHECK(found.ray_test.is_proof_complete);
        CHECK(found.ray_test.unproved == 0);
    }
    return found.splits;
}

/// The model with its turning parts turned, each about its own pivot.
PolygonModel turned_by(const PolygonModel& model, double angle_rad) {
    PolygonModel out = model;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto pivot = octant::models::polygons::pivot_of(model, i);
        if (!pivot) { continue; }
        const auto& polygon = model.polygons[i];
        for (std::uint32_t corner = 0; corner < polygon.corner_count; ++corner) {
            std::uint32_t& vertex = out.corner_vertices[polygon.first_corner + corner];
            const glm::dvec3 place_m = model.vertices_m[vertex];
            vertex = static_cast<std::uint32_t>(out.vertices_m.size());
            out.vertices_m.push_back(octant::models::polygons::turned(model.pivots[*pivot], place_m, angle_rad));
        }
    }
    return out;
}

} // namespace

TEST_CASE("the paper's method names its eight octants and keeps its lists") {
    const OctantOrders orders = paper_orders(paper_example());
    const OrderedModel model = by(OrderMethod::Paper, paper_example());
    REQUIRE(model.cells.size() == 8);
    for (int octant = 0; octant < 8; ++octant) {
        const OrderCell& cell = model.cells[static_cast<std::size_t>(octant)];
        CHECK(cell.path == octant_name(octant));
        const auto list = model.order.polygons_of(octant);
        const auto& expected = orders.lists[static_cast<std::size_t>(octant)];
        CHECK(std::vector<std::uint32_t>(list.begin(), list.end()) == expected);
        for (const octant::Plane& plane : cell.planes) {
            CHECK(octant::distance_m(plane, octant_signs(octant)) == 1.0);
        }
    }
    CHECK(model.splits == 0);
    CHECK(model.cyclic_cells == 0);
}

TEST_CASE("one list is right for every eye of the paper's example") { check_tree(paper_example(), 1500, 1); }

TEST_CASE("exact lists keep the precedences that the paper's example needs") {
    const OrderedModel found = by(OrderMethod::Exact, paper_example());
    CHECK(octant::tests::keeps_table_4(
        [&](const glm::dvec3& signs) { return found.order.polygons_of(found.order.cell_of(signs * 400.0)); }));
    CHECK(count_wrong_rays(found.model, found.order, all_eyes(1000)).wrong == 0);
}

TEST_CASE("the shipped aircraft have a right and proved list for every eye, and few of them") {
    CHECK(check_tree(shipped("f15"), 1500, 6) == 0);
    CHECK(check_tree(shipped("500md"), 1500, 10) == 0);
    check_tree(shipped("500md-detailed"), 150, 140);
}

TEST_CASE("concave, thin and round shapes have a right list for every eye") {
    check_tree(octant::tests::u_channel(), 1500, 1);
    check_tree(octant::tests::plate_between_boxes(), 1500, 2);
    check_tree(octant::tests::torus(100), 600, 8);
    check_tree(octant::tests::pile(7, 6), 1000, 40);
}

TEST_CASE("a pile whose bodies hide one another in rings is ordered with few splits") {
    const OrderedModel pile = by(OrderMethod::Exact, octant::tests::pile(1989, 25));
    CHECK(pile.splits >= 1);
    CHECK(pile.splits <= 3);
    CHECK(count_wrong_rays(pile.model, pile.order, all_eyes(300)).wrong == 0);
}

TEST_CASE("an eye lies in front of all planes of its cell, and its cell's path is its octant's") {
    for (const OrderMethod method : {OrderMethod::Paper, OrderMethod::Exact}) {
        const OrderedModel found = by(method, shipped("f15"));
        RandomGenerator dice(3);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 from_centre_m = dice.direction() * dice.between(25.0, 80.0);
            const glm::dvec3 eye_m = found.centre_m + from_centre_m;
            const OrderCell& cell = found.cells[static_cast<std::size_t>(found.order.cell_of(eye_m))];
            for (const octant::Plane& plane : cell.planes) { CHECK(octant::distance_m(plane, eye_m) > -1e-6); }
            if (method == OrderMethod::Paper) {
                for (int axis = 0; axis < 3; ++axis) {
                    const char sign = from_centre_m[axis] < 0.0 ? '-' : '+';
                    CHECK(cell.path[static_cast<std::size_t>(axis)] == sign);
                }
            }
        }
    }
}

TEST_CASE("the orders hold while the rotors turn") {
    const PolygonModel still = shipped("500md");
    const OrderedModel tree = by(OrderMethod::Exact, still);
    REQUIRE(tree.splits == 0);
    CHECK(tree.notes.empty());
    for (int step = 0; step < 12; ++step) {
        const PolygonModel turned = turned_by(still, octant::rad_from_deg(30.0 * step + 4.0));
        CHECK(count_wrong_rays(turned, tree.order, all_eyes(100)).wrong == 0);
    }
}

TEST_CASE("a list names a polygon that faces some eye of its cell once, and no other") {
    const OrderedModel found = by(OrderMethod::Exact, shipped("f15"));
    RandomGenerator dice(5);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 eye_m = dice.direction() * dice.between(1.0, 40.0);
        const auto list = found.order.polygons_of(found.order.cell_of(eye_m));
        CHECK(std::set<std::uint32_t>(list.begin(), list.end()).size() == list.size());
        for (std::size_t p = 0; p < found.model.polygons.size(); ++p) {
            if (octant::distance_m(octant::models::polygons::plane_of(found.model, p), eye_m) > 1e-6) {
                CHECK(std::ranges::count(list, p) == 1);
            }
        }
    }
}

TEST_CASE("the same model gives the same cells and lists") {
    const OrderedModel once = by(OrderMethod::Exact, octant::tests::pile(7, 6));
    const OrderedModel twice = by(OrderMethod::Exact, octant::tests::pile(7, 6));
    CHECK(std::ranges::equal(once.order.polygons(), twice.order.polygons()));
    REQUIRE(once.cells.size() == twice.cells.size());
    for (std::size_t i = 0; i < once.cells.size(); ++i) { CHECK(once.cells[i].planes == twice.cells[i].planes); }
}

TEST_CASE("progress rises while cells are searched for") {
    OrderOptions options;
    double last = -1.0;
    bool rises = true;
    options.progress = [&](double share) {
        rises = rises && share >= last;
        last = share;
    };
    CHECK(ordered(shipped("f15"), options).found_by == OrderSource::Tree);
    CHECK(rises);
    CHECK(last > 0.0);
    CHECK(last < 1.0);
}

TEST_CASE("neither place nor size of a model matters to its order") {
    const PolygonModel model = octant::tests::three_bars();
    const OrderedModel still = by(OrderMethod::Exact, model);
    for (const auto& [scale, away] : {std::pair{1.0, 1e6}, std::pair{1e-6, 0.0}, std::pair{1e6, 0.0}}) {
        PolygonModel other = model;
        for (glm::dvec3& vertex_m : other.vertices_m) { vertex_m = vertex_m * scale + away; }
        const OrderedModel moved = by(OrderMethod::Exact, other);
        INFO(scale << " times, " << away << " m away");
        CHECK(moved.splits == still.splits);
        REQUIRE(moved.order.cell_count() == still.order.cell_count());
        for (int cell = 0; cell < still.order.cell_count(); ++cell) {
            CHECK(std::ranges::equal(moved.order.polygons_of(cell), still.order.polygons_of(cell)));
        }
        const auto count = count_wrong_rays(moved.model, moved.order, all_eyes(500));
        CHECK(count.hits > 500);
        CHECK(count.wrong == 0);
    }
}

TEST_CASE("a model that is turned has the same lists") {
    for (const PolygonModel& model : {shipped("f15"), octant::tests::three_bars(), octant::tests::pile(7, 6)}) {
        PolygonModel other = model;
        const glm::dquat turn = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, -2, 0.5)));
        for (glm::dvec3& vertex_m : other.vertices_m) { vertex_m = turn * vertex_m; }
        const OrderedModel still = by(OrderMethod::Exact, model);
        const OrderedModel turned = by(OrderMethod::Exact, other);
        INFO(model.name);
        CHECK(turned.splits == still.splits);
        REQUIRE(turned.order.cell_count() == still.order.cell_count());
        for (int cell = 0; cell < still.order.cell_count(); ++cell) {
            CHECK(std::ranges::equal(turned.order.polygons_of(cell), still.order.polygons_of(cell)));
        }
    }
}

namespace {

/// Two blades about the origin: one turns about z, the other about x.
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
    const OrderedModel found = by(OrderMethod::Exact, crossing_rotors());
    CHECK(found.splits == 0);
    REQUIRE(found.notes.size() == 1);
    CHECK(found.notes[0] == "across and along meet as they turn; no order is right for them");
}

TEST_CASE("rings of bars and polygons that pass through one another are split") {
    const OrderedModel bars = by(OrderMethod::Exact, octant::tests::three_bars());
    CHECK(bars.splits >= 2);
    CHECK(bars.splits <= 4);
    CHECK(bars.model.polygons.size() == 6 + static_cast<std::size_t>(bars.splits));
    CHECK(count_wrong_rays(bars.model, bars.order, all_eyes(2000)).wrong == 0);
    const OrderedModel crossed = by(OrderMethod::Exact, octant::tests::fig_14(true));
    CHECK(crossed.splits >= 2);
    CHECK(count_wrong_rays(crossed.model, crossed.order, all_eyes(2000)).wrong == 0);
}

TEST_CASE("a model whose cycles no cut of the search resolves is split by planes") {
    PolygonModel model;
    model.materials.emplace_back();
    model.parts = {"all"};
    model.vertices_m = {{-0.985746, 0.859528, 1.75496}, {-0.311808, 0.775657, 1.758152},
        {-0.623282, 0.800776, 1.756676}, {-0.617095, 0.896428, 1.756709}, {-0.311808, 0.908202, 1.758152}};
    model.corner_vertices = {0, 3, 2, 4, 1, 2, 3};
    model.polygons = {{0, 3, 0, 0}, {3, 4, 0, 0}};
    const OrderedModel found = by(OrderMethod::Exact, model);
    CHECK(count_wrong_rays(found.model, found.order, all_eyes(300)).wrong == 0);
    CHECK(found.ray_test.rays > 1000);
    CHECK(found.ray_test.wrong == 0);
}

TEST_CASE("where no time is left for the search, polygons are split by planes and a note says so") {
    const PolygonModel pile = octant::tests::pile(7, 12);
    OrderOptions options;
    options.seconds = 0.001;
    const OrderedModel found = ordered(pile, options);
    CHECK(found.found_by == OrderSource::Parts);
    CHECK(found.cells.empty());
    REQUIRE(found.notes.size() == 1);
    CHECK(found.notes[0] ==
          "no view cells are used, polygons are split by planes: the search for cells took more than 0.001 s");
    CHECK(count_wrong_rays(found.model, found.order, all_eyes(600)).wrong == 0);
    const OrderedModel again = ordered(pile, options);
    CHECK(std::ranges::equal(again.order.polygons(), found.order.polygons()));
}

TEST_CASE("cells that were found before the time was spent are kept, and the others are parted") {
    int kept = 0;
    for (const auto& model : {shipped("f15"), shipped("500md"), octant::tests::pile(7, 12)}) {
        for (const double seconds : {0.03, 0.1}) {
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

TEST_CASE("the ray test allows for rays that graze what lies within the tolerance of an order") {
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

TEST_CASE("the ray test sees what is painted too early, off the origin and as a decal too") {
    PolygonModel model = octant::tests::plate_between_boxes();
    OrderedModel found = by(OrderMethod::Exact, model);
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

TEST_CASE("orders are proved before they are used") {
    for (const auto& model : {shipped("concave"), octant::tests::three_bars()}) {
        const OrderedModel found = by(OrderMethod::Exact, model);
        INFO(model.name);
        CHECK(found.ray_test.is_proof_complete);
        CHECK(found.ray_test.unproved == 0);
    }
}

TEST_CASE("what rays see of polygons that changed places the proof sees too, and more") {
    const OrderedModel found = by(OrderMethod::Exact, shipped("f15"));
    std::vector<std::vector<std::uint32_t>> lists;
    for (int cell = 0; cell < found.order.cell_count(); ++cell) {
        const auto list = found.order.polygons_of(cell);
        lists.emplace_back(list.begin(), list.end());
    }
    int seen = 0;
    int unproved = 0;
    RandomGenerator dice(3);
    for (int i = 0; i < 20; ++i) {
        auto changed = lists;
        auto& list = changed[static_cast<std::size_t>(dice.between(0, double(lists.size())))];
        const auto at = static_cast<std::size_t>(dice.between(0, double(list.size()) - 4.0));
        std::swap(list[at], list[at + 3]);
        const auto nodes = found.order.nodes();
        const DrawOrder order({nodes.begin(), nodes.end()}, changed);
        const RayTestResult test = ray_test_order(found.model, order, {.proof_s = 10.0});
        CHECK(test.is_proof_complete);
        CHECK((test.unproved > 0 || test.wrong == 0));
        unproved += test.unproved > 0 ? 1 : 0;
        seen += test.wrong > 0 ? 1 : 0;
    }
    CHECK(seen > 0);
    CHECK(unproved >= seen);
}

TEST_CASE("a proof ends when its work is spent, the same each time") {
    const OrderedModel found = by(OrderMethod::Exact, octant::tests::torus(416));
    CHECK(ray_test_order(found.model, found.order, {.proof_s = 10.0}).is_proof_complete);
    const RayTestResult ended = ray_test_order(found.model, found.order, {.proof_s = 1e-5});
    CHECK_FALSE(ended.is_proof_complete);
    CHECK(ended.wrong == 0);
    OrderOptions options;
    options.seconds = 0.3;
    const OrderedModel once = ordered(shipped("f15"), options);
    const OrderedModel again = ordered(shipped("f15"), options);
    CHECK(once.ray_test.is_proof_complete == again.ray_test.is_proof_complete);
    CHECK(once.ray_test.unproved == again.ray_test.unproved);
}
