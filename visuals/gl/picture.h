#pragma once

#include <cstdint>
#include <vector>

namespace octant::visuals::gl {

/// A picture in memory.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; ///< 4 bytes a pixel, rows from the top, no gaps
};

} // namespace octant::visuals::gl
