#include "sim/base/units.h"
#include "visuals/nature/relief_shadows.h"

#include <catch2/catch.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

using namespace octant;
using visuals::nature::ReliefShadows;

namespace {

constexpr int side = 81;
constexpr double relief_spacing_m = 10.0;

models::heights::HeightField make_ground_tiles(const std::function<double(double, double)>& height_m) {
    std::vector<float> heights;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights.push_back(static_cast<float>(height_m(column * relief_spacing_m, row * relief_spacing_m)));
        }
    }
    return {side, side, relief_spacing_m, heights};
}

glm::dvec3 sun_at(double azimuth_deg, double elevation_deg) {
    const double azimuth = rad_from_deg(azimuth_deg);
    const double elevation = rad_from_deg(elevation_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth), std::sin(elevation)};
}

ReliefShadows light_of(const models::heights::HeightField& field, const glm::dvec3& to_sun) {
    return ReliefShadows(visuals::terrain::GroundSamples(field), to_sun);
}

} // namespace

TEST_CASE("level ground keeps all light under every sun") {
    const auto level = make_ground_tiles([](double, double) { return 100.0; });
    for (const double elevation_deg : {1.0, 20.0, 90.0}) {
        const ReliefShadows light = light_of(level, sun_at(37.0, elevation_deg));
        for (const double at_m : {0.0, 133.0, 800.0}) {
            const auto left = light.at(static_cast<float>(at_m), 400.0F, 1.0F);
            CHECK(left.sun == Approx(1.0));
            CHECK(left.sky == Approx(1.0));
        }
    }
}

TEST_CASE("a strip of ground that is reduced to one row or column has its light from end to end") {
    constexpr int length = 8194;
    constexpr double end_m = (length - 1) * relief_spacing_m;
    for (const glm::ivec2& size : {glm::ivec2(length, 2), {length, 8}, {2, length}, {8, length}}) {
        CAPTURE(size.x, size.y);
        const models::heights::HeightField strip(
            size.x, size.y, relief_spacing_m, std::vector<float>(static_cast<std::size_t>(size.x * size.y), 5.0F));
        const ReliefShadows light = light_of(strip, sun_at(37.0, 20.0));
        for (const double at_m : {0.0, 4444.0, end_m}) {
            const auto along = static_cast<float>(at_m);
            const auto left = size.x > size.y ? light.at(along, 10.0F, 1.0F) : light.at(10.0F, along, 1.0F);
            CHECK(left.sun == Approx(1.0));
            CHECK(left.sky == Approx(1.0));
        }
    }
}

TEST_CASE("a wall throws a shadow as long as the sun says, away from the sun") {
    // 60 m high, from north to south; the sun stands in the west, 30 degrees up.
    const auto wall = make_ground_tiles([](double east, double) { return std::abs(east - 300.0) < 11.0 ? 60.0 : 0.0; });
    const ReliefShadows light = light_of(wall, sun_at(270.0, 30.0));
    const double reach_m = 60.0 / std::tan(rad_from_deg(30.0));
    CHECK(light.at(280.0F, 400.0F, 1.0F).sun == Approx(1.0));
    CHECK(light.at(static_cast<float>(310.0 + reach_m - 30.0), 400.0F, 1.0F).sun < 0.05F);
    CHECK(light.at(static_cast<float>(310.0 + reach_m + 30.0), 400.0F, 1.0F).sun > 0.95F);
    const ReliefShadows other = light_of(wall, sun_at(90.0, 30.0));
    CHECK(other.at(350.0F, 400.0F, 1.0F).sun == Approx(1.0));
    CHECK(other.at(250.0F, 400.0F, 1.0F).sun < 0.05F);
}

TEST_CASE("a shadow is as long under a sun between the grid's axes") {
    const auto tower = make_ground_tiles(
        [](double east, double north) { return std::hypot(east - 400.0, north - 400.0) < 45.0 ? 80.0 : 0.0; });
    for (const double azimuth_deg : {20.0, 45.0, 110.0, 200.0, 290.0}) {
        INFO(azimuth_deg);
        const glm::dvec3 to_sun = sun_at(azimuth_deg, 25.0);
        const ReliefShadows light = light_of(tower, to_sun);
        const glm::dvec2 away = -glm::dvec2(to_sun) / std::cos(rad_from_deg(25.0));
        const double reach_m = 45.0 + 80.0 / std::tan(rad_from_deg(25.0));
        const auto sun_at_m = [&](double from_m) {
            return light
                .at(static_cast<float>(400.0 + from_m * away.x), static_cast<float>(400.0 + from_m * away.y), 1.0F)
                .sun;
        };
        CHECK(sun_at_m(100.0) < 0.1F);
        CHECK(sun_at_m(reach_m - 35.0) < 0.5F);
        CHECK(sun_at_m(reach_m + 35.0) > 0.9F);
        CHECK(sun_at_m(-100.0) > 0.95F);
    }
}

TEST_CASE("the bottom of a valley sees less of the sky than its rims") {
    const auto valley = make_ground_tiles([](double east, double) { return 0.8 * std::abs(east - 400.0); });
    const ReliefShadows light = light_of(valley, sun_at(0.0, 90.0));
    CHECK(light.at(400.0F, 400.0F, 1.0F).sky < 0.85F);
    CHECK(light.at(400.0F, 400.0F, 1.0F).sky > 0.3F);
    CHECK(light.at(700.0F, 400.0F, 1.0F).sky > 0.95F);
    CHECK(light.at(400.0F, 400.0F, 1.0F).sun == Approx(1.0));
}

TEST_CASE("a wide footprint sees the mean of light and shadow") {
    const auto teeth =
        make_ground_tiles([](double east, double) { return static_cast<int>(east / 40.0) % 2 == 0 ? 25.0 : 0.0; });
    const ReliefShadows light = light_of(teeth, sun_at(270.0, 35.0));
    const float wide = light.at(400.0F, 400.0F, 160.0F).sun;
    CHECK(wide > 0.3F);
    CHECK(wide < 0.9F);
    CHECK(std::abs(light.at(420.0F, 400.0F, 160.0F).sun - wide) < 0.1F);
}

TEST_CASE("light in hollows is that of the ground alone and is shared between suns") {
    const auto hills = make_ground_tiles(
        [](double x_m, double y_m) { return 60.0 * std::sin(x_m / 70.0) * std::cos(y_m / 90.0) + 0.1 * x_m; });
    const ReliefShadows morning = light_of(hills, sun_at(90.0, 12.0));
    const ReliefShadows alone = light_of(hills, sun_at(250.0, 20.0));
    const ReliefShadows shared(visuals::terrain::GroundSamples(hills), sun_at(250.0, 20.0), &morning);
    double differences = 0.0;
    for (float x_m = 0.0F; x_m < 800.0F; x_m += 13.0F) {
        for (float y_m = 0.0F; y_m < 800.0F; y_m += 17.0F) {
            for (const float footprint_m : {1.0F, 40.0F, 300.0F}) {
                const auto expected = alone.at(x_m, y_m, footprint_m);
                const auto got = shared.at(x_m, y_m, footprint_m);
                REQUIRE(got.sun == expected.sun);
                REQUIRE(got.sky == expected.sky);
                differences += std::abs(static_cast<double>(morning.at(x_m, y_m, footprint_m).sun - got.sun));
            }
        }
    }
    CHECK(differences > 100.0);
}
