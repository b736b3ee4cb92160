#include "models/heights/height_field_export.h"
#include "models/heights/runway_strip.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "tests/scratch.h"
#include "ui/world/path_placement.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using octant::GeoPosition;
using octant::TransverseMercator;
using octant::ui::world::path_origin_from_text;
using ui::settings::RunSettings;
using ui::world::RenderDevice;
using ui::world::World;

TEST_CASE("a place in metres is taken as it is") {
    CHECK(path_origin_from_text("1200,-300.5", nullptr, {5000, 5000}) == glm::dvec2(1200, -300.5));
    CHECK(path_origin_from_text("49.3,-123.1", nullptr, {5000, 5000}) == glm::dvec2(49.3, -123.1));
    const TransverseMercator map({49.0, -123.0});
    CHECK(path_origin_from_text("1200,300", &map, {5000, 5000}) == glm::dvec2(1200, 300));
}

TEST_CASE("a place in degrees is found on a map with a place") {
    const TransverseMercator map({49.0, -123.0});
    for (const char* text : {"49.01N,123.01W", "49.01,-123.01"}) {
        const glm::dvec2 place = path_origin_from_text(text, &map, {5000, 5000});
        CHECK(place.y == Approx(1112).margin(5));
        CHECK(place.x == Approx(-731).margin(5));
    }
}

TEST_CASE("a place that is neither is refused") {
    CHECK_THROWS_WITH(path_origin_from_text("here", nullptr, {1, 1}),
        "--place: expected X,Y in metres or LAT,LON in degrees, got 'here'");
    CHECK_THROWS_WITH(path_origin_from_text("1,2,3", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("49N,123", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("-49N,123W", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("nan,0", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("49N,123W", nullptr, {1, 1}),
        "--place: expected X,Y in metres on a map without a place on the earth, got '49N,123W'");
    const TransverseMercator map(GeoPosition{49, -123});
    CHECK_THROWS_WITH(path_origin_from_text("99N,123W", &map, {1, 1}), Catch::Contains("latitude up to 90"));
}

namespace {

/// 26 by 26 km of waves of such a height, as a file.
std::string waves(const std::string& name, double wave_m) {
    constexpr int side = 513;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(static_cast<float>(500.0 + wave_m * std::sin(column / 7.0) * std::cos(row / 8.0)));
        }
    }
    const std::filesystem::path file = tests::scratch_folder() / name;
    models::heights::write_height_field(file, {side, side, 50.0, heights_m});
    return file.string();
}

RunSettings airfield_over(const std::string& terrain) {
    RunSettings settings;
    settings.path.terrain = terrain;
    settings.path.heading_deg = 70.0;
    settings.ground.airfield = true;
    return settings;
}

/// The farthest that the ground that is asked for heights lies from the runway's plane.
double farthest_off_m(const World& world) {
    const models::heights::RunwayStrip& strip = *world.scene.ground->runway();
    double farthest_m = 0.0;
    for (double along_m = 0.0; along_m <= strip.length_m; along_m += 10.0) {
        for (const double left_m : {-82.0, -22.0, 0.0, 22.0, 82.0}) {
            const glm::dvec2 at_m = strip.place({along_m, left_m});
            farthest_m = std::max(
                farthest_m, std::abs(world.scene.ground->height_at(at_m.x, at_m.y).value() - strip.plane_m(at_m)));
        }
    }
    return farthest_m;
}

} // namespace

TEST_CASE("an airfield lies below the beginning of the path, and heights are those of its ground") {
    RunSettings settings = airfield_over(waves("gentle.tif", 5.0));
    const World world = ui::world::load_world(settings);
    const auto runway = world.scene.ground->runway();
    REQUIRE(runway);
    const sim::AircraftState first = world.flight.trajectory.samples().front();
    CHECK(glm::distance(runway->strip_from_world(glm::dvec2(first.position_m)), glm::dvec2(300.0, 0.0)) < 1e-6);
    CHECK(runway->heading_rad == Approx(rad_from_deg(70.0)));
    CHECK(farthest_off_m(world) < 0.02); // tiles keep heights to the centimetre
    CHECK_THAT(world.notes.back(), Catch::StartsWith("airfield: runway 07/25 lies where the path begins"));

    settings.ground.airfield = false;
    const World bare = ui::world::load_world(settings, RenderDevice::Cpu, &world);
    CHECK_FALSE(bare.scene.ground->runway());
    const glm::dvec2 before(bare.flight.trajectory.samples().front().position_m);
    CHECK(before == glm::dvec2(first.position_m));
    const glm::dvec2 at_m = runway->place({700.0, 10.0});
    CHECK(std::abs(*bare.scene.ground->height_at(at_m.x, at_m.y) - runway->plane_m(at_m)) > 0.5);
}

TEST_CASE("an airfield stays where it is when the ground is meshed or coloured anew") {
    RunSettings settings = airfield_over(waves("gentle.tif", 5.0));
    const World world = ui::world::load_world(settings);
    settings.air.palette = visuals::scene::Palette::Arid;
    const auto recoloured = ui::world::rebuilt_scene_ground(world.scene, settings, RenderDevice::Cpu);
    REQUIRE(recoloured);
    CHECK(recoloured->ground->runway() == world.scene.ground->runway());
    settings.ground.lod.metric = visuals::terrain::GroundMetric::Printed;
    const World other = ui::world::load_world(settings);
    REQUIRE(other.scene.ground->runway());
    CHECK(*other.scene.ground->runway() == *world.scene.ground->runway());
    CHECK(farthest_off_m(other) < 1e-3);
    const ui::world::SceneGround repeat_option = ui::world::load_scene_ground(
        settings, RenderDevice::Cpu, ui::world::fixed_runway_finder(world.scene.ground->runway()));
    CHECK(*repeat_option.ground->runway() == *world.scene.ground->runway());
}

TEST_CASE("ground on which no airfield can lie is refused with what it would need") {
    CHECK_THROWS_WITH(ui::world::load_world(airfield_over(waves("rough.tif", 150.0))),
        Catch::Matchers::Matches(
            "--show airfield: expected ground within 6 km of the path on which a runway of 1,800 m "
            "needs cuttings and embankments of at most 15 m, got [0-9]+ m at best; another --place "
            "may do"));
    RunSettings flooded = airfield_over(waves("gentle.tif", 5.0));
    flooded.air.water_level_m = 600.0;
    CHECK_THROWS_WITH(ui::world::load_world(flooded), Catch::EndsWith("got only water or the edge of the map"));
    for (const char* const terrain : {"none", "background60"}) {
        CHECK_THROWS_WITH(ui::world::load_world(airfield_over(terrain)),
            std::string("--show airfield: expected ground that can be levelled, got '") + terrain + "'");
    }
}
