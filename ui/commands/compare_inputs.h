#pragma once

#include "ui/report/comparison.h"
#include "ui/sweep/rounds.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// What octant compare is given on either side.
enum class ComparedKind { Programs, Settings, Recordings };

/// The kind of both sides, told by the files themselves. Throws Error where they are of two kinds, or of none.
ComparedKind compared_kind(const std::array<std::filesystem::path, 2>& sides);

/// Recordings of a side: the folder or the file itself (packed, or recorded by another program: frame_capture.h), else
/// those in a folder or in its runs/, in the order of their names. Adds a note for each table beside captures that is
/// none. Throws Error where there is no recording.
std::vector<report::LoadedRecording> load_side(const std::filesystem::path& side, std::vector<std::string>& notes);

/// What a user must know of a recording: that it ended early, what was guessed or left out of a capture; a line each,
/// with its name.
std::vector<std::string> notes_on(const report::LoadedRecording& recording);

/// One flight of both sides, with the indices of its recordings.
struct MatchedFlight {
    std::string name;
    report::Variant before;
    report::Variant after;
};

/// Flights that both sides have.
struct MatchedFlights {
    std::vector<MatchedFlight> flights;
    std::vector<std::string> notes; ///< what one side alone has, and sides that several programs recorded
};

/// Sets recordings of the new side against those of the old side, which come first: those of the same settings and
/// input files; of a flight that is left on both sides in one variant, these; where each side is one flight in one
/// variant, these whatever they are. Flights have different names. `names`: of the sides.
MatchedFlights matched_flights(
    report::Recordings recordings, std::size_t old_count, const std::array<std::string, 2>& names);

/// The flights of --settings FILE: of a sweep's FILE.toml all, else the one that a settings file or a recording
/// describes. Without files the standard flight: a turn of an F-15 over hills, 200 frames of 640x360 pixels. Each has a
/// name of its own. Repeats of a sweep are left out. Throws Error.
std::vector<sweep::RoundFlight> compared_flight_settings(
    std::span<const std::string> files, std::vector<std::string>& notes);

} // namespace octant::ui::commands
