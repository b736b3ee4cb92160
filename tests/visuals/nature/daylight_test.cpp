#include "sim/base/units.h"
#include "visuals/nature/daylight.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace octant;
using namespace octant::visuals::nature;

namespace {

Daylight under(double elevation_deg) {
    return Daylight({.sun_azimuth_rad = 1.0, .sun_elevation_rad = rad_from_deg(elevation_deg)});
}

float warmth(const glm::vec3& colour) { return colour.x / colour.z; }

} // namespace

TEST_CASE("the zenith's luminance and colour are the model's own") {
    // Worked out by hand from the paper's equations for turbidity 2 and the sun 60 degrees up.
    const PerezSky sky(rad_from_deg(60.0), 2.0);
    const glm::dvec3 light = sky.light(pi / 2.0, 0.0);
    const double luminance = glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722));
    const double chi = (4.0 / 9.0 - 2.0 / 120.0) * (2.0 * pi / 3.0);
    CHECK(luminance == Approx(3.1196 * std::tan(chi) + 1.9882).epsilon(2e-3));
    CHECK(light.z > light.y);
    CHECK(light.y > light.x);
}

TEST_CASE("sunlight is lost in the air, blue first, and more of it under a low sun") {
    const glm::dvec3 high = sunlight_transmittance(rad_from_deg(70.0), 2.6);
    const glm::dvec3 low = sunlight_transmittance(rad_from_deg(2.0), 2.6);
    for (int part = 0; part < 3; ++part) {
        CHECK(low[part] < 0.05 * high[part]);
        CHECK(high[part] < 1.0);
    }
    CHECK(high.x > high.z);
    CHECK(low.x / low.z > 10.0 * high.x / high.z);
}

TEST_CASE("under a sun of 35 degrees the haze away from the sun has the colour that was given") {
    const glm::vec3 given(0.3F, 0.5F, 0.4F);
    const Daylight day({0.0, rad_from_deg(35.0), given});
    for (int part = 0; part < 3; ++part) { CHECK(day.haze_away()[part] == Approx(given[part]).margin(1e-4)); }
}

TEST_CASE(
    "the lower the sun, the warmer it is, the weaker beside the sky's light, and the darker are ground and horizon") {
    float last_warmth = 0.0F;
    float last_share = 10.0F;
    float last_on_level = 10.0F;
    for (const double elevation_deg : {60.0, 30.0, 25.0, 20.0, 15.0, 12.0, 8.0, 4.0, 1.0}) {
        INFO(elevation_deg);
        const Daylight day = under(elevation_deg);
        CHECK(warmth(day.sunlight()) > last_warmth);
        const float share = day.sunlight().y / day.ambient().y;
        CHECK(share < last_share);
        const float on_level = day.ambient().y + day.sunlight().y * static_cast<float>(day.to_sun().z);
        CHECK(on_level < last_on_level);
        last_warmth = warmth(day.sunlight());
        last_share = share;
        last_on_level = on_level;
    }
    CHECK(warmth(under(2.0).haze_away()) > warmth(under(35.0).haze_away()) + 0.3F);
    CHECK(under(2.0).haze_away().y < under(35.0).haze_away().y);
}

TEST_CASE("a low sun leaves light on level ground, blue in the shade, and is warm itself") {
    for (const double elevation_deg : {12.0, 5.0, 1.5}) {
        INFO(elevation_deg);
        const Daylight day = under(elevation_deg);
        CHECK(day.ambient().y + day.sunlight().y * static_cast<float>(day.to_sun().z) > 0.58F);
        CHECK(warmth(day.ambient()) < 1.0F);
        CHECK(warmth(day.sunlight()) > 1.2F);
    }
}

TEST_CASE("a low sun's sky is blue overhead, warm below the sun, and nowhere green or lilac") {
    for (const double elevation_deg : {5.0, 3.0, 1.5, 0.0}) {
        const Daylight day = under(elevation_deg);
        CHECK(warmth(day.sky({0.0, 0.0, 1.0})) < 0.7F);
        CHECK(warmth(day.sky({day.horizontal_to_sun(), 0.0})) > 1.15F);
        for (int i = 0; i < 400; ++i) {
            const double up = rad_from_deg(4.5 * (i % 20));
            const double around = 2.0 * pi * i / 400.0;
            const glm::vec3 colour =
                day.sky({std::cos(up) * std::sin(around), std::cos(up) * std::cos(around), std::sin(up)});
            INFO(elevation_deg << " degrees: " << colour.x << ", " << colour.y << ", " << colour.z);
            CHECK(colour.y < std::max(colour.x, colour.z) + 0.01F);
            CHECK(colour.y > std::min(colour.x, colour.z) - 0.02F);
        }
    }
}

TEST_CASE("the sun's path on water lies below the sun and is wide enough for triangles of 70 pixels") {
    const glm::vec3 black(0.0F);
    for (const double elevation_deg : {50.0, 30.0, 12.0, 5.0}) {
        INFO(elevation_deg);
        const Daylight day = under(elevation_deg);
        const WaterReflection water(day);
        const auto brightness = [&](double beside_rad) {
            const double azimuth = 1.0 + beside_rad;
            const double level = std::cos(rad_from_deg(elevation_deg));
            return water
                .shaded_colour(black,
                    {level * std::sin(azimuth), level * std::cos(azimuth), -std::sin(rad_from_deg(elevation_deg))})
                .x;
        };
        CHECK(brightness(0.0) > brightness(0.2));
        CHECK(brightness(0.2) > brightness(0.9));
        CHECK(brightness(0.2) - brightness(0.9) > 0.25F * (brightness(0.0) - brightness(0.9)));
    }
}

TEST_CASE("all colours are display values for every sun and direction") {
    for (double elevation_deg = -5.0; elevation_deg <= 90.0; elevation_deg += 2.5) {
        const Daylight day = under(elevation_deg);
        for (int i = 0; i < 400; ++i) {
            const double up = std::asin((i % 20) / 19.0);
            const double around = 2.0 * pi * i / 20.0;
            const glm::vec3 colour =
                day.sky({std::cos(up) * std::sin(around), std::cos(up) * std::cos(around), std::sin(up)});
            for (int part = 0; part < 3; ++part) {
                REQUIRE(colour[part] >= 0.0F);
                REQUIRE(colour[part] <= 1.0F);
            }
        }
    }
}

TEST_CASE("the sky meets the horizon's haze without a step, and glare ends without one") {
    const Daylight day = under(10.0);
    for (double around = 0.0; around < 6.0; around += 0.5) {
        const glm::dvec3 level(std::sin(around), std::cos(around), 0.0);
        const glm::vec3 sky = day.sky(level);
        const glm::vec3 haze = day.horizon(glm::dot(glm::dvec2(level), day.horizontal_to_sun()));
        CHECK(glm::length(sky - haze) < 1e-5F);
    }
    CHECK(glm::length(day.glare(Daylight::glare_rad)) == 0.0F);
    CHECK(glm::length(day.glare(0.99 * Daylight::glare_rad)) < 1e-3F);
    CHECK(day.glare(Daylight::disc_rad).x > 0.3F);
}

TEST_CASE("the light on the ground does not depend on the colour of the horizon") {
    const Daylight usual({0.0, 0.5});
    const Daylight odd({0.0, 0.5, glm::vec3(1.0F, 0.0F, 1.0F)});
    CHECK(usual.ambient() == odd.ambient());
    CHECK(usual.sunlight() == odd.sunlight());
    CHECK(odd.ambient().y > 0.2F);
    CHECK(odd.sky({0.0, 0.6, 0.8}).y >= 0.0F);
}
