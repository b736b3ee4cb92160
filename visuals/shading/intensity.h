#pragma once

#include <glm/vec3.hpp>

#include <algorithm>

namespace octant::visuals::shading {

/// One distant white light, and how surfaces reflect it. Directions are in the axes of the polygons that are lit.
struct ShadingLight {
    glm::vec3 to_light{0.0F, 0.0F, 1.0F}; ///< A unit vector towards the light.
    float ambient = 0.45F;                ///< The factor on the surface's colour everywhere.
    float diffuse = 0.65F;                ///< The factor on colour times cosine between normal and light.
    /// The factor on cosine^shininess between the mirrored light and the eye; the highlight is white.
    float specular = 0.25F;
    int shininess = 24; ///< The exponent of the highlight, at least 1.

    bool operator==(const ShadingLight&) const = default;
};

/// intensity() of a surface without a highlight (ambient + diffuse). `cosine` is that between the normal and the
/// direction to the light.
inline float diffuse_intensity(float cosine, float colour_sum, const ShadingLight& light) {
    return (light.ambient + light.diffuse * std::max(cosine, 0.0F)) * colour_sum;
}

/// Phong reflection at a point, summed over red, green and blue and not clamped to what a screen can show: ambient +
/// diffuse + specular. `normal` is a unit vector, `colour_sum` red + green + blue of the surface (each 0 to 1). A
/// surface that faces away from the light has its ambient part only.
float intensity(const glm::vec3& place_m, const glm::vec3& normal, float colour_sum, const ShadingLight& light,
    const glm::vec3& eye_m);

} // namespace octant::visuals::shading
