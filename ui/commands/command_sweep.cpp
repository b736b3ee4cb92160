#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/setting_rows.h"
#include "ui/sweep/engine.h"
#include "ui/sweep/paper.h"
#include "ui/sweep/split_flight.h"
#include "ui/sweep/sweep_file.h"
#include "ui/sweep/sweep_folder.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
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

/// What a sweep is asked for.
struct SweepOptions : base::OutputOptions {
    std::filesystem::path file;
    std::optional<std::filesystem::path> out;
    std::string on = "local";
    sweep::EngineOptions engine;
    std::optional<int> jobs;
    std::optional<int> tasks;
    std::optional<int> split;
    std::optional<std::filesystem::path> hosts;
    std::optional<std::filesystem::path> program;
    std::optional<int> minutes;
    int retries = 1;
    bool list = false;
    bool paper = false;
};

/// What came of a sweep's runs, and how they shared machines.
struct SweepResults {
    std::vector<sweep::RunResult> results;
    std::string machine_sharing;
};

namespace fs = std::filesystem;

/// Numbers of the runs that are not done.
std::vector<std::size_t> unfinished_runs(const std::vector<sweep::RunResult>& results) {
    std::vector<std::size_t> runs;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (!results[i].done()) { runs.push_back(i); }
    }
    return runs;
}

std::size_t count_of(const std::vector<sweep::RunResult>& results, sweep::RunState state) {
    return static_cast<std::size_t>(std::ranges::count(results, state, &sweep::RunResult::state));
}

std::unique_ptr<sweep::Engine> engine_of(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    sweep::EngineOptions engine = options.engine;
    engine.quiet = options.quiet;
    engine.jobs = options.jobs.value_or(0);
    engine.tasks = options.tasks.value_or(0);
    engine.minutes = options.minutes.value_or(engine.minutes);
    engine.program = options.program ? options.program->string() : fs::read_symlink("/proc/self/exe").string();
    if (options.hosts) { engine.hosts = fs::absolute(*options.hosts); }
    if (options.on == "slurm") { return sweep::slurm_engine(sweep, folder, engine); }
    return options.on == "parallel" ? sweep::parallel_engine(sweep, folder, engine)
                                    : sweep::local_engine(sweep, folder, engine);
}

std::vector<sweep::RunResult> results_of(
    const sweep::Sweep& sweep, const sweep::SweepFolder& folder, bool with_videos) {
    std::vector<sweep::RunResult> results;
    for (const sweep::SweepRun& run : sweep.runs) { results.push_back(sweep::result_of(folder, run, with_videos)); }
    return results;
}

/// Has flown what is not done yet, and tries again what failed. What came of all runs.
std::vector<sweep::RunResult> fly_all(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder, sweep::Engine& engine) {
    const bool quiet = options.quiet;
    std::vector<sweep::RunResult> results = results_of(sweep, folder, options.engine.videos);
    const std::size_t done_before = results.size() - unfinished_runs(results).size();
    if (done_before > 0) { base::print_note(quiet, fmt::format("flights that are done already: {}", done_before)); }
    for (const std::size_t run : unfinished_runs(results)) {
        results[run].state = sweep::RunState::NotBegun;
        results[run].fault.clear();
    }
    folder.remove_logs(sweep, unfinished_runs(results));
    for (int attempt = 0; attempt <= options.retries && !base::StopSignals::received(); ++attempt) {
        const std::vector<std::size_t> left = unfinished_runs(results);
        if (left.empty()) { break; }
        if (attempt > 0) {
            base::print_note(quiet, fmt::format("note: flights that failed and are tried again: {}", left.size()));
        }
        engine.fly(left);
        results = results_of(sweep, folder, options.engine.videos);
    }
    return results;
}

/// Sets state and fault of a flight of which not all parts are done: those of a part that failed, else of one that was
/// stopped. A flight of which only some parts have begun counts as stopped. False where all parts are done.
bool set_fault_of_parts(std::span<const sweep::RunResult> parts, sweep::RunResult& flight) {
    using sweep::RunState;
    const auto first = [&](RunState state) { return std::ranges::find(parts, state, &sweep::RunResult::state); };
    auto part = first(RunState::Failed);
    if (part == parts.end()) { part = first(RunState::Stopped); }
    if (part == parts.end()) { part = first(RunState::NotBegun); }
    if (part == parts.end()) { return false; }
    flight.state = part->state;
    if (std::ranges::count(parts, RunState::NotBegun, &sweep::RunResult::state) == std::ssize(parts)) { return true; }
    if (part->state == RunState::NotBegun) { flight.state = RunState::Stopped; }
    flight.fault = fmt::format("{}: {}", part->name, part->fault.empty() ? text_of(part->state) : part->fault);
    return true;
}

