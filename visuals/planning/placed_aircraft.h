#pragma once

#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// One aircraft of one frame, where it is.
struct PlacedAircraft {
    /// Index into Scene::aircraft; a cockpit comes behind them.
    std::uint32_t number = 0;
    const AircraftModel* model = nullptr;
    std::uint32_t model_index = 0;
    /// What it may be drawn as: itself, and another one far away, where there is one.
    const AircraftModel* near_model = nullptr;
    const AircraftModel* far_model = nullptr;
    std::uint32_t near_index = 0;
    std::uint32_t far_index = 0;
    double far_error_m = 0.0;
    /// Polygons in the order of the index buffer: what IndexRange::first_polygon counts in. Empty for a mesh.
    std::span<const std::uint32_t> list;
    /// Of the index buffer: what is drawn of it, one range after the other. Keeps its memory.
    std::vector<scene::IndexRange> ranges;
    /// The polygons of all ranges; of a refined mesh its triangles.
    int polygon_count = 0;
    /// The cell of the draw order in which the eye is; 0 where the order has parts.
    int cell = 0;
    /// Whether it was in view in the last frame, and so had a representation to go on from.
    bool is_represented = false;
    /// True if the aircraft is absent (AircraftState::is_present): nothing of it is drawn.
    bool is_hidden = false;
    /// Index into AircraftModel::errors_m.
    std::size_t representation = 0;
    /// As AircraftDraw::first_smooth.
    std::uint32_t first_smooth = 0;
    scene::PolygonTints tints{};
    /// Index into FramePlan::parts.
    std::uint32_t first_part = 0;
    /// Body axes to world axes with the eye at the origin: the body, then each pivot turned.
    std::span<const glm::dmat4> parts;
};

/// Whether an aircraft is drawn as what stands in for it far away.
inline bool is_far(const PlacedAircraft& aircraft) {
    return aircraft.far_model != nullptr && aircraft.model == aircraft.far_model;
}

/// Whether an aircraft is drawn as a mesh, which has no painting order: its hidden surfaces are removed by depth.
inline bool is_mesh(const PlacedAircraft& aircraft) {
    return aircraft.representation < aircraft.model->polygons_from_mesh();
}

/// Whether that mesh is one that is refined in each frame.
inline bool is_refined(const PlacedAircraft& aircraft) {
    return is_mesh(aircraft) && aircraft.model->progressive != nullptr;
}

/// The corners of a polygon of an aircraft where it is; world axes with the eye at the origin.
void place_polygon(const PlacedAircraft& aircraft, std::uint32_t polygon, ViewPolygon& placed);

/// What a whole aircraft is drawn by; valid as long as the aircraft and its ranges.
scene::AircraftDraw draw_of(const PlacedAircraft& aircraft);

/// What a part of its index buffer is drawn by.
scene::AircraftDraw draw_of(const PlacedAircraft& aircraft, std::uint32_t first_index, std::uint32_t index_count);

/// The body matrix of an aircraft and one matrix for each pivot of its model, at a time.
void place_parts(const models::polygons::PolygonModel& model, const glm::dmat4& body_to_eye_world, double time_s,
    std::span<glm::dmat4> parts);

/// Turns and moves a part that somebody else turns; nothing where the model has no such pivot. `numbered` is the model
/// whose pivots `articulated_parts` counts: the part of the same name turns in `model`, which is the same or stands in
/// for it from afar. `parts` as place_parts() has them.
void place_articulated_part(const models::polygons::PolygonModel& model, const models::polygons::PolygonModel& numbered,
    const ArticulatedPart& articulated_parts, std::span<glm::dmat4> parts);

} // namespace octant::visuals::planning
