#include "models/polygons/polygon_model.h"
#include "sim/base/axes.h"
#include "sim/base/random_generator.h"
#include "tests/paper_example.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/orderfile/random_ray_test.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

using namespace octant;
using namespace octant::visuals::draworder;
using octant::RandomGenerator;
using octant::tests::paper_example;
using octant::visuals::orderfile::count_wrong_rays;

TEST_CASE("children of an octant path are the parts of its triangle") {
    const auto close = [](const OctantTriangle& a, const OctantTriangle& b) {
        return std::ranges::equal(a, b, [](const auto& p, const auto& q) { return glm::distance(p, q) < 1e-15; });
    };
    CHECK(close(octant_triangle("+-+"), {glm::dvec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}}));
    CHECK(close(octant_triangle("+++/0"), {glm::dvec3(1, 0, 0), {0.5, 0.5, 0}, {0.5, 0, 0.5}}));
    CHECK(close(octant_triangle("+++/1"), {glm::dvec3(0.5, 0.5, 0), {0, 1, 0}, {0, 0.5, 0.5}}));
    CHECK(close(octant_triangle("+++/2"), {glm::dvec3(0.5, 0, 0.5), {0, 0.5, 0.5}, {0, 0, 1}}));
    CHECK(close(octant_triangle("+++/3"), {glm::dvec3(0, 0.5, 0.5), {0.5, 0, 0.5}, {0.5, 0.5, 0}}));
}

TEST_CASE("an octant path means the same eyes in the axes of any file") {
    for (const char* name : {"right,up,back", "up,right,forward", "left,back,up"}) {
        const auto axes = models::polygons::FileAxes::from_text(name);
        for (const std::string path : {"+++", "-+-/2", "+--/0/3/1", "---/1/1/0/2"}) {
            const std::string in_file = path_in_file(path, axes);
            CHECK(path_in_body(in_file, axes) == path);
            glm::dvec3 body(0.0);
            glm::dvec3 file(0.0);
            for (const glm::dvec3& corner : octant_triangle(path)) { body += corner; }
            for (const glm::dvec3& corner : octant_triangle(in_file)) { file += corner; }
            CHECK(glm::distance(axes.body_from_file(file), body) < 1e-15);
        }
    }
}

namespace {

ScreenPolygon seen(const std::vector<glm::dvec3>& corners) {
    ScreenPolygon polygon{corners, corners[0], corners[0]};
    for (const glm::dvec3& corner : corners) {
        polygon.least = glm::min(polygon.least, corner);
        polygon.most = glm::max(polygon.most, corner);
    }
    return polygon;
}

using Order = std::vector<std::uint32_t>;

} // namespace

