#pragma once

#include "models/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/scene/aircraft_hull.h"
#include "visuals/scene/camera_rig.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// A part of a model's index buffer.
struct IndexRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    int polygons = 0;
};

/// A polygon model as drawn: one vertex a polygon corner, in the order of
/// PolygonModel::corner_vertices, with the polygon's own normal and colour
/// (flat shading), one index buffer that holds the list of every draw cell and, behind them, all
/// polygons in file order.
struct AircraftModel {
    models::PolygonModel polygons;
    draworder::DrawOrder order;
    ModelBuffers buffers;
    std::vector<IndexRange> cells; ///< one for each cell of the order
    IndexRange file_order;
    std::vector<std::uint32_t> file_list; ///< 0, 1, 2, ...: what file_order draws
    HullExtent hull;
    Subject subject;
};

/// Makes a model ready to be drawn. `pilot_eye_m`: body axes. Loading work.
AircraftModel aircraft_model(
    models::PolygonModel polygons, draworder::DrawOrder order, const glm::dvec3& pilot_eye_m);

/// Where the pilot's eye is in an aircraft, body axes: a stated point for the built-in "f15" and
/// "500md", else a quarter of the length behind the nose at the height of the top.
glm::dvec3 pilot_eye_m(const models::PolygonModel& model);

} // namespace octant::visuals::scene
