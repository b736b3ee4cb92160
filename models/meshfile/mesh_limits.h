#pragma once

#include <cstddef>

namespace octant::models::meshfile {

inline constexpr std::size_t max_polygon_corners = 10'000;

/// Of a coordinate: what is larger is a fault of the file in any unit of length.
inline constexpr double max_coordinate = 1e12;

} // namespace octant::models::meshfile
