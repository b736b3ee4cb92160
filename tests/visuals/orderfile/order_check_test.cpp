#include "models/polygons/polygon_model.h"
#include "sim/base/output_file.h"
#include "tests/order_shapes.h"
#include "tests/paper_example.h"
#include "tests/scratch.h"
#include "visuals/orderfile/order_check.h"
#include "visuals/orderfile/order_text.h"
#include "visuals/orderfile/random_ray_test.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace octant;
using namespace octant::visuals::orderfile;
using visuals::draworder::ordered;
using visuals::draworder::OrderedModel;
using visuals::draworder::OrderMethod;

namespace {

/// A model of rectangles or triangles, each its own corners.
models::polygons::PolygonModel model_of(const std::vector<std::vector<glm::dvec3>>& polygons) {
    models::polygons::PolygonModel model = tests::paper_example();
    model.vertices_m.clear();
    model.corner_vertices.clear();
    model.polygons.clear();
    for (const auto& corners : polygons) {
        models::polygons::Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(corners.size());
        for (const glm::dvec3& corner : corners) {
            model.corner_vertices.push_back(static_cast<std::uint32_t>(model.vertices_m.size()));
            model.vertices_m.push_back(corner);
        }
        model.polygons.push_back(polygon);
    }
    return model;
}

CellOrders one_cell(std::vector<Plane> planes, std::vector<std::uint32_t> list, std::size_t faces) {
    CellOrders orders;
    orders.faces = faces;
    orders.cells.push_back({.path = "", .directions = {}, .planes = planes, .list = list});
    return orders;
}

CellOrders with_pair_swapped(CellOrders orders, std::size_t cell, std::size_t place) {
    std::swap(orders.cells[cell].list[place], orders.cells[cell].list[place + 1]);
    return orders;
}

const std::vector<glm::dvec3> low_plate{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

std::vector<glm::dvec3> moved(std::vector<glm::dvec3> corners, const glm::dvec3& by) {
    for (glm::dvec3& corner : corners) { corner += by; }
    return corners;
}

const Plane above{{0, 0, 1}, 0};

} // namespace

TEST_CASE("of two plates one above the other only the lower may be painted first") {
    const auto plates = model_of({low_plate, moved(low_plate, {0, 0, 1})});
    CHECK(check_order(plates, one_cell({}, {0, 1}, 2)).good());
    const OrderCheck wrong = check_order(plates, one_cell({}, {1, 0}, 2));
    CHECK(wrong.pairs == 1);
    CHECK(wrong.pairs_unproved == 1);
    CHECK(wrong.first_unproved == std::vector<UnprovedPair>{{0, 1, 0}});
}

TEST_CASE("two slanted plates side by side need a plane that none of them has") {
    // Both see the eyes above; neither lies on one side of the other's plane.
    const auto slanted = model_of(
        {{{-3, -1, 0}, {-1, -1, 1}, {-1, 1, 1}, {-3, 1, 0}}, {{1, -1, 1.2}, {3, -1, 0}, {3, 1, 0}, {1, 1, 1.2}}});
    const Plane over{{0, 0, 1}, -5};
    const OrderCheck check = check_order(slanted, one_cell({over}, {0, 1}, 2));
    CHECK(check.good());
    CHECK(check_order(slanted, one_cell({over}, {1, 0}, 2)).good());
    // From low at the right the right one hides the left one.
    const Plane right{{1, 0, 0}, -4};
    CHECK(check_order(slanted, one_cell({right}, {0, 1}, 2)).good());
    const auto tipped = model_of(
        {{{-3, -1, 0}, {-1, -1, -0.5}, {-1, 1, -0.5}, {-3, 1, 0}}, {{1, -1, 1}, {3, -1, 0}, {3, 1, 0}, {1, 1, 1}}});
    CHECK(check_order(tipped, one_cell({right}, {0, 1}, 2)).good());
    CHECK_FALSE(check_order(tipped, one_cell({right}, {1, 0}, 2)).good());
}

TEST_CASE("polygons that touch are certified, polygons that cross are not") {
    const auto roof = model_of({{{0, -1, 1}, {1, -1, 0}, {1, 1, 0}, {0, 1, 1}},
        {{-1, -1, 0}, {0, -1, 1}, {0, 1, 1}, {-1, 1, 0}}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}});
    CHECK(check_order(roof, one_cell({above}, {2, 1, 0}, 3)).good());
    CHECK(check_order(roof, one_cell({above}, {2, 0, 1}, 3)).good());
    const auto crossing = model_of({low_plate, {{-0.5, -0.5, -1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, -1}}});
    const Plane high{{0, 0, 1}, -9};
    CHECK_FALSE(check_order(crossing, one_cell({high}, {0, 1}, 2)).good());
    CHECK_FALSE(check_order(crossing, one_cell({high}, {1, 0}, 2)).good());
}

