#pragma once

#include "ui/sweep/engine.h"
#include "ui/sweep/sweep_file.h"
#include "ui/sweep/sweep_folder.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

/// What a sweep is asked for.
struct SweepOptions {
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
    bool json = false;
};

/// What came of a sweep's runs, and how they shared machines.
struct SweepResults {
    std::vector<sweep::RunResult> results;
    std::string machine_sharing;
};

/// Numbers of the runs that are not done.
std::vector<std::size_t> unfinished_runs(const std::vector<sweep::RunResult>& results);

/// Has an engine fly what is not done yet, in parts where that is asked for, and tries again what
/// failed. Throws Error when the engine itself fails.
SweepResults fly_unfinished_runs(
    const SweepOptions& options, const sweep::Sweep& sweep, const sweep::SweepFolder& folder);

} // namespace octant::ui::commands
