#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/commands/compare_inputs.h"
#include "ui/report/html_report.h"
#include "ui/settings/setting_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

namespace fs = std::filesystem;

struct CompareOptions : base::OutputOptions {
    std::array<fs::path, 2> sides; ///< old, new
    std::vector<std::string> settings;
    std::optional<fs::path> out;
    double limit = 0.0;
    sweep::RoundLimits rounds;
    int seed = 1;
};

/// What is told of one flight.
struct FlightComparison {
    report::FlightChange change;
    report::ComparedFlight runs;  ///< old and new variant
    report::NamedValues settings; ///< of the first old recording
    std::optional<double> turn_s;
    std::optional<double> seconds;
    std::optional<double> drift;
    std::array<fs::path, 2> pictures; ///< of a changed frame; empty without one
};

/// What is told of one side.
struct SideResult {
    std::string version;
    std::string commit;
    std::string program_hash;
};

/// What came of a comparison.
struct Comparison {
    std::vector<FlightComparison> flights;
    std::array<SideResult, 2> sides;
    std::vector<report::LoadedRecording> recordings;                            ///< for the page
    report::ResultTable without_pauses{.title = "Figures that contain pauses"}; ///< programs that do not record them
    std::string how; ///< the flights were flown, or "existing recordings"

    std::vector<report::FlightChange> changes() const {
        std::vector<report::FlightChange> changes;
        for (const FlightComparison& flight : flights) { changes.push_back(flight.change); }
        return changes;
    }

    std::vector<report::ComparedFlight> runs() const {
        std::vector<report::ComparedFlight> runs;
        for (const FlightComparison& flight : flights) { runs.push_back(flight.runs); }
        return runs;
    }
};

SideResult side_result(const report::LoadedRecording& recording) {
    const auto value = [&](std::string_view name) { return report::value_of(recording.run.machine, name); };
    return {value("program.version"), value("program.commit"), value("program.hash")};
}

/// Whether a folder has nothing in it but files that a comparison writes.
bool belongs_to_comparison(const fs::path& folder) {
    constexpr std::array names{"compare.csv", "compare.json", "compare.html"};
    std::error_code code;
    return std::ranges::all_of(fs::directory_iterator(folder, code), [&](const fs::directory_entry& entry) {
        const std::string name = entry.path().filename().string();
        return entry.is_directory() ? (path_exists(entry.path() / "old.json") || fs::is_empty(entry.path(), code)) &&
                                          std::ranges::all_of(fs::directory_iterator(entry.path(), code),
                                              [](const fs::directory_entry& part) {
                                                  const std::string own = part.path().filename().string();
                                                  return own.starts_with("old") || own.starts_with("new");
                                              })
                                    : std::ranges::find(names, name) != names.end();
    });
}

/// Whether a file or folder is the folder itself or lies in it.
bool is_in(const fs::path& folder, const fs::path& path) {
    std::error_code code;
    const fs::path way = fs::weakly_canonical(path, code).lexically_relative(fs::weakly_canonical(folder, code));
    return !way.empty() && *way.begin() != "..";
}

/// Makes the folder of a comparison, or empties that of an earlier one. Throws Error where what is compared lies in it.
void prepare_folder(const fs::path& folder, const CompareOptions& options) {
    std::vector<fs::path> inputs(options.sides.begin(), options.sides.end());
    inputs.insert(inputs.end(), options.settings.begin(), options.settings.end());
    for (const fs::path& input : inputs) {
        if (path_exists(folder) && is_in(folder, input)) {
            throw_error_in(folder, fmt::format("expected a folder without what is compared, got one with {}; --out "
                                               "names another",
                                       input.string()));
        }
    }
    if (path_exists(folder) && (!is_folder(folder) || !belongs_to_comparison(folder))) {
        throw_error_in(folder, "expected an empty folder or that of a comparison, got another; --out names one");
    }
    make_folder(folder);
    std::error_code code;
    const std::vector<fs::directory_entry> old_entries(fs::directory_iterator(folder, code), {});
    if (!old_entries.empty()) {
        base::print_note(options.quiet, fmt::format("note: {}: the comparison there is replaced", folder.string()));
    }
    for (const fs::directory_entry& entry : old_entries) { fs::remove_all(entry.path(), code); }
}

