#pragma once

#include "ui/settings/settings.h"
#include "ui/world/aircraft_frame.h"
#include "ui/world/input_files.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/settings.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// The folder in which painting orders and prepared meshes are cached by this value of --order-cache, made if missing;
/// nothing for "none". The user's own cache is cut down to 256 MiB; if it cannot be made or written, nothing. Throws
/// Error for a named folder that cannot be made.
std::optional<std::filesystem::path> order_cache_folder(const std::string& value);

/// Removes the oldest files of such a folder until the rest takes at most `max_bytes`. Ignores files that are not of
/// the cache, that another run is writing or that cannot be removed.
void remove_oldest(const std::filesystem::path& folder, std::uintmax_t max_bytes);

/// Inputs of load_aircraft(): equal inputs give equal aircraft.
struct AircraftSources {
    /// Names or files.
    std::vector<std::string> shapes;
    /// The files of the shapes and those that these name.
    std::vector<FileMtime> files;
    AircraftFrameSettings frame;
    visuals::scene::HiddenSurface hidden_surface{};
    visuals::draworder::OrderMethod order_method{};
    double order_seconds = 0.0;
    std::string order_cache;
    bool textures = true;

    bool operator==(const AircraftSources&) const = default;
};

/// Throws Error where a file cannot be opened.
AircraftSources aircraft_sources(const settings::RunSettings& settings, std::vector<std::string> shapes);

/// The aircraft of a run, as Scene has them.
struct LoadedAircraft {
    AircraftSources inputs;
    std::vector<std::shared_ptr<const visuals::planning::AircraftModel>> models;
    std::vector<std::uint32_t> aircraft;
    std::vector<visuals::planning::FarModel> far_models;
    std::optional<std::uint32_t> cockpit;
    /// The working dials of the cockpit.
    visuals::overlay::InstrumentLayout dials;
    /// Notes for the user.
    std::vector<std::string> notes;
    /// Painting orders kept in a folder that the run names.
    std::vector<std::filesystem::path> order_files;
};

/// Loads the aircraft, and the cockpit of the first one if its type has one: polygon models with their painting orders,
/// and meshes (mesh_aircraft.h). Throws Error.
LoadedAircraft load_aircraft(const AircraftSources& inputs);

} // namespace octant::ui::world
