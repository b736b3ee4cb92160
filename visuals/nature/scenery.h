#pragma once

#include "visuals/nature/daylight.h"
#include "visuals/nature/ground_decoration.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>

namespace octant::visuals::nature {

/// The ground that bears scenery.
struct SceneryGround {
    glm::dvec2 first_m{0.0}; ///< the first sample, world axes
    glm::ivec2 samples{0};   ///< columns and rows
    double spacing_m = 30.0; ///< between samples
    Daylight day;
    std::function<SceneryDensity(int column, int row)> density_at; ///< at a sample
    bool has_shadows = true;                                       ///< whether things cast shadows
};

/// Trees, shrubs and houses of few polygons near the eye. Positions depend on the ground alone: each lies well within
/// one triangle of every mesh of the sample grid, so that an item can be painted right after its triangle. Items are
/// cached.
std::unique_ptr<GroundDecoration> scenery_decoration(SceneryGround ground);

} // namespace octant::visuals::nature