/// The two programs of the comparison, and the flights that they fly.
struct FlightPlan {
    std::array<sweep::ComparedProgram, 2> programs;
    std::vector<sweep::RoundFlight> flights;
};

FlightPlan flight_plan(const CompareOptions& options, ComparedKind kind) {
    FlightPlan plan;
    std::vector<std::string> notes;
    const fs::path own_program = fs::read_symlink("/proc/self/exe");
    const bool same_names = options.sides[0] == options.sides[1];
    for (std::size_t s = 0; s < plan.programs.size(); ++s) {
        const fs::path& side = options.sides[s];
        const std::string_view mark = !same_names ? "" : (s == 0 ? "old " : "new ");
        plan.programs[s] = {fmt::format("{}{}", mark, side.string()),
            kind == ComparedKind::Programs ? absolute_path(side).string() : own_program.string()};
    }
    if (kind == ComparedKind::Programs) {
        plan.flights = compared_flight_settings(options.settings, notes);
    } else {
        sweep::RoundFlight flight{"flight", {}};
        for (std::size_t s = 0; s < plan.programs.size(); ++s) {
            const std::string file = options.sides[s].string();
            flight.settings[s] = compared_flight_settings(std::span(&file, 1), notes).front().settings[s];
        }
        plan.flights.push_back(std::move(flight));
    }
    for (const std::string& note : notes) { base::print_note(options.quiet, "note: " + note); }
    for (const sweep::RoundFlight& flight : plan.flights) {
        if (flight.settings[0].path.name == settings::live_path) {
            throw Error("path: expected a path or a track, got 'live', which others fly");
        }
    }
    return plan;
}

/// Names a program that flew in turns and does not record when it was stopped, as earlier versions: some of its frames
/// contain turns of the other one.
void check_pauses(const sweep::ComparedProgram& program, const sweep::FlownRounds& flown, std::size_t side,
    report::ResultTable& without_pauses) {
    bool had_turns = false;
    int paused_frames = 0;
    for (std::size_t i = side; i < flown.recordings.size(); i += 2) {
        const report::LoadedRecording& recording = flown.recordings[i];
        const report::Statistics& statistics = recording.statistics;
        had_turns = had_turns || 1e-3 * statistics.mean_ms * statistics.frames > 3.0 * flown.turn_s.value_or(HUGE_VAL);
        paused_frames += recording.flight.paused_frames();
    }
    if (had_turns && paused_frames == 0) {
        without_pauses.add({{"program", program.name},
            {"what",
                "does not record when it is stopped: its means, percentiles from P90, longest frames, 1 % lows and "
                "overruns contain turns of the other program; the change does not"}});
    }
}

Comparison fly_comparison(const CompareOptions& options, ComparedKind kind, const fs::path& folder) {
    const FlightPlan plan = flight_plan(options, kind);
    prepare_folder(folder, options);
    const base::StopSignals stop_signals;
    RandomGenerator dice(static_cast<std::uint64_t>(options.seed));
    Comparison comparison;
    for (const sweep::RoundFlight& flight : plan.flights) {
        sweep::FlownRounds flown =
            sweep::fly_rounds(plan.programs, flight, folder / flight.name, options.rounds, dice, options.quiet);
        if (comparison.recordings.empty()) {
            for (std::size_t s = 0; s < 2; ++s) { comparison.sides[s] = side_result(flown.recordings[s]); }
        }
        for (std::size_t s = 0; s < 2 && comparison.without_pauses.rows.size() < 2; ++s) {
            check_pauses(plan.programs[s], flown, s, comparison.without_pauses);
        }
        comparison.how = flown.turn_s ? "in turns" : "alternately";
        FlightComparison result{std::move(flown.change), {flight.name, {}}, flown.recordings.front().run.settings,
            flown.turn_s, flown.seconds, flown.drift, {}};
        for (const sweep::ComparedProgram& program : plan.programs) {
            result.runs.variants.push_back({program.name, {}});
        }
        for (std::size_t i = 0; i < flown.recordings.size(); ++i) {
            result.runs.variants[i % 2].runs.push_back(comparison.recordings.size() + i);
        }
        if (const auto& frames = result.change.frames.frames_changed) {
            const int middle = frames->first_frame + (frames->last_frame - frames->first_frame) / 2;
            result.pictures = sweep::fly_to_frame(plan.programs, folder / flight.name, middle, dice);
        }
        comparison.flights.push_back(std::move(result));
        std::ranges::move(flown.recordings, std::back_inserter(comparison.recordings));
    }
    return comparison;
}

