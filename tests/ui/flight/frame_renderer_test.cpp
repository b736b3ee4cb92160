#include "models/heights/height_field.h"
#include "models/heights/height_field_export.h"
#include "tests/scratch.h"
#include "ui/flight/frame_renderer.h"
#include "ui/world/scene_ground.h"
#include "visuals/groundfile/ground_import.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "fake_renderer.h"
#include "small_flight.h"

using namespace octant;
using namespace octant::tests;
namespace landscape = octant::visuals::landscape;
namespace scene = octant::visuals::scene;

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

/// The two views of a scene, drawn by nothing.
struct Views {
    explicit Views(const ui::world::World& world) : pictures(renderer, world.scene, settings) {
        settings.view.inset = scene::View::Tower;
        settings.view.size_px = {640, 480};
        settings.ground.lod.metric = visuals::terrain::GroundMetric::Midpoint;
    }

    /// Makes the views or brings them to what the settings and the scene are now.
    void update() { pictures.update_views(camera); }

    /// Triangles of ground in the next picture's inset.
    std::size_t inset_triangles() {
        ui::flight::FrameState now;
        now.states.resize(1);
        now.cameras = {camera, camera};
        now.triangle_target = 8000;
        pictures.plan(now, std::nullopt);
        pictures.draw();
        return log->triangles.back();
    }

    const scene::Camera camera = scene::camera_looking_at({-600, -900, 500}, {0, 0, 0});
    std::shared_ptr<RendererLog> log = std::make_shared<RendererLog>();
    FakeRenderer renderer{log, {640, 480}};
    ui::settings::RunSettings settings;
    ui::flight::FrameRenderer pictures;
};

} // namespace

TEST_CASE("an inset needs no file of the ground and maps it no second time") {
    const std::filesystem::path file = imported("shared.ground");
    ui::world::World world = small_world();
    Views views(world);
    views.settings.path.terrain = file.string();
    views.settings.ground.lod.metric = visuals::terrain::GroundMetric::ScreenError;
    world.scene.ground = ui::world::load_scene_ground(views.settings, ui::world::RenderDevice::Cpu).ground;
    REQUIRE(mappings_of(file) == 1);
    std::filesystem::remove(file);

    views.update();
    CHECK(views.inset_triangles() > 100);
    CHECK(mappings_of(file) == 1);
    views.settings.ground.triangles = 4000;
    views.update();
    CHECK(views.inset_triangles() <= 1000);
    CHECK(mappings_of(file) == 1);
}

TEST_CASE("an inset draws the models and the ground that the scene shares and keeps none alone") {
    const ui::world::World world = small_world(2);
    const long models = world.scene.models.front().use_count();
    const long before = world.scene.ground.use_count();
    Views views(world);
    views.update();
    CHECK(world.scene.models.front().use_count() == models);
    CHECK(world.scene.ground.use_count() == before + 2); // the views' meshers
    views.settings.view.inset.reset();
    views.update();
    CHECK(world.scene.ground.use_count() == before + 1);
}

TEST_CASE("an inset lies in the lower right corner and asks for a quarter of the triangles") {
    const ui::world::World world = small_world();
    Views views(world);
    views.settings.ground.triangles = 8000;
    views.update();
    REQUIRE(views.pictures.view_count() == 2);
    const ui::settings::RunSettings& inset = views.pictures.view_settings(1);
    CHECK(inset.view.size_px == glm::ivec2(213, 160));
    CHECK(inset.ground.triangles == 2000);
    CHECK(inset.view.kind == scene::View::Tower);
    const scene::PixelRect rectangle = ui::flight::inset_rectangle({640, 480});
    CHECK(rectangle.x + rectangle.width < 640);
    CHECK(rectangle.x > 320);
    CHECK(rectangle.y > 240);
}

TEST_CASE("an inset follows the scene to another ground") {
    ui::world::World world = small_world();
    Views views(world);
    views.update();
    const std::size_t level = views.inset_triangles();
    world.scene.ground = landscape::make_field_ground(rough_field(), views.settings.ground, views.settings.air);
    views.update();
    CHECK(views.inset_triangles() > level);
}

TEST_CASE("an inset settles anew when the control of its ground changes") {
    ui::world::World world = small_world();
    Views views(world);
    views.settings.ground.lod.control = visuals::terrain::DetailControl::Damped;
    views.settings.ground.lod.resolution_c = 3.0;
    world.scene.ground = landscape::make_field_ground(rough_field(), views.settings.ground, views.settings.air);
    views.update();
    views.inset_triangles();
    views.settings.ground.lod.resolution_c = 30.0;
    views.update();
    Views made_so(world);
    made_so.settings = views.settings;
    made_so.update();
    CHECK(views.inset_triangles() == made_so.inset_triangles());
}
