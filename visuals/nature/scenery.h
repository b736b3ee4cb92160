#pragma once

#include "visuals/nature/daylight.h"
#include "visuals/nature/ground_decoration.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>

namespace octant::visuals::nature {

/// What may stand at a sample of the ground.
using SceneryDensityAt = std::function<SceneryDensity(int column, int row)>;

/// Trees, shrubs and houses of few polygons near the eye, lit by a daylight. Samples lie `spacing_m` apart, the first
/// at `first_m` in world axes. Where things stand follows from the ground alone: at places of the sample grid that lie
/// well within one triangle in every mesh of it, so that each can be painted right after its triangle. What stands
/// where is remembered.
std::unique_ptr<GroundDecoration> scenery_decoration(const glm::dvec2& first_m, const glm::ivec2& samples,
    double spacing_m, const Daylight& day, SceneryDensityAt density_at);

} // namespace octant::visuals::nature
