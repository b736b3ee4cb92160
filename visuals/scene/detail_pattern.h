#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// The detail pattern of ground: a cube of texels that fills space by repetition without a seam. Ground shows what lies
/// on its surface, so that the pattern goes on over every edge and slope without stretching. A texel of 128 is the
/// mean. Space is filled several times, from the finest scale on each `scale_step` times as wide as the one before:
/// a pixel sees two of them, so that it has contrast however large it is.
struct DetailPattern {
    static constexpr int side_texels = 64;
    static constexpr float texels_per_m = 8.0F; ///< at the finest scale
    static constexpr int scales = 7;
    static constexpr int levels_per_scale = 2; ///< halvings of size from one scale to the next
    static constexpr int scale_step = 1 << levels_per_scale;
    /// Width of the pattern's smallest features, texels of their level.
    static constexpr int min_feature_texels = 4;
    /// Unit vectors of the cube's edges in world axes at the finest scale, at right angles; from scale to scale the
    /// first one is the second one of the scale before, and so on. None of them is parallel to level ground, and the
    /// ratios of their heights are cube roots of 2 and 4: level ground never shows the same texels twice.
    static constexpr std::array<glm::dvec3, 3> axes{glm::dvec3(0.649782467, 0.618047243, 0.442493334),
        glm::dvec3(-0.739147362, 0.377951710, 0.557506666), glm::dvec3(0.177324346, -0.689325837, 0.702414384)};
    /// Standard deviation of all levels; the pattern goes from -1 to 1.
    static constexpr double deviation = 0.36;
    /// Of pictures of 720 lines over 45 degrees.
    static constexpr double nominal_focal_px = 869.0;

    int size = side_texels;
    /// Texels along the first axis, then the second, then the third.
    std::vector<std::uint8_t> texels;
};

/// The pattern with features between four and 32 texels; then levels with half as many texels a side each, without the
/// features that are smaller than four of theirs and with the contrast of the first: one more than a scale has. The
/// same bytes on every machine. Made when they are first asked for.
const std::array<DetailPattern, DetailPattern::levels_per_scale + 1>& detail_mip_levels();

/// The width of the cube at a scale.
double detail_tile_m(int scale);

/// Texels of the finest level in a metre as the level of a pixel is chosen: the level whose texels are as wide as the
/// pixel's view of the ground. In larger pictures and narrower views than of `nominal_focal_px`, up to twice, the
/// pattern stays as coarse as there, so that the ground has the same features and the finer pixels smoother borders.
double detail_texels_per_m(double focal_px);

/// The position in the pattern at a scale, in cubes, of a point in world axes.
glm::dvec3 detail_tile_position(const glm::dvec3& place_m, int scale);

} // namespace octant::visuals::scene
