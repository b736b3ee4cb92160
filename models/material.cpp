#include "models/material.h"

#include <cmath>
#include <utility>

namespace octant::models {

namespace {

// IEC 61966-2-1, section 5.2: a straight piece near black, then a power.
double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double decoded(double display) {
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

} // namespace

glm::dvec3 srgb_from_linear(const glm::dvec3& linear) {
    return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

glm::dvec3 linear_from_srgb(const glm::dvec3& display) {
    return {decoded(display.x), decoded(display.y), decoded(display.z)};
}

void set_picture(Material& material, std::shared_ptr<const TexturePicture> picture) {
    material.texture.alpha = picture->is_opaque         ? TextureAlpha::Opaque
                             : is_transparent(material) ? TextureAlpha::Blend
                                                        : TextureAlpha::Mask;
    material.texture.picture = std::move(picture);
}

} // namespace octant::models
