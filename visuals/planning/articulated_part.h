#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace octant::visuals::planning {

/// How a part of an aircraft is turned and moved in place of turning by itself. Painting order takes a part as if it
/// were not moved.
struct ArticulatedPart {
    /// Index into Scene::aircraft.
    std::uint32_t aircraft = 0;
    /// Index into PolygonModel::pivots of the aircraft's own model, not of one that stands in for it from afar.
    std::uint32_t pivot = 0;
    /// Within body axes. The part turns about its pivot's axis alone: as far as this turns about it.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    /// Along body axes.
    glm::dvec3 offset_m{0.0};
};

} // namespace octant::visuals::planning
