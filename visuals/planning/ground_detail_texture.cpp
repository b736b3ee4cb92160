#include "visuals/planning/ground_detail_texture.h"

#include <glm/common.hpp>

#include <utility>

namespace octant::visuals::planning {

scene::DetailTexture
ground_detail_texture(std::shared_ptr<const scene::LandCoverContrast> contrast, const glm::dvec3& eye_m) {
    scene::DetailTexture detail_texture;
    for (int scale = 0; scale < scene::DetailPattern::scales; ++scale) {
        const glm::dvec2 tiles = scene::detail_tile_position(eye_m, scale);
        const auto at = static_cast<std::size_t>(scale);
        detail_texture.at_eye[at] = glm::vec2(tiles - glm::floor(tiles));
        detail_texture.eye_height_tiles[at] = static_cast<float>(glm::fract(eye_m.z / scene::detail_tile_m(scale)));
    }
    detail_texture.contrast = std::move(contrast);
    return detail_texture;
}

} // namespace octant::visuals::planning
