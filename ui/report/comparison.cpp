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

/// Names of what these differ in, in the order in which they have them.
std::vector<std::string> differing_names(std::span<const NamedValues> all) {
    std::vector<std::string> names;
    std::set<std::string_view> known;
    for (const NamedValues& one : all) {
        for (const auto& [name, value] : one) {
            const auto differs = [&name = name, &value = value](
                                     const NamedValues& each) { return value_of(each, name) != value; };
            if (known.insert(name).second && std::ranges::any_of(all, differs)) { names.push_back(name); }
        }
    }
    return names;
}

/// A value as a flight's name has it: of a hash the first eight digits.
std::string brief_value(const std::string& value) {
    const bool is_hash = value.size() == 16 && value.find_first_not_of("0123456789abcdef") == std::string::npos;
    return value.empty() ? "not set" : is_hash ? value.substr(0, 8) : value;
}

/// Adds to the names of flights that share one what of their scenes differs: ", zoom 2", ", x.toml 3f2a91c0"; a number
/// where that is not enough.
void tell_apart(std::vector<ComparedFlight>& flights, std::span<const NamedValues> scenes) {
    std::map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t i = 0; i < flights.size(); ++i) { by_name[flights[i].name].push_back(i); }
    for (const auto& [name, group] : by_name) {
        if (group.size() == 1) { continue; }
        std::vector<NamedValues> own;
        for (const std::size_t i : group) { own.push_back(scenes[i]); }
        const std::vector<std::string> differing = differing_names(own);
        std::map<std::string, int> counts;
        for (const std::size_t i : group) {
            for (const std::string& each : differing) {
                flights[i].name += fmt::format(", {} {}", each, brief_value(value_of(scenes[i], each)));
            }
            const int count = ++counts[flights[i].name];
            if (count > 1) { flights[i].name += fmt::format(" ({})", count); }
        }
    }
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

/// Indices of recordings by the time when they began; those of the same time as given.
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
    std::erase_if(both.runs,
        [&](std::size_t i) { return recordings[i].statistics.frames + recordings[i].flight.paused_frames() == 0; });
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
    std::vector<NamedValues> scenes;
    std::vector<std::vector<NamedValues>> drawings; // of the flights' variants
    std::map<NamedValues, std::size_t> known_flights;
    std::map<std::pair<std::size_t, NamedValues>, std::size_t> known_variants;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        NamedValues scene = scene_of(recordings[i], roles);
        const auto [flight, is_new_flight] = known_flights.emplace(scene, flights.size());
        if (is_new_flight) {
            scenes.push_back(std::move(scene));
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
    tell_apart(flights, scenes);
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
        if (row->frame != times.first_frame + std::ssize(times.frame_ms)) { break; } // rows are missing
        times.frame_ms.push_back(row->frame_ms);
        times.paused.push_back(row->paused);
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
    change.frames.old_runs = times[0].size();
    change.frames.new_runs = times[1].size();
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
            changes.back().flight = flight.name;
        }
    }
    adjust_for_number(changes);
    return changes;
}

void adjust_for_number(std::span<FlightChange> changes) {
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(changes, [](const FlightChange& each) { return each.frames.change.has_value(); }));
    std::vector<double> p_values;
    for (const FlightChange& each : changes) {
        if (each.frames.change) { p_values.push_back(each.frames.change->p_among(count)); }
    }
    const std::vector<double> adjusted = holm_adjusted(p_values);
    std::size_t next = 0;
    for (FlightChange& each : changes) { each.adjusted_p = each.frames.change ? adjusted[next++] : 1.0; }
}

bool FlightChange::is_changed() const { return frames.change && adjusted_p <= significance_level; }

namespace {

using OptionalNumber = std::optional<double>;

/// What an interval has; nothing where there is none.
OptionalNumber percent_where_told(const FlightChange& row, double share) {
    return row.frames.change ? OptionalNumber(100.0 * share) : std::nullopt;
}

} // namespace

