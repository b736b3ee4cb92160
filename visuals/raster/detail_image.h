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
/// follows from shifts. A texel holds its own value and that of the one above, so that two of them, one load, are the
/// four around a place. Each level repeats each way, and has its first column once more behind its last.
class DetailImage {
public:
    static constexpr int side = scene::DetailPattern::side_texels;
    static constexpr int stride = side + 1; ///< texels from row to row, of all levels

    DetailImage();

    /// The first row of a level; there is room behind the last one.
    static constexpr int row_of(int level) { return 2 * side - (2 * side >> level); }

    const std::uint16_t* texels() const { return texels_.data(); }

private:
    std::vector<std::uint16_t> texels_;
};

/// The one that all renderers share.
const DetailImage& detail_image();

/// What pixels need to look into the pattern, and how much of it the haze leaves.
struct DetailRays {
    /// World directions of the lines of sight, one unit deep: east, north and up.
    std::array<AttributePlane, 3> direction{};

    /// The pattern at a scale, 1/256 texel.
    struct Scale {
        glm::vec2 eye{0.0F}; ///< the eye's place
        float eye_up = 0.0F; ///< how high it is
        float parts_per_m = 0.0F;
    };

    std::array<Scale, scene::DetailPattern::scales> scales{};
    float haze_per_m = 0.0F; ///< as Light
    float haze_falloff_per_m = 0.0F;
    const std::uint32_t* contrast = nullptr; ///< scene::LandCoverContrast::table()
};

/// For a plan with a detail texture.
DetailRays detail_rays(const scene::FramePlan& plan, const Projection& projection);

} // namespace octant::visuals::raster