/// Flies the parts of what is not done yet and puts them together; gives what came of the whole flights.
SweepResults fly_in_parts(const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    const auto count = static_cast<std::size_t>(*options.split);
    const bool videos = options.engine.videos;
    std::vector<sweep::RunResult> results = results_of(sweep, folder, videos);
    sweep::Sweep to_fly{sweep.name, {}};
    for (const std::size_t run : unfinished_runs(results)) { to_fly.runs.push_back(sweep.runs[run]); }
    if (to_fly.runs.empty()) { return {std::move(results), fmt::format("each in {} parts", *options.split)}; }
    const sweep::Sweep parts = sweep::split_sweep(to_fly, *options.split, videos);
    const sweep::SweepFolder part_folder(folder.path() / "parts");
    part_folder.prepare(parts);
    SweepOptions of_parts = options;
    of_parts.engine.videos = false;
    const std::unique_ptr<sweep::Engine> engine = engine_of(of_parts, parts, part_folder);
    const auto part_results = fly_all(of_parts, parts, part_folder, *engine);
    for (std::size_t i = 0; i < to_fly.runs.size(); ++i) {
        const sweep::SweepRun& whole = to_fly.runs[i];
        const auto own = std::span(part_results).subspan(i * count, count);
        auto& result = *std::ranges::find(results, whole.name, &sweep::RunResult::name);
        if (set_fault_of_parts(own, result)) { continue; }
        std::vector<fs::path> recordings;
        for (const sweep::RunResult& part : own) { recordings.push_back(part_folder.recording(part.name)); }
        try {
            sweep::merge_parts(whole, folder.recording(whole.name), recordings,
                videos ? std::optional(folder.video(whole.name)) : std::nullopt);
        } catch (const Error& fault) {
            result.state = sweep::RunState::Failed;
            result.fault = fault.what();
            continue;
        }
        result = sweep::result_of(folder, whole, videos);
        for (const fs::path& part : recordings) {
            std::error_code ignored;
            fs::remove_all(part, ignored);
        }
    }
    return {std::move(results), fmt::format("each in {} parts, {}", *options.split, engine->machine_sharing())};
}

/// Has an engine fly what is not done yet, in parts where that is asked for, and tries again what failed. Throws Error
/// when the engine itself fails.
SweepResults fly_unfinished_runs(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    if (options.split) { return fly_in_parts(options, sweep, folder); }
    const std::unique_ptr<sweep::Engine> engine = engine_of(options, sweep, folder);
    std::vector<sweep::RunResult> results = fly_all(options, sweep, folder, *engine);
    return {std::move(results), engine->machine_sharing()};
}

void print_list(const sweep::Sweep& sweep, bool json) {
    if (json) {
        base::JsonValue runs = base::JsonValue::list({});
        for (const sweep::SweepRun& run : sweep.runs) {
            base::JsonValue varied;
            for (const auto& [name, value] : run.varied) { varied[name] = value; }
            runs.push_back({{"name", run.name}, {"repeat", run.repeat}, {"varied", varied}});
        }
        base::print_value({{"name", sweep.name}, {"runs", runs}}, true);
        return;
    }
    for (const sweep::SweepRun& run : sweep.runs) { std::fputs((run.name + "\n").c_str(), stdout); }
}

/// What the report says before its flights: those that are not done, and runs that differ though they must not.
std::vector<report::ResultTable> problem_table(
    const std::vector<sweep::RunResult>& results, const std::vector<std::string>& hash_mismatches) {
    std::vector<report::ResultTable> tables;
    if (const auto missing = unfinished_runs(results); !missing.empty()) {
        tables.push_back({.title = "Flights that are not done", .note = "The same command flies them."});
        for (const std::size_t i : missing) {
            if (results[i].state != sweep::RunState::NotBegun) {
                tables.back().add({{"flight", results[i].name}, {"why", results[i].fault}});
            }
        }
        if (const auto count = count_of(results, sweep::RunState::NotBegun); count > 0) {
            tables.back().add({{"flight", fmt::format("{} flights", count)}, {"why", "not begun"}});
        }
    }
    if (!hash_mismatches.empty()) {
        tables.push_back({.title = "Runs that differ in nothing did not show the same"});
        for (const std::string& line : hash_mismatches) { tables.back().add({{"what", line}}); }
    }
    return tables;
}

