#include "ui/world/path_loader.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/path_script.h"
#include "flightpaths/recorded_track.h"
#include "sim/aircraft_kind.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/report/zip_file.h"
#include "ui/settings/aircraft_entry.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

void append(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
}

constexpr std::size_t max_track_bytes = std::size_t{256} << 20U;

/// The bytes of a recorded track, or of the first one in a zip file.
std::string track_bytes(const fs::path& file) {
    std::string bytes = read_file(file, max_track_bytes);
    if (!bytes.starts_with("PK")) { return bytes; }
    constexpr std::array known{
        ".acmi", ".txt", ".kml", ".gpx", ".igc", ".csv", ".fdr", ".log", ".bin", ".tlog", ".ulg", ".json"};
    const std::vector<report::ZipEntry> entries = report::zip_entries(file);
    const auto track = std::ranges::find_if(entries, [&](const report::ZipEntry& entry) {
        return std::ranges::find(known, extension_of(entry.name)) != known.end();
    });
    if (track == entries.end() || track->bytes > max_track_bytes) {
        throw_error_in(file, "expected a recorded track of at most 256 MiB in it (.acmi, .kml, .gpx, ...), got none");
    }
    return report::zip_text(file, track->name, max_track_bytes);
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

/// Says which aircraft of several is the first one, and as what it is shown.
std::string note_of(const flightpaths::TrackRecording& recording, const std::string& shape) {
    const flightpaths::TrackedAircraft& first = recording.aircraft.front();
    const std::string_view type_name = aircraft_for_type(first.type).name;
    return fmt::format("{}{}{} is followed, as {}{}{}", printable(flightpaths::display_name(first, 0)),
        first.type.empty() ? "" : ", ", printable(first.type), printable(shape),
        first.type.empty() || shape == type_name ? "" : fmt::format("; --aircraft {} is of its type", type_name),
        recording.aircraft.size() > 1
            ? fmt::format("; {} others fly with it (--follow NAME)", recording.aircraft.size() - 1)
            : "");
}

LoadedPath from_recording(flightpaths::TrackRecording recording, const std::string& shape) {
    std::vector<flightpaths::TrackMotion> motions;
    for (const flightpaths::TrackedAircraft& aircraft : recording.aircraft) {
        motions.push_back(flightpaths::motion_of(aircraft));
    }
    const sim::AircraftKind* kind = sim::find_aircraft_kind(shape);
    LoadedPath loaded;
    loaded.trajectory = std::move(motions.front().trajectory);
    loaded.rate_hz = mean_rate_hz(loaded.trajectory);
    loaded.min_clearance_m = track_clearance_m;
    loaded.limits = kind == nullptr ? std::nullopt : std::optional(kind->limits);
    loaded.origin = recording.origin;
    loaded.notes = recording.notes;
    if (recording.aircraft.size() > 1 || !recording.aircraft.front().type.empty()) {
        loaded.notes.push_back(note_of(recording, shape));
    }
    append(loaded.notes, motions.front().notes);
    loaded.name = flightpaths::display_name(recording.aircraft.front(), 0);
    for (std::size_t i = 1; i < recording.aircraft.size(); ++i) {
        loaded.others.push_back({std::move(motions[i].trajectory), flightpaths::display_name(recording.aircraft[i], i),
            shape_for_type(recording.aircraft[i].type)});
    }
    for (flightpaths::TrackMotion& motion : motions) { loaded.inferences.push_back(std::move(motion.inference)); }
    loaded.recording = std::make_shared<const flightpaths::TrackRecording>(std::move(recording));
    return loaded;
}

} // namespace

flightpaths::TrackRecording load_recording(const fs::path& file, const std::string& follow) {
    return flightpaths::parse_track_recording(track_bytes(file), file, follow);
}

std::string shape_for_type(const std::string& type) { return std::string(aircraft_for_type(type).name); }

LoadedPath load_path(const std::string& path, const std::string& shape, bool lenient, const std::string& follow) {
    const fs::path file = base::path_file(path, shape);
    if (file.extension() != ".toml") { return from_recording(load_recording(file, follow), shape); }
    if (!follow.empty()) {
        throw Error(fmt::format("--follow: expected a recorded track, got {}", in_quotes(file.filename().string())));
    }
    const flightpaths::PathScript script = flightpaths::read_path_script(file);
    const sim::AircraftKind& kind = aircraft_kind_of_path(script);
    flightpaths::FlownPath flown = flightpaths::fly(script, kind, lenient);
    note_what_flies(path, shape, kind, flown.notes);
    LoadedPath loaded;
    loaded.trajectory = std::move(flown.trajectory);
    loaded.rate_hz = static_cast<double>(script.rate_hz);
    loaded.min_clearance_m = script.min_clearance_m;
    loaded.limits = kind.limits;
    loaded.legs = std::move(flown.legs);
    loaded.notes = std::move(flown.notes);
    return loaded;
}

