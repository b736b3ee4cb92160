#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/sample_pattern.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/picture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::visuals::raster {

/// Levels a pixel above which a triangle counts as a sliver, whose colours beyond its edges mean nothing.
constexpr double sliver_per_px = 64.0;

constexpr double any_per_px = 16000.0; ///< no triangle counts as a sliver

/// Three corners from top to bottom.
struct TopDownVertices {
    const ScreenVertex& top;
    const ScreenVertex& middle;
    const ScreenVertex& bottom;
    /// Twice the area, 1/256 pixel squared; not 0. Its sign says on which side the middle lies.
    std::int64_t doubled_area;
};

/// Whether a triangle that is flatter than a pixel covers neither a sample nor the middle of any pixel. May be false
/// where it does not; of other triangles always is.
bool is_between_samples(const TopDownVertices& vertices, const SamplePattern& samples);

/// Fills in the edges of a triangle, and its inverse depth if it has detail texture. Its box is known.
void set_edges(const TopDownVertices& vertices, Triangle& triangle);

/// Fills in these and the four values at the corners as planes of levels. Where a level would change by more than
/// `max_per_px` it is the corners' mean.
void set_edges_and_gradients(const TopDownVertices& vertices, double max_per_px, Triangle& triangle);

/// The levels of a triangle that has one colour everywhere.
ColourGradients constant_gradients(const std::array<float, 3>& rgb);

/// What SurfacePlanes::Value lists, at each corner, but 1 for the inverse of w.
using SurfaceCorners = std::array<std::array<float, SurfacePlanes::count>, 3>;

/// Fills in the planes of a triangle and their limits, from its corners in any order.
void set_surface_planes(
    const std::array<const ScreenVertex*, 3>& corners, const SurfaceCorners& values, SurfacePlanes& planes);

// -- Planes of textured triangles.

/// The planes over the picture by which textured triangles are painted: ColourGradients whose first two values are
/// texture coordinates in texels of the fine mip level, and whose last two are light and haze, as shares of
/// whole_share.
struct TexturePlanes {
    /// A little less than 256, whose double would need more than sixteen bits.
    static constexpr float whole_share = 255.98F;

    ColourGradients gradients;
    MipSelection mip_selection;
    bool is_accurate = false; ///< wrong by at most 1/16 texel, and light and haze by at most 1/512
};

/// Units of 2^-16 texel of a level in a texel of the finest level.
inline double texel_scale(std::size_t level) { return 65536.0 / static_cast<double>(std::uint64_t{1} << level); }

/// Planes that are exact in the middle of some pixels of the picture, whose perspective `extra` holds.
TexturePlanes fit_texture_planes(const TriangleExtra& extra, const scene::PixelRect& pixels, std::size_t level_count);

/// A textured triangle whose planes hold for all of it, because perspective bends them by at most 1/32 texel, and light
/// and haze by at most 1/512.
struct AffineTexturedTriangle {
    std::array<ScreenVertex, 3> vertices; ///< with values as in TexturePlanes
    MipSelection mip_selection;
};

/// Texture coordinates are moved so that they are as much too far at one corner or edge as too near at another. Nothing
/// where perspective bends them too much. `vertices` are placed, with coordinates in texels of the finest of
/// `level_count` levels.
std::optional<AffineTexturedTriangle> fit_affine_texture(
    const std::array<const ScreenVertex*, 3>& vertices, std::size_t level_count);

} // namespace octant::visuals::raster
