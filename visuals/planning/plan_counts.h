#pragma once

#include "visuals/landscape/ground_mesher.h"

namespace octant::visuals::planning {

/// What one frame draws.
struct PlanCounts {
    landscape::GroundCounts ground;
    int aircraft_polygons = 0;
    /// The cell of the first aircraft's draw order in which the eye is; 0 where it has parts.
    int draw_cell = 0;
    /// Ground triangles and aircraft polygons painted again, cut by planes.
    int cuts = 0;
    /// Groups of aircraft that meet or stand in a ring, painted by polygons.
    int overlap_groups = 0;
    /// Aircraft painted by depth, as they meet each other or the ground in too many places.
    int unordered = 0;
    int shadow_triangles = 0;
    /// Triangles of roads and the runway; those of the ground have them among them, as what stands on it.
    int painted_triangles = 0;
    /// Triangles in view of clouds and all else that is seen through.
    int transparent_triangles = 0;
    /// Polygons of whole models and triangles of refined meshes, and those of them that are lit smoothly.
    int smoothable_polygons = 0;
    int smooth_polygons = 0;
    /// The representation of the first aircraft, 0 = the finest.
    int aircraft_level = 0;
    /// Vertex splits and edge collapses in all meshes that are refined.
    int refine_splits = 0;
    int refine_collapses = 0;
};

} // namespace octant::visuals::planning
