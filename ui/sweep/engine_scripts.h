#pragma once

#include "ui/sweep/engine.h"

#include <span>
#include <string>

namespace octant::ui::sweep {

/// A script for sbatch that flies the runs named in jobs.txt as one job array of `tasks`, each of which flies every
/// tasks-th run. Submitted again after whatever happened, it flies what is not done yet.
std::string sbatch_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options, int tasks);

/// Number of tasks of a sweep's job array.
int tasks_of(const Sweep& sweep, const EngineOptions& options);

/// The tasks of the array that fly these runs: "0,3,7".
std::string task_list(std::span<const std::size_t> runs, int tasks);

/// A script that flies the runs named in todo.txt by GNU parallel, on the machines of a file. Run again after whatever
/// happened, it flies what is not done yet.
std::string parallel_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options);

} // namespace octant::ui::sweep
