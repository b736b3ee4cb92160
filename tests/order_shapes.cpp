#include "tests/order_shapes.h"

#include "models/procedural/procedural_models.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace octant::tests {

namespace {

using models::polygons::PolygonModel;
using Points = std::vector<glm::dvec3>;

PolygonModel empty_model(const std::string& name) {
    PolygonModel model;
    model.name = name;
    model.materials.push_back({.name = "grey"});
    return model;
}

/// Adds a polygon of the newest part.
void add(PolygonModel& model, const std::vector<std::uint32_t>& corners) {
    model.polygons.push_back({.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size()),
        .corner_count = static_cast<std::uint32_t>(corners.size()),
        .part = static_cast<std::uint32_t>(model.parts.size() - 1)});
    model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
}

/// A convex solid between two polygons with as many corners each, as a part of its own. `base_m` runs counter-clockwise
/// seen from `top_m`, which lies over it; a top of one point makes a pyramid.
void add_prism(PolygonModel& model, const Points& base_m, const Points& top_m) {
    model.parts.push_back("body" + std::to_string(model.parts.size()));
    const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
    const auto sides = static_cast<std::uint32_t>(base_m.size());
    model.vertices_m.insert(model.vertices_m.end(), base_m.begin(), base_m.end());
    model.vertices_m.insert(model.vertices_m.end(), top_m.begin(), top_m.end());
    std::vector<std::uint32_t> under;
    std::vector<std::uint32_t> over;
    for (std::uint32_t i = 0; i < sides; ++i) {
        under.push_back(first + sides - 1 - i);
        over.push_back(first + sides + i);
        const std::uint32_t next = (i + 1) % sides;
        if (top_m.size() == 1) {
            add(model, {first + i, first + next, first + sides});
        } else {
            add(model, {first + i, first + next, first + sides + next, first + sides + i});
        }
    }
    add(model, under);
    if (top_m.size() > 1) { add(model, over); }
}

void add_box(PolygonModel& model, const glm::dvec3& least, const glm::dvec3& most) {
    const auto level = [&](double z) {
        return Points{{least.x, least.y, z}, {most.x, least.y, z}, {most.x, most.y, z}, {least.x, most.y, z}};
    };
    add_prism(model, level(least.z), level(most.z));
}

/// A solid of the pile before it is placed; centred on the origin. `kind` 0 .. 3 as in pile().
struct Body {
    Points base_m;
    Points top_m;
    double radius_m = 0.0;
};

Body body_of_kind(int kind, RandomGenerator& dice) {
    constexpr std::array<int, 4> corner_counts{4, 3, 3, 6};
    const int corners = corner_counts[static_cast<std::size_t>(kind)];
    const double half_height_m = dice.between(0.2, 0.8);
    const double across_m = dice.between(0.3, 1.0);
    const double along_m = dice.between(0.3, 1.0);
    Body body;
    for (int i = 0; i < corners; ++i) {
        const double angle_rad = 2.0 * pi * (i + 0.5) / corners;
        const glm::dvec3 corner(across_m * std::cos(angle_rad), along_m * std::sin(angle_rad), -half_height_m);
        body.base_m.push_back(corner);
        body.top_m.emplace_back(corner.x, corner.y, half_height_m);
    }
    if (kind == 1) { body.top_m = {{0.1, 0.1, half_height_m}}; }
    body.radius_m = std::hypot(std::max(across_m, along_m), half_height_m);
    return body;
}

glm::dquat random_attitude(RandomGenerator& dice) {
    const glm::dvec3 axis = dice.direction(); // Compilers differ in which argument comes first.
    return glm::angleAxis(dice.between(0.0, 2.0 * pi), axis);
}

void turn(Points& points, const glm::dquat& attitude) {
    for (glm::dvec3& point : points) { point = attitude * point; }
}

/// Where a body lies, with what is needed to keep others off it.
struct Placed {
    Points points;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> edges;
    glm::dvec3 middle{0.0};
    double radius_m = 0.0;
};

