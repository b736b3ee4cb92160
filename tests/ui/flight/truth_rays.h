#pragma once

#include "visuals/raster/renderer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/truth.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::tests {

/// The truth of a picture, and the memory of its arrays.
struct TruthPicture {
    glm::ivec2 size_px{0};
    std::vector<float> depth_m;
    std::vector<std::uint8_t> class_id;
    std::vector<std::uint32_t> object_id;
    std::vector<glm::vec3> normal;
    std::vector<glm::vec2> flow_px;
    std::vector<glm::vec2> previous_px;
    std::vector<float> coverage;

    explicit TruthPicture(const glm::ivec2& size);

    visuals::scene::TruthArrays arrays();

    std::size_t at(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_px.x) + static_cast<std::size_t>(column);
    }

    bool operator==(const TruthPicture& other) const;
};

/// Counts of pixels whose truth is not what a ray meets.
struct RayCheck {
    int pixels = 0; ///< that show anything but sky
    int aircraft = 0;
    int wrong = 0;
    std::vector<glm::ivec2> wrong_at; ///< the first of them
};

/// Compares class, object, depth and normal of a picture with rays through the middles of its pixels: every triangle of
/// the plan in double precision, by the nearest hit. A truth is right if it is that of a triangle that comes within
/// `reach_px` of the pixel's middle and behind no triangle that covers a place of this reach around it. Shares no code
/// with the rasterizer. Clouds are left out: the plan must have none.
RayCheck check_by_rays(const visuals::scene::FramePlan& plan, std::span<const visuals::scene::ModelBuffers> models,
    const TruthPicture& truth, double reach_px = 0.02);

} // namespace octant::tests
