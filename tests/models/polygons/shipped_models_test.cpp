#include "models/polygons/obj_reader.h"
#include "sim/base/plane.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace octant::models;
using namespace octant::models::polygons;

namespace {

PolygonModel shipped(const std::string& name) {
    return read_obj(std::string(OCTANT_SOURCE_DIR) + "/models/" + name + ".obj");
}

const Pivot& pivot_named(const PolygonModel& model, const std::string& part) {
    const auto found =
        std::ranges::find_if(model.pivots, [&](const Pivot& pivot) { return model.parts[pivot.part] == part; });
    REQUIRE(found != model.pivots.end());
    return *found;
}

/// What a part sweeps when it turns once: from least to most along the axis, and how far from it.
struct Sweep {
    double min_m = 1e9;
    double max_m = -1e9;
    double radius_m = 0.0;
};

Sweep sweep_of(const PolygonModel& model, const Pivot& pivot) {
    Sweep sweep;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        if (model.polygons[i].part == pivot.part) {
            for (const std::uint32_t vertex : model.corners(i)) {
                const glm::dvec3 offset_m = model.vertices_m[vertex] - pivot.point_m;
                const double along_m = glm::dot(offset_m, pivot.axis);
                sweep.min_m = std::min(sweep.min_m, along_m);
                sweep.max_m = std::max(sweep.max_m, along_m);
                sweep.radius_m = std::max(sweep.radius_m, glm::length(offset_m - pivot.axis * along_m));
            }
        }
    }
    return sweep;
}

/// How many of the points all over a polygon lie in what a sweep holds.
int points_near(const PolygonModel& model, std::size_t polygon, const Pivot& pivot, const Sweep& sweep) {
    constexpr int steps = 60;
    const auto corners = model.corners(polygon);
    const glm::dvec3& origin_m = model.vertices_m[corners[0]];
    int inside = 0;
    for (std::size_t j = 1; j + 1 < corners.size(); ++j) {
        const glm::dvec3 to_first_m = model.vertices_m[corners[j]] - origin_m;
        const glm::dvec3 to_second_m = model.vertices_m[corners[j + 1]] - origin_m;
        for (int point = 0; point < steps * steps; ++point) {
            const double first = (point % steps) / (steps - 1.0);
            const double second = (1.0 - first) * (point / steps) / (steps - 1.0);
            const glm::dvec3 offset_m = origin_m + to_first_m * first + to_second_m * second - pivot.point_m;
            const double along_m = glm::dot(offset_m, pivot.axis);
            const bool near = along_m > sweep.min_m && along_m < sweep.max_m &&
                              glm::length(offset_m - pivot.axis * along_m) < sweep.radius_m;
            inside += near ? 1 : 0;
        }
    }
    return inside;
}

/// True when all polygons of a part lie in one plane, each with a twin that faces the other way.
bool is_flat_plate(const PolygonModel& model, std::uint32_t part) {
    std::vector<octant::Plane> planes;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        if (model.polygons[i].part == part) { planes.push_back(plane_of(model, i)); }
    }
    int fronts = 0;
    for (const octant::Plane& plane : planes) {
        const double sign = glm::dot(plane.normal, planes[0].normal) > 0.0 ? 1.0 : -1.0;
        fronts += sign > 0.0 ? 1 : -1;
        if (glm::distance(plane.normal * sign, planes[0].normal) > 1e-7 ||
            std::abs(plane.offset_m * sign - planes[0].offset_m) > 1e-7) {
            return false;
        }
    }
    return !planes.empty() && fronts == 0;
}

} // namespace

TEST_CASE("the shipped models are read without notes and without cuts") {
    for (const char* name :
        {"f15", "500md", "concave", "f15-cockpit", "500md-cockpit", "f15-detailed", "500md-detailed"}) {
        const PolygonModel model = shipped(name);
        CHECK(model.notes.empty());
        CHECK(model.parents.empty());
    }
}

TEST_CASE("the rotors of the 500MD turn at their published rates") {
    const PolygonModel model = shipped("500md");
    CHECK(pivot_named(model, "rotor").turns_per_s == 8.2);
    CHECK(pivot_named(model, "tail_rotor").turns_per_s == 50.3);
}

TEST_CASE("no blade of a 500MD rotor ever hides another: all lie in one plane") {
    const PolygonModel model = shipped("500md");
    for (const char* rotor : {"rotor", "tail_rotor"}) { CHECK(is_flat_plate(model, pivot_named(model, rotor).part)); }
}

TEST_CASE("the main rotor turns in one plane above all the rest") {
    const PolygonModel model = shipped("500md");
    const Pivot& hub = pivot_named(model, "rotor");
    const Sweep sweep = sweep_of(model, hub);
    CHECK(sweep.max_m - sweep.min_m < 1e-9);
    CHECK(sweep.radius_m == Approx(4.025).epsilon(1e-3));
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        for (const std::uint32_t vertex : model.corners(i)) {
            CHECK(glm::dot(model.vertices_m[vertex] - hub.point_m, hub.axis) <= 0.0);
        }
    }
}

TEST_CASE("what the tail rotor sweeps keeps clear of everything else") {
    const PolygonModel model = shipped("500md");
    const Pivot& hub = pivot_named(model, "tail_rotor");
    const Sweep sweep = sweep_of(model, hub);
    CHECK(sweep.radius_m == Approx(0.7).epsilon(5e-3));
    CHECK(sweep.max_m == Approx(-sweep.min_m));
    CHECK(sweep.max_m < 0.03);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        if (!pivot_of(model, i)) { CHECK(points_near(model, i, hub, {-0.13, 0.13, 0.8}) == 0); }
    }
}
