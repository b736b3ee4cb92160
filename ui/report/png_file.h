#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// A picture that somebody else owns: rows without gaps, `channels` values a pixel (1 = grey, 3 = RGB, 4 = RGBA) of 8
/// or 16 bits in the processor's byte order. GL reads its bottom row first, files begin with the top row.
struct PixelView {
    int width_px = 0;
    int height_px = 0;
    int channels = 3;
    std::span<const std::byte> bytes;
    bool bottom_row_first = false;
    int bits = 8;

    std::size_t row_bytes() const {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(channels) *
               static_cast<std::size_t>(bits / 8);
    }

    /// True when the sizes are positive, `channels` is 1, 3 or 4, `bits` 8 or 16 and `bytes` holds exactly the rows.
    bool is_whole() const {
        return width_px > 0 && height_px > 0 && (channels == 1 || channels == 3 || channels == 4) &&
               (bits == 8 || bits == 16) && bytes.size() == row_bytes() * static_cast<std::size_t>(height_px);
    }

    /// Row `y` counted from the top.
    std::span<const std::byte> row(int y) const {
        const int stored = bottom_row_first ? height_px - 1 - y : y;
        return bytes.subspan(static_cast<std::size_t>(stored) * row_bytes(), row_bytes());
    }
};

/// A picture of our own, top row first.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    int channels = 3;
    std::vector<std::byte> bytes;

    PixelView view() const { return {width_px, height_px, channels, bytes, false}; }
};

enum class PngEffort {
    Fast, ///< a picture a frame: level 1, Sub filter, run lengths
    Small ///< a picture in a page: level 5
};

/// The picture as a PNG, grey or RGB, of its bits (alpha is dropped). `picture.is_whole()` must hold. Same picture,
/// same bytes. Throws Error when libpng cannot (more than a million pixels a side).
std::string png_bytes(const PixelView& picture, PngEffort effort = PngEffort::Fast);

/// png_bytes as a file, whole or not at all. Throws Error.
void write_png(const std::filesystem::path& path, const PixelView& picture);

/// Reads a PNG of any kind as 8-bit RGB, or RGBA when it has transparency. `path` is only named in errors. Throws Error
/// for what is no PNG, is damaged or holds more than 100 million pixels.
Picture picture_from_png(const std::filesystem::path& path, std::string_view bytes);

/// picture_from_png of a file.
Picture read_png(const std::filesystem::path& path);

} // namespace octant::ui::report
