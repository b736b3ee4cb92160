#include "ui/commands/compare_inputs.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/report/frame_capture.h"
#include "ui/report/run_file.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_check.h"
#include "ui/settings/settings_file.h"
#include "ui/sweep/sweep_file.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <unistd.h>
#include <utility>

namespace octant::ui::commands {

namespace {

namespace fs = std::filesystem;
using Indices = std::vector<std::size_t>;

/// Why a file holds no frame times that another program recorded; empty where it holds them.
std::string capture_fault(const fs::path& file) {
    try {
        report::read_frame_capture(file);
        return {};
    } catch (const Error& fault) { return fault.what(); }
}

bool may_be_capture(const fs::path& path) {
    const std::string ending = extension_of(path);
    return is_file(path) && (ending == ".csv" || ending == ".json");
}

bool is_recording(const fs::path& path) {
    return is_folder(path) ? report::is_run_file(path / "run.json")
                           : is_file(path) && (extension_of(path) == ".zip" ||
                                                  (may_be_capture(path) && capture_fault(path).empty()));
}

/// The recordings in a folder, in the order of their names. Where there are captures, notes name other tables.
std::vector<fs::path> recordings_in(const fs::path& folder, std::vector<std::string>& notes) {
    std::vector<fs::path> found;
    std::vector<fs::path> others;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code)) {
        if (is_recording(entry.path())) {
            found.push_back(entry.path());
        } else if (may_be_capture(entry.path())) {
            others.push_back(entry.path());
        }
    }
    std::ranges::sort(found);
    std::ranges::sort(others);
    for (const fs::path& other : others) {
        if (std::ranges::any_of(found, may_be_capture)) {
            notes.push_back(fmt::format("left out: {}", capture_fault(other)));
        }
    }
    return found;
}

ComparedKind kind_of(const fs::path& side) {
    const bool is_table = is_file(side) && extension_of(side) == ".csv"; // a damaged one is refused when it is read
    if (is_folder(side) || is_table || is_recording(side)) { return ComparedKind::Recordings; }
    char first = '\0';
    if (is_file(side)) { open_file(side) >> first; }
    if (first == '{') { return ComparedKind::Settings; }
    if (is_file(side) && ::access(side.c_str(), X_OK) == 0) { return ComparedKind::Programs; }
    throw_error_in(side, fmt::format("expected a program, a settings file, a recording or a folder of recordings, {}",
                             path_exists(side) ? "got none of them" : "found none"));
}

/// "turn-f15" of "turn-f15-r2", a repeat.
std::string without_repeat(const std::string& name) {
    const std::size_t at = name.rfind("-r");
    return at != std::string::npos && at > 0 && whole_number(name.substr(at + 2)) ? name.substr(0, at) : name;
}

/// The settings of a recording that say how the flight is drawn.
report::NamedValues drawing_settings(const report::LoadedRecording& recording) {
    report::NamedValues drawing;
    for (const auto& row : recording.run.settings) {
        if (report::role_of(row.first, &settings::comparison_role) == report::SettingRole::Drawing) {
            drawing.push_back(row);
        }
    }
    return drawing;
}

} // namespace

ComparedKind compared_kind(const std::array<fs::path, 2>& sides) {
    constexpr std::array names{"a program", "a settings file", "recordings"};
    const ComparedKind before = kind_of(sides[0]);
    const ComparedKind after = kind_of(sides[1]);
    if (before != after) {
        throw_error_in(sides[1], fmt::format("expected {} as {} is, got {}", names[static_cast<std::size_t>(before)],
                                     sides[0].string(), names[static_cast<std::size_t>(after)]));
    }
    return before;
}

std::vector<report::LoadedRecording> load_side(const fs::path& side, std::vector<std::string>& notes) {
    std::vector<fs::path> places = is_file(side) || is_recording(side) ? std::vector{side} : recordings_in(side, notes);
    if (places.empty()) { places = recordings_in(side / "runs", notes); }
    if (places.empty()) { throw_error_in(side, "expected a recording or a folder of recordings, found none in it"); }
    return report::load_recordings(places);
}

std::vector<std::string> notes_on(const report::LoadedRecording& recording) {
    std::vector<std::string> notes;
    const std::string name = printable(recording.display_name);
    for (const auto& [fact, value] : recording.run.facts) {
        if (!recording.capture_format.empty() && fact == "note") {
            notes.push_back(fmt::format("{}: {}", name, value));
        }
    }
    if (recording.ended_early || !recording.run.stopped.empty()) {
        notes.push_back(fmt::format("{} ended early, after {} frames", name, recording.flight.frames()));
    }
    return notes;
}

