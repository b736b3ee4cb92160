#pragma once

#include "models/polygons/polygon_model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::planar {

/// A corner of one polygon that lies on a side of another, between its ends: a T-junction.
struct TJunction {
    std::size_t corner = 0; ///< of PolygonModel::corner_vertices, where the side begins
    std::uint32_t vertex = 0;
    double share = 0.0; ///< of the side that lies before it, 0 to 1
};

/// All corners that lie within twice the touching_reach of a side of a polygon of the same turning part: polygon after
/// polygon, along its sides; of corners in one place only one.
std::vector<TJunction> t_junctions(const polygons::PolygonModel& model);

} // namespace octant::models::planar
