#include "models/planar/planar_model.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/random_generator.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace octant::models::planar;
using octant::RandomGenerator;
using octant::models::polygons::plane_of;
using octant::models::polygons::PolygonModel;

namespace {

PolygonModel empty() {
    PolygonModel model;
    model.materials.resize(1);
    model.parts = {"all"};
    return model;
}

void add(PolygonModel& model, const std::vector<std::uint32_t>& corners) {
    octant::models::polygons::Polygon polygon;
    polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
    polygon.corner_count = static_cast<std::uint32_t>(corners.size());
    model.polygons.push_back(polygon);
    model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
}

double unevenness(const PolygonModel& model) {
    double most = 0.0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const octant::Plane plane = plane_of(model, i);
        for (const std::uint32_t vertex : model.corners(i)) {
            most = std::max(most, std::abs(distance_m(plane, model.vertices_m[vertex])));
        }
    }
    return most;
}

/// A torus of planar quadrangles, turned, as a file with six decimals keeps it.
PolygonModel written_torus() {
    PolygonModel model = empty();
    constexpr int around = 24;
    constexpr int across = 12;
    const auto turned = [](const glm::dvec3& p) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(1, 2, 3));
        const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0, 0, 1)));
        return p.x * a + p.y * b + p.z * glm::cross(a, b);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2.0 * 3.141592653589793 * i / around;
            const double v = 2.0 * 3.141592653589793 * j / across;
            const double r = 3.0 + std::cos(v);
            const glm::dvec3 at = turned({r * std::cos(u), r * std::sin(u), std::sin(v)});
            model.vertices_m.push_back(glm::round(at * 1e6) / 1e6);
        }
    }
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t next = (i + 1) % around;
            const std::uint32_t up = (j + 1) % across;
            add(model, {i * across + j, next * across + j, next * across + up, i * across + up});
        }
    }
    return model;
}

/// A square plate of one metre in the plane z = 0.
PolygonModel plate() {
    PolygonModel model = empty();
    model.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    add(model, {0, 1, 2, 3});
    return model;
}

} // namespace

TEST_CASE("the grid of a file is the last decimal that any coordinate needs") {
    CHECK(decimal_grid(std::vector<glm::dvec3>{{12.5, -0.25, 3.0}}) == Approx(0.01));
    CHECK(decimal_grid(std::vector<glm::dvec3>{{1e6 + 0.125, 2e-3, 0.0}}) == Approx(1e-3));
    const std::vector<glm::dvec3> eight_decimals{{-10.534324, -6.385421, -0.00775233}};
    for (const double scale : {1e-6, 1.0, 1e6}) {
        CHECK(decimal_grid(std::vector<glm::dvec3>{scale * (eight_decimals[0] + 1e6)}) == Approx(scale * 1e-8));
    }
    CHECK(decimal_grid(std::vector<glm::dvec3>{{1.0 / 3.0, 1.0, 0.0}}) == 0.0);
    CHECK(decimal_grid(std::vector<glm::dvec3>{1e6 + glm::dvec3(1.0, 2.0, 4.0) / 3.0}) == 0.0);
    CHECK(decimal_grid(std::vector<glm::dvec3>{{0.0, 0.0, 0.0}}) == 0.0);
}

TEST_CASE("quadrangles of a file with six decimals become planar without being cut") {
    const PolygonModel given = written_torus();
    REQUIRE(unevenness(given) > 1e-8);
    const PlanarModel planar = planar_model(given);
    CHECK(planar.triangulated_polygons == 0);
    CHECK(planar.model.polygons.size() == given.polygons.size());
    CHECK(unevenness(planar.model) < 2.0 * planar_noise);
    const PolygonModel back = in_model_frame(planar.model, planar, given);
    for (std::size_t i = 0; i < given.vertices_m.size(); ++i) {
        CHECK(glm::distance(back.vertices_m[i], given.vertices_m[i]) < 8e-6);
    }
}

TEST_CASE("a quadrangle that is bent by more than its file's precision is cut") {
    PolygonModel model = plate();
    model.vertices_m[2].z = 1.0 / 3e4;
    const PlanarModel planar = planar_model(model);
    CHECK(planar.triangulated_polygons == 1);
    REQUIRE(planar.model.polygons.size() == 2);
    CHECK(planar.model.parents == std::vector<std::uint32_t>{0, 0});
    CHECK(in_model_frame(planar.model, planar, model).vertices_m == model.vertices_m);
}

