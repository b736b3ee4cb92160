#pragma once

#include "visuals/nature/daylight.h"
#include "visuals/nature/ground_decoration.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>

namespace octant::visuals::nature {

/// The density of scenery at a sample of the ground.
using SceneryDensityAt = std::function<SceneryDensity(int column, int row)>;

/// Trees, shrubs and houses of few polygons near the eye. Samples lie `spacing_m` apart, the first at `first_m` in
/// world axes. Positions depend on the ground alone: each lies well within one triangle of every mesh of the sample
/// grid, so that an item can be painted right after its triangle. Items are cached.
std::unique_ptr<GroundDecoration> scenery_decoration(const glm::dvec2& first_m, const glm::ivec2& samples,
    double spacing_m, const Daylight& day, SceneryDensityAt density_at);

} // namespace octant::visuals::nature
