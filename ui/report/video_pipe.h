#pragma once

#include "ui/report/child_program.h"
#include "ui/report/picture_view.h"

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

/// How a video came out. `text` is one line: empty when made, else "not made: ...".
struct VideoResult {
    enum class Outcome {
        Made,
        NoFfmpeg, ///< not installed: a flight goes on without its video
        Failed    ///< ffmpeg's last line is in `text`
    };

    Outcome outcome = Outcome::Made;
    std::string text;
};

/// Frames piped raw to ffmpeg (H.264, crf 20, yuv420p, fragments of about a second): the file plays
/// even when the program is killed in mid-flight.
class VideoPipe {
public:
    /// Starts ffmpeg, found on PATH, which replaces the file. Without ffmpeg nothing is started and
    /// finish() says so. Throws Error when the file cannot be written there or the system cannot
    /// start a program.
    VideoPipe(const std::filesystem::path& file, const VideoFormat& format);

    /// True while frames are taken: false without ffmpeg and after it failed.
    bool running() const { return program_.has_value() && !broken_; }

    /// Hands on one frame, `picture` of the video's format; does nothing when not running().
    void add(const PictureView& picture);

    /// Waits until the file is whole. Once only.
    VideoResult finish();

private:
    VideoFormat format_;
    std::optional<ChildProgram> program_;
    bool broken_ = false;
};

} // namespace octant::ui::report
