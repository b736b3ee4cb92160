#include "sim/base/units.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/planning/sky.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

using namespace octant;
using namespace octant::visuals::landscape;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

glm::ivec3 parts(std::uint32_t colour) {
    return {static_cast<int>(colour & 255U), static_cast<int>((colour >> 8U) & 255U),
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

namespace {

/// Front faces seen from the eye at the origin that a ray meets: edges turn counter-clockwise.
int faces_hit(const TriangleDraw& draw, std::size_t first, std::size_t end, const glm::dvec3& ray) {
    int hits = 0;
    for (std::size_t i = first; i < end; i += 3) {
        const glm::dvec3 a(draw.vertices[draw.indices[i]].position_m);
        const glm::dvec3 b(draw.vertices[draw.indices[i + 1]].position_m);
        const glm::dvec3 c(draw.vertices[draw.indices[i + 2]].position_m);
        hits += glm::dot(ray, glm::cross(a, b)) <= 0 && glm::dot(ray, glm::cross(b, c)) <= 0 &&
                glm::dot(ray, glm::cross(c, a)) <= 0 && glm::dot(ray, a + b + c) > 0;
    }
    return hits;
}

constexpr std::size_t dome_indices = std::size_t{20} * 36 * 6; ///< before those of the sun

glm::dvec3 ray_at(double elevation_rad, double azimuth_rad) {
    return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::cos(elevation_rad) * std::cos(azimuth_rad),
        std::sin(elevation_rad)};
}

visuals::nature::Daylight sun_at(double azimuth_deg, double elevation_deg) {
    return visuals::nature::Daylight({rad_from_deg(azimuth_deg), rad_from_deg(elevation_deg)});
}

} // namespace

TEST_CASE("the sky's triangles face the eye and cover every direction above the horizon once") {
    Sky sky(sun_at(200.0, 35.0));
    const TriangleDraw draw = sky.around({}, {{0.8F, 0.8F, 0.8F}, 1000.0F});
    for (int tick = 0; tick < 200; ++tick) {
        const glm::dvec3 ray = ray_at(rad_from_deg(0.3 + tick * 0.44), tick * 2.39996);
        CHECK(faces_hit(draw, 0, dome_indices, ray) == 1);
    }
}

TEST_CASE("the sun's disc lies where the sun stands, is half a degree wide and brighter than the sky") {
    for (const double elevation_deg : {0.1, 2.0, 35.0, 89.0, 90.0}) {
        INFO(elevation_deg);
        const visuals::nature::Daylight day = sun_at(120.0, elevation_deg);
        Sky sky(day);
        const TriangleDraw draw = sky.around({}, {{0.8F, 0.8F, 0.8F}, 1000.0F});
        const std::size_t disc = draw.indices.size() - std::size_t{30} * 3;
        CHECK(faces_hit(draw, disc, draw.indices.size(), day.to_sun()) >= 1);
        const glm::dvec3 across = glm::normalize(glm::cross(day.to_sun(), glm::dvec3(0.3, -0.2, 0.1)));
        for (const double side : {-1.0, 1.0}) {
            const auto beside = [&](double from_sun_deg) {
                const double rad = side * rad_from_deg(from_sun_deg);
                return std::cos(rad) * day.to_sun() + std::sin(rad) * across;
            };
            CHECK(faces_hit(draw, disc, draw.indices.size(), beside(0.4)) == 0);
            const bool above = beside(0.25).z > 0.0;
            CHECK(faces_hit(draw, disc, draw.indices.size(), beside(0.25)) == (above ? 1 : 0));
        }
        const int sun = brightness(draw.vertices[draw.indices[disc]].colour);
        CHECK(sun > brightness(models::packed_colour(day.haze_away())) + 100);
    }
}

TEST_CASE("the sky has the haze's colour at the horizon and is bluer overhead") {
    const visuals::nature::Daylight day = sun_at(90.0, 35.0);
    Sky sky(day);
    const TriangleDraw draw = sky.around({}, {day.haze_away(), 1000.0F});
    for (std::size_t i = 0; i < std::size_t{14} * 36; ++i) {
        const models::ColourVertex& vertex = draw.vertices[i];
        if (vertex.position_m.z == 0.0F && vertex.position_m.x < 0.0F) {
            CHECK(vertex.colour == (models::packed_colour(day.haze_away()) & 0x00ffffffU));
        }
        if (vertex.position_m.z > 999.0F) { CHECK(parts(vertex.colour).z > parts(vertex.colour).x + 50); }
    }
}

TEST_CASE("below the horizon the plain fades into the haze with distance") {
    Sky sky(sun_at(90.0, 35.0));
    const Haze haze{{1.0F, 1.0F, 1.0F}, 20000.0F};
    constexpr double map_edge_m = 5000.0; // the plain begins there, however steep the look
    const TriangleDraw draw = sky.around({1000.0, map_edge_m, {0.0F, 0.0F, 0.0F}}, haze);
    int last = 255 * 3 + 1;
    const models::ColourVertex* lowest = nullptr;
    for (std::size_t ring = 14; ring < 21; ++ring) {
        lowest = &draw.vertices[ring * 36];
        CHECK(brightness(lowest->colour) <= last);
        last = brightness(lowest->colour);
        const double distance_m = std::max(1000.0 / -static_cast<double>(lowest->position_m.z) * 1000.0, map_edge_m);
        CHECK(last / 765.0 == Approx(1.0 - std::exp(-distance_m / 20000.0)).margin(0.01));
    }
    CHECK(last < 255 * 3 / 3);
}

TEST_CASE("below the horizon of an eye under the plain there is land that fades into the haze") {
    Sky sky(sun_at(90.0, 35.0));
    const TriangleDraw draw = sky.around({-300.0, 5000.0, {0.0F, 0.0F, 0.0F}}, {{1.0F, 1.0F, 1.0F}, 20000.0F});
    CHECK(brightness(draw.vertices[std::size_t{14} * 36].colour) > 0.9 * 765.0);
    CHECK(brightness(draw.vertices[std::size_t{20} * 36].colour) < 0.5 * 765.0);
}

TEST_CASE("past the land around a map the plain begins where that land ends") {
    visuals::nature::Backdrop land;
    land.vertices = {{{-30000.0, -20000.0, 0.0}, {}, 0.0F}, {{30000.0, 20000.0, 0.0}, {}, 0.0F}};
    Sky sky(sun_at(90.0, 35.0), land);
    const Haze haze{{1.0F, 1.0F, 1.0F}, 20000.0F};
    const auto lowest = [&](const glm::dvec3& eye_m) {
        const TriangleDraw draw = sky.around({1000.0, 5000.0, {0.0F, 0.0F, 0.0F}}, haze, eye_m);
        return brightness(draw.vertices[std::size_t{20} * 36].colour) / 765.0;
    };
    CHECK(lowest({0.0, 0.0, 1000.0}) == Approx(1.0 - std::exp(-1.0)).margin(0.01));
    CHECK(lowest({0.0, 12000.0, 1000.0}) == Approx(1.0 - std::exp(-0.4)).margin(0.01));
}

TEST_CASE("what is painted last of the land around a map is the nearest, from eyes above and below its mean height") {
    const visuals::nature::BackdropSource ridges{{3000.0, 2000.0}, 400.0, {}, std::nullopt,
        [](const glm::dvec2& at_m) {
            return 400.0 + 300.0 * std::sin(at_m.x / 170.0 + 1.0) * std::cos(at_m.y / 130.0);
        },
        [](const glm::dvec2&, double) { return glm::vec3(0.5F); }};
    Sky sky(sun_at(90.0, 35.0), make_backdrop(ridges));
    int hidden = 0;
    int seen = 0;
    for (int eye = 0; eye < 24; ++eye) {
        const glm::dvec3 eye_m(
            2800.0 * std::sin(1.0 + 7.0 * eye), 1900.0 * std::sin(2.0 + 11.0 * eye), 150.0 + 25.0 * eye);
        const TriangleDraw draw = sky.around({eye_m.z - 400.0, 0.0, {}}, {{}, 20000.0F}, eye_m);
        for (int look = 0; look < 400; ++look) {
            const glm::dvec3 ray = ray_at(rad_from_deg(-6.0 + 0.03 * look), 2.4 * look);
            double nearest_m = std::numeric_limits<double>::infinity();
            double last_m = nearest_m;
            for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
                if (draw.indices[i] < sky.first_land_vertex()) { continue; }
                const glm::dvec3 a(draw.vertices[draw.indices[i]].position_m);
                const glm::dvec3 normal = glm::cross(glm::dvec3(draw.vertices[draw.indices[i + 1]].position_m) - a,
                    glm::dvec3(draw.vertices[draw.indices[i + 2]].position_m) - a);
                if (glm::dot(normal, a) >= 0.0 || faces_hit(draw, i, i + 3, ray) == 0) { continue; }
                last_m = glm::dot(normal, a) / glm::dot(normal, ray);
                hidden += std::isfinite(nearest_m) ? 1 : 0;
                nearest_m = std::min(nearest_m, last_m);
            }
            seen += std::isfinite(nearest_m) ? 1 : 0;
            CHECK(last_m <= nearest_m * (1.0 + 1e-4));
        }
    }
    CHECK(seen > 3000);
    CHECK(hidden > 3000);
}

