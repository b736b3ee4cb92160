#pragma once

#include <glm/vec3.hpp>

#include <algorithm>

namespace octant::visuals::shading {

/// One far white light and how surfaces throw it back. Axes as those of the polygons it falls on.
struct ShadingLight {
    glm::vec3 to_light{0.0F, 0.0F, 1.0F}; ///< unit vector
    float ambient = 0.45F;                ///< times the surface's colour
    float diffuse = 0.65F;                ///< times the colour and the cosine to the light
    float specular = 0.25F; ///< white, times the cosine to the mirrored light ^ shininess
    int shininess = 24;     ///< at least 1

    bool operator==(const ShadingLight&) const = default;
};

/// intensity() of a surface without gloss, by the cosine between its normal and the light.
inline float matt_intensity(float cosine, float colour_sum, const ShadingLight& light) {
    return (light.ambient + light.diffuse * std::max(cosine, 0.0F)) * colour_sum;
}

/// Phong reflection at a point, red + green + blue, not cut off at what a screen can show: ambient
/// + diffuse + specular. `normal`: unit vector. What faces away from the light has ambient only.
float intensity(
    const glm::vec3& place_m,
    const glm::vec3& normal,
    float colour_sum,
    const ShadingLight& light,
    const glm::vec3& eye_m);

} // namespace octant::visuals::shading
