#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// The detail texture of ground, in mip levels of half the size each, all in one list: where a texel of any level lies
/// follows from shifts. A texel holds its own value and that of the one beside it along the second axis, so that two of
/// them, one load, are four around a place, and two loads all eight. Each level repeats each way, and each of its rows
/// along the first axis has its first texel once more behind its last.
class DetailImage {
public:
    static constexpr int side = scene::DetailPattern::side_texels;
    static constexpr int stride = side + 1;  ///< texels from row to row, of all levels
    static constexpr int rows = side * side; ///< of the first level, a layer of `side` rows behind the other

    DetailImage();

    /// The first row of a level; there is room behind the last one.
    static constexpr int row_of(int level) { return 2 * rows - (2 * rows >> level); }

    const std::uint16_t* texels() const { return texels_.data(); }

private:
    std::vector<std::uint16_t> texels_;
};

/// The one that all renderers share.
const DetailImage& detail_image();

/// What pixels need to look into the pattern, and how much of it the haze leaves.
struct DetailRays {
    /// Directions of the lines of sight along the pattern's axes, one unit deep.
    std::array<AttributePlane, 3> direction{};
    std::array<float, 3> up{};   ///< along the pattern's axes, one unit long
    float texels2_per_m2 = 0.0F; ///< scene::detail_texels_per_m(), squared

    /// The pattern at a scale, 1/256 texel.
    struct Scale {
        glm::vec3 eye{0.0F}; ///< the eye's place within the next scale's cube
        float parts_per_m = 0.0F;
    };

    std::array<Scale, scene::DetailPattern::scales - 1> scales{};
    float haze_per_m = 0.0F; ///< as Light
    float haze_falloff_per_m = 0.0F;
    const std::uint32_t* contrast = nullptr; ///< scene::LandCoverContrast::table()
};

/// For a plan with a detail texture.
DetailRays detail_rays(const scene::FramePlan& plan, const Projection& projection);

} // namespace octant::visuals::raster