std::span<const Column<FlightChange>> change_columns() {
    using F = FlightChange;
    static constexpr std::array pairing_names{"rounds", "frames", "figures"};
    static constexpr std::array columns{
        column<&F::flight>("flight", "flight"),
        column<&F::old_variant>("old", "old"),
        column<&F::new_variant>("new", "new"),
        column<[](const F& row) { return pairing_names[static_cast<std::size_t>(row.frames.pairing)]; }>("pairing",
            "compared by", 0,
            "rounds: frame by frame within rounds flown alternately; frames: frame by frame of flights in another "
            "order; figures: only the flights' median frame times, as the frames are not the same"),
        column<[](const F& row) { return row.frames.old_runs; }>("old_runs", "old runs"),
        column<[](const F& row) { return row.frames.new_runs; }>("new_runs", "new runs"),
        column<[](const F& row) { return row.frames.frames; }>(
            "frames", "frames", 0, "of each flight, without its warm-up: of the shortest where they differ"),
        with_sign(column<[](const F& row) { return row.frames.old_ms; }>(
            "old_ms", "old, ms", 3, "median over the runs of their mean frame time (figures: median frame time)")),
        with_sign(column<[](const F& row) { return row.frames.new_ms; }>("new_ms", "new, ms", 3, "as old_ms")),
        with_sign(column<[](const F& row) { return OptionalNumber(100.0 * row.frames.share()); }>("change_percent",
            "change, %", 2,
            "of the frame time, frame by frame, each frame with the weight of its usual time; none where a side has no "
            "frames")),
        with_sign(column<[](const F& row) { return percent_where_told(row, row.frames.low_share()); }>(
            "low_percent", "low, %", 2, "lower end of the 95 % interval")),
        with_sign(column<[](const F& row) { return percent_where_told(row, row.frames.high_share()); }>(
            "high_percent", "high, %", 2, "upper end of the 95 % interval")),
        with_sign(column<[](const F& row) {
            return row.frames.change ? OptionalNumber(row.frames.change->p) : std::nullopt;
        }>("p", "p", 4, "probability of such a change where there is none, by the same test as the interval")),
        with_sign(column<[](const F& row) {
            return row.frames.change ? OptionalNumber(row.adjusted_p) : std::nullopt;
        }>("adjusted_p", "adjusted p", 4,
            "p with all comparisons of the table counted (Holm); by Student's t where signed ranks of so few rounds "
            "cannot reach 0.05 among so many")),
        with_sign(column<[](const F& row) { return row.frames.mann_whitney_p; }>(
            "mann_whitney_p", "U's p", 4, "of Mann and Whitney's U of the runs' frame times")),
        column<&F::is_changed>("changed", "changed", 0, "adjusted_p is at most 0.05"),
        column<[](const F& row) {
            return row.frames.stage_changed ? stage_names[row.frames.stage_changed->stage] : std::string_view();
        }>("stage", "stage", 0, "of the frame that changed most; empty where none did for sure"),
        with_sign(column<[](const F& row) {
            return row.frames.stage_changed ? OptionalNumber(row.frames.stage_changed->change_ms) : std::nullopt;
        }>("stage_change_ms", "stage, ms", 3, "mean change of that stage in the changed frames, or in all")),
        column<[](const F& row) {
            return row.frames.frames_changed ? std::optional(row.frames.frames_changed->first_frame) : std::nullopt;
        }>("first_frame", "first frame", 0,
            "of the changed frames; none where the change is all over the flight or nowhere for sure"),
        column<[](const F& row) {
            return row.frames.frames_changed ? std::optional(row.frames.frames_changed->last_frame) : std::nullopt;
        }>("last_frame", "last frame", 0, "as first_frame"),
        with_sign(column<[](const F& row) {
            return row.frames.frames_changed ? OptionalNumber(row.frames.frames_changed->change_ms) : std::nullopt;
        }>("frames_change_ms", "frames, ms", 3, "mean change of the changed frames")),
        column<&F::same_states>("same_states", "same states", 0, "the state hashes of all runs are the same"),
        column<&F::same_pictures>("same_pictures", "same pictures", 0, "the picture hashes of all runs are the same"),
        column<[](const F& row) { return fmt::format("{}", fmt::join(row.flight_differences, ", ")); }>(
            "differences", "different flights", 0, "what makes the two different flights; empty for one flight"),
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

/// "between 23.0 % faster and 438.2 % slower": the interval of a change alone, whose mean would say more than is known.
std::string interval_text(const FrameChange& change) {
    const auto end = [](double share) {
        return fmt::format("{:.1f} % {}", 100.0 * std::abs(share), share < 0.0 ? "faster" : "slower");
    };
    return fmt::format("between {} and {}", end(change.low_share()), end(change.high_share()));
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
    const bool is_told = verdict_of_one(change, limit, resolution) != Verdict::CannotTell;
    if (change.is_changed()) {
        const std::string beyond =
            is_told ? "" : fmt::format("; cannot tell whether more than {:.2g} % slower", 100.0 * limit);
        return text + place_text(change.frames) + beyond;
    }
    return is_told ? "no change found: " + text : "cannot tell: " + interval_text(change.frames);
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
            const auto old_runs = std::ranges::count(both.sides, Side::Old);
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
                        fmt::format("{}: expected three runs or more of each variant, got {} and {}", name, old_runs,
                            std::ssize(both.sides) - old_runs));
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
