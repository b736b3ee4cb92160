#pragma once

#include "ui/sweep/sweep_folder.h"

#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::sweep {

/// The sweep of all parts of a sweep's runs: run 3 of these is part 3 % count + 1 of run 3 / count. With `for_videos`
/// the parts keep every picture. Throws Error for flights that cannot be divided, with the reason.
Sweep split_sweep(const Sweep& sweep, int count, bool for_videos);

/// Makes the recording of a whole run, with its report, of those of its parts, as if one program had flown it: rows one
/// after the other, hashes over all of them. Each part begins with the last frame of the part before, by which the seam
/// between them is checked. `video`: where a video of all pictures goes. Throws Error where a seam does not fit, naming
/// both machines, and for parts of different programs or input files.
void merge_parts(const SweepRun& whole, const std::filesystem::path& folder,
    const std::vector<std::filesystem::path>& parts, const std::optional<std::filesystem::path>& video);

} // namespace octant::ui::sweep
