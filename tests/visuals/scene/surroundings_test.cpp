#include "sim/base/units.h"
#include "visuals/scene/ground_colours.h"
#include "visuals/scene/sky.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant;
using namespace octant::visuals::scene;

namespace {

glm::ivec3 parts(std::uint32_t colour) {
    return {
        static_cast<int>(colour & 255U),
        static_cast<int>((colour >> 8U) & 255U),
        static_cast<int>((colour >> 16U) & 255U)};
}

int brightness(std::uint32_t colour) {
    const glm::ivec3 p = parts(colour);
    return p.x + p.y + p.z;
}

models::heights::HeightField ramp(float rise_east) {
    std::vector<float> heights;
    for (int row = 0; row < 40; ++row) {
        for (int column = 0; column < 40; ++column) {
            heights.push_back(100.0F + rise_east * static_cast<float>(column));
        }
    }
    return {40, 40, 10.0, heights};
}

} // namespace

TEST_CASE("the sky's triangles face the eye and cover every direction above the horizon once") {
    Sky sky;
    const TriangleDraw draw = sky.around({}, {{0.8F, 0.8F, 0.8F}, 1000.0F});
    for (int tick = 0; tick < 200; ++tick) {
        const double elevation = rad_from_deg(0.3 + tick * 0.44);
        const double azimuth = tick * 2.39996;
        const glm::dvec3 ray(
            std::cos(elevation) * std::sin(azimuth),
            std::cos(elevation) * std::cos(azimuth),
            std::sin(elevation));
        int hits = 0;
        for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
            const glm::dvec3 a(draw.vertices[draw.indices[i]].position_m);
            const glm::dvec3 b(draw.vertices[draw.indices[i + 1]].position_m);
            const glm::dvec3 c(draw.vertices[draw.indices[i + 2]].position_m);
            // Front faces seen from the eye at the origin: edges turn counter-clockwise.
            hits += glm::dot(ray, glm::cross(a, b)) <= 0 && glm::dot(ray, glm::cross(b, c)) <= 0 &&
                    glm::dot(ray, glm::cross(c, a)) <= 0;
        }
        CHECK(hits == 1);
    }
}

TEST_CASE("the sky has the haze's colour at the horizon and is bluer overhead") {
    Sky sky;
    const Haze haze{{0.8F, 0.6F, 0.4F}, 1000.0F};
    for (const models::ColourVertex& vertex : sky.around({}, haze).vertices) {
        if (vertex.position_m.z == 0.0F) {
            CHECK(vertex.colour == models::packed_colour(haze.colour));
        }
        if (vertex.position_m.z > 999.0F) {
            CHECK(parts(vertex.colour).z > parts(vertex.colour).x + 50);
        }
    }
}

TEST_CASE("below the horizon the plain fades into the haze with distance") {
    Sky sky;
    const Haze haze{{1.0F, 1.0F, 1.0F}, 20000.0F};
    const TriangleDraw draw = sky.around({1000.0, 5000.0, {0.0F, 0.0F, 0.0F}}, haze);
    int last = 255 * 3 + 1;
    for (std::size_t i = 8 * 24; i < draw.vertices.size(); i += 24) {
        CHECK(brightness(draw.vertices[i].colour) < last);
        last = brightness(draw.vertices[i].colour);
    }
    const double distance_m =
        1000.0 /
        std::sin(std::asin(-static_cast<double>(draw.vertices.back().position_m.z) / 1000.0));
    CHECK(last / 765.0 == Approx(1.0 - std::exp(-distance_m / 20000.0)).margin(0.01));
}

TEST_CASE("ground that faces the sun is brighter than ground that faces away") {
    Settings settings;
    settings.air.sun_azimuth_deg = 270.0;
    const auto to_the_sun = ground_colours(ramp(1.0F), settings.air);
    const auto away = ground_colours(ramp(-1.0F), settings.air);
    CHECK(brightness(to_the_sun[820]) > brightness(away[820]) + 20);
}

TEST_CASE("level ground at the water level is water and one above it is not") {
    Settings settings;
    settings.air.water_level_m = 100.0;
    const glm::ivec3 water = parts(ground_colours(ramp(0.0F), settings.air)[820]);
    CHECK(water.z > water.x + 20);
    settings.air.water_level_m = 90.0;
    const glm::ivec3 land = parts(ground_colours(ramp(0.0F), settings.air)[820]);
    CHECK(land.z < land.y);
}

TEST_CASE("the mean colour is the mean") {
    const glm::vec3 mean = mean_colour({0xff000000U, 0xffffffffU, 0xff0000ffU, 0xff000000U});
    CHECK(mean.x == Approx(0.5));
    CHECK(mean.y == Approx(0.25));
    CHECK(mean.z == Approx(0.25));
}
