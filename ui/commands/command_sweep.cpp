#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/results_text.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/commands/commands.h"
#include "ui/commands/value_option.h"
#include "ui/commands/sweep_run.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/video_pipe.h"
#include "ui/sweep/split_flight.h"
#include "ui/sweep/sweep_file.h"
#include "ui/sweep/sweep_folder.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::commands {

namespace {

namespace fs = std::filesystem;

void print_list(const sweep::Sweep& sweep, bool json) {
    if (json) {
        base::JsonValue runs = base::JsonValue::list({});
        for (const sweep::SweepRun& run : sweep.runs) {
            base::JsonValue varied;
            for (const auto& [name, value] : run.varied) {
                varied[name] = value;
            }
            runs.push_back({{"name", run.name}, {"repeat", run.repeat}, {"varied", varied}});
        }
        base::print_value({{"name", sweep.name}, {"runs", runs}}, true);
        return;
    }
    for (const sweep::SweepRun& run : sweep.runs) {
        std::fputs((run.name + "\n").c_str(), stdout);
    }
}

/// What the report says before its flights: those that are not done, and runs that differ though
/// they must not.
std::vector<report::HtmlTable> problem_table(
    const std::vector<sweep::RunResult>& results, const std::vector<std::string>& hash_mismatches) {
    std::vector<report::HtmlTable> tables;
    if (const auto missing = unfinished_runs(results); !missing.empty()) {
        tables.push_back(
            {"Flights that are not done", {"flight", "why"}, {}, "The same command flies them."});
        for (const std::size_t i : missing) {
            tables.back().rows.push_back({results[i].name, results[i].fault});
        }
    }
    if (!hash_mismatches.empty()) {
        tables.push_back({"Runs that differ in nothing did not show the same", {"what"}, {}, ""});
        for (const std::string& line : hash_mismatches) {
            tables.back().rows.push_back({line});
        }
    }
    return tables;
}

void write_results(
    const sweep::Sweep& sweep,
    const sweep::SweepFolder& folder,
    const std::vector<sweep::RunResult>& results,
    const std::vector<std::string>& hash_mismatches) {
    write_file(folder.path() / "sweep.csv", sweep::sweep_csv(folder, sweep, results));
    std::vector<report::LoadedRecording> recordings;
    for (const sweep::RunResult& result : results) {
        if (result.done) {
            recordings.push_back(report::load_recording(folder.recording(result.name)));
        }
    }
    write_file(
        folder.path() / "report.html",
        report::html_report(recordings, problem_table(results, hash_mismatches), folder.path()));
}

void print_end(
    const sweep::Sweep& sweep,
    const std::vector<sweep::RunResult>& results,
    const std::vector<std::string>& hash_mismatches,
    const std::string& machine_sharing,
    bool json) {
    const std::size_t missing = unfinished_runs(results).size();
    if (json) {
        base::JsonValue runs = base::JsonValue::list({});
        for (const sweep::RunResult& result : results) {
            runs.push_back(
                {{"name", result.name},
                 {"done", result.done},
                 {"fault", result.done ? std::string() : result.fault},
                 {"host", result.host},
                 {"state_hash", result.state_hash},
                 {"picture_hash", result.picture_hash},
                 {"noise", result.noise}});
        }
        base::print_value(
            {{"name", sweep.name},
             {"flown", machine_sharing},
             {"done", results.size() - missing},
             {"of", results.size()},
             {"differences", hash_mismatches},
             {"runs", runs}},
            true);
        return;
    }
    std::fputs(
        fmt::format("{} of {} flights done, {}\n", results.size() - missing, results.size(), machine_sharing)
            .c_str(),
        stdout);
    for (const sweep::RunResult& result : results) {
        if (!result.done) {
            std::fputs(fmt::format("failed: {}: {}\n", result.name, result.fault).c_str(), stdout);
        }
    }
    for (const std::string& line : hash_mismatches) {
        std::fputs((line + "\n").c_str(), stdout);
    }
}

/// Throws Error for an option that the engine asked for does not have.
void check_engine(const SweepOptions& options) {
    const auto refuse = [&](std::string_view option, std::string_view engines) {
        throw Error(
            fmt::format("{}: expected --on {} beside it, got {}", option, engines, options.on));
    };
    const bool slurm = options.on == "slurm";
    if (options.tasks && !slurm) {
        refuse("--tasks", "slurm");
    }
    if (!options.engine.sbatch_options.empty() && !slurm) {
        refuse("--sbatch", "slurm");
    }
    if (options.hosts && options.on != "parallel") {
        refuse("--hosts", "parallel");
    }
    if (options.minutes && options.on == "local") {
        refuse("--minutes", "slurm or parallel");
    }
}

void run_sweep(const SweepOptions& options) {
    check_engine(options);
    const sweep::Sweep sweep = sweep::read_sweep(options.file);
    if (options.list) {
        print_list(sweep, options.json);
        return;
    }
    if (options.split) { // before anything is written
        sweep::split_sweep(sweep, *options.split, options.engine.videos);
    }
    const bool quiet = options.engine.quiet;
    const sweep::SweepFolder folder(
        fs::absolute(options.out.value_or(sweep.name)).lexically_normal());
    folder.prepare(sweep);
    if (options.engine.videos) {
        make_folder(folder.path() / "videos");
        report::check_video(folder.video(sweep.runs.front().name));
    }
    const base::StopSignals stop_signals;
    const SweepResults flown = fly_unfinished_runs(options, sweep, folder);
    const std::vector<std::string> hash_mismatches = sweep::hash_mismatches(sweep, flown.results);
    write_results(sweep, folder, flown.results, hash_mismatches);
    print_end(sweep, flown.results, hash_mismatches, flown.machine_sharing, options.json);
    base::print_note(
        quiet, fmt::format("results: {0}/sweep.csv, {0}/report.html", folder.path().string()));
    if (!hash_mismatches.empty() || !unfinished_runs(flown.results).empty()) {
        throw CheckFailed();
    }
}

} // namespace

