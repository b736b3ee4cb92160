#include "ui/studies/program/bench.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace octant::ui::studies::program {

namespace {

const BenchScene& scene_named(const std::vector<BenchScene>& scenes, const std::string& name) {
    for (const BenchScene& scene : scenes) {
        if (scene.name == name) { return scene; }
    }
    FAIL("no scene is named " << name);
    return scenes.front();
}

} // namespace

TEST_CASE("a table of costs has a scene without features and with each one alone") {
    settings::RunSettings measured = settings::measurement_settings();
    measured.path.terrain = "canyon";
    const std::vector<BenchScene> scenes = feature_scenes({"canyon", measured});
    const settings::RunSettings& none = scenes.front().settings;
    CHECK(scenes.front().name == "canyon: no features");
    CHECK_FALSE(none.air.sky);
    CHECK_FALSE(none.surface.shadows);
    CHECK_FALSE(none.air.relief_shadows);
    const BenchScene& scenery = scene_named(scenes, "canyon: scenery");
    CHECK(scenery.settings.ground.scenery);
    CHECK_FALSE(scenery.settings.ground.near_detail);
    for (std::size_t i = 1; i < scenes.size(); ++i) {
        CAPTURE(scenes[i].name);
        CHECK_FALSE(scenes[i].settings == none);
        CHECK(scenes[i].settings.path.terrain == "canyon");
    }
}

TEST_CASE("a table of costs has the defaults as they are, by OpenGL, too") {
    const std::vector<BenchScene> scenes = feature_scenes({"hills", settings::measurement_settings()});
    CHECK(scene_named(scenes, "hills: those of the defaults").settings == settings::RunSettings());
    settings::RunSettings by_gl;
    by_gl.drawing.renderer = settings::RendererKind::Gl;
    CHECK(scenes.back().settings == by_gl);
}

TEST_CASE("a table of costs has ground by a texture from both renderers, else without features") {
    const std::vector<BenchScene> scenes = feature_scenes({"hills", settings::measurement_settings()});
    settings::RunSettings expected = scenes.front().settings;
    expected.air.ground_shading = visuals::scene::GroundShading::Texture;
    CHECK(scene_named(scenes, "hills: ground by texture").settings == expected);
    expected.drawing.renderer = settings::RendererKind::Gl;
    CHECK(scene_named(scenes, "hills: ground by texture by OpenGL").settings == expected);
}

TEST_CASE("a table of costs has an airfield where there is room for one") {
    const std::vector<BenchScene> scenes = feature_scenes({"hills", settings::measurement_settings()});
    const BenchScene& airfield = scene_named(scenes, "hills: airfield");
    CHECK(airfield.is_optional);
    settings::RunSettings without = airfield.settings;
    without.ground.airfield = false;
    CHECK(without == scenes.front().settings);
    for (const BenchScene& scene : scenes) { CHECK(scene.settings.ground.airfield == (&scene == &airfield)); }
}

TEST_CASE("costs of features are timed over fewer frames than single scenes, unless it is said") {
    BenchOptions options;
    const int usual = timed_frames(options);
    options.features = true;
    CHECK(10 * timed_frames(options) <= usual);
    options.frames = 77;
    CHECK(timed_frames(options) == 77);
}

TEST_CASE("growth is measured from 20,000 to 200,000 triangles of ground, all else alike") {
    settings::RunSettings measured = settings::measurement_settings();
    measured.path.terrain = "canyon";
    const std::vector<BenchScene> scenes = triangle_count_scenes({"canyon", measured});
    REQUIRE(scenes.size() == 4);
    CHECK(scenes.front().name == "canyon, 20000");
    CHECK(scenes.front().settings.ground.triangles == 20000);
    CHECK(scenes.back().settings.ground.triangles == 200000);
    for (BenchScene scene : scenes) {
        scene.settings.ground.triangles = measured.ground.triangles;
        CHECK(scene.settings == measured);
    }
}

} // namespace octant::ui::studies::program
