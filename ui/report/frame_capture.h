#pragma once

#include "ui/report/run_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::report {

struct FrameTime {
    double time_s = 0.0;   ///< since the first frame; never decreases
    double frame_ms = 0.0; ///< above 0
};

/// Frame times that another program recorded: PresentMon (also OCAT and FrameView), CapFrameX or MangoHud.
struct FrameCapture {
    std::string format; ///< "PresentMon CSV", "CapFrameX CSV", "CapFrameX JSON", "MangoHud log"
    /// The title is the application, or the file's name where the file names no application. Facts are the format, the
    /// application and the notes: what was left out, guessed or mended. No settings, no summary.
    RunFile run;
    std::vector<FrameTime> frames; ///< at least one; of the application and swap chain with the most frames
};

/// Name of the fact that names the application of a capture.
inline constexpr const char* application_fact = "application";

/// True for a file that may be a capture: any file that is no zip file.
bool is_frame_capture(const std::filesystem::path& path);

/// Reads a capture. The format is recognised by what the file holds, never by its name. Fields are separated by commas,
/// semicolons or tabs, and numbers may have decimal commas. Rows without a frame time (NA, 0) and frames that a driver
/// generated are left out and counted in a note. Throws Error "file:line: expected ..., got ..." for anything else.
FrameCapture read_frame_capture(const std::filesystem::path& path);

} // namespace octant::ui::report