TEST_CASE("a planar model keeps its bits, whatever its place and size") {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        for (const double away : {0.0, 1e6}) {
            PolygonModel model = plate();
            for (glm::dvec3& vertex : model.vertices_m) { vertex = vertex * scale + away * scale; }
            const PlanarModel planar = planar_model(model);
            CHECK(planar.radius_m == Approx(std::sqrt(0.5) * scale));
            CHECK(in_model_frame(planar.model, planar, model).vertices_m == model.vertices_m);
        }
    }
}

TEST_CASE("of polygons that cannot all be planar the one that was bent gives up, whatever the order") {
    // Three corners of the square touch a triangle at height 0, the fourth one at 2e-6.
    const std::vector<glm::dvec3> given{{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}, {-0.5, 0.5, 2e-6}, {0.5, 1.5, 2e-6},
        {-0.5, 1.5, 2e-6}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 2e-6}};
    const Incidence low{.corners = {0, 1, 2}, .touching = {6, 7, 8}};
    const Incidence high{.corners = {3, 4, 5}, .touching = {9}};
    const Incidence square{.corners = {6, 7, 8, 9}, .touching = {}};
    std::vector<glm::dvec3> points = given;
    CHECK(planarize(points, std::vector{low, high, square}, 4e-6) == std::vector<bool>{false, false, true});
    CHECK(points == given);
    CHECK(planarize(points, std::vector{square, low, high}, 4e-6) == std::vector<bool>{true, false, false});
    CHECK(points == given);
}

TEST_CASE("six decimals are the same model at any place and in any unit, to the last bit") {
    const PolygonModel given = written_torus();
    const PlanarModel planar = planar_model(given);
    CHECK(planar.grid_m == Approx(1e-6));
    for (const double scale : {1e-6, 1.0, 1e6}) {
        for (const double away : {0.0, 1e6}) {
            PolygonModel model = given;
            for (glm::dvec3& vertex : model.vertices_m) { vertex = (vertex + away) * scale; }
            CHECK(planar_model(model).model.vertices_m == planar.model.vertices_m);
        }
    }
}

TEST_CASE("what ends a hair beside a polygon ends on it") {
    PolygonModel model = plate();
    model.vertices_m.insert(model.vertices_m.end(), {{0.3, 0.3, 4e-7}, {0.6, 0.3, -3e-7}, {0.5, 0.3, 0.812345}});
    add(model, {4, 5, 6});
    const PlanarModel planar = planar_model(model);
    CHECK(planar.triangulated_polygons == 0);
    const octant::Plane floor = plane_of(planar.model, 0);
    CHECK(std::abs(distance_m(floor, planar.model.vertices_m[4])) < planar_noise);
    CHECK(std::abs(distance_m(floor, planar.model.vertices_m[5])) < planar_noise);
    CHECK(distance_m(floor, planar.model.vertices_m[6]) > 0.5);
}

TEST_CASE("corners in one place are one, and polygons without an area are left out") {
    PolygonModel model = plate();
    model.vertices_m.insert(model.vertices_m.end(), {{1, 1, 0}, {0.5, 0, 0}, {0.500001, 1, 0}});
    add(model, {0, 1, 4, 3});
    add(model, {0, 5, 1});
    const PlanarModel planar = planar_model(model);
    CHECK(planar.dropped_polygons == 1);
    REQUIRE(planar.model.polygons.size() == 2);
    CHECK(planar.model.vertices_m[4] == planar.model.vertices_m[2]);
}

TEST_CASE("a polygon with a slight dent is cut into convex pieces") {
    PolygonModel model = plate();
    model.vertices_m.push_back({0.5, 1.0 / 3e5, 0});
    model.corner_vertices = {0, 4, 1, 2, 3};
    model.polygons[0].corner_count = 5;
    const PlanarModel planar = planar_model(model);
    CHECK(planar.triangulated_polygons == 1);
    for (std::size_t i = 0; i < planar.model.polygons.size(); ++i) {
        CHECK_FALSE(octant::models::polygons::polygon_fault(planar.model, i, planar_tolerance));
    }
}

