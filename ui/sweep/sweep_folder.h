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
///   jobs.txt            the names of its runs in the order of flying, one a line
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

    /// Makes the folder and writes jobs.txt, in the order of `sweep.runs`, and jobs/. Throws Error if the folder
    /// contains anything else than a sweep.
    void prepare(const Sweep& sweep) const;

    /// Removes the logs of these runs, which are indices into the sweep's. A run that has a log afterwards has begun.
    void remove_logs(const Sweep& sweep, std::span<const std::size_t> runs) const;

    /// Whether any of these runs has begun.
    bool any_begun(const Sweep& sweep, std::span<const std::size_t> runs) const;

private:
    std::filesystem::path folder_;
};

enum class RunState {
    Flown,
    Failed,
    Stopped, ///< a signal has ended it before its last frame
    NotBegun
};

/// As tables have it: "flown", "failed", "stopped", "not begun".
std::string text_of(RunState state);

/// The result of a run.
struct RunResult {
    std::string name;
    RunState state = RunState::NotBegun;
    std::string fault; ///< one line that says why a run that has begun is not done
    std::string host;  ///< the machine that flew it
    std::string state_hash;
    std::string picture_hash;
    std::string noise; ///< why its times cannot be compared; empty = they can

    bool done() const { return state == RunState::Flown; }
};

/// The columns of a result, without those of the varied values and of the flight's statistics.
std::span<const report::Column<RunResult>> result_columns();

/// Reads a run's recording. The run is done if the recording has its summary, was not stopped and was made with the
/// same settings, input files and program file, and if its video exists where `with_video` asks for one. Otherwise it
/// has begun if it has a log. Throws Error when a newer program wrote the recording.
RunResult result_of(const SweepFolder& folder, const SweepRun& run, bool with_video = false);

/// One line for each pair of runs with the same settings but different hashes, with both names and machines. Runs whose
/// settings follow the clock (--adapt) are left out.
std::vector<std::string> hash_mismatches(const Sweep& sweep, std::span<const RunResult> results);

/// The results and statistics as comma-separated text, a line for each run.
std::string sweep_csv(const SweepFolder& folder, const Sweep& sweep, std::span<const RunResult> results);

} // namespace octant::ui::sweep