Placed shape_of(const Body& body) {
    PolygonModel alone = empty_model("alone");
    add_prism(alone, body.base_m, body.top_m);
    Placed shape;
    shape.points = alone.vertices_m;
    shape.radius_m = body.radius_m;
    for (std::size_t i = 0; i < alone.polygons.size(); ++i) {
        shape.normals.push_back(models::polygons::normal_of(alone, i));
        const auto corners = alone.corners(i);
        for (std::size_t j = 0; j < corners.size(); ++j) {
            const glm::dvec3 edge = alone.vertices_m[corners[(j + 1) % corners.size()]] - alone.vertices_m[corners[j]];
            shape.edges.push_back(glm::normalize(edge));
        }
    }
    return shape;
}

/// Gap between the two along a direction; negative where they overlap.
double gap_along(const Placed& a, const Placed& b, const glm::dvec3& direction) {
    double max_a = -1e9;
    double min_b = 1e9;
    for (const glm::dvec3& point : a.points) { max_a = std::max(max_a, glm::dot(point + a.middle, direction)); }
    for (const glm::dvec3& point : b.points) { min_b = std::min(min_b, glm::dot(point + b.middle, direction)); }
    return min_b - max_a;
}

/// By separating axes: the normals of both, and edges of one across edges of the other.
bool apart(const Placed& a, const Placed& b) {
    constexpr double min_gap_m = 0.02;
    if (glm::distance(a.middle, b.middle) > a.radius_m + b.radius_m + min_gap_m) { return true; }
    const auto parts = [&](const glm::dvec3& n) {
        return gap_along(a, b, n) > min_gap_m || gap_along(b, a, n) > min_gap_m;
    };
    if (std::ranges::any_of(a.normals, parts) || std::ranges::any_of(b.normals, parts)) { return true; }
    return std::ranges::any_of(a.edges, [&](const glm::dvec3& edge) {
        return std::ranges::any_of(b.edges, [&](const glm::dvec3& other) {
            const glm::dvec3 n = glm::cross(edge, other);
            return glm::length(n) > 1e-6 && parts(glm::normalize(n));
        });
    });
}

/// From far away along a random line towards the origin, until the next step would hit another.
void place(Placed& shape, const std::vector<Placed>& others, RandomGenerator& dice) {
    constexpr double step_m = 0.1;
    const glm::dvec3 direction = dice.direction();
    double distance_m = 0.0;
    for (const Placed& other : others) {
        distance_m = std::max(distance_m, glm::length(other.middle) + other.radius_m + 2.0 * shape.radius_m);
    }
    shape.middle = direction * distance_m;
    while (distance_m > step_m) {
        shape.middle = direction * (distance_m - step_m);
        if (!std::ranges::all_of(others, [&](const Placed& o) { return apart(shape, o); })) {
            shape.middle = direction * distance_m;
            return;
        }
        distance_m -= step_m;
    }
}

} // namespace

PolygonModel u_channel() {
    PolygonModel model = empty_model("u_channel");
    model.parts.emplace_back("channel");
    // y and z of the outline, counter-clockwise seen from +x; points 8 and 9 lie under the inner walls.
    const std::array<glm::dvec2, 10> outline{{{-1.5, 1}, {-1.5, -1}, {-0.5, -1}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -1},
        {1.5, -1}, {1.5, 1}, {0.5, 1}, {-0.5, 1}}};
    for (const double x : {-2.0, 2.0}) {
        for (const glm::dvec2& point : outline) { model.vertices_m.emplace_back(x, point.x, point.y); }
    }
    const auto side = [&](std::uint32_t from, std::uint32_t to) { add(model, {from, to, to + 10, from + 10}); };
    for (const auto& [from, to] : {std::pair{0U, 1U}, {1U, 2U}, {2U, 3U}, {3U, 4U}}) { side(from, to); }
    for (const auto& [from, to] : {std::pair{4U, 5U}, {5U, 6U}, {6U, 7U}}) { side(from, to); }
    add(model, {7, 8, 9, 0, 10, 19, 18, 17});
    const std::array<std::vector<std::uint32_t>, 3> ends{{{0, 9, 3, 2, 1}, {9, 8, 4, 3}, {8, 7, 6, 5, 4}}};
    for (const std::vector<std::uint32_t>& end : ends) {
        add(model, end);
        std::vector<std::uint32_t> opposite(end.rbegin(), end.rend());
        for (std::uint32_t& vertex : opposite) { vertex += 10; }
        add(model, opposite);
    }
    return model;
}

