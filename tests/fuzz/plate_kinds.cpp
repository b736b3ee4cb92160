// Single polygons: through one another, upon one another, thin, bent, given twice.
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

Soup plates(RandomGenerator& dice, int polygons) {
    Soup soup;
    for (int i = std::max(2, polygons); i > 0; --i) {
        const glm::dvec3 centre = point_within(dice, 0.5);
        const glm::dmat3 axes = any_attitude(dice);
        add_disc(soup, centre, axes, dice.between(0.2, 1.0), whole_between(dice, 3, 7));
    }
    return soup;
}

Soup two_sided(RandomGenerator& dice, int polygons) {
    Soup soup = plates(dice, polygons / 2);
    add_backs(soup);
    return soup;
}

/// Triangles with one side a million times shorter than the others, and ordinary ones.
Soup slivers(RandomGenerator& dice, int polygons) {
    Soup soup = plates(dice, polygons / 3);
    for (int i = std::max(2, polygons - polygons / 3); i > 0; --i) {
        const double aspect = std::pow(10.0, dice.between(2.0, 6.0));
        const glm::dvec3 at = point_within(dice, 0.7);
        const glm::dvec3 along = dice.direction() * dice.between(0.3, 1.2);
        const glm::dvec3 across = glm::normalize(glm::cross(along, dice.direction()));
        const double place = dice.next();
        soup.push_back({at, at + along, at + along * place + across * (glm::length(along) / aspect)});
    }
    return soup;
}

/// Some polygons twice or more, some with their corners counted from another one.
Soup repeated(RandomGenerator& dice, int polygons) {
    Soup soup = plates(dice, polygons / 2);
    const std::size_t first = soup.size();
    for (std::size_t i = 0; i < first; ++i) {
        const auto which = static_cast<std::size_t>(dice.next() * static_cast<double>(soup.size()));
        auto copy = soup[which];
        std::rotate(copy.begin(), copy.begin() + whole_between(dice, 0, 2), copy.end());
        soup.push_back(copy);
    }
    return soup;
}

/// Polygons painted upon others in the very same plane: with exact numbers in planes of the axes.
Soup decals(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int walls = std::max(1, polygons / 5);
    for (int wall = 0; wall < walls; ++wall) {
        const int axis = whole_between(dice, 0, 2);
        const double level = 0.25 * whole_between(dice, -3, 3);
        const int marks = 1 + std::max(1, polygons / walls - 1);
        for (int mark = 0; mark < marks; ++mark) {
            const double half_m = mark == 0 ? 1.0 : dice.between(0.1, 0.5);
            const glm::dvec3 centre = mark == 0 ? glm::dvec3(0.0) : point_within(dice, 0.7);
            std::vector<glm::dvec3> mark_corners;
            const int corners = mark == 0 ? 4 : whole_between(dice, 3, 6);
            add_disc(soup, centre, glm::dmat3(1.0), half_m, corners);
            for (glm::dvec3& corner : soup.back()) {
                glm::dvec3 at(0.0);
                at[(axis + 1) % 3] = corner.x;
                at[(axis + 2) % 3] = corner.y;
                at[axis] = level;
                corner = at;
            }
        }
    }
    if (dice.next() < 0.3) { add_backs(soup); }
    return soup;
}

/// A wall whose neighbours' corners lie in the middle of its sides, folded at those sides.
Soup t_junctions(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int strips = std::clamp(polygons / 3, 2, 12);
    double x = -0.5;
    double z = 0.0;
    int cuts = whole_between(dice, 1, 3);
    for (int strip = 0; strip < strips; ++strip) {
        const double next_x = x + dice.between(0.05, 0.3) * (dice.next() < 0.8 ? 1.0 : -1.0);
        const double next_z = z + dice.between(-0.3, 0.3);
        for (int i = 0; i < cuts; ++i) {
            const double y = -0.5 + static_cast<double>(i) / cuts;
            const double next_y = -0.5 + static_cast<double>(i + 1) / cuts;
            soup.push_back({{x, y, z}, {next_x, y, next_z}, {next_x, next_y, next_z}, {x, next_y, z}});
        }
        x = next_x;
        z = next_z;
        cuts = cuts % 3 + 1;
    }
    if (dice.next() < 0.5) { add_backs(soup); }
    return soup;
}

/// Polygons with corners a little off their planes, 1e-7 to 1e-5 of the size.
Soup bent(RandomGenerator& dice, int polygons) {
    Soup soup;
    if (dice.next() < 0.5) {
        soup = plates(dice, polygons);
    } else {
        for (int i = std::max(2, polygons / 6); i > 0; --i) {
            const glm::dvec3 centre = point_within(dice, 0.9);
            add_box(soup, centre, any_attitude(dice), glm::dvec3(0.1, 0.3, dice.between(0.05, 0.5)));
        }
    }
    const double bend_m = 2.0 * std::pow(10.0, dice.between(-7.0, -5.0));
    for (auto& polygon : soup) {
        for (glm::dvec3& corner : polygon) { corner += dice.direction() * (bend_m * dice.next()); }
    }
    return soup;
}

/// Plates that stand on others: an edge or a corner on a face, no more.
Soup standing(RandomGenerator& dice, int polygons) {
    Soup soup = plates(dice, std::max(1, polygons / 4));
    while (soup.size() < static_cast<std::size_t>(std::max(3, polygons))) {
        const auto which = static_cast<std::size_t>(dice.next() * static_cast<double>(soup.size()));
        const auto& under = soup[which];
        const double share = dice.between(0.1, 0.9);
        const glm::dvec3 a = glm::mix(under[0], under[1], share);
        const glm::dvec3 b = glm::mix(under[1], under[2], dice.next() < 0.5 ? share : 1.0);
        const glm::dvec3 up = dice.direction() * dice.between(0.1, 0.6);
        if (dice.next() < 0.7) {
            soup.push_back({a, b, b + up, a + up});
        } else {
            const glm::dvec3 aside = dice.direction() * 0.3;
            soup.push_back({glm::mix(a, b, share), a + up + aside, a + up - aside});
        }
    }
    return soup;
}

constexpr std::array<Kind, 8> kinds{{
    {"plates", "tilted plates through one another", plates},
    {"two-sided", "the same, seen from both sides", two_sided},
    {"slivers", "triangles up to a million times longer than wide", slivers},
    {"repeated", "polygons given more than once", repeated},
    {"decals", "polygons upon others in one plane", decals},
    {"t-junctions", "corners in the middle of neighbours' sides", t_junctions},
    {"bent", "polygons off their planes by 1e-7 to 1e-5", bent},
    {"standing", "plates whose sides and corners lie on other plates", standing},
}};

} // namespace

std::span<const Kind> plate_kinds() { return kinds; }

} // namespace octant::tests::fuzz
