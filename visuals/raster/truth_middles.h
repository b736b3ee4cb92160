#pragma once

#include "visuals/raster/tile.h"
#include "visuals/raster/truth_surfaces.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// The triangles that the middles of a tile's pixels show, and what a thread needs to find them.
struct TileMiddles {
    static constexpr std::size_t pixels = std::size_t{tile_width} * tile_height;

    /// For each pixel, row after row, the triangle's place in the tile's list, from 1; 0 = none. Only those of the
    /// tile's size count.
    std::array<std::uint32_t, pixels> shown{};
    /// A bit for each column whose middle shows a triangle.
    std::array<std::uint64_t, tile_height> full{};
    std::uint32_t full_rows = 0;
    /// One over the depth of the land around the map that `shown` names, 1/m.
    std::vector<double> land;
    // Of groups that are drawn by depth.
    std::vector<float> depth;
    std::vector<std::uint32_t> nearest; ///< as `shown`
};

/// Writes TileMiddles::shown: painting order walked from near to far as paint_tile() does, with one sample in the
/// middle of each pixel, whatever samples the picture has. Clouds count where they are opaque enough (scene/truth.h),
/// glass as if it were opaque; other transparent triangles do not count. Nor does land that shows its back: land in
/// front of it covers the same pixels, but may come earlier in painting order, which orders what faces the eye. Land
/// around the map, whose painting order is rough, goes by its planes, which `surfaces` knows.
void find_middles(const glm::ivec2& first_px, const glm::ivec2& size_px, std::span<const TileTriangle> triangles,
    const TruthSurfaces& surfaces, TileMiddles& middles);

/// Whether a transparent triangle that covers a pixel of the picture counts there.
bool is_cloud_at(const Triangle& triangle, const glm::ivec2& at);

} // namespace octant::visuals::raster
