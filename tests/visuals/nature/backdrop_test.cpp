#include "visuals/nature/backdrop.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace octant::visuals::nature;

namespace {

constexpr double mean_m = 500.0;
const glm::vec3 mean_colour(0.4F, 0.5F, 0.3F);

/// Ground that rises to the east, brighter there, over 4 x 2 km.
BackdropSource slope(std::vector<glm::dvec2>* asked = nullptr) {
    return {{2000.0, 1000.0}, mean_m, mean_colour, std::nullopt,
        [asked](const glm::dvec2& at_m) {
            if (asked != nullptr) { asked->push_back(at_m); }
            return mean_m + 0.1 * at_m.x;
        },
        [](const glm::dvec2& at_m, double) { return glm::vec3(static_cast<float>(0.5 + at_m.x / 5000.0)); }};
}

double outside_m(const glm::dvec3& at_m) { return std::max(std::abs(at_m.x) - 2000.0, std::abs(at_m.y) - 1000.0); }

} // namespace

TEST_CASE("the land around a map begins under its border and ends at its mean height and colour") {
    const Backdrop land = make_backdrop(slope());
    double nearest_end_m = 1e9;
    int under = 0;
    for (std::size_t i = 0; i < land.vertices.size(); ++i) {
        const Backdrop::BackdropVertex& corner = land.vertices[i];
        if (i < land.outer_vertices) {
            nearest_end_m = std::min(nearest_end_m, outside_m(corner.at_m));
            CHECK(corner.at_m.z == Approx(mean_m));
            CHECK(glm::length(corner.colour - mean_colour) < 1e-6F);
        } else if (outside_m(corner.at_m) < 0.0) {
            ++under;
            CHECK(corner.at_m.z < mean_m + 0.1 * corner.at_m.x - 10.0);
        } else if (outside_m(corner.at_m) < 100.0) {
            CHECK(std::abs(corner.at_m.z - mean_m - 0.1 * corner.at_m.x) < 30.0);
        }
    }
    CHECK(under > 10);
    CHECK(nearest_end_m == Approx(20000.0));
}

TEST_CASE("only places on the map are asked for, whatever its shape") {
    std::vector<glm::dvec2> asked;
    make_backdrop(slope(&asked));
    for (const glm::dvec2& at_m : asked) {
        REQUIRE(std::abs(at_m.x) <= 2000.0);
        REQUIRE(std::abs(at_m.y) <= 1000.0);
    }
}

TEST_CASE("where a map ends in water, water goes on to the horizon, and land elsewhere") {
    BackdropSource coast = slope();
    coast.water_level_m = mean_m - 50.0; // west of the map's x = -500
    const Backdrop land = make_backdrop(coast);
    REQUIRE(land.outer_vertices > 0);
    for (std::size_t i = 0; i < land.outer_vertices; ++i) {
        const Backdrop::BackdropVertex& corner = land.vertices[i];
        if (corner.at_m.x > -499.0) { continue; }
        CHECK(corner.is_water);
        CHECK(corner.at_m.z == mean_m - 50.0);
    }
    for (const Backdrop::BackdropVertex& corner : land.vertices) {
        if (corner.at_m.x > 2500.0 && corner.at_m.x < 4000.0 && std::abs(corner.at_m.y) < 1000.0) {
            CHECK_FALSE(corner.is_water);
        }
    }
}

TEST_CASE("seen from above the land faces up and covers everything around the map once") {
    const Backdrop land = make_backdrop(slope());
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < land.indices.size(); i += 3) {
        const glm::dvec2 a(land.vertices[land.indices[i]].at_m);
        const glm::dvec2 b(land.vertices[land.indices[i + 1]].at_m);
        const glm::dvec2 c(land.vertices[land.indices[i + 2]].at_m);
        const double twice_m2 = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        REQUIRE(twice_m2 > 0.0);
        area_m2 += 0.5 * twice_m2;
    }
    const double all_m2 = 4.0 * 42000.0 * 21000.0; // 20 km past the border of so small a map
    const double map_m2 = 4.0 * 0.99 * 2000.0 * 0.99 * 1000.0;
    CHECK(area_m2 == Approx(all_m2 - map_m2).epsilon(1e-9));
}
