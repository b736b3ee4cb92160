#include "ui/settings/settings_check.h"

#include "models/polygons/file_axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/sun_position.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/setting_rows.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <type_traits>

namespace octant::ui::settings {

bool is_built_in_ground(const std::string& name) {
    return std::ranges::find(built_in_terrains, name) != built_in_terrains.end();
}

bool is_imported_ground(const std::string& name_or_file) {
    return !is_built_in_ground(name_or_file) && visuals::groundfile::is_ground_file(name_or_file);
}

bool has_no_detail_levels(const std::string& terrain) { return terrain == "background60" || terrain == "none"; }

namespace scene = visuals::scene;

namespace {

void check_listed_numbers(const RunSettings& settings) {
    visit_settings(settings, []<class Value>(const SettingInfo& info, const Value& value) {
        if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<int>>) {
            try {
                const std::optional<int> number(value);
                if (number) { check_listed(info, *number); }
            } catch (const Error& fault) { throw Error(fmt::format("--{}", fault.what())); }
        }
    });
}

void check_time(const scene::AirSettings& air) {
    if (air.time && !sim::solar_time_from_text(*air.time)) {
        throw Error(
            fmt::format("--time: expected a day and an hour as YYYY-MM-DDTHH:MM, got '{}'", printable(*air.time)));
    }
}

void check_part(const RunSettings& settings) {
    if (!settings.time.part) { return; }
    if (!part_from_text(*settings.time.part)) {
        throw Error(fmt::format("--part: expected K/N, the Kth of N parts, got '{}'", printable(*settings.time.part)));
    }
    if (settings.adapt.terrain || settings.adapt.shading) {
        throw Error(fmt::format("--part: expected --adapt none beside it, as what follows the clock depends on frames "
                                "that another part draws, got --adapt {}",
            text_of(settings.adapt)));
    }
    if (settings.path.name == live_path) { throw Error("--part: expected a path or a track, got what others fly"); }
}

void check_shading(const scene::ShadingSettings& shading, const scene::Adaptation& adapt) {
    const bool by_share =
        adapt.shading || shading.device_ratio || shading.smooth_share < 1.0 || shading.rule == scene::HybridRule::Paper;
    if (by_share && shading.kind != scene::AircraftShading::Hybrid) {
        throw Error(fmt::format("--shading: expected hybrid beside --adapt shading, --smooth-share, "
                                "--paper-shading device-ratio or --shading-rule paper, got {}",
            text_of(shading.kind)));
    }
    if (shading.far_m <= shading.near_m) {
        throw Error(
            fmt::format("--paper-shading far: expected more than near ({}), got {}", shading.near_m, shading.far_m));
    }
}

void check_terrain_adaptation(const scene::GroundSettings& ground, const std::string& terrain) {
    if (ground.lod.control != visuals::terrain::DetailControl::Exact) {
        throw Error(fmt::format("--adapt terrain: expected --terrain-lod screen-error or exact, got --terrain-lod {}",
            text_of(ground.lod)));
    }
    if (has_no_detail_levels(terrain)) {
        throw Error(fmt::format("--adapt terrain: expected ground with levels of detail, got {}", terrain));
    }
}

void check_ground(const scene::GroundSettings& ground, const std::string& terrain) {
    const bool by_error = visuals::terrain::ground_metric(ground.lod) == visuals::terrain::GroundMetric::ScreenError;
    visuals::terrain::TerrainLod without_metric = ground.lod;
    without_metric.metric.reset();
    if (by_error && visuals::terrain::ground_metric(without_metric) != visuals::terrain::GroundMetric::ScreenError) {
        throw Error(
            "--mesh screen-error: expected --detail exact without --roughness-c, --fans or --propagation, got one "
            "that only --terrain-lod exact or paper has");
    }
    if (!by_error && is_imported_ground(terrain)) {
        throw Error(fmt::format("{}: expected --terrain-lod screen-error for an imported ground, got --terrain-lod {}",
            printable(terrain), text_of(ground.lod)));
    }
    if (!by_error && ground.error_px) {
        throw Error(
            fmt::format("--error-px: expected --terrain-lod screen-error, got --terrain-lod {}", text_of(ground.lod)));
    }
}

void check_ground_texture(const scene::AirSettings& air, const std::string& terrain) {
    const bool draped = air.drape.has_value();
    const bool textured = draped || air.ground_shading == scene::GroundShading::Texture;
    if (textured && has_no_detail_levels(terrain)) {
        throw Error(fmt::format("{}: expected ground with heights (hills, canyon or a file), got --terrain {}",
            draped ? "--drape" : "--ground-look shading=texture", printable(terrain)));
    }
    if (draped && air.ground_shading == scene::GroundShading::Vertex) {
        throw Error("--drape: expected --ground-look shading=texture or auto beside it, got vertex");
    }
}

/// Clouds and the ribbon have a place in the order of the whole scene, and none by depth.
void check_transparency(const RunSettings& settings) {
    const auto refuse_depth = [&](const char* option, bool is_on) {
        if (is_on && settings.surface.hidden_surface == scene::HiddenSurface::DepthBuffer) {
            throw Error(
                fmt::format("{}: expected --hidden-surface octant or back-face beside it, got depth-buffer", option));
        }
    };
    refuse_depth("--clouds", settings.air.clouds > 0.0);
    refuse_depth("--show path-ribbon", settings.view.path_ribbon);
    if (settings.view.path_ribbon && settings.path.name == live_path) {
        throw Error("--show path-ribbon: expected a path or a track, got what others fly");
    }
}

} // namespace

void check_eye_point(const scene::ViewSettings& view) {
    const bool free = view.kind == scene::View::Free;
    if (free && (!view.eye_m || !view.look_m)) {
        throw Error("--view free: expected --eye X,Y,Z and --look X,Y,Z, got at most one of them");
    }
    if (free && *view.eye_m == *view.look_m) { throw Error("--look: expected another point than --eye, got the same"); }
    if (!free && view.kind != scene::View::Tower && view.eye_m) {
        throw Error(fmt::format("--eye: expected --view tower or free beside it, got --view {}", text_of(view.kind)));
    }
    if (!free && view.look_m) {
        throw Error(fmt::format("--look: expected --view free beside it, got --view {}", text_of(view.kind)));
    }
}

void check_settings(const RunSettings& settings) {
    check_listed_numbers(settings);
    if (settings.path.axes != "auto") { // also where a built-in model needs none
        models::polygons::FileAxes::from_text(settings.path.axes);
    }
    if (settings.view.inset == scene::View::Free && settings.view.kind != scene::View::Free) {
        throw Error(
            fmt::format("--inset free: expected --view free beside it, got --view {}", text_of(settings.view.kind)));
    }
    check_part(settings);
    if (settings.adapt.terrain) { check_terrain_adaptation(settings.ground, settings.path.terrain); }
    check_shading(settings.shading, settings.adapt);
    check_ground(settings.ground, settings.path.terrain);
    check_ground_texture(settings.air, settings.path.terrain);
    check_eye_point(settings.view);
    check_time(settings.air);
    check_transparency(settings);
    if (settings.drawing.renderer == RendererKind::Gl && settings.view.samples == 16) {
        throw Error("--samples: expected 1 or 4 beside --renderer gl, got 16");
    }
}

} // namespace octant::ui::settings
