#include "ui/commands/bench_features.h"

#include <array>
#include <string_view>
#include <utility>

namespace octant::ui::commands {

namespace {

using settings::RunSettings;

/// What makes a picture richer, and how it is switched on.
struct Feature {
    std::string_view name;
    void (*put)(RunSettings&, bool on);
};

constexpr double cloud_share = 0.5;

constexpr std::array features{
    Feature{"sky", [](RunSettings& settings, bool on) { settings.air.sky = on; }},
    Feature{
        "relief shadows", [](RunSettings& settings, bool on) { settings.air.relief_shadows = on; }},
    Feature{
        "aircraft's shadows",
        [](RunSettings& settings, bool on) { settings.surface.shadows = on; }},
    Feature{
        "near detail", [](RunSettings& settings, bool on) { settings.ground.near_detail = on; }},
    Feature{"scenery", [](RunSettings& settings, bool on) { settings.ground.scenery = on; }},
    Feature{
        "clouds",
        [](RunSettings& settings, bool on) { settings.air.clouds = on ? cloud_share : 0.0; }},
    Feature{"effects", [](RunSettings& settings, bool on) { settings.surface.effects = on; }},
    Feature{"path ribbon", [](RunSettings& settings, bool on) { settings.view.path_ribbon = on; }}};

void put_all(RunSettings& settings, bool on) {
    for (const Feature& feature : features) {
        feature.put(settings, on);
    }
}

/// The settings of a scene with the features of the defaults.
RunSettings with_defaults(RunSettings settings) {
    const RunSettings defaults;
    settings.air.sky = defaults.air.sky;
    settings.air.relief_shadows = defaults.air.relief_shadows;
    settings.air.clouds = defaults.air.clouds;
    settings.surface.shadows = defaults.surface.shadows;
    settings.surface.effects = defaults.surface.effects;
    settings.ground.near_detail = defaults.ground.near_detail;
    settings.ground.scenery = defaults.ground.scenery;
    settings.view.path_ribbon = defaults.view.path_ribbon;
    return settings;
}

} // namespace

std::vector<BenchScene> feature_scenes(const BenchScene& scene) {
    std::vector<BenchScene> scenes;
    const auto add = [&](std::string_view name, RunSettings settings) {
        scenes.push_back({scene.name + ": " + std::string(name), std::move(settings)});
    };
    RunSettings none = scene.settings;
    put_all(none, false);
    add("no features", none);
    for (const Feature& feature : features) {
        RunSettings one = none;
        feature.put(one, true);
        add(feature.name, one);
    }
    RunSettings textured = none;
    textured.air.ground_shading = visuals::scene::GroundShading::Texture;
    add("ground by texture", textured);
    add("those of the defaults", with_defaults(scene.settings));
    RunSettings all = scene.settings;
    put_all(all, true);
    add("all of them", all);
    if (scene.settings.drawing.renderer != settings::RendererKind::Gl) {
        textured.drawing.renderer = settings::RendererKind::Gl;
        textured.view.samples.reset();
        add("ground by texture by OpenGL", textured);
        RunSettings by_gl = with_defaults(scene.settings);
        by_gl.drawing.renderer = settings::RendererKind::Gl;
        by_gl.view.samples.reset();
        add("those of the defaults by OpenGL", by_gl);
    }
    return scenes;
}

} // namespace octant::ui::commands
