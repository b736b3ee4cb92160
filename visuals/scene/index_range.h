#pragma once

#include <cstdint>

namespace octant::visuals::scene {

/// A part of a model's index buffer.
struct IndexRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    int polygons = 0;
    /// Where its polygons begin in the list that the index buffer follows; 0 for a mesh.
    std::uint32_t first_polygon = 0;
};

} // namespace octant::visuals::scene
