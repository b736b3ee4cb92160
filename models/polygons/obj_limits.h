#pragma once

#include <cstddef>

namespace octant::models::polygons {

// What an OBJ file of polygons may hold at most. Files with more are refused.
inline constexpr std::size_t max_obj_vertices = 1'000'000;
inline constexpr std::size_t max_obj_polygons = 1'000'000;
inline constexpr std::size_t max_obj_corners_of_polygon = 1'000;
inline constexpr double max_obj_coordinate_m = 1e7;

} // namespace octant::models::polygons
