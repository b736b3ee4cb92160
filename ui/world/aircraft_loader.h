#pragma once

#include "ui/settings/settings.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// The aircraft of a run, as Scene has them.
struct LoadedAircraft {
    std::vector<std::shared_ptr<const visuals::planning::AircraftModel>> models;
    std::vector<std::uint32_t> aircraft;
    std::vector<visuals::planning::FarModel> far_models;
    std::optional<std::uint32_t> cockpit;
    /// The working dials of the cockpit.
    visuals::overlay::InstrumentLayout dials;
    /// What a person should be told.
    std::vector<std::string> notes;
    /// Kept painting orders that were used.
    std::vector<std::filesystem::path> order_files;
};

/// Loads aircraft of these shapes, names or files, and the cockpit of the first one where it has
/// one: polygon models with their painting orders, chains of levels, and meshes, which get levels
/// here. Throws Error.
LoadedAircraft
load_aircraft(const settings::RunSettings& settings, const std::vector<std::string>& shapes);

} // namespace octant::ui::world
