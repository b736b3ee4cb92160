#include "visuals/roads/road_network.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "valley_fields.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::roads;
using visuals::terrain::GroundSamples;

namespace {

using Step = std::pair<std::size_t, std::size_t>;

std::vector<Step> steps_of(const std::vector<Route>& routes) {
    std::vector<Step> steps;
    for (const Route& route : routes) {
        for (std::size_t i = 1; i < route.size(); ++i) { steps.emplace_back(std::minmax(route[i - 1], route[i])); }
    }
    return steps;
}

/// Which cells can be reached from each other: the least cell that each one is joined to.
std::map<std::size_t, std::size_t> groups_of(const std::vector<Step>& steps) {
    std::map<std::size_t, std::size_t> group;
    for (const auto& [a, b] : steps) {
        group.emplace(a, a);
        group.emplace(b, b);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : steps) {
            const std::size_t least = std::min(group[a], group[b]);
            changed = changed || group[a] != least || group[b] != least;
            group[a] = least;
            group[b] = least;
        }
    }
    return group;
}

double bumpy(const glm::dvec2& at_m) {
    return 150.0 + 60.0 * std::sin(at_m.x / 900.0) * std::cos(at_m.y / 1300.0) +
           25.0 * std::sin(at_m.x / 310.0 + at_m.y / 470.0);
}

} // namespace

TEST_CASE("a road from one basin to the other goes over the pass") {
    const RoadCostGrid ground(GroundSamples(field_of(401, two_basins)), {});
    std::vector<std::size_t> towns;
    for (const double x_m : {-3050.0, 2950.0}) {
        towns.push_back(
            ground.cell(static_cast<int>((x_m + 5000.0) / 100.0), static_cast<int>((5000.0 - 1550.0) / 100.0)));
    }
    const std::vector<Route> routes = find_routes(ground, towns);
    REQUIRE(routes.size() == 1);
    CHECK(std::set{routes[0].front(), routes[0].back()} == std::set{towns[0], towns[1]});
    const bool over_pass = std::ranges::any_of(routes[0], [&](std::size_t cell) {
        return glm::distance(ground.place_m(cell), {0.0, 2000.0}) < 300.0;
    });
    CHECK(over_pass);
    for (const std::size_t cell : routes[0]) { CHECK(ground.height_above_valley_m(cell) < 120.0); }
}

TEST_CASE("roads join all towns that can be joined, and no step is in two of them") {
    const RoadConstraints constraints{90.0, 1500.0, nullptr};
    const RoadCostGrid ground(GroundSamples(field_of(1201, bumpy)), constraints);
    const std::vector<std::size_t> towns = find_towns(ground, constraints);
    REQUIRE(towns.size() > 20);
    const std::vector<Route> routes = find_routes(ground, towns);
    std::vector<Step> steps = steps_of(routes);
    const auto groups = groups_of(steps);
    std::set<std::size_t> different;
    for (const std::size_t town : towns) {
        REQUIRE(groups.contains(town));
        different.insert(groups.at(town));
    }
    CHECK(different.size() == 1);
    std::ranges::sort(steps);
    CHECK(std::ranges::adjacent_find(steps) == steps.end());
    for (const auto& [from, to] : steps) {
        CHECK(ground.is_free(from));
        CHECK(ground.is_free(to));
        CHECK(glm::distance(ground.place_m(from), ground.place_m(to)) < 224.0);
    }
}

TEST_CASE("a route goes on where two roads meet in a line, and ends where three do") {
    const RoadConstraints constraints{90.0, 1500.0, nullptr};
    const RoadCostGrid ground(GroundSamples(field_of(1201, bumpy)), constraints);
    const std::vector<Route> routes = find_routes(ground, find_towns(ground, constraints));
    std::map<std::size_t, int> ends;
    std::set<std::size_t> inner;
    for (const Route& route : routes) {
        REQUIRE(route.size() >= 2);
        ++ends[route.front()];
        ++ends[route.back()];
        inner.insert(route.begin() + 1, route.end() - 1);
    }
    for (const auto& [cell, count] : ends) {
        CHECK(count != 2);
        CHECK_FALSE(inner.contains(cell));
    }
}

TEST_CASE("nobody lives on steep ground, on water, high above a valley or above the trees") {
    const RoadConstraints constraints{90.0, 150.0, nullptr};
    const RoadCostGrid ground(GroundSamples(field_of(1201, bumpy)), constraints);
    for (const std::size_t town : find_towns(ground, constraints)) {
        CHECK(ground.is_free(town));
        CHECK(ground.slope(town) <= 0.1);
        CHECK(ground.height_above_valley_m(town) <= 90.0);
        CHECK(ground.height_m(town) <= 240.0);
    }
    const auto steep = field_of(401, [](const glm::dvec2& at_m) { return 3000.0 + 0.5 * at_m.x; });
    CHECK(find_towns(RoadCostGrid(GroundSamples(steep), {}), {}).empty());
    CHECK(find_routes(RoadCostGrid(GroundSamples(steep), {}), {}).empty());
}

TEST_CASE("what lies beyond water is not joined") {
    const auto strait = field_of(801, [](const glm::dvec2& at_m) { return std::abs(at_m.x) < 60.0 ? -5.0 : 20.0; });
    const RoadCostGrid ground(GroundSamples(strait), {});
    const std::vector<Route> routes = find_routes(ground, find_towns(ground, {}));
    REQUIRE_FALSE(routes.empty());
    for (const Route& route : routes) {
        const bool is_west = ground.place_m(route.front()).x < 0.0;
        for (const std::size_t cell : route) { CHECK((ground.place_m(cell).x < 0.0) == is_west); }
    }
}
