#pragma once

#include "ui/sweep/sweep_folder.h"

#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::sweep {

/// The sweep of all parts of a sweep's runs: run 3 of these is part 3 % count + 1 of run 3 / count. With `for_videos`
/// the parts record every picture. Throws Error, with the reason, for a flight that cannot be divided.
Sweep split_sweep(const Sweep& sweep, int count, bool for_videos);

/// Joins the recordings of the parts of a run to the recording of the whole run, with its report: the rows of all
/// frames and the hashes over them, as if one program had flown it. Each part begins with the last frame of the part
/// before; both recordings of that frame must be equal. `video`: the file for a video of all pictures. Throws Error,
/// with the names of both machines, where they differ, and for parts of different programs or input files.
void merge_parts(const SweepRun& whole, const std::filesystem::path& folder,
    const std::vector<std::filesystem::path>& parts, const std::optional<std::filesystem::path>& video);

} // namespace octant::ui::sweep