Command sweep_command() {
    auto options = std::make_shared<SweepOptions>();
    return {
        .name = "sweep",
        .summary = "Flies many flights, by a table of what they vary, and reports them together",
        .options =
            {required(text_option("file", "FILE.toml", "what is flown", options->file)),
             with_shown_default(
                 "the sweep's name",
                 text_option("--out", "DIR", "folder of all of it", options->out)),
             flag("--list", "print the flights and fly none", options->list),
             choice_option(
                 "--on",
                 "ENGINE",
                 "who flies: local, processes of this machine; slurm, a job array; parallel, GNU "
                 "parallel over ssh, all machines seeing the folder",
                 {"local", "slurm", "parallel"},
                 options->on),
             value_option(
                 {"retries", "N", "how often a flight that failed is tried again", 0, 100},
                 options->retries),
             flag(
                 "--share-cores",
                 "fly several at once on a machine; frame times then depend on each other",
                 options->engine.share_cores),
             value_option(
                 {"jobs", "N", "flights at once: here, on each machine, of the array", 1, 10000},
                 options->jobs),
             value_option(
                 {"tasks", "N", "tasks of the job array [one a flight, at most 1000]", 1, 100000},
                 options->tasks),
             value_option(
                 {"minutes", "N", "time limit of a task or a flight on engines [60]", 1, 100000},
                 options->minutes),
             value_option(
                 {"split",
                  "N",
                  "fly each flight in N parts, of consecutive frames, and put these together",
                  2,
                  10000},
                 options->split),
             flag(
                 "--video",
                 "write a video of each flight, videos/NAME.mp4",
                 options->engine.videos),
             list_option(
                 "--sbatch",
                 "OPTION",
                 "a further option of sbatch, such as --sbatch=--partition=long",
                 Arity::Repeatable,
                 options->engine.sbatch_options),
             text_option("--hosts", "FILE", "GNU parallel's file of machines", options->hosts),
             with_shown_default(
                 "this one",
                 text_option(
                     "--program",
                     "FILE",
                     "octant as the machines that fly call it",
                     options->program)),
             flag("--json", "results as JSON", options->json),
             flag("--quiet", "no progress, no notes", options->engine.quiet)},
        .footer =
            "Examples:\n"
            "  octant sweep budgets.toml --list\n"
            "  octant sweep budgets.toml --out budgets\n"
            "  octant sweep budgets.toml --on slurm --minutes 30 --sbatch=--partition=long\n"
            "  octant sweep budgets.toml --on parallel --hosts machines.txt\n"
            "  octant sweep long.toml --split 4 --share-cores --video\n"
            "Flights that are done are not flown again. Exit code 1: some failed, or runs that\n"
            "differ in nothing did not show the same.",
        .run = [options] { run_sweep(*options); }};
}

} // namespace octant::ui::commands
