#pragma once

#include "ui/sweep/sweep_folder.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::sweep {

/// How the flights of a sweep are distributed.
struct EngineOptions {
    std::string program;      ///< the octant program, as the machines that fly call it
    bool share_cores = false; ///< run several flights at once on a machine; their frame times then affect each other
    int jobs = 0;             ///< flights at once on a machine or in a job array; 0 = as many as fit
    int tasks = 0;            ///< tasks of a job array; 0 = one for each run, at most 1000
    bool videos = false;      ///< write a video of each flight to SweepFolder::video
    int minutes = 60;         ///< time limit of a task of a job array
    std::vector<std::string> sbatch_options; ///< further options of sbatch, such as "--partition=long"
    std::filesystem::path hosts;             ///< GNU parallel's file of machines
    std::string machine_sharing;             ///< how the runs share machines, for reports; engines fill it in
    bool quiet = false;
};

/// Runs flights on processes or machines.
class Engine {
public:
    Engine() = default;
    virtual ~Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    Engine(Engine&&) = delete;
    Engine& operator=(Engine&&) = delete;

    /// Attempts each of these runs once, in this order, and waits for all of them; the results are in the folder.
    /// `runs`: indices into the sweep's runs. Throws Error with the scheduler's message if it fails and none of these
    /// runs has a log, or if it does not tell any more whether they have ended.
    virtual void fly(std::span<const std::size_t> runs) = 0;

    /// How the runs shared machines, for the report: "one at a time".
    virtual std::string machine_sharing() const = 0;
};

/// Child processes on this machine, one at a time unless EngineOptions::share_cores is set.
std::unique_ptr<Engine> local_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options);

/// A Slurm job array, submitted by a script in the folder. Throws Error if sbatch is not installed or does
/// not work.
std::unique_ptr<Engine> slurm_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options);

/// GNU parallel over ssh, started by a script in the folder. All machines must see the folder under the same name.
/// Throws Error if GNU parallel is not installed or does not work.
std::unique_ptr<Engine> parallel_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options);

/// The text quoted as one shell word.
std::string shell_quoted(const std::string& text);

/// A script for sbatch that flies the runs named in jobs.txt as one job array of `tasks`, each of which flies every
/// tasks-th run. Submitted again, it flies only the runs that are not done.
std::string sbatch_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options, int tasks);

/// Number of tasks of a sweep's job array.
int tasks_of(const Sweep& sweep, const EngineOptions& options);

/// The tasks of the array that fly these runs: "0,3,7".
std::string task_list(std::span<const std::size_t> runs, int tasks);

/// A script that flies the runs named in todo.txt by GNU parallel on the machines listed in a file. Run again, it flies
/// only the runs that are not done.
std::string parallel_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options);

} // namespace octant::ui::sweep
