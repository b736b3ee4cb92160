#include "models/polygons/polygon_model.h"
#include "tests/order_shapes.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/split.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>
#include <vector>

using namespace octant::visuals::draworder;
using namespace octant::tests;
using octant::Plane;
using octant::models::polygons::Pivot;
using octant::models::polygons::PolygonModel;

namespace {

int cut_all(PolygonModel& model) {
    SearchBudget budget(100.0);
    return split_penetrating(model, budget);
}

using Outline = std::vector<std::uint32_t>;

Outline corners(const PolygonModel& model, std::size_t polygon) {
    const auto span = model.corners(polygon);
    return {span.begin(), span.end()};
}

double area_m2(const PolygonModel& model, std::size_t polygon) {
    const Outline outline = corners(model, polygon);
    const glm::dvec3& origin_m = model.vertices_m[outline[0]];
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        sum += glm::cross(model.vertices_m[outline[i]] - origin_m, model.vertices_m[outline[i + 1]] - origin_m);
    }
    return glm::length(sum) * 0.5;
}

/// Areas of the pieces of each polygon of the file.
std::vector<double> areas_by_parent(const PolygonModel& model, std::size_t parents) {
    std::vector<double> areas_m2(parents, 0.0);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) { areas_m2[model.parent_of(i)] += area_m2(model, i); }
    return areas_m2;
}

/// Polygons that polygon_fault refuses.
int bad_polygons(const PolygonModel& model) {
    int bad = 0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        bad += octant::models::polygons::polygon_fault(model, i, 1e-9) ? 1 : 0;
    }
    return bad;
}

/// Signed volume inside closed solids.
double volume_m3(const PolygonModel& model) {
    double sum = 0.0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        sum -= octant::models::polygons::plane_of(model, i).offset_m * area_m2(model, i) / 3.0;
    }
    return sum;
}

/// Sides that the same number of polygons runs along in each direction: all of them, without cracks, in closed solids.
bool closed(const PolygonModel& model) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ahead;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> back;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Outline outline = corners(model, i);
        for (std::size_t j = 0; j < outline.size(); ++j) {
            const std::uint32_t next = outline[(j + 1) % outline.size()];
            ahead.emplace_back(outline[j], next);
            back.emplace_back(next, outline[j]);
        }
    }
    std::ranges::sort(ahead);
    std::ranges::sort(back);
    return ahead == back;
}

PolygonModel square() {
    PolygonModel model = fig_14();
    model.vertices_m = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    model.polygons.resize(1);
    model.corner_vertices.resize(4);
    return model;
}

/// One model of two, the second moved.
PolygonModel together(const PolygonModel& first, const PolygonModel& second, const glm::dvec3& by_m) {
    PolygonModel both = first;
    const auto vertices = static_cast<std::uint32_t>(first.vertices_m.size());
    for (const glm::dvec3& vertex_m : second.vertices_m) { both.vertices_m.push_back(vertex_m + by_m); }
    for (std::size_t i = 0; i < second.polygons.size(); ++i) {
        both.polygons.push_back(second.polygons[i]);
        both.polygons.back().part += static_cast<std::uint32_t>(first.parts.size());
        both.polygons.back().first_corner = static_cast<std::uint32_t>(both.corner_vertices.size());
        for (const std::uint32_t vertex : second.corners(i)) { both.corner_vertices.push_back(vertices + vertex); }
    }
    both.parts.insert(both.parts.end(), second.parts.begin(), second.parts.end());
    return both;
}

} // namespace

TEST_CASE("a square is cut into a front piece with its number and a back piece behind all") {
    PolygonModel model = square();
    CHECK(split_polygon(model, 0, {{1, 0, 0}, -0.5}) == 1);
    CHECK(corners(model, 0) == Outline{4, 1, 2, 5});
    CHECK(corners(model, 1) == Outline{0, 4, 5, 3});
    CHECK(model.vertices_m[4] == glm::dvec3(0.5, 0, 0));
    CHECK(model.vertices_m[5] == glm::dvec3(0.5, 2, 0));
    CHECK(model.parents == std::vector<std::uint32_t>{0, 0});
}