namespace {

/// The programs that recorded these runs, a short name each.
std::set<std::string> programs_of(report::Recordings recordings, const Indices& runs) {
    std::set<std::string> programs;
    for (const std::size_t i : runs) {
        const report::NamedValues& machine = recordings[i].run.machine;
        programs.insert(fmt::format("{} ({}, file {})", report::value_of(machine, "program.version"),
            report::value_of(machine, "program.commit"), report::value_of(machine, "program.hash").substr(0, 8)));
    }
    return programs;
}

/// Adds to names that several flights have the name of their first recording.
void tell_apart(report::Recordings recordings, std::vector<MatchedFlight>& flights) {
    std::map<std::string, int> counts;
    for (const MatchedFlight& flight : flights) { ++counts[flight.name]; }
    for (MatchedFlight& flight : flights) {
        if (counts[flight.name] > 1) {
            flight.name += fmt::format(" ({})", recordings[flight.before.runs.front()].display_name);
        }
    }
}

/// Adds notes of sides whose runs of a flight several programs recorded.
void add_program_notes(report::Recordings recordings, MatchedFlights& matched) {
    for (const MatchedFlight& flight : matched.flights) {
        for (const report::Variant& side : {flight.before, flight.after}) {
            const std::set<std::string> programs = programs_of(recordings, side.runs);
            if (programs.size() > 1) {
                matched.notes.push_back(fmt::format("{}: {} has flights of several programs, taken together: {}",
                    flight.name, side.name, fmt::join(programs, ", ")));
            }
        }
    }
}

} // namespace

MatchedFlights matched_flights(
    report::Recordings recordings, std::size_t old_count, const std::array<std::string, 2>& names) {
    using Sides = std::array<Indices, 2>;
    MatchedFlights matched;
    const auto match = [&](const Sides& runs) {
        const report::LoadedRecording& first = recordings[runs[0].front()];
        const std::string name = old_count > 1 ? without_repeat(first.name) : first.run.title;
        matched.flights.push_back({name, {names[0], runs[0]}, {names[1], runs[1]}});
    };
    std::array<std::vector<Indices>, 2> left; // variants that only one side has
    for (const report::ComparedFlight& flight : report::compared_flights(recordings, &settings::comparison_role)) {
        std::map<report::NamedValues, Sides> by_drawing;
        for (const report::Variant& variant : flight.variants) {
            for (const std::size_t i : variant.runs) {
                by_drawing[drawing_settings(recordings[i])][i < old_count ? 0 : 1].push_back(i);
            }
        }
        std::array<std::vector<Indices>, 2> single;
        for (const auto& [drawing, runs] : by_drawing) {
            if (!runs[0].empty() && !runs[1].empty()) {
                match(runs);
            } else {
                single[runs[0].empty() ? 1 : 0].push_back(runs[runs[0].empty() ? 1 : 0]);
            }
        }
        if (single[0].size() == 1 && single[1].size() == 1) {
            match({single[0][0], single[1][0]});
        } else {
            for (std::size_t s = 0; s < left.size(); ++s) {
                left[s].insert(left[s].end(), single[s].begin(), single[s].end());
            }
        }
    }
    if (matched.flights.empty() && left[0].size() == 1 && left[1].size() == 1) {
        match({left[0][0], left[1][0]});
        left = {};
    }
    std::ranges::sort(matched.flights, {}, [](const MatchedFlight& flight) { return flight.before.runs.front(); });
    tell_apart(recordings, matched.flights);
    for (const auto& side : left) {
        for (const Indices& runs : side) {
            matched.notes.push_back(
                fmt::format("{}: the other side has no flight like it", recordings[runs.front()].display_name));
        }
    }
    add_program_notes(recordings, matched);
    return matched;
}

std::vector<sweep::RoundFlight> compared_flight_settings(
    std::span<const std::string> files, std::vector<std::string>& notes) {
    std::vector<sweep::RoundFlight> flights;
    std::set<std::string> names;
    const auto add = [&](const std::string& wanted, const settings::RunSettings& given) {
        std::string name = wanted;
        for (int i = 2; !names.insert(name).second; ++i) { name = fmt::format("{}-{}", wanted, i); }
        const settings::RunSettings flown = world::with_absolute_paths(given);
        flights.push_back({name, {flown, flown}});
    };
    for (const std::string& file : files) {
        if (extension_of(file) == ".toml") {
            const sweep::Sweep sweep = sweep::read_sweep(file);
            notes.insert(notes.end(), sweep.notes.begin(), sweep.notes.end());
            for (const sweep::SweepRun& run : sweep.runs) {
                if (run.repeat == 1) { add(without_repeat(run.name), run.settings); }
            }
        } else {
            const settings::RunSettings given = settings::read_settings(file, &notes);
            settings::check_settings(given);
            const fs::path place = absolute_path(file);
            const bool is_run = place.filename() == "run.json" && place.has_parent_path();
            add((is_run ? place.parent_path() : place).stem().string(), given);
        }
    }
    if (files.empty()) {
        settings::RunSettings standard;
        standard.path.name = "turn";
        standard.view.size_px = {640, 360};
        standard.time.frames = 200;
        add("standard", standard);
    }
    return flights;
}

} // namespace octant::ui::commands
