#include "models/heights/height_field.h"
#include "models/heights/height_field_export.h"
#include "tests/scratch.h"
#include "ui/flight/inset_view.h"
#include "ui/world/scene_ground.h"
#include "visuals/groundfile/ground_import.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "small_flight.h"

using namespace octant;
using namespace octant::tests;
namespace landscape = octant::visuals::landscape;
namespace scene = octant::visuals::scene;
using ui::flight::InsetView;

namespace {

models::heights::HeightField rough_field() {
    constexpr int side = 129;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(static_cast<float>(std::lround(100.0 * std::sin(column / 5.0) * std::cos(row / 7.0))));
        }
    }
    return {side, side, 50.0, heights_m};
}

/// An imported ground of that name in the scratch folder.
std::filesystem::path imported(const std::string& name) {
    const std::filesystem::path out = scratch_folder() / name;
    std::filesystem::path heights = out;
    heights += ".tif";
    models::heights::write_height_field(heights, rough_field());
    visuals::groundfile::import_ground(
        {heights}, out, {}, [](visuals::groundfile::ImportStage, double) { return false; });
    return out;
}

/// How many times this process has a file mapped.
int mappings_of(const std::filesystem::path& file) {
    std::ifstream maps("/proc/self/maps");
    int count = 0;
    for (std::string line; std::getline(maps, line);) {
        count += line.find(file.string()) != std::string::npos ? 1 : 0;
    }
    return count;
}

ui::settings::RunSettings with_inset() {
    ui::settings::RunSettings settings;
    settings.view.inset = scene::View::Tower;
    settings.view.size_px = {640, 480};
    return settings;
}

const scene::Camera camera = scene::camera_looking_at({-600, -900, 500}, {0, 0, 0});

std::size_t triangles_of(InsetView& inset) {
    const std::array there{sim::AircraftState{}};
    return inset.plan(camera, there, {}, std::nullopt).ground.indices.size() / 3;
}

} // namespace

TEST_CASE("an inset needs no file of the ground and maps it no second time") {
    ui::settings::RunSettings settings = with_inset();
    const std::filesystem::path file = imported("shared.ground");
    settings.path.terrain = file.string();
    ui::world::World world = small_world();
    world.scene.ground = ui::world::load_scene_ground(settings, ui::world::RenderDevice::Cpu).ground;
    REQUIRE(mappings_of(file) == 1);
    std::filesystem::remove(file);

    InsetView inset(settings, world.scene);
    CHECK(triangles_of(inset) > 100);
    CHECK(mappings_of(file) == 1);
    settings.ground.triangles = 4000;
    inset.apply_settings(settings);
    CHECK(triangles_of(inset) <= 1000);
    CHECK(mappings_of(file) == 1);
}

TEST_CASE("an inset draws the models and the ground that the scene shares and keeps none alone") {
    const ui::world::World world = small_world(2);
    const long models = world.scene.models.front().use_count();
    ui::settings::RunSettings settings = with_inset();
    settings.ground.mesh = scene::GroundMetric::Midpoint;
    const long before = world.scene.ground.use_count();
    {
        InsetView inset(settings, world.scene);
        CHECK(world.scene.models.front().use_count() == models);
        CHECK(world.scene.ground.use_count() == before + 1); // its mesher's
    }
    CHECK(world.scene.ground.use_count() == before);
}

TEST_CASE("an inset lies in the lower right corner and asks for a quarter of the triangles") {
    const ui::world::World world = small_world();
    ui::settings::RunSettings settings = with_inset();
    settings.ground.mesh = scene::GroundMetric::Midpoint;
    settings.ground.triangles = 8000;
    const InsetView inset(settings, world.scene);
    CHECK(inset.settings().view.size_px == glm::ivec2(213, 160));
    CHECK(inset.settings().ground.triangles == 2000);
    CHECK(inset.settings().view.kind == scene::View::Tower);
    CHECK(inset.rectangle().x + inset.rectangle().width < 640);
    CHECK(inset.rectangle().x > 320);
    CHECK(inset.rectangle().y > 240);
}

TEST_CASE("an inset follows the scene to another ground") {
    ui::world::World world = small_world();
    ui::settings::RunSettings settings = with_inset();
    settings.ground.mesh = scene::GroundMetric::Midpoint;
    InsetView inset(settings, world.scene);
    const std::size_t level = triangles_of(inset);
    world.scene.ground = landscape::make_quadtree_ground(rough_field(), settings.ground, settings.air);
    inset.apply_settings(settings);
    CHECK(triangles_of(inset) > level);
}

TEST_CASE("an inset settles anew when the control of its ground changes") {
    ui::world::World world = small_world();
    ui::settings::RunSettings settings = with_inset();
    settings.ground.mesh = scene::GroundMetric::Midpoint;
    settings.ground.detail = scene::DetailControl::Damped;
    settings.ground.resolution_c = 3.0;
    world.scene.ground = landscape::make_quadtree_ground(rough_field(), settings.ground, settings.air);
    InsetView inset(settings, world.scene);
    triangles_of(inset);
    settings.ground.resolution_c = 30.0;
    inset.apply_settings(settings);
    InsetView made_so(settings, world.scene);
    CHECK(triangles_of(inset) == triangles_of(made_so));
}
