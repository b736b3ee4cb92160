#include "ui/world/loaded_path.h"

#include "flightpaths/acmi_recording.h"
#include "flightpaths/path_script.h"
#include "flightpaths/recorded_track.h"
#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/report/zip_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

namespace {

namespace fs = std::filesystem;

/// Lowest clearance of a recorded track that is lifted over ground: it names none itself.
constexpr double track_clearance_m = 50.0;

const sim::AircraftKind& aircraft_kind_of_path(const flightpaths::PathScript& script) {
    try {
        return sim::aircraft_kind(script.aircraft);
    } catch (const Error& fault) { throw_error_at(script.file, script.aircraft_line, fault.what()); }
}

/// What a person should be told where an aircraft without a row of its own flies a built-in path.
void note_what_flies(const std::string& path, const std::string& shape, const sim::AircraftKind& flown,
    std::vector<std::string>& notes) {
    const bool is_built_in = std::ranges::find(base::built_in_paths, path) != base::built_in_paths.end();
    if (is_built_in && sim::find_aircraft_kind(shape) == nullptr) {
        notes.push_back(fmt::format("{} flies the {} path of {}, within its limits: only its own shape is known",
            printable(std::filesystem::path(shape).filename().string()), path, flown.name));
    }
}

double mean_rate_hz(const sim::Trajectory& trajectory) {
    const auto steps = static_cast<double>(trajectory.samples().size() - 1);
    return 1.0 / ((trajectory.end_s() - trajectory.start_s()) / steps);
}

LoadedPath from_track(flightpaths::RecordedTrack track, const std::string& shape) {
    const double rate_hz = mean_rate_hz(track.trajectory);
    const sim::AircraftKind* kind = sim::find_aircraft_kind(shape);
    return {std::move(track.trajectory), rate_hz, track_clearance_m,
        kind == nullptr ? std::nullopt : std::optional(kind->limits), track.origin, {}, std::move(track.notes), {}, {},
        false};
}

/// A tape as it is, or the first one in a zip file.
std::string tacview_note(const fs::path& file) {
    constexpr std::size_t largest_tape = std::size_t{256} << 20;
    const std::string bytes = read_file(file, largest_tape);
    if (!bytes.starts_with("PK")) { return bytes; }
    const std::vector<report::ZipEntry> entries = report::zip_entries(file);
    const auto tape = std::ranges::find_if(entries, [](const report::ZipEntry& entry) {
        return extension_of(entry.name) == ".acmi" || extension_of(entry.name) == ".txt";
    });
    if (tape == entries.end() || tape->bytes > largest_tape) {
        throw_error_in(file, "expected a tape of at most 256 MiB in it (.acmi), got none");
    }
    return report::zip_text(file, tape->name, largest_tape);
}

/// The known aircraft that has this type in Tacview, the first one for any other.
const sim::AircraftKind& aircraft_for_type(const std::string& type) {
    const auto tags = split_fields(type, '+');
    const auto kinds = sim::aircraft_kinds();
    const auto same = std::ranges::find_if(kinds, [&](const sim::AircraftKind& kind) {
        const auto wanted = split_fields(kind.tacview_type, '+');
        return std::ranges::all_of(
            wanted, [&](std::string_view tag) { return std::ranges::find(tags, tag) != tags.end(); });
    });
    return same == kinds.end() ? kinds.front() : *same;
}

/// What a person should be told of who is who.
std::string note_of(const flightpaths::RecordedAircraft& first, const std::string& shape) {
    const std::string_view type_name = aircraft_for_type(first.type).name;
    return fmt::format("{}{}{} is followed, as {}{}", printable(first.name.empty() ? "an aircraft" : first.name),
        first.type.empty() ? "" : ", ", printable(first.type), printable(shape),
        shape == type_name ? "" : fmt::format("; --aircraft {} is of its type", type_name));
}

LoadedPath from_tacview(const fs::path& file, const std::string& shape) {
    flightpaths::AcmiRecording tape = flightpaths::parse_acmi(tacview_note(file), file);
    LoadedPath loaded = from_track({std::move(tape.aircraft.front().trajectory), tape.origin, {}}, shape);
    loaded.is_tape = true;
    loaded.notes = std::move(tape.notes);
    loaded.notes.push_back(note_of(tape.aircraft.front(), shape));
    for (std::size_t i = 1; i < tape.aircraft.size(); ++i) {
        loaded.other_trajectories.push_back(std::move(tape.aircraft[i].trajectory));
        loaded.other_aircraft.emplace_back(aircraft_for_type(tape.aircraft[i].type).name);
    }
    return loaded;
}

} // namespace

LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient) {
    const fs::path file = base::path_file(path, shape);
    if (extension_of(file) == ".acmi") { return from_tacview(file, shape); }
    if (file.extension() != ".toml") { return from_track(flightpaths::read_recorded_track(file), shape); }
    const flightpaths::PathScript script = flightpaths::read_path_script(file);
    const sim::AircraftKind& kind = aircraft_kind_of_path(script);
    flightpaths::FlownPath flown = flightpaths::fly(script, kind, lenient);
    note_what_flies(path, shape, kind, flown.notes);
    return {std::move(flown.trajectory), static_cast<double>(script.rate_hz), script.min_clearance_m, kind.limits, {},
        std::move(flown.legs), std::move(flown.notes), {}, {}, false};
}

} // namespace octant::ui::world
