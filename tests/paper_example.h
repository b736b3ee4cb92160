#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <span>

namespace octant::tests {

/// Vertices V1 .. V14 and polygons P1 .. P10 of the 1989 paper's example (tables 2 and 3), its x, y, z taken as body
/// axes.
models::polygons::PolygonModel paper_example();

/// Whether lists of the example keep what its table 4 needs: in four octants one polygon once and before three others,
/// which are there once, too. `list_at` is the list for an eye in the octant of these signs.
bool keeps_table_4(const std::function<std::span<const std::uint32_t>(const glm::dvec3& signs)>& list_at);

} // namespace octant::tests
