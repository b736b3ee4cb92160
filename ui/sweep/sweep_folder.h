#pragma once

#include "ui/report/table.h"
#include "ui/sweep/sweep_file.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::sweep {

/// The files of a sweep in its folder:
///   jobs.txt            the names of its runs, one a line
///   jobs/NAME.json      the settings of a run
///   runs/NAME/          its recording
///   logs/NAME.log       its standard output and standard error
///   videos/NAME.mp4     its video, with --video
///   sweep.csv           a line for each run: result, machine, statistics, hashes
///   report.html         all runs
class SweepFolder {
public:
    explicit SweepFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& path() const { return folder_; }

    std::filesystem::path job(const std::string& run) const { return folder_ / "jobs" / (run + ".json"); }

    std::filesystem::path recording(const std::string& run) const { return folder_ / "runs" / run; }

    std::filesystem::path log(const std::string& run) const { return folder_ / "logs" / (run + ".log"); }

    std::filesystem::path video(const std::string& run) const { return folder_ / "videos" / (run + ".mp4"); }

    /// Makes the folder and writes jobs.txt and jobs/. Throws Error if the folder contains anything else than a sweep.
    void prepare(const Sweep& sweep) const;

private:
    std::filesystem::path folder_;
};

/// The result of a run.
struct RunResult {
    std::string name;
    bool done = false;
    std::string fault; ///< one line that says why it is not done
    std::string host;  ///< the machine that flew it
    std::string state_hash;
    std::string picture_hash;
    std::string noise; ///< why its times cannot be compared; empty = they can
};

/// The columns of a result, without those of the varied values and of the flight's statistics.
std::span<const report::Column<RunResult>> result_columns();

/// Reads a run's recording. The run is done if the recording has its summary, was not stopped and was made with the
/// same settings, input files and program file, and if its video exists where `with_video` asks for one.
RunResult result_of(const SweepFolder& folder, const SweepRun& run, bool with_video = false);

/// One line for each pair of runs with the same settings but different hashes, with both names and machines. Runs whose
/// settings follow the clock (--adapt) are left out.
std::vector<std::string> hash_mismatches(const Sweep& sweep, std::span<const RunResult> results);

/// The results and statistics as comma-separated text, a line for each run.
std::string sweep_csv(const SweepFolder& folder, const Sweep& sweep, std::span<const RunResult> results);

} // namespace octant::ui::sweep
