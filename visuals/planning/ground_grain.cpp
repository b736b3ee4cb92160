#include "visuals/planning/ground_grain.h"

#include <glm/common.hpp>

#include <utility>

namespace octant::visuals::planning {

scene::Grain
ground_grain(std::shared_ptr<const scene::CoverContrast> contrast, const glm::dvec3& eye_m) {
    scene::Grain grain;
    for (int scale = 0; scale < scene::GrainPattern::scales; ++scale) {
        const glm::dvec2 tiles = scene::place_in_grain(eye_m, scale);
        grain.at_eye[static_cast<std::size_t>(scale)] = glm::vec2(tiles - glm::floor(tiles));
    }
    grain.contrast = std::move(contrast);
    return grain;
}

} // namespace octant::visuals::planning
