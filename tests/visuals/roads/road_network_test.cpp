#include "models/procedural/procedural_terrain.h"
#include "sim/base/random_generator.h"
#include "visuals/roads/road_network.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "valley_fields.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::roads;
using visuals::terrain::GroundSamples;

namespace {

double lakes(const glm::dvec2& at_m) {
    return 40.0 + 70.0 * std::sin(at_m.x / 1100.0) * std::cos(at_m.y / 900.0) + 9.0 * std::sin(at_m.x / 130.0);
}

const RoadNetwork& lake_roads() {
    static const RoadNetwork roads(GroundSamples(field_of(1001, lakes)), RoadConstraints{0.0, 1500.0, nullptr});
    return roads;
}

double length_m(const RoadNetwork& roads) {
    double sum_m = 0.0;
    for (const RoadSection& section : roads.sections()) {
        for (std::size_t i = 1; i < section.levels[0].size(); ++i) {
            sum_m += glm::distance(section.levels[0][i - 1].at_m, section.levels[0][i].at_m);
        }
    }
    return sum_m;
}

/// Whether an edge of one of its levels has a place in a box, by places along them.
bool touches(const RoadSection& section, const glm::dvec2& min_m, const glm::dvec2& max_m) {
    if (glm::any(glm::greaterThan(section.min_m, max_m)) || glm::any(glm::lessThan(section.max_m, min_m))) {
        return false;
    }
    for (const std::vector<RoadPoint>& level : section.levels) {
        for (std::size_t i = 1; i < level.size(); ++i) {
            for (int step = 0; step <= 8; ++step) {
                const glm::dvec2 on_m = glm::mix(level[i - 1].at_m, level[i].at_m, step / 8.0);
                const glm::dvec2 to_left_edge_m =
                    glm::mix(level[i - 1].to_left_edge_m, level[i].to_left_edge_m, step / 8.0);
                for (const double aside : {-1.0, 0.0, 1.0}) {
                    const glm::dvec2 at_m = on_m + aside * to_left_edge_m;
                    if (glm::all(glm::greaterThanEqual(at_m, min_m)) && glm::all(glm::lessThanEqual(at_m, max_m))) {
                        return true;
                    }
                }
            }
        }
    }
    return false;
}

/// By places a metre apart along all middle lines.
double nearest_m(const RoadNetwork& roads, const glm::dvec2& place_m) {
    double min_m = 1e9;
    for (const RoadSection& section : roads.sections()) {
        for (std::size_t i = 1; i < section.levels[0].size(); ++i) {
            const glm::dvec2& from_m = section.levels[0][i - 1].at_m;
            const glm::dvec2& to_m = section.levels[0][i].at_m;
            const int steps = static_cast<int>(std::ceil(glm::distance(from_m, to_m)));
            for (int step = 0; step <= steps; ++step) {
                const glm::dvec2 on_m = glm::mix(from_m, to_m, static_cast<double>(step) / steps);
                min_m = std::min(min_m, glm::distance(on_m, place_m));
            }
        }
    }
    return min_m;
}

} // namespace

TEST_CASE("no road runs over water") {
    REQUIRE(length_m(lake_roads()) > 30000.0);
    for (const RoadSection& section : lake_roads().sections()) {
        for (const RoadPoint& point : section.levels[0]) { REQUIRE(lakes(point.at_m) > -0.5); }
    }
}

TEST_CASE("the index of roads misses no piece") {
    const RoadNetwork& roads = lake_roads();
    RandomGenerator dice(11);
    std::vector<std::uint32_t> found;
    int met = 0;
    int found_in_vain = 0;
    for (int i = 0; i < 150; ++i) {
        const double x_m = dice.between(-15000.0, 15000.0);
        const double y_m = dice.between(-15000.0, 15000.0);
        const double width_m = dice.between(1.0, 3000.0);
        const double depth_m = dice.between(1.0, 3000.0);
        const glm::dvec2 min_m(x_m, y_m);
        const glm::dvec2 max_m = min_m + glm::dvec2(width_m, depth_m);
        found.clear();
        roads.sections_in_box(min_m, max_m, found);
        const std::set<std::uint32_t> all(found.begin(), found.end());
        bool any = false;
        for (std::uint32_t number = 0; number < roads.sections().size(); ++number) {
            const bool meets = touches(roads.sections()[number], min_m, max_m);
            any = any || meets;
            REQUIRE((!meets || all.contains(number)));
        }
        found_in_vain += any ? 0 : static_cast<int>(all.size());
        REQUIRE((!any || roads.may_intersect(min_m, max_m)));
        met += any ? 1 : 0;
    }
    CHECK(met > 20);
    CHECK(found_in_vain < met);
    CHECK_FALSE(roads.may_intersect({1e6, 1e6}, {2e6, 2e6}));
    CHECK_FALSE(roads.may_intersect({-2e6, -2e6}, {-1e6, -1e6}));
}

TEST_CASE("a place is near a road where its middle line is") {
    const RoadNetwork& roads = lake_roads();
    RandomGenerator dice(5);
    int near = 0;
    for (int i = 0; i < 60; ++i) {
        const double x_m = dice.between(-12000.0, 12000.0);
        const glm::dvec2 place_m(x_m, dice.between(-12000.0, 12000.0));
        const double own_m = nearest_m(roads, place_m);
        near += own_m < 400.0 ? 1 : 0;
        REQUIRE(roads.is_near(place_m, own_m + 1.0));
        REQUIRE_FALSE(roads.is_near(place_m, own_m - 1.0));
    }
    CHECK(near > 4);
}

TEST_CASE("made grounds have roads, low in their valleys, and the same ones each time") {
    for (const char* const kind : {"hills", "canyon"}) {
        INFO(kind);
        const models::heights::HeightField field = models::procedural::procedural_terrain(kind).value();
        const GroundSamples ground(field);
        const RoadConstraints constraints{0.0, 3000.0, nullptr};
        const RoadNetwork roads(ground, constraints);
        const RoadNetwork again(ground, constraints);
        REQUIRE(roads.sections().size() == again.sections().size());
        for (std::size_t i = 0; i < roads.sections().size(); ++i) {
            REQUIRE(roads.sections()[i].min_m == again.sections()[i].min_m);
            REQUIRE(roads.sections()[i].max_m == again.sections()[i].max_m);
        }
        CHECK(length_m(roads) > 20000.0);
    }
}

TEST_CASE("ground that is too small has no roads, and asking for some is harmless") {
    const RoadNetwork none(GroundSamples(field_of(9, lakes)), {});
    CHECK(none.sections().empty());
    CHECK_FALSE(none.may_intersect({-1e3, -1e3}, {1e3, 1e3}));
    CHECK_FALSE(none.is_near({0.0, 0.0}, 1e6));
}
