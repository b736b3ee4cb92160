#pragma once

#include <glm/vec3.hpp>

namespace octant::models {

// Display values: the colours of this project. A part of red, green or blue, 0..1, that goes to the screen as it is,
// times 255: non-linear in light, encoded as sRGB (IEC 61966-2-1) says. Files of models give them so, but for glTF,
// whose colours are linear in light by its specification.

/// Display values of parts that are linear in light, 0..1 each.
glm::dvec3 srgb_from_linear(const glm::dvec3& linear);

/// Parts linear in light of display values, 0..1 each. In double, so that a float comes back to the bit.
glm::dvec3 linear_from_srgb(const glm::dvec3& display);

} // namespace octant::models
