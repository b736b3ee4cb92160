#include "ui/report/comparison.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/report/frame_capture.h"
#include "ui/report/frame_csv.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <set>

namespace octant::ui::report {

namespace {

/// A file's name without its folder, which differs from machine to machine; any other text as it is.
std::string without_folder(const std::string& value) {
    return value.find('/') == std::string::npos ? value : std::filesystem::path(value).filename().string();
}

/// The role of a setting by its name in a recording: "terrain-lod.kind" has that of "terrain-lod".
SettingRole role_of(std::string_view name, SettingRoles roles) { return roles(name.substr(0, name.find('.'))); }

/// What of a recording makes another flight of it, by name.
NamedValues scene_of(const LoadedRecording& recording, SettingRoles roles) {
    NamedValues scene;
    for (const auto& [name, value] : recording.run.settings) {
        if (role_of(name, roles) == SettingRole::Scene && value != unset_value) {
            scene.emplace_back(name, without_folder(value));
        }
    }
    for (const auto& [file, hash] : recording.run.inputs) { scene.emplace_back(without_folder(file), hash); }
    if (!recording.capture_format.empty()) {
        scene.emplace_back(application_fact, value_of(recording.run.facts, application_fact));
    }
    scene.emplace_back(
        "processor", fmt::format("{}, {} cores", recording.run.machine_info.cpu, recording.run.machine_info.cores));
    std::ranges::sort(scene);
    return scene;
}

/// What makes another variant of a flight of a recording.
NamedValues drawing_of(const LoadedRecording& recording, SettingRoles roles) {
    NamedValues drawing;
    for (const auto& [name, value] : recording.run.settings) {
        if (role_of(name, roles) == SettingRole::Drawing) { drawing.emplace_back(name, without_folder(value)); }
    }
    drawing.emplace_back("device", recording.run.device);
    for (const char* const part : {"program.version", "program.commit", "program.hash"}) {
        drawing.emplace_back(part, value_of(recording.run.machine, part));
    }
    return drawing;
}

/// Names of what all these differ in, in their order.
std::vector<std::string> differing_names(std::span<const NamedValues> all) {
    std::vector<std::string> names;
    for (const auto& [name, value] : all.front()) {
        if (std::ranges::any_of(all, [&](const NamedValues& each) { return value_of(each, name) != value; })) {
            names.push_back(name);
        }
    }
    return names;
}

/// "order-method exact, samples 4; 1.0.0 (3f2a91c)".
std::string variant_name(const NamedValues& drawing, std::span<const std::string> names) {
    std::vector<std::string> parts;
    std::string program;
    for (const std::string& name : names) {
        const std::string value = value_of(drawing, name);
        if (!name.starts_with("program.")) {
            parts.push_back(fmt::format("{} {}", name, value == unset_value ? "not set" : value));
        } else if (name == "program.hash" && program.empty() && !value.empty()) {
            program = "build " + value.substr(0, 8);
        } else if (name != "program.hash" && !value.empty()) {
            program = fmt::format("{} ({})", value_of(drawing, "program.version"), value_of(drawing, "program.commit"));
        }
    }
    if (!program.empty()) { parts.push_back(program); }
    return parts.empty() ? "all the same" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string flight_title(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

/// Indices of recordings by the time when they began; those of the same second as given.
std::vector<std::size_t> in_time_order(Recordings recordings, std::vector<std::size_t> runs) {
    std::ranges::stable_sort(
        runs, {}, [&](std::size_t i) -> const std::string& { return recordings[i].run.machine_info.start_time_utc; });
    return runs;
}

/// The recordings of two variants in the order of time, and of which side each is.
struct TwoSides {
    std::vector<std::size_t> runs;
    std::vector<Side> sides;
};

TwoSides two_sides(Recordings recordings, const Variant& before, const Variant& after) {
    TwoSides both;
    both.runs = before.runs;
    both.runs.insert(both.runs.end(), after.runs.begin(), after.runs.end());
    std::erase_if(both.runs, [&](std::size_t i) { return recordings[i].statistics.frames == 0; });
    both.runs = in_time_order(recordings, std::move(both.runs));
    for (const std::size_t run : both.runs) {
        both.sides.push_back(std::ranges::count(before.runs, run) > 0 ? Side::Old : Side::New);
    }
    return both;
}

/// Whether all recordings have the same hash, where they have one.
bool have_same(Recordings recordings, std::span<const std::size_t> runs, std::string RunFile::*hash) {
    std::set<std::string> hashes;
    for (const std::size_t run : runs) { hashes.insert(recordings[run].run.*hash); }
    hashes.erase("");
    return hashes.size() <= 1;
}

const Statistic* statistic_of(std::string_view name) {
    const auto found = std::ranges::find_if(all_statistics(), [&](const Statistic& statistic) {
        return statistic.key == name || statistic.key == fmt::format("{}_ms", name);
    });
    return found == all_statistics().end() || !found->less_is_better || found->decimals == 0 ? nullptr : &*found;
}

/// Puts the variant that has the recording or the name `baseline` first in each flight that has it. Throws Error where
/// none has.
void move_baseline_first(Recordings recordings, std::vector<ComparedFlight>& flights, std::string_view baseline) {
    std::string name(baseline);
    for (const ComparedFlight& flight : flights) {
        for (const Variant& variant : flight.variants) {
            const bool has_recording = std::ranges::any_of(variant.runs, [&](std::size_t i) {
                return recordings[i].name == baseline || recordings[i].display_name == baseline;
            });
            if (has_recording) { name = variant.name; }
        }
    }
    bool is_found = false;
    for (ComparedFlight& flight : flights) {
        const auto found = std::ranges::find(flight.variants, name, &Variant::name);
        if (found == flight.variants.end()) { continue; }
        std::rotate(flight.variants.begin(), found, found + 1);
        is_found = true;
    }
    if (!is_found) {
        throw Error(fmt::format("--baseline: expected one of the recordings or the name of a variant such as '{}', "
                                "got '{}'",
            printable(flights.empty() ? "" : flights.front().variants.front().name), printable(name)));
    }
}

} // namespace

std::vector<std::string> flight_differences(
    const LoadedRecording& first, const LoadedRecording& second, SettingRoles roles) {
    const NamedValues one = scene_of(first, roles);
    const NamedValues other = scene_of(second, roles);
    std::set<std::string> names;
    const auto add_missing = [&](const NamedValues& from, const NamedValues& in) {
        for (const auto& row : from) {
            if (!std::ranges::binary_search(in, row)) { names.insert(row.first); }
        }
    };
    add_missing(one, other);
    add_missing(other, one);
    return {names.begin(), names.end()};
}

std::vector<ComparedFlight> compared_flights(Recordings recordings, SettingRoles roles, std::string_view baseline) {
    std::vector<ComparedFlight> flights;
    std::vector<std::vector<NamedValues>> drawings; // of the flights' variants
    std::map<NamedValues, std::size_t> known_flights;
    std::map<std::pair<std::size_t, NamedValues>, std::size_t> known_variants;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        const auto [flight, is_new_flight] = known_flights.emplace(scene_of(recordings[i], roles), flights.size());
        if (is_new_flight) {
            flights.push_back({flight_title(recordings[i]), {}});
            drawings.emplace_back();
        }
        auto& variants = flights[flight->second].variants;
        NamedValues drawing = drawing_of(recordings[i], roles);
        const auto [variant, is_new] = known_variants.emplace(std::pair(flight->second, drawing), variants.size());
        if (is_new) {
            variants.emplace_back();
            drawings[flight->second].push_back(std::move(drawing));
        }
        variants[variant->second].runs.push_back(i);
    }
    for (std::size_t f = 0; f < flights.size(); ++f) {
        auto& variants = flights[f].variants;
        const std::vector<std::string> names = differing_names(drawings[f]);
        for (std::size_t v = 0; v < variants.size(); ++v) { variants[v].name = variant_name(drawings[f][v], names); }
    }
    if (!baseline.empty()) { move_baseline_first(recordings, flights, baseline); }
    return flights;
}

FrameTimes read_frame_times(const LoadedRecording& recording) {
    FrameTimes times;
    if (!recording.capture_format.empty()) {
        for (const FrameTime& frame : read_frame_capture(recording.folder.path).frames) {
            times.frame_ms.push_back(frame.frame_ms);
        }
        return times;
    }
    FrameReader rows(recording.folder.path / "frames.csv");
    while (const auto row = rows.next()) {
        if (row->warm_up) { continue; }
        if (times.frame_ms.empty()) { times.first_frame = row->frame; }
        times.frame_ms.push_back(row->frame_ms);
        const std::array<double, stage_names.size()> stages_ms = stages_of(*row);
        for (std::size_t s = 0; s < stages_ms.size(); ++s) { times.stage_ms[s].push_back(stages_ms[s]); }
    }
    return times;
}

FlightChange flight_change(Recordings recordings, const Variant& before, const Variant& after, SettingRoles roles) {
    const LoadedRecording& first = recordings[before.runs.front()];
    FlightChange change;
    change.flight = flight_title(first);
    change.old_variant = before.name;
    change.new_variant = after.name;
    change.flight_differences = flight_differences(first, recordings[after.runs.front()], roles);
    const TwoSides both = two_sides(recordings, before, after);
    change.same_states = have_same(recordings, both.runs, &RunFile::state_hash);
    change.same_pictures = have_same(recordings, both.runs, &RunFile::picture_hash);
    std::array<std::vector<FrameTimes>, 2> times;
    for (std::size_t i = 0; i < both.runs.size(); ++i) {
        times[static_cast<std::size_t>(both.sides[i])].push_back(read_frame_times(recordings[both.runs[i]]));
    }
    if (times[0].empty() || times[1].empty()) { return change; }
    const bool are_own =
        std::ranges::all_of(both.runs, [&](std::size_t run) { return recordings[run].capture_format.empty(); });
    const bool same_frames = change.same_states && change.flight_differences.empty() && are_own;
    change.frames = frame_change(times[0], times[1], both.sides, same_frames);
    change.adjusted_p = change.frames.change ? change.frames.change->p : 1.0;
    return change;
}

std::vector<FlightChange> flight_changes(
    Recordings recordings, std::span<const ComparedFlight> flights, SettingRoles roles) {
    std::vector<FlightChange> changes;
    for (const ComparedFlight& flight : flights) {
        for (std::size_t v = 1; v < flight.variants.size(); ++v) {
            changes.push_back(flight_change(recordings, flight.variants.front(), flight.variants[v], roles));
        }
    }
    adjust_for_number(changes);
    return changes;
}

void adjust_for_number(std::span<FlightChange> changes) {
    std::vector<double> p_values;
    for (const FlightChange& each : changes) {
        if (each.frames.change) { p_values.push_back(each.frames.change->p); }
    }
    const std::vector<double> adjusted = holm_adjusted(p_values);
    std::size_t next = 0;
    for (FlightChange& each : changes) { each.adjusted_p = each.frames.change ? adjusted[next++] : 1.0; }
}

bool FlightChange::is_changed() const { return frames.change && adjusted_p <= significance_level; }

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr Column<FlightChange> number_column(std::string_view key, std::string_view name, int decimals,
    double (*value)(const FlightChange&), std::string_view definition, bool is_optional = false) {
    Column<FlightChange> column;
    column.key = key;
    column.name = name;
    column.decimals = decimals;
    column.definition = definition;
    column.is_optional = is_optional;
    column.is_signed = true;
    column.value = value;
    return column;
}

constexpr Column<FlightChange> whole_column(std::string_view key, std::string_view name,
    double (*value)(const FlightChange&), std::string_view definition, bool is_optional = false) {
    Column<FlightChange> column = number_column(key, name, 0, value, definition, is_optional);
    column.kind = ColumnKind::Whole;
    column.is_signed = false;
    return column;
}

constexpr Column<FlightChange> truth_column(
    std::string_view key, std::string_view name, double (*value)(const FlightChange&), std::string_view definition) {
    Column<FlightChange> column = whole_column(key, name, value, definition);
    column.kind = ColumnKind::Truth;
    return column;
}

constexpr Column<FlightChange> text_column(std::string_view key, std::string_view name,
    std::string (*text)(const FlightChange&), std::string_view definition) {
    Column<FlightChange> column;
    column.key = key;
    column.name = name;
    column.kind = ColumnKind::Text;
    column.definition = definition;
    column.text = text;
    return column;
}

double percent_or_none(const FlightChange& row, double share) { return row.frames.change ? 100.0 * share : none; }

} // namespace

std::span<const Column<FlightChange>> change_columns() {
    using F = FlightChange;
    static constexpr std::array pairing_names{"rounds", "frames", "figures"};
    static constexpr std::array columns{
        column<&F::flight>("flight", "flight"),
        column<&F::old_variant>("old", "old"),
        column<&F::new_variant>("new", "new"),
        text_column(
            "pairing", "compared by",
            [](const F& row) { return std::string(pairing_names[static_cast<std::size_t>(row.frames.pairing)]); },
            "rounds: frame by frame within rounds flown alternately; frames: frame by frame of flights in another "
            "order; figures: only the flights' median frame times, as the frames are not the same"),
        whole_column(
            "old_runs", "old runs", [](const F& row) { return static_cast<double>(row.frames.old_runs); }, ""),
        whole_column(
            "new_runs", "new runs", [](const F& row) { return static_cast<double>(row.frames.new_runs); }, ""),
        whole_column(
            "frames", "frames", [](const F& row) { return static_cast<double>(row.frames.frames); },
            "of each flight, without its warm-up"),
        number_column(
            "old_ms", "old, ms", 3, [](const F& row) { return row.frames.old_ms; },
            "median over the runs of their mean frame time (figures: median frame time)"),
        number_column(
            "new_ms", "new, ms", 3, [](const F& row) { return row.frames.new_ms; }, "as old_ms"),
        number_column(
            "change_percent", "change, %", 2, [](const F& row) { return 100.0 * row.frames.share(); },
            "of the frame time, frame by frame, each frame with the weight of its usual time"),
        number_column(
            "low_percent", "low, %", 2, [](const F& row) { return percent_or_none(row, row.frames.low_share()); },
            "lower end of the 95 % interval", true),
        number_column(
            "high_percent", "high, %", 2, [](const F& row) { return percent_or_none(row, row.frames.high_share()); },
            "upper end of the 95 % interval", true),
        number_column(
            "p", "p", 4, [](const F& row) { return row.frames.change ? row.frames.change->p : none; },
            "probability of such a change where there is none, by the same test as the interval", true),
        number_column(
            "adjusted_p", "adjusted p", 4, [](const F& row) { return row.frames.change ? row.adjusted_p : none; },
            "p with all comparisons of the table counted (Holm)", true),
        number_column(
            "mann_whitney_p", "U's p", 4, [](const F& row) { return row.frames.mann_whitney_p; },
            "of Mann and Whitney's U of the runs' frame times"),
        truth_column(
            "changed", "changed", [](const F& row) { return row.is_changed() ? 1.0 : 0.0; },
            "adjusted_p is at most 0.05"),
        text_column(
            "stage", "stage",
            [](const F& row) {
                return row.frames.stage_changed ? std::string(stage_names[row.frames.stage_changed->stage]) : "";
            },
            "of the frame that changed most; empty where none did for sure"),
        number_column(
            "stage_change_ms", "stage, ms", 3,
            [](const F& row) { return row.frames.stage_changed ? row.frames.stage_changed->change_ms : none; },
            "mean change of that stage in the changed frames, or in all", true),
        whole_column(
            "first_frame", "first frame",
            [](const F& row) { return row.frames.frames_changed ? row.frames.frames_changed->first_frame : none; },
            "of the changed frames; none where the change is all over the flight or nowhere for sure", true),
        whole_column(
            "last_frame", "last frame",
            [](const F& row) { return row.frames.frames_changed ? row.frames.frames_changed->last_frame : none; },
            "as first_frame", true),
        number_column(
            "frames_change_ms", "frames, ms", 3,
            [](const F& row) { return row.frames.frames_changed ? row.frames.frames_changed->change_ms : none; },
            "mean change of the changed frames", true),
        truth_column(
            "same_states", "same states", [](const F& row) { return row.same_states ? 1.0 : 0.0; },
            "the state hashes of all runs are the same"),
        truth_column(
            "same_pictures", "same pictures", [](const F& row) { return row.same_pictures ? 1.0 : 0.0; },
            "the picture hashes of all runs are the same"),
        text_column(
            "differences", "different flights",
            [](const F& row) { return fmt::format("{}", fmt::join(row.flight_differences, ", ")); },
            "what makes the two different flights; empty for one flight"),
    };
    return columns;
}

namespace {

Verdict verdict_of_one(const FlightChange& change, double limit, double resolution) {
    if (!change.frames.change) { return Verdict::CannotTell; }
    if (change.is_changed() && change.frames.low_share() > limit) { return Verdict::Slower; }
    return change.frames.high_share() <= limit + resolution ? Verdict::NotSlower : Verdict::CannotTell;
}

/// "3.1 % slower (2.4 to 3.9 %)".
std::string change_text(const FrameChange& change) {
    if (!change.change) {
        const std::string size =
            change.old_ms > 0.0 ? fmt::format(" ({:+.1f} % by the medians)", 100.0 * change.share()) : std::string();
        return fmt::format("cannot tell{}: expected three flights or more of each, got {} and {}", size,
            change.old_runs, change.new_runs);
    }
    const double share = change.share();
    const double sign = share < 0.0 ? -1.0 : 1.0;
    const double low = sign * (share < 0.0 ? change.high_share() : change.low_share());
    const double high = sign * (share < 0.0 ? change.low_share() : change.high_share());
    return fmt::format("{:.1f} % {} ({:.1f} to {:.1f} %)", 100.0 * std::abs(share), share < 0.0 ? "faster" : "slower",
        100.0 * low, 100.0 * high);
}

/// "; frames 210-260, plan stage +0.8 ms".
std::string place_text(const FrameChange& change) {
    std::vector<std::string> parts;
    if (change.frames_changed) {
        parts.push_back(
            fmt::format("frames {}-{}", change.frames_changed->first_frame, change.frames_changed->last_frame));
    }
    if (change.stage_changed) {
        parts.push_back(fmt::format(
            "{} stage {:+.2g} ms", stage_names[change.stage_changed->stage], change.stage_changed->change_ms));
    }
    return parts.empty() ? "" : fmt::format("; {}", fmt::join(parts, ", "));
}

std::string answer_of_one(const FlightChange& change, double limit, double resolution) {
    const std::string text = change_text(change.frames);
    if (!change.frames.change) { return text; }
    if (change.is_changed()) { return text + place_text(change.frames); }
    return verdict_of_one(change, limit, resolution) == Verdict::CannotTell ? "cannot tell: " + text
                                                                            : "no change found: " + text;
}

} // namespace

Verdict verdict_of(std::span<const FlightChange> changes, double limit, double resolution) {
    bool all_told = true;
    for (const FlightChange& change : changes) {
        const Verdict verdict = verdict_of_one(change, limit, resolution);
        if (verdict == Verdict::Slower) { return verdict; }
        all_told = all_told && verdict == Verdict::NotSlower;
    }
    return all_told ? Verdict::NotSlower : Verdict::CannotTell;
}

std::string answer_text(std::span<const FlightChange> changes, double limit, double resolution) {
    if (changes.empty()) { return "nothing is compared: no flight has two variants"; }
    if (changes.size() == 1) { return answer_of_one(changes.front(), limit, resolution); }
    const auto changed = std::ranges::count_if(changes, &FlightChange::is_changed);
    const auto untold = std::ranges::count_if(changes,
        [&](const FlightChange& each) { return verdict_of_one(each, limit, resolution) == Verdict::CannotTell; });
    double logarithms = 0.0;
    std::size_t counted = 0;
    for (const FlightChange& change : changes) {
        if (change.frames.change) {
            logarithms += change.frames.change->estimate;
            ++counted;
        }
    }
    std::string text = fmt::format("{} of {} variants changed", changed, changes.size());
    if (counted > 0) {
        text +=
            fmt::format(", geometric mean {:+.1f} %", 100.0 * std::expm1(logarithms / static_cast<double>(counted)));
    }
    return untold == 0 ? text : text + fmt::format("; {} cannot be told", untold);
}

Gate read_gate(const std::string& text) {
    Gate gate;
    for (const std::string_view part : split_fields(text, ',')) {
        const std::size_t equals = part.find('=');
        const bool whole = equals != std::string_view::npos && part.ends_with('%');
        const Statistic* const statistic = whole ? statistic_of(part.substr(0, equals)) : nullptr;
        const auto percent =
            statistic != nullptr ? finite_number(part.substr(equals + 1, part.size() - equals - 2)) : std::nullopt;
        if (!percent || *percent < 0.0) {
            throw Error(fmt::format("--gate: expected figures and what they may grow by, as in p50=5%,p99=10%, got "
                                    "'{}'",
                printable(text)));
        }
        gate.emplace_back(std::string(statistic->key), *percent / 100.0);
    }
    return gate;
}

GateResult gate_result(Recordings recordings, std::span<const ComparedFlight> flights, const Gate& gate) {
    GateResult result;
    const auto has_variants = [](const ComparedFlight& flight) { return flight.variants.size() > 1; };
    if (std::ranges::none_of(flights, has_variants)) {
        result.undecided.push_back(flights.size() == 1
                                       ? "all recordings are repeats of one variant of one flight by the same program"
                                       : "no two recordings are variants of one flight");
    }
    for (const ComparedFlight& flight : flights) {
        for (std::size_t v = 1; v < flight.variants.size(); ++v) {
            const TwoSides both = two_sides(recordings, flight.variants.front(), flight.variants[v]);
            for (const auto& [key, allowed] : gate) {
                const Statistic& statistic = *statistic_of(key);
                std::vector<Trial> trials;
                for (std::size_t i = 0; i < both.runs.size(); ++i) {
                    const double value = statistic.value(recordings[both.runs[i]].statistics);
                    trials.push_back({both.sides[i], std::log(std::max(value, 1e-6))});
                }
                const std::string name = fmt::format("{}, {}: {}", flight.name, flight.variants[v].name, key);
                const auto change = change_of(trials);
                if (!change) {
                    result.undecided.push_back(
                        fmt::format("{}: expected three runs or more of each variant, got {} and {}", name,
                            flight.variants.front().runs.size(), flight.variants[v].runs.size()));
                } else if (std::expm1(change->low) > allowed) {
                    result.failures.push_back(fmt::format("{} {:+.1f} % ({:+.1f} to {:+.1f} %), above {:+.1f} %", name,
                        100.0 * std::expm1(change->estimate), 100.0 * std::expm1(change->low),
                        100.0 * std::expm1(change->high), 100.0 * allowed));
                }
            }
        }
    }
    return result;
}

} // namespace octant::ui::report
