#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::planar {

/// The places that lie on one polygon.
struct Incidence {
    std::vector<std::uint32_t> corners;  ///< of the outline, in order, each once
    std::vector<std::uint32_t> touching; ///< others within the reach of plane and outline, ascending
};

/// Which places lie on which polygons. `places[v]` is the place of vertex v as one_place() gives it, `kind[v]`
/// separates vertices that never touch each other's polygons. Lengths are in the unit of `vertices`.
std::vector<Incidence> incidences_of(const polygons::PolygonModel& model, std::span<const glm::dvec3> vertices,
    std::span<const std::uint32_t> places, std::span<const std::uint32_t> kind, double reach);

} // namespace octant::models::planar
