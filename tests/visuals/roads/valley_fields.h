#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <functional>

namespace octant::tests {

using HeightAt = std::function<double(const glm::dvec2& at_m)>;

/// A square field around the origin, 25 m from sample to sample.
models::heights::HeightField field_of(int samples, const HeightAt& height_m);

/// Two basins side by side, 300 m deep, between them a ridge from south to north with one pass at y = 2,000 m.
double two_basins(const glm::dvec2& at_m);

} // namespace octant::tests
