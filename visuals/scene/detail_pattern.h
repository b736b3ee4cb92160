#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// The detail patterns of ground: cubes of texels that fill space by repetition without a seam. Ground shows what lies
/// on its surface, so that a pattern goes on over every edge and slope without stretching. A texel of 128 is the mean,
/// and texels have a normal distribution. Space is filled several times, from the finest scale on each `scale_step`
/// times as wide as the one before: a pixel sees two of them, so that it has contrast however large it is.
///
/// Both patterns are reliefs in the light of the sun: brighter where they rise and where they face it.
class DetailPattern {
public:
    enum class Kind {
        Open,  ///< uneven ground
        Crowns ///< domes side by side, and gaps between them
    };

    static constexpr int side_texels = 64;
    static constexpr float texels_per_m = 16.0F; ///< at the finest scale
    static constexpr int scales = 8;
    static constexpr int levels_per_scale = 2; ///< halvings of size from one scale to the next
    static constexpr int levels = levels_per_scale + 1;
    /// Of pixels near the eye: they see the second scale, too, so that the first one's repetition is not seen.
    static constexpr float min_level = 0.45F;
    static constexpr int scale_step = 1 << levels_per_scale;
    /// Unit vectors of the cube's edges in world axes, at right angles. None of them is parallel to level ground, and
    /// the ratios of their heights are cube roots of 2 and 4: level ground never shows the same texels twice.
    static constexpr std::array<glm::dvec3, 3> axes{glm::dvec3(0.649782467, 0.618047243, 0.442493334),
        glm::dvec3(-0.739147362, 0.377951710, 0.557506666), glm::dvec3(0.177324346, -0.689325837, 0.702414384)};
    /// Standard deviation of all levels; the pattern goes from -1 to 1.
    static constexpr double deviation = 0.36;
    /// A pixel's level is the one whose texels are as wide as the side of a square of the area that the pixel sees of
    /// the ground, so that slopes of unlike slant beside each other have features of like size; but not narrower than
    /// the root of this share of the pixel's length there.
    static constexpr float min_share2_of_length = 0.125F;
    /// Of what a pixel sees of ground, its length over its width, squared, up to which the pattern is seen in full. On
    /// ground at a lower angle it would be streaks: it fades as this grows. The width is the area over the length.
    static constexpr float max_slant2 = 300.0F;
    /// Of pictures of 720 lines over 45 degrees.
    static constexpr double nominal_focal_px = 869.0;

    /// `to_sun`: level, of length 1, in world axes.
    explicit DetailPattern(const glm::dvec3& to_sun);

    /// How texels() are arranged: of each kind all levels, each of half the size of the one before, in rows along the
    /// first axis, layers of `side` rows behind one another. A texel holds its own value and, in the higher byte, that
    /// of the one beside it along the second axis, so that two of them, one load, are four around a place, and two
    /// loads all eight. Each level repeats each way, and each of its rows has its first texel once more behind its
    /// last.
    static constexpr int stride = side_texels + 1;         ///< texels from row to row, of all levels
    static constexpr int rows = side_texels * side_texels; ///< of the first level
    static constexpr int texels_of_kind = 2 * rows * stride;

    /// The first row of a level; there is room behind the last one.
    static constexpr int row_of(int level) { return 2 * rows - (2 * rows >> level); }

    const std::uint16_t* texels() const { return texels_.data(); }

    /// A texel of a level, 0..255. Indices along the axes, within the level.
    std::uint8_t texel(Kind kind, int level, const glm::ivec3& at) const;

private:
    void write_level(Kind kind, int level, const std::vector<std::uint8_t>& texels);

    std::vector<std::uint16_t> texels_;
};

/// The patterns in the light of a sun of this azimuth, rounded to eighths of a turn. Made when they are first asked
/// for.
const DetailPattern& detail_pattern(double sun_azimuth_rad);

/// The width of the cube at a scale.
double detail_tile_m(int scale);

/// Texels of the finest level in a metre as the level of a pixel is chosen. In larger pictures and narrower views than
/// of `nominal_focal_px`, up to twice, the pattern stays as coarse as there, so that the ground has the same features
/// and the finer pixels smoother borders.
double detail_texels_per_m(double focal_px);

/// The position in the pattern at a scale, in cubes, of a point in world axes.
glm::dvec3 detail_tile_position(const glm::dvec3& place_m, int scale);

} // namespace octant::visuals::scene
