#pragma once

#include "ui/report/child_program.h"
#include "ui/report/png_file.h"

#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::report {

/// What every frame of a video is.
struct VideoFormat {
    int width_px = 0;
    int height_px = 0;
    int channels = 3; ///< 3 = RGB, 4 = RGBA
    bool bottom_row_first = false;
    double frames_per_s = 60.0;
};

/// Before long work: throws Error where a VideoPipe would.
void check_video(const std::filesystem::path& file);

/// Frames piped raw to ffmpeg (H.264, crf 20, yuv420p, fragments of about a second): the file plays even when the
/// program is killed in mid-flight.
class VideoPipe {
public:
    /// Starts ffmpeg, which replaces the file. Throws Error when the file cannot be written there, or when there is no
    /// ffmpeg on PATH or the system cannot start it.
    VideoPipe(const std::filesystem::path& file, const VideoFormat& format);

    /// True while frames are taken: false after ffmpeg failed.
    bool running() const { return !broken_; }

    /// Hands on one frame, `picture` of the video's format; does nothing when not running().
    void add(const PixelView& picture);

    /// Waits until the file is whole. Returns nothing on success, else an error line that ends in ffmpeg's last one;
    /// the file is then cut after its last whole fragment, or removed if it has none. Once only.
    std::optional<std::string> finish();

private:
    std::filesystem::path file_;
    VideoFormat format_;
    ChildProgram program_;
    bool broken_ = false;
};

} // namespace octant::ui::report