void write_results(const sweep::Sweep& sweep, const sweep::SweepFolder& folder,
    const std::vector<sweep::RunResult>& results, const std::vector<std::string>& hash_mismatches) {
    write_file(folder.path() / "sweep.csv", sweep::sweep_csv(folder, sweep, results));
    std::vector<std::filesystem::path> done;
    for (const sweep::RunResult& result : results) {
        if (result.done()) { done.push_back(folder.recording(result.name)); }
    }
    const std::vector<report::ResultTable> problems = problem_table(results, hash_mismatches);
    const std::vector<report::LoadedRecording> recordings = report::load_recordings(done);
    const auto flights = report::compared_flights(recordings, &settings::comparison_role);
    const auto changes = report::flight_changes(recordings, flights, &settings::comparison_role);
    write_file(
        folder.path() / "report.html", report::html_report(recordings, {.first_tables = problems,
                                                                           .folder = folder.path(),
                                                                           .flights = flights,
                                                                           .changes = changes,
                                                                           .roles = &settings::comparison_role}));
}

void print_end(const sweep::Sweep& sweep, const std::vector<sweep::RunResult>& results,
    const std::vector<std::string>& hash_mismatches, const std::string& machine_sharing, bool json) {
    using sweep::RunState;
    const std::size_t done = count_of(results, RunState::Flown);
    if (json) {
        base::print_value(
            {{"name", sweep.name}, {"flown", machine_sharing}, {"done", done}, {"of", results.size()},
                {"failed", count_of(results, RunState::Failed)}, {"stopped", count_of(results, RunState::Stopped)},
                {"not_begun", count_of(results, RunState::NotBegun)}, {"differences", hash_mismatches},
                {"runs", report::json_rows(sweep::result_columns(), results)}},
            true);
        return;
    }
    std::string counts; // " (2 failed, 9001 not begun)"
    for (const RunState state : {RunState::Failed, RunState::Stopped, RunState::NotBegun}) {
        if (const auto count = count_of(results, state); count > 0) {
            counts += fmt::format("{}{} {}", counts.empty() ? " (" : ", ", count, text_of(state));
        }
    }
    counts += counts.empty() ? "" : ")";
    std::fputs(
        fmt::format("{} of {} flights done{}, {}\n", done, results.size(), counts, machine_sharing).c_str(), stdout);
    for (const sweep::RunResult& result : results) {
        if (!result.done() && result.state != RunState::NotBegun) {
            std::fputs(fmt::format("{}: {}: {}\n", text_of(result.state), result.name, result.fault).c_str(), stdout);
        }
    }
    for (const std::string& line : hash_mismatches) { std::fputs((line + "\n").c_str(), stdout); }
}

/// Throws Error for an option that the engine asked for does not have.
void check_engine(const SweepOptions& options) {
    const auto refuse = [&](std::string_view option, std::string_view engines) {
        throw Error(fmt::format("{}: expected --on {} beside it, got {}", option, engines, options.on));
    };
    const bool slurm = options.on == "slurm";
    if (options.tasks && !slurm) { refuse("--batch tasks", "slurm"); }
    if (!options.engine.sbatch_options.empty() && !slurm) { refuse("--sbatch", "slurm"); }
    if (options.hosts && options.on != "parallel") { refuse("--batch hosts", "parallel"); }
    if (options.minutes && options.on == "local") { refuse("--batch minutes", "slurm or parallel"); }
}

void run_sweep(const SweepOptions& options) {
    check_engine(options);
    const sweep::Sweep sweep = sweep::read_sweep(options.file);
    for (const std::string& note : sweep.notes) { base::print_note(options.quiet, "note: " + note); }
    if (options.list) {
        print_list(sweep, options.json);
        return;
    }
    if (options.split) { // before anything is written
        sweep::split_sweep(sweep, *options.split, options.engine.videos);
    }
    // Flown in another order than the file's, which all results have.
    const std::vector<std::size_t> order = sweep::flying_order(sweep);
    sweep::Sweep to_fly{sweep.name, {}};
    for (const std::size_t run : order) { to_fly.runs.push_back(sweep.runs[run]); }
    const sweep::SweepFolder folder(fs::absolute(options.out.value_or(sweep.name)).lexically_normal());
    folder.prepare(to_fly);
    if (options.engine.videos) {
        make_folder(folder.path() / "videos");
        report::check_video(folder.video(sweep.runs.front().name));
    }
    const base::StopSignals stop_signals;
    const SweepResults flown = fly_unfinished_runs(options, to_fly, folder);
    std::vector<sweep::RunResult> results(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) { results[order[i]] = flown.results[i]; }
    const std::vector<std::string> hash_mismatches = sweep::hash_mismatches(sweep, results);
    write_results(sweep, folder, results, hash_mismatches);
    if (options.paper) {
        for (const std::string& note : sweep::write_paper(options.file, sweep, folder, results)) {
            base::print_note(options.quiet, note);
        }
    }
    print_end(sweep, results, hash_mismatches, flown.machine_sharing, options.json);
    base::print_note(options.quiet, fmt::format("results: {0}/sweep.csv, {0}/report.html", folder.path().string()));
    if (!hash_mismatches.empty() || !unfinished_runs(results).empty()) { throw CheckFailed(); }
}

