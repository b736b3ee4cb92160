#pragma once

#include "models/heights/import_options.h"
#include "sim/trajectory.h"
#include "visuals/scene/settings.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {
class UnpackedRecording;
}

namespace octant::ui::settings {

/// Auto: Raster where no GPU draws.
enum class RendererKind { Auto, Raster, Gl };
enum class ContextKind { OsMesa, Egl, Window };

/// The name of a path that others fly: aircraft stand at its place until somebody moves them.
inline constexpr std::string_view live_path = "live";

/// Values of --order-cache that are no folders: the user's own cache, and none.
inline constexpr std::string_view user_order_cache = "user";
inline constexpr std::string_view no_order_cache = "none";
inline constexpr std::array built_in_order_caches{user_order_cache, no_order_cache};

/// Whether a value of --order-cache is a folder.
constexpr bool is_order_cache_folder(std::string_view value) {
    return std::ranges::find(built_in_order_caches, value) == built_in_order_caches.end();
}

/// Which path is flown, by which aircraft, over which ground.
struct PathSettings {
    /// A built-in path, a path file or a recorded track.
    std::string name = "straight";
    /// Names or files, at least one where a path is flown. The first aircraft flies the path, the others beside it.
    std::vector<std::string> aircraft = {"f15"};
    /// The aircraft of a recorded track that becomes the first one, by call sign, id, name or pilot; without it the
    /// recording's pilot, else the one recorded longest.
    std::optional<std::string> follow;
    /// Files of further recorded tracks, whose aircraft fly on the first one's clock (UTC).
    std::vector<std::string> tracks;
    /// How much later than recorded the aircraft of `tracks` fly.
    double track_offset_s = 0.0;
    /// Directions of the axes of aircraft files, or "auto": by their formats and shapes.
    std::string axes = "auto";
    /// Metres a unit of length of aircraft files.
    double aircraft_scale = 1.0;
    std::string terrain = "hills";
    /// Sample spacing of terrain files that do not give one.
    double terrain_spacing_m = 30.0;
    /// Metres a unit of heights, of terrain files that name none; 1 if not set.
    std::optional<double> terrain_height_scale;
    /// The coordinate system of terrain files that name none; metres if not set.
    std::optional<std::string> terrain_system;
    /// Stored numbers of terrain files that mean "no data".
    models::heights::VoidValues terrain_voids;
    /// The band of terrain files that holds heights, by number or name; chosen if not set.
    std::optional<std::string> terrain_band;
    /// Where the path's origin lies, as "X,Y" in metres or "LAT,LON" in degrees; without it the centre of the map.
    std::optional<std::string> place;
    /// How far the path is turned clockwise; without it, to the heading of least relief.
    std::optional<double> heading_deg;
    /// Without it, paths are lifted clear of the ground, and tracks that know their place fly at the heights that they
    /// give.
    std::optional<sim::HeightMode> height_mode;
    /// Whether only the part of a track that lies over the map is flown.
    bool over_map = false;
    /// Whether legs are limited to the aircraft's abilities, with a note, instead of being refused.
    bool lenient = false;

    bool operator==(const PathSettings&) const = default;
};

/// Which frames are drawn, and how fast.
struct TimeSettings {
    double rate_hz = 60.0;
    bool frame_per_sample = false;
    /// How long after the path's own start the flight begins.
    double start_s = 0.0;
    /// Which part of the frames is drawn, as "K/N"; those before it are flown all the same.
    std::optional<std::string> part;
    std::optional<int> frames;
    std::optional<double> seconds;
    int warm_up = 10;
    /// The flight goes no faster than the clock.
    bool realtime = false;
    /// A number N keeps every Nth frame as PNG, and 0 none; without it, one a simulated second.
    std::optional<int> pictures;

    bool operator==(const TimeSettings&) const = default;
};

/// Who draws the pictures.
struct DrawingSettings {
    RendererKind renderer = RendererKind::Auto;
    ContextKind context = ContextKind::OsMesa;
    /// Of the raster renderer; without it one for each core.
    std::optional<int> raster_threads;

    bool operator==(const DrawingSettings&) const = default;
};

/// Everything that decides what a run shows. Inherits view, surface, shading, ground, air and adapt from
/// scene::Settings. A run is repeated by repeating its RunSettings. Each field has a row (setting_rows.h) from which
/// its option, its file entry and its widget are made. Output files are not settings.
struct RunSettings : visuals::scene::Settings {
    /// Owns the folder of files that were read from a packed recording; else null.
    std::shared_ptr<const report::UnpackedRecording> unpacked;
    PathSettings path;
    TimeSettings time;
    DrawingSettings drawing;

    bool operator==(const RunSettings&) const = default;
};

/// Eye point, point in the middle of the picture, and picture of commands that draw one picture. Frame: the command's.
struct EyeView {
    std::optional<glm::dvec3> eye_m;
    std::optional<glm::dvec3> look_m;
    glm::ivec2 size_px{1280, 720};
    double fov_deg = 45.0; ///< vertical
};

/// Default settings for measurements: without procedural detail, scenery and roads.
inline RunSettings measurement_settings() {
    RunSettings settings;
    settings.ground.near_detail = false;
    settings.ground.scenery = false;
    settings.ground.roads = false;
    return settings;
}

} // namespace octant::ui::settings
