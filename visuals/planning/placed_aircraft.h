#pragma once

#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/frame_view.h"

#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// What one aircraft of a view can be drawn as, and where its data begins in the lists of a frame plan. The same in all
/// frames.
struct ViewedAircraft {
    /// Index into Scene::aircraft; the cockpit has the number after the last aircraft.
    std::uint32_t number = 0;
    /// AircraftDraw::object; the cockpit has that of the first aircraft.
    std::uint32_t object = 1;
    const AircraftModel* near_model = nullptr;
    const AircraftModel* far_model = nullptr; ///< FarModel; null = near_model is drawn at any distance.
    std::uint32_t near_index = 0;             ///< Index into Scene::models, as far_index.
    std::uint32_t far_index = 0;
    double far_error_m = 0.0;
    /// Index into FramePlan::parts.
    std::uint32_t first_part = 0;
    /// As AircraftDraw::first_smooth. Set by SmoothChoice.
    std::uint32_t first_smooth = 0;
};

/// The disc of a rotor in one frame.
struct PlacedDisc {
    std::uint32_t disc = 0; ///< Index into AircraftModel::discs.
    std::size_t side = 0;   ///< Index into RotorDisc::sides: the one that the eye sees.
    /// It is painted before this one of PlacedAircraft::ranges, or after the last one.
    std::size_t range = 0;
};

/// One aircraft as it is in one frame. Fleet writes all members but those of ViewedAircraft anew in each frame.
struct PlacedAircraft : ViewedAircraft {
    const AircraftModel* model = nullptr; ///< near_model or far_model.
    std::uint32_t model_index = 0;
    /// Body axes to world axes with the eye at the origin: the body, then each pivot turned.
    std::span<const glm::dmat4> parts;
    /// The same of far_model where the aircraft is drawn as near_model; empty if it has none.
    std::span<const glm::dmat4> far_parts;
    /// True if the aircraft is absent (AircraftState::is_present): nothing of it is drawn.
    bool is_absent = false;
    /// The cell of the draw order in which the eye is; 0 unless DrawOrder::has_one_cell_per_eye.
    int cell = 0;
    /// Index into AircraftModel::errors_m.
    std::size_t representation = 0;
    /// The ranges of the model's index buffer that are drawn, one after the other; of a refined mesh only its glass.
    std::vector<scene::IndexRange> ranges;
    /// The discs that are seen: in painting order; of an aircraft that is drawn by depth from far to near.
    std::vector<PlacedDisc> discs;
    /// For each of AircraftModel::discs how strong it is: below 1 its blades are drawn, at 0 they alone.
    std::vector<float> disc_strengths;
    std::vector<float> far_disc_strengths; ///< The same of far_parts.
    /// The polygon numbers in the order of the index buffer: IndexRange::first_polygon is an index into it. Empty for a
    /// mesh.
    std::span<const std::uint32_t> list;
    /// The polygons of all ranges; of a refined mesh its triangles.
    int polygon_count = 0;
    scene::PolygonTints tints{};
};

/// Whether an aircraft is drawn as its far model.
inline bool is_far(const PlacedAircraft& aircraft) {
    return aircraft.far_model != nullptr && aircraft.model == aircraft.far_model;
}

/// Whether an aircraft is drawn as a mesh, which has no painting order: its hidden surfaces are removed by depth.
inline bool is_mesh(const PlacedAircraft& aircraft) {
    return aircraft.representation < aircraft.model->polygon_representation();
}

/// Whether that mesh is one that is refined in each frame.
inline bool is_refined(const PlacedAircraft& aircraft) {
    return is_mesh(aircraft) && aircraft.model->progressive != nullptr;
}

inline bool is_glass(const scene::IndexRange& range) { return range.opacity < 1.0F; }

/// Whether something of an aircraft is transparent.
inline bool has_glass(const PlacedAircraft& aircraft) { return std::ranges::any_of(aircraft.ranges, is_glass); }

/// Writes the corners of a polygon of an aircraft, in world axes with the eye at the origin, to `placed`.
void place_polygon(const PlacedAircraft& aircraft, std::uint32_t polygon, ViewPolygon& placed);

/// The same of a model whose parts are placed by these matrices.
void place_polygon(
    const AircraftModel& model, std::span<const glm::dmat4> parts, std::uint32_t polygon, ViewPolygon& placed);

/// The draw of a part of an aircraft's ranges; valid as long as these.
scene::AircraftDraw draw_of(const PlacedAircraft& aircraft, std::span<const scene::IndexRange> ranges);

/// The draw of a whole aircraft; valid as long as the aircraft and its ranges.
inline scene::AircraftDraw draw_of(const PlacedAircraft& aircraft) { return draw_of(aircraft, aircraft.ranges); }

/// The draw of a part of its model's index buffer.
scene::AircraftDraw draw_of(const PlacedAircraft& aircraft, std::uint32_t first_index, std::uint32_t index_count);

/// The body matrix of an aircraft and one matrix for each pivot of its model, at a time.
void place_parts(const models::polygons::PolygonModel& model, const glm::dmat4& body_to_eye_world, double time_s,
    std::span<glm::dmat4> parts);

/// Moves parts as the controls stand. `parts`: AircraftModel::part_count() matrices, the first ones those of
/// place_parts().
void move_parts(const AircraftModel& model, const models::ControlPositions& positions, std::span<glm::dmat4> parts);

/// The pivot of `model` that turns the part of the name that `pivot` of `numbered` turns; past the end where there is
/// none.
std::size_t pivot_in(
    const models::polygons::PolygonModel& model, const models::polygons::PolygonModel& numbered, std::size_t pivot);

/// A circle in world axes with the eye at the origin.
struct WorldCircle {
    glm::dvec3 centre_m{0.0};
    glm::dvec3 axis{0.0, 0.0, 1.0}; ///< unit vector
    double radius_m = 0.0;
};

/// The disc `side` of RotorDisc::sides of a model whose parts are placed by these matrices; its axis is the pivot's.
WorldCircle place_disc(
    const AircraftModel& model, std::span<const glm::dmat4> parts, std::uint32_t disc, std::size_t side);

/// Turns and moves a part as a host program says; does nothing where the model has no such pivot. `part.pivot` is an
/// index into the pivots of `numbered`; in `model`, which may be its far model, the pivot of the same name turns.
/// `parts`: the result of place_parts().
void place_articulated_part(const models::polygons::PolygonModel& model, const models::polygons::PolygonModel& numbered,
    const ArticulatedPart& part, std::span<glm::dmat4> parts);

} // namespace octant::visuals::planning
