#include "sim/hidden_height.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/planning/mesh_levels.h"
#include "visuals/planning/planner.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

// Where each aircraft of a frame is, and as what it is drawn: polygons in the order of its eye
// point, a level of detail or a mesh refined for this frame.

namespace octant::visuals::planning {

namespace {

/// What the boxes around aircraft are made wider by, so that rounding leaves nothing outside: wider
/// ones only cost time.
constexpr double hull_margin_px = 0.25;
constexpr double hull_margin_m = 0.01;

glm::dmat4 body_to_eye_world(const sim::AircraftState& state, const glm::dvec3& eye_m) {
    glm::dmat4 matrix(glm::mat3_cast(state.body_to_world));
    matrix[3] = glm::dvec4(state.position_m - eye_m, 1.0);
    return matrix;
}

/// The state as it is seen over a round earth: sunk as far as the ground below it.
sim::AircraftState sunk(sim::AircraftState state, const glm::dvec3& eye_m, double earth_radius_m) {
    if (earth_radius_m > 0.0) {
        const glm::dvec2 level_m(state.position_m - eye_m);
        state.position_m.z -= glm::dot(level_m, level_m) / (2.0 * earth_radius_m);
    }
    return state;
}

scene::Tints tints_of(const PlacedAircraft& aircraft, scene::ModelLook look) {
    const AircraftModel& model = *aircraft.model;
    if (look == scene::ModelLook::None ||
        (look == scene::ModelLook::Levels && is_refined(aircraft))) {
        return {};
    }
    if (look == scene::ModelLook::Shading) {
        return scene::shading_tints;
    }
    const double radius_m =
        model.progressive ? model.progressive->half_diagonal_m() : model.subject.radius_m;
    const double error_m =
        is_far(aircraft) ? aircraft.far_error_m : model.errors_m[aircraft.representation];
    const std::uint32_t colour = scene::level_colour(error_m, radius_m);
    return {colour, colour};
}

} // namespace

void Planner::place_and_refine(const PlanRequest& request) {
    const scene::Camera& camera = request.camera;
    pixel_rad_ = 1.0 / focal_px(camera, settings_.view.size_px.y);
    frustum_ = frustum_normals(camera, aspect_);
    turned_ = request.turned;
    place_aircraft(camera, request.states);
    refine_meshes(camera);
    if (request.when_refined) {
        request.when_refined();
    }
}

/// Decides where each aircraft is, which list it is painted by and which box stands in for it.
void Planner::place_aircraft(
    const scene::Camera& camera, std::span<const sim::AircraftState> states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
        const sim::AircraftState state = sunk(states[i], camera.eye_m, mesher_->earth_radius_m());
        placed_[i].is_hidden = sim::is_hidden_at(states[i].position_m.z);
        place(placed_[i], state, camera.eye_m);
        const glm::dvec3 position_m = state.position_m - camera.eye_m;
        const double margin_m =
            hull_margin_m + hull_margin_px * pixel_rad_ * glm::length(position_m);
        HullExtent extent = placed_[i].model->hull;
        if (i < effects_.size() && !effects_[i].empty()) {
            extent.least_m = glm::min(extent.least_m, effects_[i].extent().least_m);
            extent.most_m = glm::max(extent.most_m, effects_[i].extent().most_m);
        }
        hulls_[i] = placed_hull(extent, position_m, state.body_to_world, margin_m);
    }
    if (placed_.size() > states.size()) {
        sim::AircraftState around_eye = states.front();
        around_eye.position_m = camera.eye_m;
        place(placed_.back(), around_eye, camera.eye_m);
    }
}

void Planner::place(
    PlacedAircraft& aircraft, const sim::AircraftState& state, const glm::dvec3& eye_m) {
    choose_model(aircraft, glm::length(state.position_m - eye_m));
    const AircraftModel& model = *aircraft.model;
    const auto parts =
        std::span(parts_).subspan(aircraft.first_part, model.polygons.pivots.size() + 1);
    place_parts(model.polygons, body_to_eye_world(state, eye_m), state.time_s, parts);
    const auto number = static_cast<std::size_t>(&aircraft - placed_.data());
    const models::polygons::PolygonModel& numbered =
        aircraft.far_model == nullptr ? model.polygons : aircraft.near_model->polygons;
    for (const TurnedPart& turned : turned_) {
        if (turned.aircraft == number) {
            place_turned_part(model.polygons, numbered, turned, parts);
        }
    }
    const glm::dvec3 eye_in_body_m =
        draworder::eye_in_body(eye_m, state.position_m, state.body_to_world);
    aircraft.cell = model.order.one_cell_an_eye() ? model.order.cell_of(eye_in_body_m) : 0;
    represent(aircraft);
    aircraft.tints = tints_of(aircraft, settings_.shading.show_model);
    choose_ranges(aircraft, eye_in_body_m);
    aircraft.polygon_count = 0;
    for (const scene::IndexRange& range : aircraft.ranges) {
        aircraft.polygon_count += range.polygons;
    }
}

