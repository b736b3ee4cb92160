#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// The fine pattern of ground, in levels of half the size each.
class GrainImage {
public:
    /// A square that repeats each way.
    struct Level {
        int size;   ///< texels a side, a power of two
        int stride; ///< bytes a row: behind its texels its first ones once more
        std::vector<std::uint8_t> texels;
    };

    GrainImage();

    const std::vector<Level>& levels() const { return levels_; }

private:
    std::vector<Level> levels_;
};

/// The one that all renderers share.
const GrainImage& grain_image();

/// Where pixels look in the pattern: at_eye + ray * depth, in texels of the finest level, where
/// depth is that along the line of sight.
struct GrainRays {
    RealPlane x;
    RealPlane y;
    glm::dvec2 at_eye{0.0};
};

/// Of a plan that has grain.
GrainRays grain_rays(const scene::FramePlan& plan, const Projection& projection);

} // namespace octant::visuals::raster
