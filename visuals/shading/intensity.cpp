// Phong reflection of Kim and Park's hybrid rendering model (2008), section 3: "ambient, diffuse and specular
// reflection for R, G and B, all summed to the intensity of a vertex". Deviations: the paper's text takes the polygon's
// normal at its vertices, which makes their intensities nearly the same; here the caller brings a normal, that of the
// vertex for corners.
#include "visuals/shading/intensity.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace octant::visuals::shading {

namespace {

/// base^exponent by repeated squaring. std::pow may differ in its last bits from library to library; this gives the
/// same bits everywhere, and so the same choices.
float whole_power(float base, int exponent) {
    float power = 1.0F;
    for (; exponent > 0; exponent /= 2) {
        power *= exponent % 2 == 1 ? base : 1.0F;
        base *= base;
    }
    return power;
}

} // namespace

float intensity(const glm::vec3& place_m, const glm::vec3& normal, float colour_sum, const ShadingLight& light,
    const glm::vec3& eye_m) {
    assert(light.shininess >= 1);
    const float cosine = glm::dot(normal, light.to_light);
    if (cosine <= 0.0F || light.specular <= 0.0F) { return diffuse_intensity(cosine, colour_sum, light); }
    const glm::vec3 mirrored = 2.0F * cosine * normal - light.to_light;
    const glm::vec3 to_eye = eye_m - place_m;
    const float towards_eye = glm::dot(mirrored, to_eye);
    float specular = 0.0F;
    if (towards_eye > 0.0F) {
        specular = light.specular * whole_power(towards_eye / glm::length(to_eye), light.shininess);
    }
    return diffuse_intensity(cosine, colour_sum, light) + 3.0F * specular;
}

} // namespace octant::visuals::shading