/// Chooses between an aircraft's own model and the one that stands in for it, by the rule for
/// levels of detail.
void Planner::choose_model(PlacedAircraft& aircraft, double distance_m) const {
    if (aircraft.far_model == nullptr) {
        return;
    }
    const double nearest_m = std::max(distance_m - aircraft.near_model->subject.radius_m, 0.0);
    const std::array errors_m{0.0, aircraft.far_error_m};
    const bool far = chosen_level(
                         errors_m,
                         settings_.surface.aircraft_error_px * pixel_rad_ * nearest_m,
                         is_far(aircraft) ? 1 : 0) == 1;
    aircraft.model = far ? aircraft.far_model : aircraft.near_model;
    aircraft.model_index = far ? aircraft.far_index : aircraft.near_index;
    aircraft.parts =
        std::span(parts_).subspan(aircraft.first_part, aircraft.model->polygons.pivots.size() + 1);
}

/// Chooses what of an aircraft's index buffer is drawn; of a refined mesh and of one that is not
/// there nothing.
void Planner::choose_ranges(PlacedAircraft& aircraft, const glm::dvec3& eye_in_body_m) {
    const AircraftModel& model = *aircraft.model;
    aircraft.ranges.clear();
    aircraft.list = {};
    if (aircraft.is_hidden) {
        return;
    }
    if (is_solid(aircraft)) {
        if (!is_refined(aircraft)) {
            aircraft.ranges.push_back(model.levels[aircraft.representation].range);
        }
        return;
    }
    if (settings_.surface.hidden_surface != scene::HiddenSurface::Octant) {
        aircraft.list = model.file_list;
        aircraft.ranges.push_back(model.file_order);
        return;
    }
    aircraft.list = model.order.polygons();
    for (const auto& range : model.order.ranges_of(eye_in_body_m, walk_)) {
        aircraft.ranges.push_back(index_range(model, range));
    }
}

/// Chooses the coarsest representation that is as good as asked for; out of view the coarsest of
/// all.
void Planner::represent(PlacedAircraft& aircraft) {
    const AircraftModel& model = *aircraft.model;
    if (model.as_polygons() == 0) {
        return;
    }
    const glm::dvec3 place_m(aircraft.parts[0][3]);
    const double radius_m = model.subject.radius_m;
    if (aircraft.is_hidden || !scene::in_view(place_m, radius_m, frustum_)) {
        aircraft.representation = model.as_polygons();
        aircraft.is_represented = false; // what it is when it comes back into view is chosen anew
        return;
    }
    const double nearest_m = std::max(glm::length(place_m) - radius_m, 0.0);
    aircraft.representation = static_cast<std::size_t>(chosen_level(
        model.errors_m,
        settings_.surface.aircraft_error_px * pixel_rad_ * nearest_m,
        aircraft.is_represented ? static_cast<int>(aircraft.representation) : -1));
    aircraft.is_represented = true;
}

/// Refines the meshes of the aircraft that are drawn as meshes; those drawn as polygons keep theirs
/// as they are.
void Planner::refine_meshes(const scene::Camera& camera) {
    const RefineLook look{frustum_, camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0), pixel_rad_};
    refine_splits_ = 0;
    refine_collapses_ = 0;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
        const bool before = was_refined_[i] != 0;
        was_refined_[i] = is_refined(placed_[i]) ? 1 : 0;
        if (is_refined(placed_[i])) {
            const refine::RefinedFrame frame =
                refined_[i]->update(placed_[i].parts[0], look, !before);
            refine_splits_ += static_cast<int>(frame.splits);
            refine_collapses_ += static_cast<int>(frame.collapses);
            placed_[i].polygon_count = refined_[i]->triangles();
        }
    }
}

} // namespace octant::visuals::planning