namespace {

/// How much later than the first recording's clock another one's begins. Notes where one of them has no UTC.
double clock_offset_s(const LoadedPath& first, const LoadedPath& other, const std::string& file, double offset_s,
    std::vector<std::string>& notes) {
    const auto first_utc_s = first.recording ? first.recording->begin_utc_s : std::nullopt;
    const auto other_utc_s = other.recording->begin_utc_s;
    if (first_utc_s && other_utc_s) { return *other_utc_s - *first_utc_s + offset_s; }
    notes.push_back(fmt::format("{}: {} has no times in UTC, so it begins with the first aircraft (--offset SECONDS)",
        printable(file), first_utc_s ? "it" : "the flight's path"));
    return first.trajectory.start_s() - other.trajectory.start_s() + offset_s;
}

/// Adds the aircraft of another recording to a flight, in its axes and on its clock.
void add_track(const std::string& file, double offset_s, LoadedPath& loaded) {
    constexpr const char* any_shape = "f15";
    LoadedPath other = from_recording(load_recording(file), any_shape);
    if (!loaded.origin || !other.origin) {
        throw Error(fmt::format("--track: expected recordings with latitudes and longitudes, got none in {}",
            in_quotes(other.origin ? "the flight's path" : file)));
    }
    const double later_s = clock_offset_s(loaded, other, file, offset_s, loaded.notes);
    const TransverseMercator frame(*loaded.origin);
    const TransverseMercator own(*other.origin);
    const glm::dvec2 way_m = frame.local_from_geo(*other.origin);
    constexpr double furthest_m = 1e6;
    if (!(std::hypot(way_m.x, way_m.y) <= furthest_m)) {
        throw Error(fmt::format("--track: expected a recording within {:.0f} km of the first, got {:.0f} km: {}",
            furthest_m / 1000.0, std::hypot(way_m.x, way_m.y) / 1000.0, printable(file)));
    }
    const auto in_axes = [&](const sim::Trajectory& path) {
        std::vector<sim::AircraftState> samples;
        const sim::Trajectory turned = flightpaths::reprojected(path, own, frame);
        for (sim::AircraftState state : turned.samples()) {
            state.position_m += glm::dvec3(way_m, 0.0);
            state.time_s += later_s;
            samples.push_back(state);
        }
        return sim::Trajectory(std::move(samples));
    };
    append(loaded.notes, other.recording->notes);
    const std::string stem = fs::path(file).stem().string();
    const auto named = [&](const std::string& name) { return name == "aircraft 1" ? stem : name; };
    loaded.others.push_back(
        {in_axes(other.trajectory), named(other.name), shape_for_type(other.recording->aircraft.front().type)});
    for (OtherAircraft& aircraft : other.others) {
        loaded.others.push_back({in_axes(aircraft.trajectory), aircraft.name, aircraft.shape});
    }
    const sim::Trajectory& added = loaded.others[loaded.others.size() - 1 - other.others.size()].trajectory;
    if (added.end_s() < loaded.trajectory.start_s() || added.start_s() > loaded.trajectory.end_s()) {
        loaded.notes.push_back(
            fmt::format("{}: flown {:.0f} s {} the first aircraft's flight: not seen with it", printable(file),
                std::max(loaded.trajectory.start_s() - added.end_s(), added.start_s() - loaded.trajectory.end_s()),
                added.end_s() < loaded.trajectory.start_s() ? "before" : "after"));
    }
}

} // namespace

LoadedPath load_paths(const settings::RunSettings& settings) {
    const settings::PathSettings& path = settings.path;
    LoadedPath loaded = load_path(
        path_of(settings), settings::aircraft_shape(path.aircraft.front()), path.lenient, path.follow.value_or(""));
    for (const std::string& file : path.tracks) {
        add_track(file, path.track_offset_s, loaded);
        if (loaded.others.size() >= flightpaths::max_recorded_aircraft) {
            throw Error(
                fmt::format("--track: expected at most {} aircraft, got more", flightpaths::max_recorded_aircraft));
        }
    }
    return loaded;
}

} // namespace octant::ui::world
