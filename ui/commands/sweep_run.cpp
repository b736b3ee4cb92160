#include "ui/commands/sweep_run.h"

#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/sweep/split_flight.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <utility>

namespace octant::ui::commands {

namespace {

namespace fs = std::filesystem;

std::unique_ptr<sweep::Engine> engine_of(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    sweep::EngineOptions engine = options.engine;
    engine.jobs = options.jobs.value_or(0);
    engine.tasks = options.tasks.value_or(0);
    engine.minutes = options.minutes.value_or(engine.minutes);
    engine.program =
        options.program ? options.program->string() : fs::read_symlink("/proc/self/exe").string();
    if (options.hosts) {
        engine.hosts = fs::absolute(*options.hosts);
    }
    if (options.on == "slurm") {
        return sweep::slurm_engine(sweep, folder, engine);
    }
    return options.on == "parallel" ? sweep::parallel_engine(sweep, folder, engine)
                                    : sweep::local_engine(sweep, folder, engine);
}

std::vector<sweep::RunResult>
results_of(const sweep::Sweep& sweep, const sweep::SweepFolder& folder, bool with_videos) {
    std::vector<sweep::RunResult> results;
    for (const sweep::SweepRun& run : sweep.runs) {
        results.push_back(sweep::result_of(folder, run, with_videos));
    }
    return results;
}

/// Has flown what is not done yet, and tries again what failed. What came of all runs.
std::vector<sweep::RunResult> fly_all(
    const SweepOptions& options,
    const sweep::Sweep& sweep,
    const sweep::SweepFolder& folder,
    sweep::Engine& engine) {
    const bool quiet = options.engine.quiet;
    std::vector<sweep::RunResult> results = results_of(sweep, folder, options.engine.videos);
    const std::size_t done_before = results.size() - unfinished_runs(results).size();
    if (done_before > 0) {
        base::print_note(quiet, fmt::format("flights that are done already: {}", done_before));
    }
    for (int attempt = 0; attempt <= options.retries && !base::StopSignals::received(); ++attempt) {
        const std::vector<std::size_t> left = unfinished_runs(results);
        if (left.empty()) {
            break;
        }
        if (attempt > 0) {
            base::print_note(
                quiet,
                fmt::format("note: flights that failed and are tried again: {}", left.size()));
        }
        engine.fly(left);
        results = results_of(sweep, folder, options.engine.videos);
    }
    return results;
}

/// Flies the parts of what is not done yet and puts them together; gives what came of the whole
/// flights.
SweepResults fly_in_parts(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    const auto count = static_cast<std::size_t>(*options.split);
    const bool videos = options.engine.videos;
    std::vector<sweep::RunResult> results = results_of(sweep, folder, videos);
    sweep::Sweep to_fly{sweep.name, {}};
    for (const std::size_t run : unfinished_runs(results)) {
        to_fly.runs.push_back(sweep.runs[run]);
    }
    if (to_fly.runs.empty()) {
        return {std::move(results), fmt::format("each in {} parts", *options.split)};
    }
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
        const auto failed = std::ranges::find(own, false, &sweep::RunResult::done);
        auto& result = *std::ranges::find(results, whole.name, &sweep::RunResult::name);
        if (failed != own.end()) {
            result.fault = fmt::format("{}: {}", failed->name, failed->fault);
            continue;
        }
        std::vector<fs::path> recordings;
        for (const sweep::RunResult& part : own) {
            recordings.push_back(part_folder.recording(part.name));
        }
        try {
            sweep::merge_parts(
                whole,
                folder.recording(whole.name),
                recordings,
                videos ? std::optional(folder.video(whole.name)) : std::nullopt);
        } catch (const Error& fault) {
            result.fault = fault.what();
            continue;
        }
        result = sweep::result_of(folder, whole, videos);
        for (const fs::path& part : recordings) {
            std::error_code ignored;
            fs::remove_all(part, ignored);
        }
    }
    return {
        std::move(results), fmt::format("each in {} parts, {}", *options.split, engine->machine_sharing())};
}

} // namespace

std::vector<std::size_t> unfinished_runs(const std::vector<sweep::RunResult>& results) {
    std::vector<std::size_t> runs;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (!results[i].done) {
            runs.push_back(i);
        }
    }
    return runs;
}

SweepResults fly_unfinished_runs(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder) {
    if (options.split) {
        return fly_in_parts(options, sweep, folder);
    }
    const std::unique_ptr<sweep::Engine> engine = engine_of(options, sweep, folder);
    std::vector<sweep::RunResult> results = fly_all(options, sweep, folder, *engine);
    return {std::move(results), engine->machine_sharing()};
}

} // namespace octant::ui::commands
