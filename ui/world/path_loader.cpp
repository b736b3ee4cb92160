#include "ui/world/path_loader.h"

#include "flightpaths/acmi_recording.h"
#include "flightpaths/path_script.h"
#include "flightpaths/recorded_track.h"
#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/report/zip_file.h"
#include "ui/settings/aircraft_entry.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;

std::string path_of(const settings::RunSettings& settings) {
    return settings::parse_aircraft_entry(settings.path.aircraft.front()).path.value_or(settings.path.name);
}

namespace {

/// Lowest clearance of a recorded track that is lifted over ground: it names none itself.
constexpr double track_clearance_m = 50.0;

const sim::AircraftKind& aircraft_kind_of_path(const flightpaths::PathScript& script) {
    try {
        return sim::aircraft_kind(script.aircraft);
    } catch (const Error& fault) { throw_error_at(script.file, script.aircraft_line, fault.what()); }
}

/// Notes that an aircraft of unknown type flies a built-in path within the limits of another type.
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

/// The text of an ACMI recording, or of the first one in a zip file.
std::string acmi_text(const fs::path& file) {
    constexpr std::size_t max_bytes = std::size_t{256} << 20;
    const std::string bytes = read_file(file, max_bytes);
    if (!bytes.starts_with("PK")) { return bytes; }
    const std::vector<report::ZipEntry> entries = report::zip_entries(file);
    const auto recording = std::ranges::find_if(entries, [](const report::ZipEntry& entry) {
        return extension_of(entry.name) == ".acmi" || extension_of(entry.name) == ".txt";
    });
    if (recording == entries.end() || recording->bytes > max_bytes) {
        throw_error_in(file, "expected an ACMI recording of at most 256 MiB in it (.acmi), got none");
    }
    return report::zip_text(file, recording->name, max_bytes);
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

/// Says which aircraft of the recording is the first one, and as what it is shown.
std::string note_of(const flightpaths::RecordedAircraft& first, const std::string& shape) {
    const std::string_view type_name = aircraft_for_type(first.type).name;
    return fmt::format("{}{}{} is followed, as {}{}", printable(first.name.empty() ? "an aircraft" : first.name),
        first.type.empty() ? "" : ", ", printable(first.type), printable(shape),
        shape == type_name ? "" : fmt::format("; --aircraft {} is of its type", type_name));
}

LoadedPath from_tacview(const fs::path& file, const std::string& shape) {
    flightpaths::AcmiRecording recording = flightpaths::parse_acmi(acmi_text(file), file);
    LoadedPath loaded = from_track({std::move(recording.aircraft.front().trajectory), recording.origin, {}}, shape);
    loaded.is_acmi_recording = true;
    loaded.notes = std::move(recording.notes);
    loaded.notes.push_back(note_of(recording.aircraft.front(), shape));
    for (std::size_t i = 1; i < recording.aircraft.size(); ++i) {
        loaded.other_trajectories.push_back(std::move(recording.aircraft[i].trajectory));
        loaded.other_aircraft.emplace_back(aircraft_for_type(recording.aircraft[i].type).name);
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
