#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::report {

/// A recording read back. The figures come from frames.csv, whether the flight ended or not.
struct LoadedRecording {
    std::filesystem::path folder;
    std::string name; ///< the folder's own name
    RunFile run;
    std::vector<FrameRecord> records;
    Statistics statistics;
    bool ended_early = false;                    ///< killed: no summary in run.json
    std::vector<std::filesystem::path> pictures; ///< in frame order
};

/// Reads a recording, a killed one too: then a torn last line of frames.csv is left out. Throws
/// Error for what is no recording or is damaged.
LoadedRecording load_recording(const std::filesystem::path& folder);

/// Writes mangohud.csv and trace.json where a killed flight left none. Throws Error.
void complete_timing_files(const LoadedRecording& recording);

} // namespace octant::ui::report
