#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

/// A colour image with its georeference, if it has one.
struct Image {
    int width = 0;
    int height = 0;
    int file_width = 0; ///< in the file, before it was reduced; 0 for an image that was made
    int file_height = 0;
    std::vector<std::uint8_t> rgba; ///< row after row from the top; alpha 0 = no data
    /// x = t[0] + column t[1] + row t[2], y = t[3] + column t[4] + row t[5] in `wkt`; column and row count from the
    /// outer corner of the first pixel.
    std::array<double, 6> transform{0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    std::string wkt;  ///< coordinate system; empty = not georeferenced
    std::string name; ///< of the file, for messages
    std::string note; ///< message for the user; empty = none

    const std::uint8_t* pixel(int column, int row) const {
        return &rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(column))];
    }
};

/// Largest width and height that is held unless a smaller one is asked for, pixels. A larger file is read at reduced
/// resolution, averaged, and `note` says so.
inline constexpr int max_image_px = 16384;

/// Reads an image of 8 bits a part, of PNG also of 16: GeoTIFF, PNG, JPEG, BMP, SGI, TGA, GIF or WebP with red, green
/// and blue, grey or a palette, with or without alpha or a value for no data. Nothing else is opened, no network is
/// used and nothing is written. A file counts as placed when it has both a coordinate system and a pixel size, in it or
/// in a side file
/// (.aux.xml, .tfw and the like). Memory: 4 bytes a pixel.
///
/// Throws Error "file: expected ..., got ..." for no readable file, a damaged one, other kinds of file and other
/// depths.
Image read_image(const std::filesystem::path& file, int largest_px = max_image_px);

/// Reads an image from the bytes of a file; `name` is for messages.
Image image_from_bytes(const std::string& name, std::string_view bytes, int largest_px = max_image_px);

/// The extent of a ground that an image covers.
struct GroundArea {
    std::string name;
    glm::dvec2 half_extent_m{0.0}; ///< from the centre, east and north
    double spacing_m = 1.0;        ///< of its samples
    std::optional<CoordinateSystem> system;
};

GroundArea area_of(const HeightField& field);

/// Resamples an image to the extent of the ground, north up, with alpha 0 where the image has no data. A georeferenced
/// image is transformed to the ground's coordinate system (bilinear, accurate to an eighth of a pixel); its pixels keep
/// about their size but become no larger than the ground's spacing. An image without georeference is stretched over the
/// ground. A side has at most `largest_px` pixels. `note` names ground that the image does not cover.
///
/// Throws Error for a georeferenced image over ground without a coordinate system, and for an image outside the ground.
Image resampled_to_ground(Image image, const GroundArea& ground, int largest_px);

} // namespace octant::models::heights
