#pragma once

#include "visuals/scene/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::settings {

enum class HeightMode { Clear, Follow, Datum };
enum class ContextKind { OsMesa, Egl, Window };

/// Which path, aircraft and ground.
struct PathSettings {
    std::string name = "straight";               ///< built-in path, path file or recorded track
    std::vector<std::string> aircraft = {"f15"}; ///< the first flies the path, others beside it
    std::string axes = "right,up,back";          ///< of aircraft files
    std::string terrain = "hills";
    double terrain_spacing_m = 30.0;   ///< of files that do not say
    std::optional<std::string> place;  ///< "X,Y" metres or "LAT,LON" degrees
    std::optional<double> heading_deg; ///< turns the path; nothing: the heading of least relief
    /// Nothing: clear, or datum for a track that knows its place.
    std::optional<HeightMode> height_mode;
    bool lenient = false;

    bool operator==(const PathSettings&) const = default;
};

/// Which frames are drawn, and how fast.
struct TimeSettings {
    double rate_hz = 60.0;
    bool frame_per_sample = false;
    double start_s = 0.0; ///< where in the path the flight begins, after the path's own start
    std::optional<int> frames;
    std::optional<double> seconds;
    int warm_up = 10;
    bool realtime = false;       ///< no faster than the clock
    std::optional<int> pictures; ///< every Nth frame as PNG, 0 = none; nothing: one a second

    bool operator==(const TimeSettings&) const = default;
};

/// Who draws.
struct DrawingSettings {
    ContextKind context = ContextKind::OsMesa;

    bool operator==(const DrawingSettings&) const = default;
};

/// Everything that decides what a run shows: what a picture shows (the parts of scene::Settings),
/// the flight, its frames and who draws them. A run is repeated by repeating its Settings; each
/// field is an option of the command line (ui/settings/settings_fields.h says name, unit and
/// meaning). What only says where results go is not here.
struct Settings : visuals::scene::Settings {
    PathSettings path;
    TimeSettings time;
    DrawingSettings drawing;

    bool operator==(const Settings&) const = default;
};

} // namespace octant::ui::settings