std::vector<Option> options_of(SweepOptions& options) {
    std::vector<Option> table = with_output_options(options,
        {required(text_option("file", "FILE.toml", "parameter table of the batch", options.file)),
            with_shown_default("the sweep's name",
                text_option("--out", "DIR", "output folder for recordings, logs and the report", options.out)),
            flag("--list", "print the names of the flights without running them", options.list),
            choice_option("--on", "ENGINE",
                "where flights run: local (processes on this machine), slurm (a job array) or parallel (GNU parallel "
                "over ssh); all machines must see the folder under the same name",
                {"local", "slurm", "parallel"}, options.on),
            value_option({"split", "N", "render each flight in N parts of consecutive frames and join them", 2, 10000},
                options.split),
            flag("--video", "write a video of each flight to videos/NAME.mp4", options.engine.videos),
            flag("--paper",
                "write tables (LaTeX, CSV, Markdown), figures (SVG, PDF) and an archive that flies everything again to "
                "paper/",
                options.paper),
            list_option("--sbatch", "OPTION",
                "further option for sbatch, such as --sbatch=--partition=long; repeatable", Arity::Repeatable,
                options.engine.sbatch_options)});
    add_family(table, {.name = "--batch", .form = "KEY=VALUE,...", .meaning = "how flights run:"},
        {{"jobs", value_option({"jobs", "N",
                                   "number of flights run at once: on this machine, on each machine, or of the job "
                                   "array",
                                   1, 10000},
                      options.jobs)},
            {"retries",
                value_option({"retries", "N", "number of times a failed flight is repeated", 0, 100}, options.retries)},
            {"share-cores", flag("--share-cores",
                                "run several flights at once on one machine; their frame times then affect each other",
                                options.engine.share_cores)},
            {"tasks",
                value_option(
                    {"tasks", "N", "slurm: number of tasks of the job array [one per flight, at most 1000]", 1, 100000},
                    options.tasks)},
            {"minutes",
                value_option({"minutes", "N", "slurm, parallel: time limit of a task or a flight [60]", 1, 100000},
                    options.minutes)},
            {"hosts", text_option("--hosts", "FILE", "parallel: file with the names of the machines (--sshloginfile)",
                          options.hosts)},
            {"program", with_shown_default("this one",
                            text_option("--program", "FILE",
                                "path of the octant program on the machines that run the flights", options.program))}});
    return table;
}

} // namespace

Command sweep_command() {
    auto options = std::make_shared<SweepOptions>();
    return {.name = "sweep",
        .summary = "Runs a batch of flights from a parameter table and writes one report",
        .options = options_of(*options),
        .footer = "A table, here of 12 flights:\n"
                  "  repeats = 3\n"
                  "  [settings]                      # options of octant fly\n"
                  "  size = \"640x360\"\n"
                  "  [vary]                          # all combinations are flown\n"
                  "  path = [\"straight\", \"turn\"]\n"
                  "  triangles = [2000, 4000]\n"
                  "Examples:\n"
                  "  octant sweep budgets.toml --list\n"
                  "  octant sweep budgets.toml --out budgets\n"
                  "  octant sweep budgets.toml --on slurm --batch minutes=30 --sbatch=--partition=long\n"
                  "  octant sweep budgets.toml --on parallel --batch hosts=machines.txt\n"
                  "  octant sweep long.toml --split 4 --batch share-cores --video\n"
                  "  octant sweep budgets.toml --out budgets --paper\n"
                  "Flights that are done are not flown again. All first repeats are flown before all second ones, "
                  "shuffled in each; results stand in the order of the file.\n"
                  "Exit code 0: all flights are done. 1: a flight failed or has not begun, or flights with the same "
                  "settings have different hashes. 2: invalid input, or the scheduler refused the flights. A sweep "
                  "that a signal stopped ends by that signal.",
        .run = [options] { run_sweep(*options); }};
}

} // namespace octant::ui::commands
