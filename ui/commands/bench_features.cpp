#include "ui/commands/bench_features.h"

#include <array>
#include <fmt/format.h>
#include <string_view>
#include <type_traits>
#include <utility>

namespace octant::ui::commands {

namespace {

namespace scene = visuals::scene;
using settings::RunSettings;

/// What makes a picture richer: its share of what it can be in settings, 0: off.
struct Feature {
    std::string_view name;
    double (*share)(const RunSettings&);
    void (*put)(RunSettings&, double share);
    double on = 1.0; ///< the share that is measured
};

/// A feature that is a field of a part of the settings: a flag or a share.
template <auto part, auto field>
constexpr Feature feature(std::string_view name, double on = 1.0) {
    return {
        name,
        [](const RunSettings& settings) { return static_cast<double>((settings.*part).*field); },
        [](RunSettings& settings, double share) {
            auto& value = (settings.*part).*field;
            value = static_cast<std::remove_reference_t<decltype(value)>>(share);
        },
        on};
}

constexpr double cloud_share = 0.5;

using scene::AirSettings;
using scene::GroundSettings;
using scene::SurfaceSettings;

constexpr std::array features{
    feature<&RunSettings::air, &AirSettings::sky>("sky"),
    feature<&RunSettings::air, &AirSettings::relief_shadows>("relief shadows"),
    feature<&RunSettings::surface, &SurfaceSettings::shadows>("aircraft's shadows"),
    feature<&RunSettings::ground, &GroundSettings::near_detail>("near detail"),
    feature<&RunSettings::ground, &GroundSettings::scenery>("scenery"),
    feature<&RunSettings::ground, &GroundSettings::roads>("roads"),
    feature<&RunSettings::air, &AirSettings::clouds>("clouds", cloud_share),
    feature<&RunSettings::surface, &SurfaceSettings::effects>("effects"),
    feature<&RunSettings::view, &scene::ViewSettings::path_ribbon>("path ribbon")};

/// The settings of a scene with each feature's share as `share_of` says.
template <class ShareOf>
RunSettings with_features(RunSettings settings, const ShareOf& share_of) {
    for (const Feature& feature : features) {
        feature.put(settings, share_of(feature));
    }
    return settings;
}

} // namespace

std::vector<BenchScene> feature_scenes(const BenchScene& scene) {
    std::vector<BenchScene> scenes;
    const auto add = [&](std::string_view name, RunSettings settings) {
        scenes.push_back({scene.name + ": " + std::string(name), std::move(settings), false});
    };
    const auto with = [&](const auto& share_of) { return with_features(scene.settings, share_of); };
    const RunSettings none = with([](const Feature&) { return 0.0; });
    add("no features", none);
    for (const Feature& feature : features) {
        RunSettings one = none;
        feature.put(one, feature.on);
        add(feature.name, one);
    }
    RunSettings textured = none;
    textured.air.ground_shading = visuals::scene::GroundShading::Texture;
    RunSettings with_airfield = none;
    with_airfield.ground.airfield = true;
    const bool has_ground = scene.settings.path.terrain != "none";
    if (has_ground) {
        add("ground by texture", textured);
        add("airfield", with_airfield);
        scenes.back().is_optional = true;
    }
    const RunSettings by_default =
        with([](const Feature& feature) { return feature.share(RunSettings()); });
    add("those of the defaults", by_default);
    add("all of them", with([](const Feature& feature) { return feature.on; }));
    if (scene.settings.drawing.renderer != settings::RendererKind::Gl) {
        if (has_ground) {
            textured.drawing.renderer = settings::RendererKind::Gl;
            textured.view.samples.reset();
            add("ground by texture by OpenGL", textured);
        }
        RunSettings by_gl = by_default;
        by_gl.drawing.renderer = settings::RendererKind::Gl;
        by_gl.view.samples.reset();
        add("those of the defaults by OpenGL", by_gl);
    }
    return scenes;
}

std::vector<BenchScene> triangle_count_scenes(const BenchScene& scene) {
    std::vector<BenchScene> scenes;
    for (const int triangles : {20000, 50000, 100000, 200000}) {
        scenes.push_back({fmt::format("{}, {}", scene.name, triangles), scene.settings, false});
        scenes.back().settings.ground.triangles = triangles;
    }
    return scenes;
}

} // namespace octant::ui::commands
