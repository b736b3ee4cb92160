#include "models/heights/height_field_export.h"
#include "models/heights/runway_strip.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "tests/scratch.h"
#include "ui/world/airfield.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using ui::settings::RunSettings;
using ui::world::RenderDevice;
using ui::world::World;

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
    settings.ground.mesh = visuals::scene::GroundMetric::Printed;
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
            "--airfield: expected ground within 6 km of the path on which a runway of 1,800 m "
            "needs cuttings and embankments of at most 15 m, got [0-9]+ m at best; another --place "
            "may do"));
    RunSettings flooded = airfield_over(waves("gentle.tif", 5.0));
    flooded.air.water_level_m = 600.0;
    CHECK_THROWS_WITH(ui::world::load_world(flooded), Catch::EndsWith("got only water or the edge of the map"));
    for (const char* const terrain : {"none", "background60"}) {
        CHECK_THROWS_WITH(ui::world::load_world(airfield_over(terrain)),
            std::string("--airfield: expected ground that can be levelled, got '") + terrain + "'");
    }
}
