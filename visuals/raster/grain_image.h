#pragma once

#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/grain_pattern.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// The fine pattern of ground, in levels of half the size each, all in one list: where a texel of
/// any level lies follows from shifts. A texel holds its own value and that of the one above, so
/// that two of them, one load, are the four around a place. Each level repeats each way, and has
/// its first column once more behind its last.
class GrainImage {
public:
    static constexpr int side = scene::GrainPattern::texels_a_side;
    static constexpr int stride = side + 1; ///< texels from row to row, of all levels
    static constexpr int levels = 9;        ///< the last one has four texels a side

    GrainImage();

    /// The first row of a level; there is room behind the last one.
    static constexpr int row_of(int level) { return 2 * side - (2 * side >> level); }

    const std::uint16_t* texels() const { return texels_.data(); }

private:
    std::vector<std::uint16_t> texels_;
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
