#pragma once

#include <cstddef>
#include <span>

namespace octant::ui::report {

/// An 8-bit picture that somebody else owns: rows without gaps, `channels` bytes a pixel (3 = RGB, 4 = RGBA). GL reads
/// its bottom row first, files begin with the top row.
struct PixelView {
    int width_px = 0;
    int height_px = 0;
    int channels = 3;
    std::span<const std::byte> bytes;
    bool bottom_row_first = false;

    std::size_t row_bytes() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(channels); }

    /// True when the sizes are positive, `channels` is 3 or 4 and `bytes` holds exactly the rows.
    bool is_whole() const {
        return width_px > 0 && height_px > 0 && (channels == 3 || channels == 4) &&
               bytes.size() == row_bytes() * static_cast<std::size_t>(height_px);
    }

    /// Row `y` counted from the top.
    std::span<const std::byte> row(int y) const {
        const int stored = bottom_row_first ? height_px - 1 - y : y;
        return bytes.subspan(static_cast<std::size_t>(stored) * row_bytes(), row_bytes());
    }
};

} // namespace octant::ui::report