PolygonModel plate_between_boxes() {
    PolygonModel model = empty_model("plate_between_boxes");
    add_box(model, {-3, -1, -1}, {-1, 1, 1});
    model.parts.emplace_back("plate");
    const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
    for (const glm::dvec2& p : {glm::dvec2(-2, -2), {2, -2}, {2, 2}, {-2, 2}}) {
        model.vertices_m.emplace_back(0.0, p.x, p.y);
    }
    add(model, {first, first + 1, first + 2, first + 3});
    add(model, {first + 3, first + 2, first + 1, first});
    add_box(model, {1, -1, -1}, {3, 1, 1});
    return model;
}

PolygonModel three_bars() {
    PolygonModel model = empty_model("three_bars");
    const glm::dvec3 towards_eye = glm::normalize(glm::dvec3(1, 1, 1));
    const glm::dvec3 along = glm::normalize(glm::dvec3(0, 1, -1));
    const glm::dvec3 inward = glm::cross(towards_eye, along);
    for (int bar = 0; bar < 3; ++bar) {
        for (const auto& [t, aside] : {std::pair{-5, -2}, {5, -2}, {5, -1}, {-5, -1}}) {
            const glm::dvec3 p = along * (1.0 * t) + inward * (1.0 * aside) + towards_eye * (0.1 * t);
            const std::array<glm::dvec3, 3> turns{p, glm::dvec3(p.y, p.z, p.x), glm::dvec3(p.z, p.x, p.y)};
            model.vertices_m.push_back(turns[static_cast<std::size_t>(bar)]);
        }
        model.parts.push_back("bar" + std::to_string(bar));
        const auto first = static_cast<std::uint32_t>(4 * bar);
        add(model, {first, first + 1, first + 2, first + 3});
    }
    for (std::uint32_t bar = 0; bar < 3; ++bar) {
        add(model, {4 * bar + 3, 4 * bar + 2, 4 * bar + 1, 4 * bar});
        model.polygons.back().part = bar;
    }
    return model;
}

PolygonModel fig_14(bool both_sides) {
    PolygonModel model = empty_model("fig_14");
    model.parts.emplace_back("rectangle");
    model.vertices_m = {{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}, {-1, 0.5, -1}, {0, -0.5, 2}, {1, 0.5, -1}};
    add(model, {0, 1, 2, 3});
    model.parts.emplace_back("triangle");
    add(model, {4, 5, 6});
    if (both_sides) {
        add(model, {3, 2, 1, 0});
        model.polygons.back().part = 0;
        add(model, {6, 5, 4});
    }
    return model;
}

PolygonModel torus(int quads) {
    int around = quads;
    for (int i = 3; i <= quads / 3; ++i) {
        const auto strain = [&](int n) { return std::abs(std::log(1.0 * n * n / quads / 1.6)); };
        if (quads % i == 0 && strain(i) < strain(around)) { around = i; }
    }
    return models::procedural::torus(around, quads / around);
}

PolygonModel pile(std::uint64_t seed, int bodies) {
    RandomGenerator dice(seed);
    PolygonModel model = empty_model("pile");
    std::vector<Placed> placed;
    for (int i = 0; i < bodies; ++i) {
        Body body = body_of_kind(i % 4, dice);
        const glm::dquat attitude = random_attitude(dice);
        turn(body.base_m, attitude);
        turn(body.top_m, attitude);
        Placed shape = shape_of(body);
        place(shape, placed, dice);
        for (Points* points : {&body.base_m, &body.top_m}) {
            for (glm::dvec3& point : *points) { point += shape.middle; }
        }
        add_prism(model, body.base_m, body.top_m);
        placed.push_back(std::move(shape));
    }
    return model;
}

PolygonModel big_pile() { return pile(1989, 174); }

} // namespace octant::tests
