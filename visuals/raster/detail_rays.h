#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

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
    const std::uint16_t* texels = nullptr;   ///< scene::DetailPattern::texels()
};

/// For a plan with a detail texture.
DetailRays detail_rays(const scene::FramePlan& plan, const Projection& projection);

} // namespace octant::visuals::raster
