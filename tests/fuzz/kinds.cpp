#include "tests/fuzz/kinds.h"

#include "sim/base/error.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "tests/fuzz/obj_polygons.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace octant::tests::fuzz {

namespace {

/// A whole number, least to most, all equally likely.
int whole_between(RandomGenerator& dice, int least, int most) {
    return least + static_cast<int>(dice.next() * static_cast<double>(most - least + 1));
}

/// A point of a cube around the origin.
glm::dvec3 point_within(RandomGenerator& dice, double half_m) {
    const double x = dice.between(-half_m, half_m);
    const double y = dice.between(-half_m, half_m);
    return {x, y, dice.between(-half_m, half_m)};
}

/// Axes whose first one points along `along`.
glm::dmat3 attitude_along(const glm::dvec3& along) {
    const glm::dvec3 x = glm::normalize(along);
    const glm::dvec3 aside = std::abs(x.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 y = glm::normalize(glm::cross(aside, x));
    return {x, y, glm::cross(x, y)};
}

/// Axes of a random attitude, right-handed.
glm::dmat3 any_attitude(RandomGenerator& dice) {
    const glm::dvec3 x = dice.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(dice.direction(), x));
    return {x, y, glm::cross(x, y)};
}

/// Adds the six outward faces of a box.
void add_box(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, const glm::dvec3& half_m) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const int next = (axis + 1) % 3;
            const int last = (axis + 2) % 3;
            std::vector<glm::dvec3> face;
            constexpr std::array<std::array<double, 2>, 4> ways{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
            for (const auto& way : ways) {
                glm::dvec3 at(0.0);
                at[axis] = side * half_m[axis];
                at[next] = way[0] * half_m[next];
                at[last] = side * way[1] * half_m[last];
                face.push_back(centre + axes * at);
            }
            soup.push_back(face);
        }
    }
}

/// Adds a polygon of `corners` corners on a circle, its normal the attitude's third axis.
void add_disc(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, double radius_m, int corners) {
    std::vector<glm::dvec3> polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle_rad = 2.0 * pi * i / corners;
        polygon.push_back(
            centre + axes * glm::dvec3(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 0.0));
    }
    soup.push_back(polygon);
}

/// Adds the same polygons seen from behind.
void add_backs(Soup& soup) {
    const std::size_t count = soup.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<glm::dvec3> back(soup[i].rbegin(), soup[i].rend());
        soup.push_back(back);
    }
}

// Solids that pass through, around and along one another.

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

// Single polygons: through one another, upon one another, thin, bent, given twice.

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

// Bodies with curved surfaces, in quads or triangles.

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

/// A way to make models that are hard to order.
struct Kind {
    std::string_view name;
    std::string_view meaning;
    /// About `polygons` polygons, at least enough for the shape, about 2 m large, around the origin.
    Soup (*make)(RandomGenerator& dice, int polygons);
};

constexpr std::array<Kind, 16> shapes{{
    {"boxes", "boxes in any attitude through one another", boxes},
    {"blocks", "boxes along the axes with faces in common planes", blocks},
    {"bars", "three to five bars across or woven around one another", bars},
    {"frames", "two or three rectangular frames, some as Borromean rings", frames},
    {"touching", "boxes that touch face to face", touching},
    {"plates", "tilted plates through one another", plates},
    {"two-sided", "the same, seen from both sides", two_sided},
    {"slivers", "triangles up to a million times longer than wide", slivers},
    {"repeated", "polygons given more than once", repeated},
    {"decals", "polygons upon others in one plane", decals},
    {"t-junctions", "corners in the middle of neighbours' sides", t_junctions},
    {"bent", "polygons off their planes by 1e-7 to 1e-5", bent},
    {"standing", "plates whose sides and corners lie on other plates", standing},
    {"links", "two or three linked tori", links},
    {"helix", "a ramp that winds around an axis, of both sides", helix},
    {"wavy", "a part of a wavy body, triangulated and roughly simplified", wavy},
}};

constexpr double far_m = 1e6;
constexpr std::array<std::string_view, 3> placed_kinds{"far", "tiny", "huge"};

template <typename Change>
void change_all(Soup& soup, const Change& change) {
    for (auto& polygon : soup) {
        for (glm::dvec3& corner : polygon) { corner = change(corner); }
    }
}

Soup made_shape(std::string_view name, RandomGenerator& dice, int polygons) {
    const auto* kind = std::ranges::find(shapes, name, &Kind::name);
    if (std::ranges::find(placed_kinds, name) != placed_kinds.end()) {
        kind = shapes.begin() + static_cast<long>(dice.next() * static_cast<double>(shapes.size()));
    }
    if (kind == shapes.end()) { throw Error(fmt::format("kind: expected one of {}, got '{}'", kind_names(), name)); }
    return kind->make(dice, polygons);
}

/// Far, tiny and huge models are moved or scaled by powers of ten in doubles.
void place(Soup& soup, std::string_view name, RandomGenerator& dice) {
    if (name == "far") {
        const glm::dvec3 away_m = dice.direction() * far_m;
        change_all(soup, [&](const glm::dvec3& corner) { return corner + away_m; });
    } else if (name == "tiny") {
        change_all(soup, [](const glm::dvec3& corner) { return corner * 1e-6; });
    } else if (name == "huge") {
        change_all(soup, [](const glm::dvec3& corner) { return corner * 1e6; });
    }
}

} // namespace

std::span<const std::string_view> kind_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (const Kind& kind : shapes) { all.push_back(kind.name); }
        all.insert(all.end(), placed_kinds.begin(), placed_kinds.end());
        return all;
    }();
    return names;
}

ObjPolygons made_model(std::string_view kind, std::uint64_t seed, int polygons) {
    RandomGenerator dice(seed * 0x9e3779b97f4a7c15U + 1989U);
    dice.next();
    Soup soup = made_shape(kind, dice, polygons);
    if (dice.next() < 0.5) {
        const glm::dmat3 rotation = any_attitude(dice);
        change_all(soup, [&](const glm::dvec3& corner) { return rotation * corner; });
    }
    const bool rounded = dice.next() < 0.5 && kind != "tiny";
    place(soup, kind, dice);
    return obj_polygons(soup, rounded ? Digits::SixDecimals : Digits::All);
}

} // namespace octant::tests::fuzz