TEST_CASE("a polygon may be left out only where no eye sees its front") {
    const auto plates = model_of({low_plate, moved(low_plate, {5, 0, 0})});
    const Plane below{{0, 0, -1}, 0};
    CHECK(check_order(plates, one_cell({below}, {}, 2)).good());
    const OrderCheck check = check_order(plates, one_cell({above}, {1}, 2));
    CHECK(check.unlisted == 1);
    CHECK(check.first_unproved == std::vector<UnprovedPair>{{0, 0, 0}});
    CellOrders from_below = one_cell({below}, {}, 2);
    from_below.two_sided = {1};
    CHECK(check_order(plates, from_below).first_unproved == std::vector<UnprovedPair>{{0, 1, 1}});
}

TEST_CASE("the paper's table is certified beyond the model's radius, and no other order is") {
    const auto model = tests::paper_example();
    const CellOrders orders = cell_orders(ordered(model, {.method = OrderMethod::Paper}));
    const OrderCheck check = check_order(model, orders);
    CHECK(check.good());
    CHECK(check.pairs == 4 * 10 + 2 * 15 + 2 * 6);
    CHECK(check.by_plane + check.by_linear_program == check.pairs);
    // Whatever two neighbours change places: the certificate and the rays agree.
    for (std::size_t cell = 0; cell < 8; ++cell) {
        for (std::size_t place = 0; place + 1 < orders.cells[cell].list.size(); ++place) {
            const CellOrders swapped = with_pair_swapped(orders, cell, place);
            const auto rays =
                count_wrong_rays(model, swapped, {.eyes = 4000, .rays_per_eye = 5, .min_distance_radii = 1.8});
            INFO(cell << " " << place);
            CHECK(check_order(model, swapped).good() == (rays.wrong == 0));
        }
    }
}

TEST_CASE("rays find eyes that no cell has") {
    const auto model = tests::paper_example();
    CellOrders orders = cell_orders(ordered(model, {.method = OrderMethod::Paper}));
    CHECK(count_wrong_rays(model, orders, {.eyes = 200}).eyes_without_cell == 0);
    orders.cells.erase(orders.cells.begin());
    const RayTestCounts count = count_wrong_rays(model, orders, {.eyes = 200});
    CHECK(count.eyes_without_cell > 5);
    CHECK(count.eyes > 100);
}

TEST_CASE("a turning part is certified for every angle") {
    // A blade that turns about z above a plate, and one that dips into a box beside it.
    auto rotor = model_of({low_plate, {{0, -0.1, 1}, {3, -0.1, 1}, {3, 0.1, 1}, {0, 0.1, 1}},
        {{-2.5, -1, 0}, {-1.5, -1, 0}, {-1.5, 1, 2}, {-2.5, 1, 2}}});
    rotor.parts = {"body", "rotor"};
    rotor.polygons[1].part = 1;
    rotor.pivots = {{.part = 1, .point_m = {0, 0, 1}, .axis = {0, 0, 1}}};
    auto plate_and_blade = rotor;
    plate_and_blade.polygons.resize(2);
    CHECK(check_order(plate_and_blade, one_cell({}, {0, 1}, 2)).good());
    CHECK_FALSE(check_order(plate_and_blade, one_cell({}, {1, 0}, 2)).good());
    // At the file's angle the ramp is far from the blade, at half a turn they cross. The eyes are high above both.
    const double half = std::sqrt(0.5);
    const std::vector<Plane> high{{{0, 0, 1}, -9}, {{half, 0, half}, 0}, {{-half, 0, half}, 0}};
    const CellOrders orders = one_cell(high, {0, 2, 1}, 3);
    auto fixed = rotor;
    fixed.pivots.clear();
    CHECK(check_order(fixed, orders).good());
    CHECK_FALSE(check_order(rotor, orders).good());
    CHECK(count_wrong_rays(rotor, orders, {.max_distance_radii = 9}).wrong == 0);
    CHECK(count_wrong_rays(rotor, orders, {.max_distance_radii = 9, .turn_rad = 3.1}).wrong > 0);
}

TEST_CASE("planes that others make needless are dropped") {
    const Plane left{{1, 0, 0}, 1};
    const Plane farther_left{{1, 0, 0}, 2};
    const Plane near_corner{glm::normalize(glm::dvec3(1, 0, 1)), 5};
    CHECK(without_redundant(std::vector<Plane>{farther_left, left, above, near_corner}) ==
          std::vector<Plane>{left, above});
}

TEST_CASE("orders found for all kinds of shapes are certified, and come back from a file") {
    const auto path = tests::scratch_folder() / "shapes.txt";
    for (const auto& model : {tests::u_channel(), tests::plate_between_boxes(), tests::three_bars(),
             tests::fig_14(true), tests::pile(3, 4)}) {
        const OrderedModel found = ordered(model);
        const CellOrders orders = cell_orders(found);
        INFO(model.name);
        CHECK(check_order(found.model, orders).good());
        write_file(path, order_text(orders));
        const CellOrders read = read_order_file(path, found.model.polygons.size());
        CHECK(check_order(found.model, read).good());
        const RayTestCounts rays = count_wrong_rays(found.model, read, {.eyes = 300, .min_distance_radii = 0.1});
        CHECK(rays.hits > 100);
        CHECK(rays.wrong == 0);
        CHECK(rays.eyes_without_cell == 0);
    }
}
