#pragma once

#include "flightpaths/track_writer.h"
#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/base/output_file.h"
#include "ui/world/world.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::flight {

/// Writes track.csv and track.acmi of a flight into a folder: its path up to `until_s`. Throws Error.
void write_tracks(const std::filesystem::path& folder, const world::World& world, double until_s);

/// Writes the tracks of a flight that left the world's path: `flight` holds its samples, `frame` says how the world
/// lies on the earth, null where that is not known. Throws Error.
void write_tracks(const std::filesystem::path& folder, const world::World& world, const sim::Trajectory& flight,
    const EarthFrame* frame);

/// The tracks of a flight along the world's path while it is flown: at any time the files hold what has been flown, so
/// that those of a killed flight go no further than it came.
class StreamedTracks {
public:
    /// Makes both files. Throws Error.
    StreamedTracks(const std::filesystem::path& folder, const world::World& world);

    /// Appends what was flown up to a time, not before earlier ones, and hands it to the system at the latest every
    /// second of it. Throws Error (disk full).
    void write_until(double time_s);

private:
    struct Track {
        AppendedFile file;
        /// Of the whole path.
        std::string text;
        std::size_t written = 0;
    };

    /// Those of track.csv and track.acmi.
    std::array<Track, 2> tracks_;
    std::optional<double> flushed_s_;
};

/// The tracks of a flight that others fly, which nobody knows beforehand: track.csv has the states of all pictures,
/// track.acmi those since the first aircraft is flown, as its place on the earth is known by then. Both are handed to
/// the system at the latest every second.
class StreamedLiveTracks {
public:
    /// Makes both files. Throws Error.
    StreamedLiveTracks(const std::filesystem::path& folder, const world::World& world);

    /// Appends the first aircraft's state in a picture, later than the one before. `frame` says how the world lies on
    /// the earth, null where that is not known. Throws Error (disk full).
    void add(const sim::AircraftState& state, bool is_flown, const EarthFrame* frame);

    /// Hands everything to the system. Throws Error (disk full).
    void flush();

private:
    AppendedFile csv_;
    AppendedFile acmi_;
    flightpaths::AcmiHeader header_;
    bool is_flown_ = false;
    std::optional<double> flushed_s_;
};

} // namespace octant::ui::flight
