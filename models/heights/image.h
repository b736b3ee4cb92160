#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

/// A colour picture, and where it lies on the earth if it says so.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< row after row from the top; alpha 0 = nothing is there
    /// x = t[0] + column t[1] + row t[2], y = t[3] + column t[4] + row t[5] in `wkt`; column and row count from the
    /// outer corner of the first pixel.
    std::array<double, 6> transform{0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    std::string wkt;  ///< coordinate system; empty = a picture without a place
    std::string name; ///< of the file, for messages
    std::string note; ///< what a person should be told; empty = nothing

    const std::uint8_t* pixel(int column, int row) const {
        return &rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(column))];
    }
};

/// Largest width and height that is held, pixels. A larger file is read at reduced resolution, averaged, and `note`
/// says so.
inline constexpr int max_image_px = 16384;

/// Reads an image of 8 bits a part: GeoTIFF, PNG, JPEG, BMP, SGI or TGA with red, green and blue, grey or a palette,
/// with or without alpha or a value for no data. Nothing else is opened, no network is used and nothing is written. A
/// file counts as placed when it has both a coordinate system and a pixel size, in it or in a side file (.aux.xml, .tfw
/// and the like). Memory: 4 bytes a pixel.
///
/// Throws Error "file: expected ..., got ..." for no readable file, a damaged one, other kinds of file and other
/// depths.
Image read_image(const std::filesystem::path& file);

/// The same of a file's bytes; `name` is only told.
Image image_from_bytes(const std::string& name, std::string_view bytes);

} // namespace octant::models::heights
