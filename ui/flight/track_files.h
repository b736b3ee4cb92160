#pragma once

#include "ui/world/world.h"

#include <filesystem>
#include <optional>

namespace octant::ui::flight {

/// Writes track.csv and track.acmi of a flight into a folder: its path up to `until_s`. Throws
/// Error.
void write_tracks(const std::filesystem::path& folder, const world::World& world, double until_s);

/// Writes the tracks of a flight that left the world's path: `flight` holds its samples,
/// `origin` says where the world's origin lies on the earth. Throws Error.
void write_tracks(
    const std::filesystem::path& folder,
    const world::World& world,
    const sim::Trajectory& flight,
    const std::optional<models::heights::GeoPlace>& origin);

/// Shortens the tracks of a flight that was killed to what was flown. Files that are not there are
/// left alone. Throws Error.
void cut_tracks(const std::filesystem::path& folder, double until_s);

} // namespace octant::ui::flight