TEST_CASE("a polygon that only rounding dents is cut, but not counted") {
    PolygonModel model = plate();
    // 11 nm are more than planar_tolerance and less than what files with six decimals keep.
    model.vertices_m.insert(model.vertices_m.end(), {{0.2, 1.1e-8, 0}, {0.205, 0, 0}});
    model.corner_vertices = {0, 4, 5, 1, 2, 3};
    model.polygons[0].corner_count = 6;
    const PlanarModel planar = planar_model(model);
    CHECK(planar.model.polygons.size() > 1);
    CHECK(planar.triangulated_polygons == 0);
}

TEST_CASE("no polygon of the shipped aircraft is bent or dented") {
    for (const std::string name : {"f15", "500md", "f15-detailed", "500md-detailed"}) {
        INFO(name);
        const PlanarModel planar = planar_model(
            octant::models::polygons::read_obj(std::string(OCTANT_SOURCE_DIR) + "/models/" + name + ".obj"));
        CHECK(planar.triangulated_polygons == 0);
        CHECK(planar.dropped_polygons == 0);
    }
}

TEST_CASE("parts that turn do not stick to what they touch") {
    PolygonModel model = plate();
    model.parts = {"hull", "rotor"};
    model.pivots = {{.part = 1, .point_m = {0.5, 0.5, 0.0}}};
    model.vertices_m.insert(model.vertices_m.end(), {{0.3, 0.3, 4e-7}, {0.6, 0.3, 4e-7}, {0.5, 0.6, 4e-7}});
    add(model, {4, 5, 6});
    model.polygons[1].part = 1;
    const PlanarModel planar = planar_model(model);
    CHECK(distance_m(plane_of(planar.model, 0), planar.model.vertices_m[4]) > 1e-7);
}

namespace {

/// A plate of two metres in the plane z = 0 and, at its side x = 1, two plates of one metre; their common corners are
/// `beside_m` off that side.
PolygonModel three_plates(double beside_m) {
    PolygonModel model;
    model.materials.resize(1);
    model.parts = {"all"};
    model.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1.0 + beside_m, 0, 0}, {2, -1, 0}, {2, 0, 0},
        {2, 1, 0}, {1.0 + beside_m, 0, 0}};
    model.corner_vertices = {0, 1, 2, 3, 1, 5, 6, 4, 8, 6, 7, 2};
    model.polygons = {{0, 4, 0, 0}, {4, 4, 0, 0}, {8, 4, 0, 0}};
    return model;
}

} // namespace

TEST_CASE("a corner between the ends of another polygon's side is found once") {
    for (const double beside_m : {0.0, 1e-6, -1e-6}) {
        const auto found = t_junctions(three_plates(beside_m));
        REQUIRE(found.size() == 1);
        CHECK(found.front().corner == 1);
        CHECK(found.front().vertex == 4);
        CHECK(found.front().share == Approx(0.5));
    }
    CHECK(t_junctions(three_plates(1e-3)).empty());
}

TEST_CASE("a sliver's own corner does not lie on its side") {
    PolygonModel model;
    model.vertices_m = {{0, 0, 0}, {10, 0, 0}, {5, 1e-5, 0}, {5, -4, 0}};
    model.corner_vertices = {0, 1, 2, 0, 3, 1};
    model.parts = {"all"};
    model.polygons = {{0, 3, 0, 0}, {3, 3, 0, 0}};
    const auto found = t_junctions(model);
    REQUIRE(found.size() == 1);
    CHECK(found.front().corner == 5);
    CHECK(found.front().vertex == 2);
}

TEST_CASE("of a part that turns no corner belongs to a side of another part") {
    PolygonModel model = three_plates(0.0);
    model.parts = {"all", "rotor"};
    model.pivots = {{.part = 1}};
    model.polygons[1].part = 1;
    model.polygons[2].part = 1;
    CHECK(t_junctions(model).empty());
    model.polygons[0].part = 1;
    CHECK(t_junctions(model).size() == 1);
}

TEST_CASE("corners on one side come in their order along it") {
    PolygonModel model = three_plates(0.0);
    model.vertices_m.insert(model.vertices_m.end(), {{-0.5, -1, 0}, {0.5, -1, 0}, {0, -2, 0}});
    model.polygons.push_back({12, 3, 0, 0});
    model.corner_vertices.insert(model.corner_vertices.end(), {10, 9, 11});
    const auto found = t_junctions(model);
    REQUIRE(found.size() == 3);
    CHECK(found[0].vertex == 9);
    CHECK(found[1].vertex == 10);
    CHECK(found[0].corner == 0);
    CHECK(found[1].corner == 0);
    CHECK(found[2].corner == 1);
}