Comparison compare_recordings(const CompareOptions& options) {
    Comparison comparison;
    comparison.how = "existing recordings";
    std::vector<std::string> notes;
    comparison.recordings = load_side(options.sides[0], notes);
    const std::size_t old_count = comparison.recordings.size();
    std::ranges::move(load_side(options.sides[1], notes), std::back_inserter(comparison.recordings));
    for (const report::LoadedRecording& recording : comparison.recordings) {
        std::ranges::move(notes_on(recording), std::back_inserter(notes));
        if (!recording.disagreement.empty()) {
            notes.push_back(
                fmt::format("{}: rows and summary disagree: {}", recording.display_name, recording.disagreement));
        }
    }
    const MatchedFlights matched =
        matched_flights(comparison.recordings, old_count, {options.sides[0].string(), options.sides[1].string()});
    notes.insert(notes.end(), matched.notes.begin(), matched.notes.end());
    for (const std::string& note : notes) { base::print_note(options.quiet, "note: " + note); }
    if (matched.flights.empty()) {
        throw_error_in(options.sides[1],
            fmt::format("expected recordings of flights that {} has, got others", options.sides[0].string()));
    }
    comparison.sides = {side_result(comparison.recordings[matched.flights.front().before.runs.front()]),
        side_result(comparison.recordings[matched.flights.front().after.runs.front()])};
    for (const MatchedFlight& flight : matched.flights) {
        FlightComparison result;
        result.change =
            report::flight_change(comparison.recordings, flight.before, flight.after, &settings::comparison_role);
        result.change.flight = flight.name;
        result.runs = {flight.name, {flight.before, flight.after}};
        result.settings = comparison.recordings[flight.before.runs.front()].run.settings;
        comparison.flights.push_back(std::move(result));
    }
    return comparison;
}

/// What is to be said of the hashes of a flight.
std::string hash_text(const report::FlightChange& change) {
    if (!change.flight_differences.empty()) {
        return fmt::format("different flights: {}", fmt::join(change.flight_differences, ", "));
    }
    if (!change.same_states) { return "states differ: not the same flight"; }
    return change.same_pictures ? "states and pictures are the same" : "states are the same, pictures differ";
}

/// The columns for people.
report::ResultTable result_table(std::span<const report::FlightChange> changes) {
    constexpr std::array<std::string_view, 10> keys{"flight", "old_runs", "new_runs", "frames", "old_ms", "new_ms",
        "change_percent", "low_percent", "high_percent", "adjusted_p"};
    report::ResultTable table{.title = "Change of the frame time"};
    for (const report::FlightChange& change : changes) {
        std::vector<report::Cell> row;
        for (const auto& column : report::change_columns()) {
            if (std::ranges::find(keys, column.key) != keys.end()) {
                row.emplace_back(std::string(column.name), report::text_of(column, change));
            }
        }
        row.emplace_back("hashes", hash_text(change));
        table.add(std::move(row));
    }
    return table;
}

/// Links to the pictures of the changed frames; nothing where no frames are named.
std::vector<report::ResultTable> picture_tables(const Comparison& comparison, const fs::path& folder) {
    report::ResultTable table{.title = "Pictures of the changed frames"};
    for (const FlightComparison& flight : comparison.flights) {
        if (flight.pictures[0].empty()) { continue; }
        std::vector<report::Cell> row = {{"flight", flight.change.flight}};
        for (std::size_t s = 0; s < 2; ++s) {
            row.emplace_back(s == 0 ? "old" : "new", flight.pictures[s].filename().string());
            row.back().link = flight.pictures[s].lexically_relative(folder).string();
        }
        table.add(std::move(row));
    }
    return table.rows.empty() ? std::vector<report::ResultTable>() : std::vector{table};
}

