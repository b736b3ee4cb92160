#pragma once

#include "ui/report/table.h"
#include "ui/sweep/sweep_file.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::sweep {

/// Where a sweep's files lie in its folder:
///   jobs.txt            the names of its runs, one a line
///   jobs/NAME.json      the settings of a run
///   runs/NAME/          its recording
///   logs/NAME.log       what it said
///   videos/NAME.mp4     a video of it, where one was asked for
///   sweep.csv           one line a run: how it ended, where, figures, hashes
///   report.html         all runs
class SweepFolder {
public:
    explicit SweepFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& path() const { return folder_; }

    std::filesystem::path job(const std::string& run) const { return folder_ / "jobs" / (run + ".json"); }

    std::filesystem::path recording(const std::string& run) const { return folder_ / "runs" / run; }

    std::filesystem::path log(const std::string& run) const { return folder_ / "logs" / (run + ".log"); }

    std::filesystem::path video(const std::string& run) const { return folder_ / "videos" / (run + ".mp4"); }

    /// Makes the folder and writes jobs.txt and jobs/. Throws Error, for a folder with other things in it too.
    void prepare(const Sweep& sweep) const;

private:
    std::filesystem::path folder_;
};

/// How a run came out.
struct RunResult {
    std::string name;
    bool done = false;
    std::string fault; ///< why not, in a line
    std::string host;  ///< where it was flown
    std::string state_hash;
    std::string picture_hash;
    std::string noise; ///< why its timings are not to be trusted; empty = quiet
};

/// How a result is written, but for the values that the sweep varies and the figures of the flight.
std::span<const report::Column<RunResult>> result_columns();

/// Looks at a run's recording: it is done when it has its summary, was not stopped, and was flown with these settings
/// and input files by this very program file, and has its video where there is to be one.
RunResult result_of(const SweepFolder& folder, const SweepRun& run, bool with_video = false);

/// Runs that differ in nothing but their repeats and do not show the same though no clock decides what they show: one
/// line each, which names both runs and their machines.
std::vector<std::string> hash_mismatches(const Sweep& sweep, std::span<const RunResult> results);

/// The results and figures as comma-separated text, one line a run.
std::string sweep_csv(const SweepFolder& folder, const Sweep& sweep, std::span<const RunResult> results);

} // namespace octant::ui::sweep
