#pragma once

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// A picture in memory: display values.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< 4 bytes a pixel, rows from the top, no gaps
};

/// A part of a picture, pixels from its upper left corner.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

} // namespace octant::visuals::scene