TEST_CASE("the farther depth range is painted first, even where the polygons lie apart") {
    const auto far_one = seen({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto occluder = seen({{5, 5, 1}, {6, 5, 1}, {5, 6, 1}});
    CHECK(paint_first(far_one, occluder) == PaintFirst::A);
    CHECK(paint_first(occluder, far_one) == PaintFirst::B);
}

TEST_CASE("with nested depth ranges polygons in separate boxes are free") {
    const auto flat = seen({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto slanted = seen({{2, 0, -1}, {3, 0, 1}, {2, 1, 1}});
    CHECK(paint_first(flat, slanted) == PaintFirst::Either);
    CHECK(paint_first(slanted, flat) == PaintFirst::Either);
}

TEST_CASE("with nested depth ranges the depth at the first crossing of edges decides") {
    // A bar along x at depth 0; another along y from depth -1 to 3, at 0.6 to 1.4 where they cross.
    const auto flat = seen({{-5, -1, 0}, {5, -1, 0}, {5, 1, 0}, {-5, 1, 0}});
    const auto rising = seen({{-1, -5, -1}, {1, -5, -1}, {1, 5, 3}, {-1, 5, 3}});
    CHECK(paint_first(flat, rising) == PaintFirst::A);
    CHECK(paint_first(rising, flat) == PaintFirst::B);
}

TEST_CASE("polygons whose boxes overlap but whose edges do not cross are free") {
    const auto lower_left = seen({{0, 0, 0}, {4, 0, 1}, {0, 4, 1}});
    const auto upper_right = seen({{4, 4, 0.5}, {1, 4, 0.5}, {4, 1, 0.5}});
    CHECK(paint_first(lower_left, upper_right) == PaintFirst::Either);
}

TEST_CASE("polygons that share an edge are free when nothing else crosses") {
    const auto left = seen({{0, 0, 0}, {0, 1, 0}, {-1, 0, -1}});
    const auto right = seen({{0, 0, 0}, {1, 0, -1}, {0, 1, 0}});
    CHECK(paint_first(left, right) == PaintFirst::Either);
}

TEST_CASE("without precedences the order is that of the numbers") {
    const TopologicalOrder sequence = topological_order(3, {});
    CHECK(sequence.order == Order{0, 1, 2});
    CHECK(sequence.broken_cycles == 0);
}

TEST_CASE("precedences are kept and the lowest number goes first otherwise") {
    const std::vector<Precedence> pairs{{3, 0}, {2, 3}, {2, 3}};
    CHECK(topological_order(5, pairs).order == Order{1, 2, 3, 0, 4});
}

TEST_CASE("a cycle is broken at the polygon that waits for the fewest, and counted") {
    const std::vector<Precedence> ring{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}};
    const TopologicalOrder sequence = topological_order(4, ring);
    CHECK(sequence.broken_cycles == 1);
    CHECK(sequence.order == Order{1, 2, 3, 0});
}

namespace {

/// What the paper's table 4 lists in an octant, numbers from 1, and what must precede what.
struct TableRow {
    std::string octant;
    Order polygons;
    std::uint32_t first;
    Order later;
};

const std::array<TableRow, 8> table_4{{
    {"+++", {1, 7, 2, 8, 3, 4}, 0, {}},
    {"++-", {1, 9, 2, 10, 3, 4}, 0, {}},
    {"+-+", {2, 7, 8, 6, 4}, 2, {4, 6, 8}},
    {"+--", {2, 9, 10, 6, 4}, 2, {4, 6, 10}},
    {"-++", {8, 3, 7, 1, 5}, 3, {1, 5, 7}},
    {"-+-", {10, 3, 9, 1, 5}, 3, {1, 5, 9}},
    {"--+", {8, 7, 6, 5}, 0, {}},
    {"---", {10, 9, 6, 5}, 0, {}},
}};

/// List of an octant by its name, numbers from 1.
Order list_of(const OctantOrders& orders, const std::string& octant) {
    for (int i = 0; i < 8; ++i) {
        if (octant_name(i) == octant) {
            Order list = orders.lists[static_cast<std::size_t>(i)];
            for (std::uint32_t& polygon : list) { ++polygon; }
            return list;
        }
    }
    return {};
}

Order sorted(Order list) {
    std::ranges::sort(list);
    return list;
}

/// The octant by which the paper's orders choose their list.
int octant_of(const glm::dvec3& eye_in_body_m) {
    static const DrawOrder order(paper_orders(paper_example()));
    return order.cell_of(eye_in_body_m);
}

} // namespace

TEST_CASE("the octant of an eye is told by its signs, zero counting as positive") {
    CHECK(octant_of({1, 1, 1}) == 0);
    CHECK(octant_of({-1, 1, 1}) == 1);
    CHECK(octant_of({1, -1, 1}) == 2);
    CHECK(octant_of({1, 1, -1}) == 4);
    CHECK(octant_of({-1, -1, -1}) == 7);
    CHECK(octant_of({0, 0, 0}) == 0);
    CHECK(octant_of({-0.0, -0.0, -0.0}) == 0);
    CHECK(octant_of({-std::numeric_limits<double>::denorm_min(), 0, 5}) == 1);
}

TEST_CASE("octants have the names and signs of the paper") {
    const std::array<std::string, 8> names{"+++", "-++", "+-+", "--+", "++-", "-+-", "+--", "---"};
    const DrawOrder order(paper_orders(paper_example()));
    for (int octant = 0; octant < 8; ++octant) {
        CHECK(octant_name(octant) == names[static_cast<std::size_t>(octant)]);
        CHECK(order.cell_of(octant_signs(octant)) == octant);
    }
}

TEST_CASE("each octant lists the polygons of the paper's table 4, each once") {
    const OctantOrders orders = paper_orders(paper_example());
    for (const TableRow& row : table_4) { CHECK(sorted(list_of(orders, row.octant)) == sorted(row.polygons)); }
    CHECK(orders.broken_cycles == 0);
}

TEST_CASE("the 12 precedences that the example needs are kept") {
    const OctantOrders orders = paper_orders(paper_example());
    for (const TableRow& row : table_4) {
        const Order list = list_of(orders, row.octant);
        for (const std::uint32_t later : row.later) {
            CHECK(std::ranges::find(list, row.first) < std::ranges::find(list, later));
        }
    }
}

TEST_CASE("no ray from any octant of the example sees a wrong polygon") {
    const DrawOrder order(paper_orders(paper_example()));
    for (int octant = 0; octant < 8; ++octant) {
        const auto count =
            count_wrong_rays(paper_example(), order, {.eyes = 150, .rays_per_eye = 20, .octant = octant});
        CHECK(count.hits > 900);
        CHECK(count.wrong == 0);
    }
}

TEST_CASE("the paper's printed table paints the example without a wrong ray, too") {
    OctantOrders printed;
    for (const TableRow& row : table_4) {
        for (int octant = 0; octant < 8; ++octant) {
            if (octant_name(octant) == row.octant) {
                for (const std::uint32_t polygon : row.polygons) {
                    printed.lists[static_cast<std::size_t>(octant)].push_back(polygon - 1);
                }
            }
        }
    }
    CHECK(count_wrong_rays(paper_example(), DrawOrder(printed), {}).wrong == 0);
}

TEST_CASE("file order paints the example wrongly: the ray test can fail") {
    CHECK(count_wrong_rays(paper_example(), file_order(paper_example()), {}).wrong_share() > 0.01);
}

TEST_CASE("a polygon is listed where it faces some eye, also where the viewpoint misses it") {
    // A plate that faces almost -x: eyes of octant +++ near the y axis still see it.
    auto plate = paper_example();
    plate.polygons.resize(1);
    plate.corner_vertices = {0, 1, 2};
    plate.polygons[0].corner_count = 3;
    plate.vertices_m = {{0, 0, 0}, {0, 0, 1}, {0.1, 1, 0}};
    REQUIRE(octant::models::polygons::normal_of(plate, 0).x < -0.9);
    const glm::dvec3 viewpoint_m(3.0 * octant::models::polygons::radius_m(plate));
    REQUIRE(octant::distance_m(octant::models::polygons::plane_of(plate, 0), viewpoint_m) < 0.0);
    CHECK(paper_orders(plate).lists[0].size() == 1);
}

TEST_CASE("whatever a random eye outside the radius sees is in its octant's list once") {
    const auto model = paper_example();
    const double radius_m = octant::models::polygons::radius_m(model);
    const OctantOrders orders = paper_orders(model);
    RandomGenerator dice(7);
    for (int sample = 0; sample < 2000; ++sample) {
        const glm::dvec3 eye_m = dice.direction() * (radius_m * dice.between(1.0, 9.0));
        const Order& list = orders.lists[static_cast<std::size_t>(octant_of(eye_m))];
        for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
            const glm::dvec3 to_eye_m = eye_m - model.vertices_m[model.corners(i)[0]];
            if (glm::dot(to_eye_m, octant::models::polygons::normal_of(model, i)) > 0.0) {
                CHECK(std::ranges::count(list, i) == 1);
            }
        }
    }
}

TEST_CASE("three bars, each over the next, cannot be ordered, and the result says so") {
    const glm::dvec3 towards_eye = glm::normalize(glm::dvec3(1, 1, 1));
    const glm::dvec3 along = glm::normalize(glm::dvec3(0, 1, -1));
    const glm::dvec3 inward = glm::cross(towards_eye, along);
    octant::models::polygons::PolygonModel bars = paper_example();
    bars.vertices_m.clear();
    bars.polygons.resize(3);
    for (int bar = 0; bar < 3; ++bar) {
        for (const auto& [t, side] : {std::pair{-5, -2}, {5, -2}, {5, -1}, {-5, -1}}) {
            const glm::dvec3 p = along * (1.0 * t) + inward * (1.0 * side) + towards_eye * (0.1 * t);
            const std::array<double, 6> turned{p.x, p.y, p.z, p.x, p.y, p.z};
            const auto first = static_cast<std::size_t>(bar);
            bars.vertices_m.emplace_back(turned[first], turned[first + 1], turned[first + 2]);
        }
    }
    bars.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    REQUIRE(glm::dot(octant::models::polygons::normal_of(bars, 0), towards_eye) > 0.9);
    const OctantOrders orders = paper_orders(bars);
    CHECK(orders.lists[0].size() == 3);
    CHECK(orders.broken_cycles >= 1);
    CHECK(count_wrong_rays(bars, DrawOrder(orders), {.octant = 0}).wrong > 0);
    bars.polygons.resize(2);
    CHECK(paper_orders(bars).broken_cycles == 0);
}

TEST_CASE("the eye in body axes follows equations (34) to (36)") {
    const double theta = 0.3;
    const double phi = -0.7;
    const double gamma = 2.1;
    const glm::dvec3 object(30, -20, 50);
    const glm::dquat attitude = glm::angleAxis(theta, glm::dvec3(1, 0, 0)) * glm::angleAxis(phi, glm::dvec3(0, 1, 0)) *
                                glm::angleAxis(gamma, glm::dvec3(0, 0, 1));
    const double st = std::sin(theta);
    const double ct = std::cos(theta);
    const double sp = std::sin(phi);
    const double cp = std::cos(phi);
    const double sg = std::sin(gamma);
    const double cg = std::cos(gamma);
    const glm::dvec3 expected(
        -object.x * cg * cp - object.y * (sg * ct + cg * sp * st) - object.z * (sg * st - cg * sp * ct),
        object.x * sg * cp - object.y * (cg * ct - sg * sp * st) - object.z * (cg * st + sg * sp * ct),
        -object.x * sp + object.y * cp * st - object.z * cp * ct);
    CHECK(glm::distance(eye_in_body({0, 0, 0}, object, attitude), expected) < 1e-12);
}

TEST_CASE("an eye behind, left and above a flying aircraft lies in octant ---") {
    // Heading east: behind is west, left is north.
    const glm::dquat attitude = octant::body_to_world_from_euler({.heading_rad = 1.5707963267948966});
    const glm::dvec3 eye = eye_in_body({70, 220, 1010}, {100, 200, 1000}, attitude);
    CHECK(glm::distance(eye, glm::dvec3(-30, -20, -10)) < 1e-9);
    CHECK(octant_name(octant_of(eye)) == "---");
}
