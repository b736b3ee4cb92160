#include "visuals/roads/road_network.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "valley_fields.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::roads;
using visuals::terrain::GroundSamples;

namespace {

std::size_t cell_at(const RoadCostGrid& ground, const glm::dvec2& place_m) {
    std::size_t best = 0;
    const auto count = static_cast<std::size_t>(ground.columns() * ground.rows());
    for (std::size_t cell = 1; cell < count; ++cell) {
        if (glm::distance(ground.place_m(cell), place_m) < glm::distance(ground.place_m(best), place_m)) {
            best = cell;
        }
    }
    return best;
}

} // namespace

TEST_CASE("a ground too small, too coarse or with no samples to spare has no cells") {
    CHECK(RoadCostGrid(GroundSamples(field_of(20, two_basins)), {}).columns() == 0);
    const models::heights::HeightField coarse(60, 60, 700.0, std::vector<float>(std::size_t{60} * 60, 100.0F));
    CHECK(RoadCostGrid(GroundSamples(coarse), {}).columns() == 0);
    const RoadCostGrid usual(GroundSamples(field_of(201, two_basins)), {});
    CHECK(usual.cell_m() == 100.0);
    CHECK(usual.columns() == 50);
    CHECK(usual.rows() == 50);
}

TEST_CASE("a cell with a sample of water is not free, nor is a taken one") {
    const auto field = field_of(
        201, [](const glm::dvec2& at_m) { return glm::length(at_m - glm::dvec2(510.0, 30.0)) < 20.0 ? -1.0 : 10.0; });
    RoadConstraints constraints;
    constraints.is_blocked = [](const glm::dvec2& at_m) { return at_m.x < -2000.0; };
    const RoadCostGrid ground(GroundSamples(field), constraints);
    int denied = 0;
    for (std::size_t cell = 0; cell < 2500; ++cell) {
        const glm::dvec2 place_m = ground.place_m(cell);
        if (place_m.x < -2000.0) {
            CHECK_FALSE(ground.is_free(cell));
        } else {
            denied += ground.is_free(cell) ? 0 : 1;
        }
    }
    CHECK(denied >= 1);
    CHECK(denied <= 4);
    CHECK_FALSE(ground.is_free(cell_at(ground, {510.0, 30.0})));
}

TEST_CASE("a cell with a cliff is not free") {
    const auto field = field_of(201, [](const glm::dvec2& at_m) { return at_m.x < 1000.0 ? 100.0 : 190.0; });
    const RoadCostGrid ground(GroundSamples(field), {});
    int cliffs = 0;
    for (std::size_t cell = 0; cell < 2500; ++cell) { cliffs += ground.is_free(cell) ? 0 : 1; }
    CHECK(cliffs == 50);
}

TEST_CASE("slopes and heights above the valley are those of the ground") {
    const RoadCostGrid tilted(
        GroundSamples(field_of(201, [](const glm::dvec2& at_m) { return 300.0 + 0.1 * at_m.x - 0.05 * at_m.y; })), {});
    const std::size_t inner = cell_at(tilted, {450.0, 450.0});
    CHECK(tilted.slope(inner) == Approx(std::hypot(0.1, 0.05)).epsilon(1e-4));
    const RoadCostGrid basins(GroundSamples(field_of(401, two_basins)), {});
    CHECK(basins.height_above_valley_m(cell_at(basins, {-3000.0, 0.0})) < 1.0);
    const double ridge_m = basins.height_above_valley_m(cell_at(basins, {50.0, -1000.0}));
    CHECK(ridge_m > 200.0);
    CHECK(ridge_m < 301.0);
}

TEST_CASE("a road costs its length in a valley, and more up, across a slope and above it") {
    const RoadCostGrid level(GroundSamples(field_of(201, [](const glm::dvec2&) { return 50.0; })), {});
    const std::size_t here = cell_at(level, {50.0, 50.0});
    CHECK(level.cost_m(here, here + 1) == Approx(100.0));
    CHECK(level.cost_m(here, here + 51) == Approx(std::sqrt(2.0) * 100.0));
    const RoadCostGrid basins(GroundSamples(field_of(401, two_basins)), {});
    const std::size_t floor = cell_at(basins, {-3050.0, -50.0});
    const std::size_t side = cell_at(basins, {-550.0, -1050.0});
    const std::size_t ridge = cell_at(basins, {50.0, -1050.0});
    const auto up = static_cast<std::size_t>(basins.columns());
    CHECK(basins.cost_m(floor, floor + 1) < 101.0);
    CHECK(basins.cost_m(side, side + 1) > basins.cost_m(side, side + up));
    CHECK(basins.cost_m(side, side + up) > 1.5 * basins.cost_m(floor, floor + up));
    CHECK(basins.cost_m(ridge, ridge + up) > 2.0 * basins.cost_m(floor, floor + up));
}
