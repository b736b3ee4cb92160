#include "visuals/planning/fleet.h"

#include "visuals/draworder/octant_order.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/control_positions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

namespace octant::visuals::planning {

namespace {

/// The margin of bounding boxes, so that rounding leaves nothing outside. A larger one costs time only.
constexpr double hull_margin_px = 0.25;
constexpr double hull_margin_m = 0.01;

refine::ViewRefinerOptions refiner_options(const scene::Settings& settings) {
    refine::ViewRefinerOptions options;
    options.error_px = settings.surface.aircraft_error_px;
    options.geomorphs = settings.ground.geomorphs;
    return options;
}

glm::dmat4 body_to_eye_world(const sim::AircraftState& state, const glm::dvec3& eye_m) {
    glm::dmat4 matrix(glm::mat3_cast(state.body_to_world));
    matrix[3] = glm::dvec4(state.position_m - eye_m, 1.0);
    return matrix;
}

constexpr double absent_depth_m = 1e5;

scene::PolygonTints model_tints(const PlacedAircraft& aircraft, scene::ModelDisplay look) {
    const AircraftModel& model = *aircraft.model;
    if (look == scene::ModelDisplay::None || (look == scene::ModelDisplay::Levels && is_refined(aircraft))) {
        return {};
    }
    if (look == scene::ModelDisplay::Shading) { return shading_tints; }
    const double radius_m = model.progressive ? model.progressive->half_diagonal_m() : model.subject.radius_m;
    const double error_m = is_far(aircraft) ? aircraft.far_error_m : model.errors_m[aircraft.representation];
    const std::uint32_t colour = level_colour(error_m, radius_m);
    return {colour, colour};
}

/// The side of a disc that the eye sees.
std::size_t side_to_eye(const PlacedAircraft& aircraft, std::uint32_t disc) {
    const WorldCircle one = place_disc(*aircraft.model, aircraft.parts, disc, 0);
    const WorldCircle other = place_disc(*aircraft.model, aircraft.parts, disc, 1);
    return glm::dot(one.centre_m + other.centre_m, one.axis) < 0.0 ? 0 : 1;
}

/// Writes the matrices of the parts of an aircraft, drawn as a model, in a state, with the eye subtracted.
void place_all_parts(const PlacedAircraft& aircraft, const AircraftModel& model, const sim::AircraftState& state,
    const Fleet::PartPositions& positions, const glm::dvec3& eye_m, std::span<glm::dmat4> parts) {
    const models::polygons::PolygonModel& polygons = model.polygons;
    place_parts(polygons, body_to_eye_world(state, eye_m), state.time_s, parts.first(polygons.pivots.size() + 1));
    if (!model.moves.empty()) { move_parts(model, positions.controls, parts); }
    const models::polygons::PolygonModel& numbered =
        aircraft.far_model == nullptr ? polygons : aircraft.near_model->polygons;
    for (const ArticulatedPart& part : positions.articulated_parts) {
        if (part.aircraft == aircraft.number) { place_articulated_part(polygons, numbered, part, parts); }
    }
}

} // namespace

sim::AircraftState sunk(sim::AircraftState state, const glm::dvec3& eye_m, double earth_radius_m) {
    if (earth_radius_m > 0.0) {
        const glm::dvec2 level_m(state.position_m - eye_m);
        state.position_m.z -= glm::dot(level_m, level_m) / (2.0 * earth_radius_m);
    }
    return state;
}

Fleet::Fleet(const Scene& scene, const scene::Settings& settings) : scene_(scene), settings_(settings) {
    for (const std::uint32_t model : scene.aircraft) {
        add(model);
        placed_.back().object = placed_.back().number + 1;
    }
    bounding_boxes_.resize(placed_.size());
    if (scene.cockpit && settings.view.kind == scene::View::Cockpit) { add(*scene.cockpit); }
    for (const PlacedAircraft& aircraft : placed_) {
        const auto& progressive = aircraft.near_model->progressive;
        refined_.push_back(
            progressive ? std::make_unique<RefinedAircraft>(progressive, refiner_options(settings), settings.shading,
                              aircraft.near_model->progressive_textures, aircraft.near_model->creases)
                        : nullptr);
    }
    last_.resize(placed_.size());
    far_parts_.resize(placed_.size());
}

/// Adds an aircraft of a model, with memory for its parts and those of its far model.
void Fleet::add(std::uint32_t model) {
    PlacedAircraft& aircraft = placed_.emplace_back();
    aircraft.number = static_cast<std::uint32_t>(placed_.size() - 1);
    aircraft.model = scene_.models[model].get();
    aircraft.model_index = model;
    aircraft.near_model = aircraft.model;
    aircraft.near_index = model;
    aircraft.first_part = static_cast<std::uint32_t>(parts_.size());
    std::size_t parts = aircraft.model->part_count();
    const auto far = std::ranges::find(scene_.far_models, model, &FarModel::model);
    if (far != scene_.far_models.end()) {
        aircraft.far_model = scene_.models[far->far_model].get();
        aircraft.far_index = far->far_model;
        aircraft.far_error_m = far->error_m;
        parts = std::max(parts, aircraft.far_model->part_count());
    }
    parts_.resize(parts_.size() + parts);
}

void Fleet::place(
    const FrameView& view, const PlanRequest& request, std::span<const std::optional<AxisAlignedBox>> effect_bounds) {
    const glm::dvec3& eye_m = view.camera.eye_m;
    for (std::size_t i = 0; i < request.states.size(); ++i) {
        sim::AircraftState state = sunk(request.states[i], eye_m, view.earth_radius_m);
        placed_[i].is_absent = !state.is_present;
        // Far below the eye an absent aircraft has no shadow, no effects and no part in the painting order of others.
        if (!state.is_present) { state.position_m = eye_m - glm::dvec3(0.0, 0.0, absent_depth_m); }
        const models::ControlPositions controls =
            request.controls.empty() ? controls_of(placed_[i], request.states[i]) : request.controls[i];
        place(placed_[i], state, {controls, request.articulated_parts}, view);
        bounding_boxes_[i] = bounding_box_of(placed_[i], state, effect_bounds[i], view);
    }
    if (placed_.size() > request.states.size()) {
        sim::AircraftState around_eye = request.states.front();
        around_eye.position_m = eye_m;
        place(placed_.back(), around_eye, {{}, request.articulated_parts}, view);
    }
}

void Fleet::place_before(const FrameView& view, const PreviousFrame& before, std::span<glm::mat4> parts) const {
    const glm::dvec3& eye_m = view.camera.eye_m;
    std::vector<glm::dmat4> placed_parts;
    std::ranges::fill(parts, glm::mat4(0.0F));
    for (const PlacedAircraft& aircraft : placed_) {
        const bool is_cockpit = aircraft.number >= bounding_boxes_.size();
        const std::size_t number = is_cockpit ? 0 : aircraft.number;
        if (number >= before.states.size() || (!before.states[number].is_present && !is_cockpit)) { continue; }
        sim::AircraftState state = sunk(before.states[number], eye_m, view.earth_radius_m);
        if (is_cockpit) { state.position_m = eye_m; }
        placed_parts.resize(aircraft.parts.size());
        const PartPositions positions{controls_of(aircraft, before.states[number]), before.articulated_parts};
        place_all_parts(aircraft, *aircraft.model, state, positions, eye_m, placed_parts);
        std::ranges::transform(
            placed_parts, parts.begin() + aircraft.first_part, [](const glm::dmat4& part) { return glm::mat4(part); });
    }
}

models::ControlPositions Fleet::controls_of(const PlacedAircraft& aircraft, const sim::AircraftState& state) const {
    return aircraft.near_model->moves.empty() ? models::ControlPositions{} : control_positions(state, *scene_.ground);
}

OrientedBox Fleet::bounding_box_of(const PlacedAircraft& aircraft, const sim::AircraftState& state,
    const std::optional<AxisAlignedBox>& effects, const FrameView& view) const {
    const glm::dvec3 position_m = state.position_m - view.camera.eye_m;
    const double margin_m = hull_margin_m + hull_margin_px * view.pixel_rad * glm::length(position_m);
    AxisAlignedBox extent = aircraft.model->hull;
    if (effects) {
        extent.min_m = glm::min(extent.min_m, effects->min_m);
        extent.max_m = glm::max(extent.max_m, effects->max_m);
    }
    return placed_box(extent, position_m, state.body_to_world, margin_m);
}

void Fleet::place(
    PlacedAircraft& aircraft, const sim::AircraftState& state, const PartPositions& positions, const FrameView& view) {
    const glm::dvec3& eye_m = view.camera.eye_m;
    choose_model(aircraft, glm::length(state.position_m - eye_m), view);
    const AircraftModel& model = *aircraft.model;
    const auto parts = std::span(parts_).subspan(aircraft.first_part, model.part_count());
    aircraft.parts = parts;
    place_all_parts(aircraft, model, state, positions, eye_m, parts);
    aircraft.far_parts = {};
    if (aircraft.far_model != nullptr && !is_far(aircraft)) {
        std::vector<glm::dmat4>& far_parts = far_parts_[aircraft.number];
        far_parts.resize(aircraft.far_model->part_count());
        place_all_parts(aircraft, *aircraft.far_model, state, positions, eye_m, far_parts);
        aircraft.far_parts = far_parts;
        aircraft.far_disc_strengths = disc_strengths(aircraft, *aircraft.far_model, far_parts, positions, view);
    }
    const glm::dvec3 eye_in_body_m = draworder::eye_in_body(eye_m, state.position_m, state.body_to_world);
    aircraft.cell = model.order.has_one_cell_per_eye() ? model.order.cell_of(eye_in_body_m) : 0;
    aircraft.disc_strengths = disc_strengths(aircraft, model, parts, positions, view);
    choose_representation(aircraft, view);
    aircraft.tints = model_tints(aircraft, settings_.shading.show_model);
    choose_ranges(aircraft, eye_in_body_m);
    aircraft.polygon_count = 0;
    for (const scene::IndexRange& range : aircraft.ranges) { aircraft.polygon_count += range.polygons; }
}

/// Chooses between an aircraft's own model and its far model, by the rule for levels of detail.
void Fleet::choose_model(PlacedAircraft& aircraft, double distance_m, const FrameView& view) {
    if (aircraft.far_model == nullptr) { return; }
    const double nearest_m = std::max(distance_m - aircraft.near_model->subject.radius_m, 0.0);
    const std::array errors_m{0.0, aircraft.far_error_m};
    bool& far = last_[aircraft.number].is_far;
    far = select_level(errors_m, settings_.surface.aircraft_error_px * view.pixel_rad * nearest_m, far ? 1 : 0) == 1;
    aircraft.model = far ? aircraft.far_model : aircraft.near_model;
    aircraft.model_index = far ? aircraft.far_index : aircraft.near_index;
}

/// Chooses the coarsest representation within the error that is allowed; out of view the coarsest of all.
void Fleet::choose_representation(PlacedAircraft& aircraft, const FrameView& view) {
    const AircraftModel& model = *aircraft.model;
    if (model.polygon_representation() == 0) { return; }
    const glm::dvec3 place_m(aircraft.parts[0][3]);
    const double radius_m = model.subject.radius_m;
    if (aircraft.is_absent || !scene::in_view(place_m, radius_m, view.frustum)) {
        aircraft.representation = model.polygon_representation();
        last_[aircraft.number].representation.reset();
        return;
    }
    const double nearest_m = std::max(glm::length(place_m) - radius_m, 0.0);
    std::optional<std::size_t>& last = last_[aircraft.number].representation;
    aircraft.representation = static_cast<std::size_t>(select_level(model.errors_m,
        settings_.surface.aircraft_error_px * view.pixel_rad * nearest_m, last ? static_cast<int>(*last) : -1));
    last = aircraft.representation;
}

/// The strength, 0 to 1, of each disc of a model whose parts are placed by these matrices. It is 0 for rotors that a
/// host program holds, with the painting order of the 1989 paper, which holds at one angle alone, and without effects.
/// It falls to 0 for discs of few pixels.
std::vector<float> Fleet::disc_strengths(const PlacedAircraft& aircraft, const AircraftModel& model,
    std::span<const glm::dmat4> parts, const PartPositions& positions, const FrameView& view) const {
    std::vector<float> strengths(model.discs.size(), 0.0F);
    const scene::SurfaceSettings& surface = settings_.surface;
    if (surface.order_method == draworder::OrderMethod::Paper || surface.effects == false) { return strengths; }
    for (std::size_t i = 0; i < strengths.size(); ++i) {
        const RotorDisc& disc = model.discs[i];
        const bool is_held = std::ranges::any_of(positions.articulated_parts, [&](const ArticulatedPart& part) {
            return part.aircraft == aircraft.number && std::ranges::any_of(disc.pivots, [&](std::uint32_t pivot) {
                return pivot == pivot_in(model.polygons, aircraft.near_model->polygons, part.pivot);
            });
        });
        if (is_held) { continue; }
        const WorldCircle circle = place_disc(model, parts, static_cast<std::uint32_t>(i), 0);
        const double distance_m = std::max(glm::length(circle.centre_m), circle.radius_m);
        constexpr double faint_px = 3.0;
        constexpr double strong_px = 8.0;
        strengths[i] =
            static_cast<float>(glm::smoothstep(faint_px, strong_px, circle.radius_m / (view.pixel_rad * distance_m)));
    }
    return strengths;
}

/// Chooses the ranges of an aircraft's index buffer that are drawn, and the discs: of a mesh its level and its glass,
/// of a refined one its glass only, of an absent aircraft none. Without painting orders the order of a model with glass
/// has all that is opaque first (draworder::opaque_first).
void Fleet::choose_ranges(PlacedAircraft& aircraft, const glm::dvec3& eye_in_body_m) {
    const AircraftModel& model = *aircraft.model;
    aircraft.ranges.clear();
    aircraft.discs.clear();
    aircraft.list = {};
    if (aircraft.is_absent) { return; }
    const scene::HiddenSurface hidden_surface = settings_.surface.hidden_surface;
    if (is_mesh(aircraft)) {
        if (!is_refined(aircraft)) { aircraft.ranges.push_back(model.levels[aircraft.representation].range); }
        if (const auto& glass = model.glass) {
            append_ranges(glass->order, glass->first_indices, glass->opacity_runs, eye_in_body_m, aircraft);
        }
    } else if (hidden_surface != scene::HiddenSurface::Octant && model.opacity_runs.empty()) {
        aircraft.list = model.file_list;
        aircraft.ranges.push_back(model.file_order);
    } else {
        aircraft.list = model.order.polygons();
        append_ranges(model.order, model.first_indices, model.opacity_runs, eye_in_body_m, aircraft);
    }
    if (hidden_surface != scene::HiddenSurface::DepthBuffer && !is_mesh(aircraft)) { return; }
    aircraft.discs.clear();
    for (std::uint32_t disc = 0; disc < model.discs.size(); ++disc) {
        const std::size_t side = side_to_eye(aircraft, disc);
        const bool is_seen = model.discs[disc].sides[side].polygon != models::none;
        if (aircraft.disc_strengths[disc] > 0.0F && is_seen) { aircraft.discs.push_back({disc, side, 0}); }
    }
    std::ranges::stable_sort(aircraft.discs, std::ranges::greater(), [&](const PlacedDisc& one) {
        return glm::length(place_disc(model, aircraft.parts, one.disc, one.side).centre_m);
    });
}

/// Appends what an eye (body axes, metres) paints, the first painted first.
void Fleet::append_ranges(const draworder::DrawOrder& order, std::span<const std::uint32_t> first_indices,
    std::span<const OpacityRun> runs, const glm::dvec3& eye_in_body_m, PlacedAircraft& aircraft) {
    const auto add = [&](std::size_t first, std::size_t end, const OpacityRun& run) {
        const std::uint32_t index = first_indices[first];
        append_run(run,
            {index, first_indices[end] - index, static_cast<int>(end - first), static_cast<std::uint32_t>(first),
                run.opacity},
            aircraft);
    };
    for (const auto& range : order.ranges_of(eye_in_body_m, walk_)) {
        const std::size_t end = range.first + range.count;
        if (runs.empty()) {
            add(range.first, end, {});
            continue;
        }
        auto run = std::ranges::upper_bound(runs, range.first, {}, &OpacityRun::first);
        for (std::size_t first = range.first; first < end; ++run) {
            const std::size_t run_end = run == runs.end() ? end : std::min<std::size_t>(run->first, end);
            add(first, run_end, *std::prev(run));
            first = run_end;
            if (run == runs.end()) { break; }
        }
    }
}

/// Appends the polygons of a run, and the disc that is painted with them.
void Fleet::append_run(const OpacityRun& run, const scene::IndexRange& range, PlacedAircraft& aircraft) const {
    const float strength = run.disc == models::none ? 0.0F : aircraft.disc_strengths[run.disc];
    if (strength < 1.0F) { aircraft.ranges.push_back(range); }
    if (strength <= 0.0F) { return; }
    const std::size_t side = side_to_eye(aircraft, run.disc);
    if (run.has_side[side]) { aircraft.discs.push_back({run.disc, side, aircraft.ranges.size()}); }
}

void Fleet::forget_frames() {
    for (std::size_t i = 0; i < last_.size(); ++i) {
        if (last_[i].is_refined) { refined_[i]->forget_frames(); }
        last_[i] = {};
    }
}

void Fleet::refine(const FrameView& view) {
    splits_ = 0;
    collapses_ = 0;
    for (PlacedAircraft& aircraft : placed_) {
        const bool is_first = !std::exchange(last_[aircraft.number].is_refined, is_refined(aircraft));
        if (!is_refined(aircraft)) { continue; }
        RefinedAircraft& refined = *refined_[aircraft.number];
        const refine::RefinedFrame frame = refined.update(aircraft.parts[0], view, is_first);
        splits_ += static_cast<int>(frame.splits);
        collapses_ += static_cast<int>(frame.collapses);
        aircraft.polygon_count = refined.triangles();
    }
}

} // namespace octant::visuals::planning
