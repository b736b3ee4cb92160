#pragma once

#include "ui/report/table.h"
#include "ui/sweep/sweep_folder.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::sweep {

/// The 95 % interval of the median frame time of a cell, from the logarithms of its repeats' medians, which are above 0
/// (report::centre_of). Nothing for fewer than three repeats.
std::optional<std::pair<double, double>> median_interval(std::span<const double> medians_ms);

/// A sweep for a paper, in the sweep folder's paper/:
///   table.tex, table.csv, table.md    a row for each cell: every combination of path, aircraft and what else is varied
///   flight-PATH-AIRCRAFT.svg, .pdf    frame time over simulated time, a curve for each variant: the median of its
///                                     repeats with a band from the lowest to the highest, cut at 2.5 times the
///                                     highest curve
///   cells.svg, cells.pdf              the medians of all cells with their intervals
///   NAME.zip                          the sweep with its input files and results, to be flown again elsewhere
/// `sweep_file` is the file that the sweep was read from. Only flights that are done are counted; writes nothing if
/// there are none. Returns notes: what was written, and what could not be packed. Throws Error.
std::vector<std::string> write_paper(const std::filesystem::path& sweep_file, const Sweep& sweep,
    const SweepFolder& folder, std::span<const RunResult> results);

} // namespace octant::ui::sweep