std::string_view verdict_name(report::Verdict verdict) {
    constexpr std::array<std::string_view, 3> names{"not slower", "slower", "cannot tell"};
    return names[static_cast<std::size_t>(verdict)];
}

/// compare.json: what --json prints.
base::JsonValue json_of(const CompareOptions& options, const Comparison& comparison, report::Verdict verdict,
    const std::string& answer, const std::string& page) {
    const auto percent = [](const std::optional<double>& share) {
        return share ? base::JsonValue(100.0 * *share) : base::JsonValue();
    };
    base::JsonValue json = {{"answer", answer}, {"verdict", std::string(verdict_name(verdict))},
        {"limit_percent", 100.0 * options.limit}, {"within_percent", 100.0 * options.rounds.within},
        {"flown", comparison.how}, {"seed", options.seed},
        {"page", page.empty() ? base::JsonValue() : base::JsonValue(page)}};
    for (std::size_t s = 0; s < 2; ++s) {
        const SideResult& side = comparison.sides[s];
        json[s == 0 ? "old" : "new"] = {{"given", options.sides[s].string()}, {"version", side.version},
            {"commit", side.commit}, {"program_hash", side.program_hash}};
    }
    base::JsonValue flights = base::JsonValue::list({});
    for (const FlightComparison& flight : comparison.flights) {
        base::JsonValue row = report::json_of(report::change_columns(), flight.change);
        row["turn_ms"] = flight.turn_s ? base::JsonValue(1000.0 * *flight.turn_s) : base::JsonValue();
        row["seconds"] = flight.seconds;
        row["drift_percent"] = percent(flight.drift);
        base::JsonValue pictures = base::JsonValue::list({});
        for (const fs::path& picture : flight.pictures) {
            if (!picture.empty()) { pictures.push_back(picture.string()); }
        }
        row["pictures"] = std::move(pictures);
        base::JsonValue settings(std::initializer_list<std::pair<std::string, base::JsonValue>>{});
        for (const auto& [name, value] : flight.settings) { settings[name] = value; }
        row["settings"] = std::move(settings);
        flights.push_back(std::move(row));
    }
    json["flights"] = std::move(flights);
    return json;
}

void compare(const CompareOptions& options) {
    const ComparedKind kind = compared_kind(options.sides);
    const bool is_flown = kind != ComparedKind::Recordings;
    if (kind != ComparedKind::Programs && !options.settings.empty()) {
        throw Error("--settings: expected two programs beside it, got settings files or recordings");
    }
    const std::optional<fs::path> out = is_flown ? options.out.value_or("octant-compare") : options.out;
    const fs::path folder = out ? absolute_path(*out) : fs::path();
    if (out && !is_flown) { prepare_folder(folder, options); }
    Comparison comparison = is_flown ? fly_comparison(options, kind, folder) : compare_recordings(options);
    std::vector<report::FlightChange> changes = comparison.changes();
    report::adjust_for_number(changes);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        comparison.flights[i].change.adjusted_p = changes[i].adjusted_p;
    }
    const report::Verdict verdict = report::verdict_of(changes, options.limit, options.rounds.within);
    const std::string answer = report::answer_text(changes, options.limit, options.rounds.within);
    const std::string page = out ? (*out / "compare.html").string() : std::string();
    const base::JsonValue json = json_of(options, comparison, verdict, answer, page);
    if (out) {
        std::vector<report::ResultTable> tables = picture_tables(comparison, folder);
        if (!comparison.without_pauses.rows.empty()) { tables.push_back(comparison.without_pauses); }
        const std::vector<report::ComparedFlight> runs = comparison.runs();
        write_file(folder / "compare.csv", report::csv_rows(report::change_columns(), changes));
        write_file(folder / "compare.json", base::json_of_results(json));
        write_file(folder / "compare.html",
            report::html_report(comparison.recordings,
                {tables, folder, runs, changes, options.limit, options.rounds.within, &settings::comparison_role}));
    }
    if (options.json) {
        base::print_value(json, true);
    } else {
        std::fputs(fmt::format("{}\n\n{}", answer, report::text_of(result_table(changes))).c_str(), stdout);
    }
    if (out) {
        base::print_note(
            options.quiet, fmt::format("results: {0}/compare.json, compare.csv, {0}/compare.html", out->string()));
    }
    if (verdict == report::Verdict::Slower) { throw CheckFailed(); }
    if (verdict == report::Verdict::CannotTell) { throw CheckFailed{exit_cannot_tell}; }
}