TEST_CASE("from beyond the map and below the land around it that land is no ceiling") {
    const visuals::nature::BackdropSource level{{3000.0, 2000.0}, 400.0, {}, std::nullopt,
        [](const glm::dvec2&) { return 400.0; }, [](const glm::dvec2&, double) { return glm::vec3(0.5F); }};
    Sky sky(sun_at(90.0, 35.0), make_backdrop(level));
    const auto land_vertices = [&](const glm::dvec3& eye_m) {
        const TriangleDraw draw = sky.around({eye_m.z - 400.0, 0.0, {}}, {{}, 20000.0F}, eye_m);
        return draw.vertices.size() - sky.first_land_vertex();
    };
    CHECK(land_vertices({3500.0, 0.0, 100.0}) == 0);
    CHECK(land_vertices({3500.0, 0.0, 500.0}) > 0);
    CHECK(land_vertices({2900.0, 0.0, 100.0}) > 0);
}

TEST_CASE("haze thins with height, and has the sun's colour towards the sun") {
    const glm::vec3 black(0.0F);
    Haze haze{{1.0F, 1.0F, 1.0F}, 10000.0F};
    const glm::vec3 level = through_haze(haze, {0.0, 10000.0, 0.0}, black);
    CHECK(level.x == Approx(1.0 - std::exp(-1.0)));
    haze.falloff_per_m = 1.0F / 2000.0F;
    CHECK(through_haze(haze, {0.0, 10000.0, 0.0}, black).x == Approx(level.x));
    // 8 km up and 6 km along: the mean of exp(-h / 2000) over 8,000 m of height.
    const double mean = (1.0 - std::exp(-4.0)) / 4.0;
    CHECK(through_haze(haze, {6000.0, 0.0, 8000.0}, black).x == Approx(1.0 - std::exp(-mean)).epsilon(1e-4));
    CHECK(through_haze(haze, {6000.0, 0.0, -800.0}, black).x > level.x * 0.6F);
    haze.falloff_per_m = 0.0F;
    haze.horizontal_to_sun = {1.0F, 0.0F};
    haze.sunward_colour = {1.0F, 0.5F, 0.0F};
    CHECK(through_haze(haze, {1e7, 0.0, 0.0}, black).y == Approx(0.5));
    CHECK(through_haze(haze, {-1e7, 0.0, 0.0}, black).y == Approx(1.0));
    CHECK(through_haze(haze, {1e7, 1e7, 0.0}, black).y == Approx(0.75));
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
