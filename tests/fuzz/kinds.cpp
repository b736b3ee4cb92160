#include "tests/fuzz/kinds.h"

#include "sim/base/error.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace octant::tests::fuzz {

namespace {

constexpr double far_m = 1e6;
constexpr std::array<std::string_view, 3> placed_kinds{"far", "tiny", "huge"};

std::vector<Kind> shapes() {
    std::vector<Kind> all;
    for (const auto kinds : {box_kinds(), plate_kinds(), curved_kinds()}) {
        all.insert(all.end(), kinds.begin(), kinds.end());
    }
    return all;
}

glm::dmat3 turn(RandomGenerator& dice) {
    const glm::dvec3 x = dice.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(dice.direction(), x));
    return {x, y, glm::cross(x, y)};
}

template <typename Change>
void change_all(Soup& soup, const Change& change) {
    for (auto& polygon : soup) {
        for (glm::dvec3& corner : polygon) { corner = change(corner); }
    }
}

Soup made_shape(std::string_view name, RandomGenerator& dice, int polygons) {
    const std::vector<Kind> all = shapes();
    auto kind = std::ranges::find(all, name, &Kind::name);
    if (std::ranges::find(placed_kinds, name) != placed_kinds.end()) {
        kind = all.begin() + static_cast<long>(dice.next() * static_cast<double>(all.size()));
    }
    if (kind == all.end()) { throw Error(fmt::format("kind: expected one of {}, got '{}'", kind_names(), name)); }
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
        for (const Kind& kind : shapes()) { all.push_back(kind.name); }
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
        const glm::dmat3 rotation = turn(dice);
        change_all(soup, [&](const glm::dvec3& corner) { return rotation * corner; });
    }
    const bool rounded = dice.next() < 0.5 && kind != "tiny";
    place(soup, kind, dice);
    return obj_polygons(soup, rounded ? Digits::SixDecimals : Digits::All);
}

} // namespace octant::tests::fuzz
