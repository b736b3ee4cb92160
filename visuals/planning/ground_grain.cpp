#include "visuals/planning/ground_grain.h"

#include <glm/common.hpp>

#include <utility>

namespace octant::visuals::planning {

scene::Grain
ground_grain(std::shared_ptr<const scene::CoverContrast> contrast, const glm::dvec3& eye_m) {
    scene::Grain grain;
    for (int scale = 0; scale < scene::GrainPattern::scales; ++scale) {
        const glm::dvec2 tiles = scene::place_in_grain(eye_m, scale);
        const auto at = static_cast<std::size_t>(scale);
        grain.at_eye[at] = glm::vec2(tiles - glm::floor(tiles));
        grain.up_at_eye[at] = static_cast<float>(glm::fract(eye_m.z / scene::grain_tile_m(scale)));
    }
    grain.contrast = std::move(contrast);
    return grain;
}

} // namespace octant::visuals::planning
