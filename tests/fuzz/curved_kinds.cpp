// Bodies with curved surfaces, in quads or triangles.
#include "sim/base/units.h"
#include "tests/fuzz/kinds.h"
#include "tests/fuzz/solids.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace octant::tests::fuzz {

namespace {

/// Points in rows and columns; both close where the surface does.
struct Grid {
    int rows = 0;
    int columns = 0;
    std::vector<glm::dvec3> points;

    glm::dvec3& at(int row, int column) {
        return points[static_cast<std::size_t>((row % rows) * columns + column % columns)];
    }
};

void add_triangle(Soup& soup, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (glm::length(glm::cross(b - a, c - a)) > 1e-7) { soup.push_back({a, b, c}); }
}

void add_torus(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, double tube_m, int rows) {
    constexpr int columns = 5;
    Grid grid{rows, columns, std::vector<glm::dvec3>(static_cast<std::size_t>(rows * columns))};
    for (int row = 0; row < rows; ++row) {
        const double around_rad = 2.0 * pi * row / rows;
        for (int column = 0; column < columns; ++column) {
            const double tube_rad = 2.0 * pi * column / columns;
            const double out_m = 0.6 + tube_m * std::cos(tube_rad);
            grid.at(row, column) = centre + axes * glm::dvec3(out_m * std::cos(around_rad),
                                                       out_m * std::sin(around_rad), tube_m * std::sin(tube_rad));
        }
    }
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            soup.push_back({grid.at(row, column), grid.at(row + 1, column), grid.at(row + 1, column + 1),
                grid.at(row, column + 1)});
        }
    }
}

/// Two or three rings through one another's holes; thick ones pass through one another.
Soup links(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int count = polygons < 90 ? 2 : 3;
    const int rows = std::clamp(polygons / count / 5, 5, 24);
    const double tube_m = dice.between(0.05, 0.3);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 centre{0.6 * i - 0.5, dice.between(-0.1, 0.1), dice.between(-0.1, 0.1)};
        const glm::dmat3 axes =
            i % 2 == 0 ? glm::dmat3(1.0)
                       : attitude_along({1.0, 0.0, dice.between(0.0, 0.3)}) * glm::dmat3(1, 0, 0, 0, 0, 1, 0, -1, 0);
        add_torus(soup, centre, axes, tube_m, rows);
    }
    return soup;
}

/// A ramp that winds around an axis, seen from both sides, perhaps with a post in the middle.
Soup helix(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int steps = std::max(6, polygons / 4);
    const double turns = dice.between(1.0, 3.0);
    const double inner_m = dice.between(0.05, 0.4);
    const auto place = [&](int step, double out_m) {
        const double share = static_cast<double>(step) / steps;
        const double angle_rad = 2.0 * pi * turns * share;
        return glm::dvec3(out_m * std::cos(angle_rad), out_m * std::sin(angle_rad), share - 0.5);
    };
    for (int step = 0; step < steps; ++step) {
        const glm::dvec3 a = place(step, inner_m);
        const glm::dvec3 b = place(step, 0.9);
        const glm::dvec3 c = place(step + 1, 0.9);
        const glm::dvec3 d = place(step + 1, inner_m);
        add_triangle(soup, a, b, c);
        add_triangle(soup, a, c, d);
    }
    add_backs(soup);
    if (dice.next() < 0.5) {
        const double post_m = inner_m * dice.between(0.5, 1.5);
        add_box(soup, glm::dvec3(0.0), glm::dmat3(1.0), {post_m, post_m, 0.8});
    }
    return soup;
}

/// A part of a wavy body, triangulated and then simplified without care: corners are drawn onto neighbours, so that
/// slivers, folds and penetrations come about.
Soup wavy(RandomGenerator& dice, int polygons) {
    const int side = std::max(3, static_cast<int>(std::sqrt(polygons / 2.0)) + 1);
    Grid grid{side, side, {}};
    const double waves = dice.between(1.0, 4.0);
    const double height = dice.between(0.05, 0.4);
    const double round = dice.between(0.3, 1.9) * pi;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double u = round * column / (side - 1);
            const double v = static_cast<double>(row) / (side - 1);
            const double out_m = 0.5 + height * std::sin(waves * u) * std::cos(waves * 4.0 * v);
            grid.points.emplace_back(out_m * std::cos(u), out_m * std::sin(u), 1.5 * v - 0.75);
        }
    }
    const double drawn_share = dice.between(0.0, 0.25);
    for (int i = static_cast<int>(drawn_share * side * side); i > 0; --i) {
        const int row = whole_between(dice, 0, side - 2);
        const int column = whole_between(dice, 0, side - 2);
        const bool along = dice.next() < 0.5;
        grid.at(row, column) = grid.at(row + (along ? 1 : 0), column + (along ? 0 : 1));
    }
    Soup soup;
    for (int row = 0; row + 1 < side; ++row) {
        for (int column = 0; column + 1 < side; ++column) {
            const glm::dvec3 a = grid.at(row, column);
            const glm::dvec3 b = grid.at(row, column + 1);
            const glm::dvec3 c = grid.at(row + 1, column + 1);
            const glm::dvec3 d = grid.at(row + 1, column);
            const bool falling = dice.next() < 0.5;
            add_triangle(soup, a, b, falling ? d : c);
            add_triangle(soup, falling ? b : a, c, d);
        }
    }
    return soup;
}

constexpr std::array<Kind, 3> kinds{{
    {"links", "two or three linked tori", links},
    {"helix", "a ramp that winds around an axis, of both sides", helix},
    {"wavy", "a part of a wavy body, triangulated and roughly simplified", wavy},
}};

} // namespace

std::span<const Kind> curved_kinds() { return kinds; }

} // namespace octant::tests::fuzz