TEST_CASE("a plane through two corners cuts without new vertices") {
    PolygonModel model = square();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1, -1, 0));
    split_polygon(model, 0, {normal, 1e-9});
    CHECK(model.vertices_m.size() == 4);
    CHECK(corners(model, 0) == Outline{0, 1, 2});
    CHECK(corners(model, 1) == Outline{0, 2, 3});
}

TEST_CASE("pieces of pieces name the polygon of the file") {
    PolygonModel model = fig_14();
    const std::uint32_t back = split_polygon(model, 1, {{0, 0, 1}, 0});
    split_polygon(model, back, {{1, 0, 0}, 0});
    split_polygon(model, 0, {{1, 0, 0}, 0});
    CHECK(model.parents == std::vector<std::uint32_t>{0, 1, 1, 1, 0});
    CHECK(model.polygons[3].part == 1);
    CHECK(bad_polygons(model) == 0);
}

TEST_CASE("neighbours get the corner in the middle of the side that is cut, and no crack opens") {
    PolygonModel model = plate_between_boxes();
    model.polygons.resize(6);
    REQUIRE(closed(model));
    const double whole_m3 = volume_m3(model);
    split_polygon(model, 0, {glm::normalize(glm::dvec3(1, 0.3, 0.2)), 2.0});
    CHECK(model.polygons.size() == 7);
    CHECK(closed(model));
    CHECK(bad_polygons(model) == 0);
    CHECK(volume_m3(model) == Approx(whole_m3));
}

TEST_CASE("a neighbour with vertices of its own in the same places gets the corner, too") {
    PolygonModel model = together(square(), square(), {2, 0, 0});
    split_polygon(model, 0, {{0, 1, 0}, -1});
    CHECK(corners(model, 1) == Outline{4, 5, 6, 7, 8});
    CHECK(model.vertices_m[8] == glm::dvec3(2, 1, 0));
}

TEST_CASE("both faces of a plate are cut through the same vertices") {
    PolygonModel model = fig_14(true);
    const Plane across{{1, 0, 0}, 0};
    split_polygon(model, 0, across);
    const std::size_t vertices = model.vertices_m.size();
    split_polygon(model, 2, across);
    CHECK(model.vertices_m.size() == vertices);
    CHECK(closed(model));
}

TEST_CASE("the rectangle and the triangle of fig. 14 become three pieces, the paper's are six") {
    PolygonModel model = fig_14();
    CHECK(cut_all(model) == 1);
    CHECK(model.polygons.size() == 3);
    CHECK(cut_all(model) == 0);
    CHECK(bad_polygons(model) == 0);
}

TEST_CASE("a plane in which two faces lie cuts for both of them") {
    PolygonModel model = fig_14(true);
    CHECK(cut_all(model) == 2);
    CHECK(cut_all(model) == 0);
    CHECK(closed(model));
}

TEST_CASE("polygons that only touch are not cut") {
    for (PolygonModel model : {u_channel(), plate_between_boxes(), three_bars(), torus(416), pile(3, 30)}) {
        CHECK(cut_all(model) == 0);
        CHECK(model.parents.empty());
    }
    // Two plates in a T: the side of one lies on the other; then its corner does.
    PolygonModel joint = square();
    joint.vertices_m.insert(joint.vertices_m.end(), {{0.5, 1, 0}, {1.5, 1, 0}, {1, 1, 1}});
    joint.polygons.push_back({.first_corner = 4, .corner_count = 3});
    joint.corner_vertices.insert(joint.corner_vertices.end(), {4, 5, 6});
    CHECK(cut_all(joint) == 0);
    joint.vertices_m[4].z = 0.5;
    CHECK(cut_all(joint) == 0);
    joint.vertices_m[5].z = -0.01;
    CHECK(cut_all(joint) == 1);
}

