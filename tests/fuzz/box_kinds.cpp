// Solids that pass through, around and along one another.
#include "sim/base/units.h"
#include "tests/fuzz/kinds.h"
#include "tests/fuzz/solids.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::tests::fuzz {

namespace {

int boxes_of(int polygons, int least) { return std::max(least, polygons / 6); }

Soup boxes(RandomGenerator& dice, int polygons) {
    Soup soup;
    for (int i = boxes_of(polygons, 2); i > 0; --i) {
        const glm::dvec3 half_m = glm::dvec3(0.1) + (point_within(dice, 0.5) + 0.5) * 0.7;
        const glm::dvec3 centre = point_within(dice, 0.6);
        add_box(soup, centre, any_attitude(dice), half_m);
    }
    return soup;
}

/// Along the axes, so that faces meet at edges, lie in one plane or nearly do.
Soup blocks(RandomGenerator& dice, int polygons) {
    Soup soup;
    const auto step = [&](int least, int most) { return 0.25 * whole_between(dice, least, most); };
    for (int i = boxes_of(polygons, 2); i > 0; --i) {
        const glm::dvec3 centre{step(-3, 3), step(-3, 3), step(-3, 3)};
        add_box(soup, centre, glm::dmat3(1.0), {step(1, 3), step(1, 3), step(1, 3)});
    }
    return soup;
}

/// Three to five bars: across one another through a middle, or woven around it.
Soup bars(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int count = std::clamp(polygons / 6, 3, 5);
    const bool woven = dice.next() < 0.5;
    const double thick_m = dice.between(0.03, 0.15);
    for (int i = 0; i < count; ++i) {
        const double angle_rad = 2.0 * pi * i / count;
        glm::dvec3 out{std::cos(angle_rad), std::sin(angle_rad), 0.0};
        glm::dvec3 along{-out.y, out.x, woven ? 0.35 : dice.between(-0.4, 0.4)};
        if (dice.next() < 0.3) { along = dice.direction(); }
        const double off_m = woven ? 0.35 : dice.between(-0.1, 0.1);
        const glm::dvec3 half_m{1.0, thick_m, thick_m * dice.between(0.5, 1.0)};
        add_box(soup, out * off_m, attitude_along(along), half_m);
    }
    return soup;
}

/// A rectangular frame of four bars around `centre`, in the plane of the first two axes.
void add_frame(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, const glm::dvec2& half_m) {
    constexpr double thick_m = 0.07;
    for (const double side : {-1.0, 1.0}) {
        add_box(
            soup, centre + axes * glm::dvec3(side * half_m.x, 0.0, 0.0), axes, {thick_m, half_m.y + thick_m, thick_m});
        add_box(
            soup, centre + axes * glm::dvec3(0.0, side * half_m.y, 0.0), axes, {half_m.x - thick_m, thick_m, thick_m});
    }
}

/// Three frames, no two linked and all three together not to be parted; in some the sizes are such that they pass
/// through one another.
Soup frames(RandomGenerator& dice, int polygons) {
    Soup soup;
    const int count = std::clamp(polygons / 24, 2, 3);
    const double narrow_m = dice.between(0.3, 0.95);
    const bool tilted = dice.next() < 0.5;
    for (int i = 0; i < count; ++i) {
        glm::dmat3 axes(0.0);
        axes[0][i] = 1.0;
        axes[1][(i + 1) % 3] = 1.0;
        axes[2][(i + 2) % 3] = 1.0;
        if (tilted) { axes = attitude_along(axes[0] + dice.direction() * 0.2); }
        add_frame(soup, dice.direction() * (tilted ? 0.1 : 0.0), axes, {1.0, narrow_m});
    }
    return soup;
}

/// Boxes put together face to face, with the faces in between kept, and slabs let into others.
Soup touching(RandomGenerator& dice, int polygons) {
    Soup soup;
    glm::dvec3 half_m{0.2, 0.3, 0.25};
    glm::dvec3 centre(-0.5);
    add_box(soup, centre, glm::dmat3(1.0), half_m);
    for (int i = boxes_of(polygons, 2) - 1; i > 0; --i) {
        const int axis = whole_between(dice, 0, 2);
        const glm::dvec3 next_half_m = glm::dvec3(0.05) + (point_within(dice, 0.5) + 0.5) * 0.4;
        glm::dvec3 step(0.0);
        step[axis] = (half_m[axis] + next_half_m[axis]) * (dice.next() < 0.8 ? 1.0 : -1.0);
        step[(axis + 1) % 3] = dice.next() < 0.5 ? 0.0 : dice.between(-0.2, 0.2);
        centre += step;
        half_m = next_half_m;
        add_box(soup, centre, glm::dmat3(1.0), half_m);
    }
    return soup;
}

constexpr std::array<Kind, 5> kinds{{
    {"boxes", "boxes in any attitude through one another", boxes},
    {"blocks", "boxes along the axes with faces in common planes", blocks},
    {"bars", "three to five bars across or woven around one another", bars},
    {"frames", "two or three rectangular frames, some as Borromean rings", frames},
    {"touching", "boxes that touch face to face", touching},
}};

} // namespace

std::span<const Kind> box_kinds() { return kinds; }

} // namespace octant::tests::fuzz
