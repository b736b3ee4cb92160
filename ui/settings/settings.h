#pragma once

#include "models/heights/import_options.h"
#include "sim/height_mode.h"
#include "visuals/scene/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::settings {

/// Auto: Raster where no GPU draws.
enum class RendererKind { Auto, Raster, Gl };
enum class ContextKind { OsMesa, Egl, Window };

/// The name of a path that others fly: aircraft stand at its place until somebody moves them.
inline constexpr std::string_view live_path = "live";

/// Which path is flown, by which aircraft, over which ground.
struct PathSettings {
    /// A built-in path, a path file or a recorded track.
    std::string name = "straight";
    /// Names or files, at least one. The first aircraft flies the path, the others beside it.
    std::vector<std::string> aircraft = {"f15"};
    /// Directions of the axes of aircraft files, or "auto": by their formats, else by their shapes.
    std::string axes = "auto";
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

/// Everything that decides what a run shows: what a picture shows (the parts of scene::Settings), the flight, its
/// frames and who draws them. A run is repeated by repeating its RunSettings. Each field has a row
/// (ui/settings/README.md) from which its option, its file entry and its widget are made. What only says where results
/// go is not here.
struct RunSettings : visuals::scene::Settings {
    PathSettings path;
    TimeSettings time;
    DrawingSettings drawing;

    bool operator==(const RunSettings&) const = default;
};

/// Settings of what is measured: the ground as it is given, without the detail and the scenery that are made up near
/// the eye.
inline RunSettings measurement_settings() {
    RunSettings settings;
    settings.ground.near_detail = false;
    settings.ground.scenery = false;
    settings.ground.roads = false;
    return settings;
}

} // namespace octant::ui::settings
