#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// The detail pattern of ground: a square tile of texels that repeats each way without a seam. A texel of 128 is the
/// mean. It is laid over the ground several times, from the finest scale on each `scale_step` times as wide as the one
/// before and turned by a right angle: a pixel sees two of them, so that it has contrast however large it is.
struct DetailPattern {
    static constexpr int side_texels = 512;
    static constexpr float texels_per_m = 8.0F; ///< at the finest scale
    static constexpr int scales = 4;
    static constexpr int levels_per_scale = 4; ///< halvings of size from one scale to the next
    static constexpr int scale_step = 1 << levels_per_scale;
    /// The shift east and north in the pattern for each metre of height, so that steep ground has the pattern, too. At
    /// every second scale it has the opposite sign, so that at most one of two scales runs in streaks down a slope.
    static constexpr glm::vec2 shift_per_height{0.22F, -0.27F};
    /// Ground whose normal leans more than by this tangent from the vertical shows the pattern upright, as on a wall
    /// that faces east or north, whichever is nearer: from above it would run in streaks down the slope. At this
    /// tangent both are stretched alike, by 1.7 at most.
    static constexpr float min_upright_slope = 0.8F;
    /// Standard deviation of all levels; the pattern goes from -1 to 1.
    static constexpr double deviation = 0.36;

    int size = side_texels;
    /// Texels row by row from the south.
    std::vector<std::uint8_t> texels;
};

/// The pattern with features between two and 128 texels, none of them stronger than the others; then levels with half
/// as many texels a side each, the means of four with the contrast of the first, as many as a scale has. The same bytes
/// on every machine. Made when they are first asked for.
const std::array<DetailPattern, DetailPattern::levels_per_scale + 1>& detail_mip_levels();

/// The width of a tile of the pattern at a scale.
double detail_tile_m(int scale);

/// The position in the pattern at a scale, in tiles, of a point in world axes.
glm::dvec2 detail_tile_position(const glm::dvec3& place_m, int scale);

} // namespace octant::visuals::scene
