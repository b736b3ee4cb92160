#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/png_file.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::report {

/// Indices of `max_count` (>= 1) of `count` things, evenly spaced, first and last among them; all when there are no
/// more.
std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t max_count);

/// The picture made smaller by a whole number, each pixel the mean of a square of the old ones, so that it is at most
/// `widest_px` wide. A picture narrower than that stays as it is. RGB.
Picture downscaled(const PixelView& picture, int widest_px);

/// A picture as a figure of a page, embedded, at most `widest_px` wide. One that cannot be read is named in its place.
std::string picture_html(const std::filesystem::path& picture, int widest_px, const std::string& caption);

/// The name of a slow frame's picture in a recording: slow-00042.png.
std::string slow_picture_name(int frame);

/// Small pictures of the slowest of a flight's frames that count, while it is flown; in constant memory.
class SlowPictures {
public:
    /// As many as a report shows.
    static constexpr std::size_t max_shown = 4;

    /// One more: the first frame of a flight's part is often slow, and is not the whole flight's.
    static constexpr std::size_t max_kept = max_shown + 1;

    /// Takes the picture where the frame is one of the slowest so far. `picture.is_whole()` must hold.
    void add(const FrameRecord& record, const PixelView& picture);

    /// Writes each of them into the folder by its name. Throws Error (disk full).
    void write(const std::filesystem::path& folder) const;

private:
    struct SlowPicture {
        FrameRecord record;
        Picture picture;
    };

    /// The slowest first.
    std::vector<SlowPicture> kept_;
};

} // namespace octant::ui::report