TEST_CASE("a polygon beside another, though across its plane, is not cut") {
    PolygonModel model = fig_14();
    for (std::size_t vertex = 4; vertex < 7; ++vertex) {
        model.vertices_m[vertex].x += 2.7; // D comes to lie 0.03 outside the rectangle
    }
    CHECK(cut_all(model) == 0);
    for (std::size_t vertex = 4; vertex < 7; ++vertex) { model.vertices_m[vertex].x -= 0.1; }
    CHECK(cut_all(model) == 1);
}

TEST_CASE("bodies that pass through one another are cut apart without loss of area") {
    PolygonModel model = together(pile(5, 8), pile(6, 8), {0.1, 0.2, 0.05});
    const std::size_t polygons = model.polygons.size();
    const std::vector<double> before_m2 = areas_by_parent(model, polygons);
    const int added = cut_all(model);
    CHECK(added > 5);
    CHECK(model.polygons.size() == polygons + static_cast<std::size_t>(added));
    CHECK(cut_all(model) == 0);
    CHECK(bad_polygons(model) == 0);
    CHECK(closed(model));
    const std::vector<double> after_m2 = areas_by_parent(model, polygons);
    for (std::size_t i = 0; i < polygons; ++i) { CHECK(after_m2[i] == Approx(before_m2[i])); }
}

TEST_CASE("a turning part is cut against itself only") {
    PolygonModel model = fig_14();
    model.pivots.push_back(Pivot{.part = 1});
    CHECK(cut_all(model) == 0);
    model.polygons[0].part = 1;
    CHECK(cut_all(model) == 1);
}

TEST_CASE("the test shapes have the polygons they promise, convex, planar and facing outward") {
    CHECK(u_channel().polygons.size() == 14);
    CHECK(plate_between_boxes().polygons.size() == 14);
    CHECK(three_bars().polygons.size() == 6);
    CHECK(torus(416).polygons.size() == 416);
    CHECK(torus(1000).polygons.size() == 1000);
    CHECK(big_pile().polygons.size() == 999);
    CHECK(volume_m3(u_channel()) == Approx(18.0));
    CHECK(volume_m3(plate_between_boxes()) == Approx(16.0));
    for (const PolygonModel& model :
        {u_channel(), plate_between_boxes(), three_bars(), fig_14(true), torus(1000), big_pile()}) {
        CHECK(bad_polygons(model) == 0);
        CHECK(closed(model));
    }
}

TEST_CASE("the three bars overlap in a circle from both sides") {
    CHECK(paper_orders(three_bars()).broken_cycles >= 2);
}

TEST_CASE("the bodies of a pile face outward, lie close together and are the same every time") {
    const PolygonModel model = pile(7, 40);
    CHECK(model.parts.size() == 40);
    CHECK(model.vertices_m == pile(7, 40).vertices_m);
    CHECK(model.vertices_m != pile(8, 40).vertices_m);
    CHECK(octant::models::polygons::radius_m(model) < 6.0);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Plane plane = octant::models::polygons::plane_of(model, i);
        for (std::size_t j = 0; j < model.polygons.size(); ++j) {
            if (model.polygons[i].part == model.polygons[j].part) {
                for (const std::uint32_t vertex : model.corners(j)) {
                    CHECK(octant::distance_m(plane, model.vertices_m[vertex]) < 1e-9);
                }
            }
        }
    }
}

TEST_CASE("pieces go into a list behind what they were cut from, the latest first") {
    std::vector<std::uint32_t> list{5, 1, 3};
    insert_cut_pieces(list, {}, 6);
    CHECK(list == std::vector<std::uint32_t>{5, 1, 3});
    const std::vector<std::uint32_t> cut_from{1, 6, 0, 1}; // of the pieces 6 to 9
    insert_cut_pieces(list, cut_from, 6);
    CHECK(list == std::vector<std::uint32_t>{5, 1, 9, 6, 7, 3});
}