/// An option that reads "2%" as 0.02.
Option percent_option(const std::string& name, const std::string& meaning, double& share) {
    return {.name = name,
        .form = "P%",
        .meaning = meaning,
        .read =
            [name, &share](const Words& words) {
                const std::string& word = words.front();
                const auto percent =
                    word.ends_with('%') ? finite_number(word.substr(0, word.size() - 1)) : std::nullopt;
                if (!percent || *percent < 0.0) {
                    throw Error(fmt::format(
                        "{}: expected a percentage of 0 or more, such as 2%, got '{}'", name, printable(word)));
                }
                share = *percent / 100.0;
            },
        .shown_default = fmt::format("{:.0f}%", 100.0 * share)};
}

std::vector<Option> options_of(CompareOptions& options) {
    constexpr const char* sides = "a program of octant, a settings file, a recording or a folder of recordings";
    return with_output_options(options,
        {required(text_option("old", "OLD", fmt::format("what is compared with: {}", sides), options.sides[0])),
            required(text_option("new", "NEW", "what is in question; of the same kind as OLD", options.sides[1])),
            list_option("--settings", "FILE",
                "a flight that both programs fly: settings file, run.json, or a sweep's FILE.toml for all its flights; "
                "repeatable [a turn over hills, 640x360, 200 frames]",
                Arity::Repeatable, options.settings),
            percent_option(
                "--within", "end when the 95 % interval of the change is this wide or less", options.rounds.within),
            percent_option("--limit", "slowdown that is allowed: up to it the exit code is 0", options.limit),
            value_option({"max-seconds", "S", "time for the rounds of a flight; three are flown in any case", 0.0, 1e6},
                options.rounds.max_seconds),
            value_option({"rounds", "N", "fly exactly this many rounds", 1, 1000}, options.rounds.rounds),
            value_option({"seed", "N", "random seed of the order of turns", 0, 1e9}, options.seed),
            with_shown_default("octant-compare where flights are flown, else nothing is written",
                text_option("--out", "DIR", "folder for recordings, compare.csv, compare.json and compare.html",
                    options.out))});
}

} // namespace

Command compare_command() {
    auto options = std::make_shared<CompareOptions>();
    return {.name = "compare",
        .summary = "Tells whether frames got slower between two programs, settings or sets of recordings",
        .options = options_of(*options),
        .footer = "Two programs fly the same flight, or this program flies two settings files, in rounds of one flight "
                  "each. Both fly at the same time in short turns, so that the speed of the machine is the same for "
                  "both. Recordings are compared as they are; three or more of each flight are needed on each side.\n"
                  "The first line is the answer, such as\n"
                  "  3.1 % slower (2.4 to 3.9 %); frames 210-260, plan stage +0.8 ms\n"
                  "In brackets is the 95 % interval. Frames and stage are those that changed for certain; pictures of "
                  "these frames are in the folder. compare.html shows all.\n"
                  "Exit code 0: no slowdown beyond --limit. 1: slower. 2: invalid input. 3: cannot tell: too few runs, "
                  "or an interval too wide for --within; more --max-seconds make it narrower.\n"
                  "Examples:\n"
                  "  octant compare old/octant new/octant --limit 1%\n"
                  "  octant compare old/octant new/octant --settings flight.json --within 1% --max-seconds 60\n"
                  "  octant compare exact.json paper.json --out order-methods\n"
                  "  octant compare before after --json",
        .run = [options] { compare(*options); }};
}

} // namespace octant::ui::commands
