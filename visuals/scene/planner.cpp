#include "visuals/scene/planner.h"

#include "visuals/draworder/octant_order.h"
#include "visuals/scene/facing.h"
#include "visuals/scene/ground_palette.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace octant::visuals::scene {

namespace {

/// Renderers round screen positions to 1/256 pixel. What is painted again is cut this much too wide
/// where only that rounding could tell, so that no line of the covered thing shows along the cut.
constexpr double rounding_px = 0.01;

/// A box may be wider without doing harm.
constexpr double hull_margin_px = 0.25;
constexpr double hull_margin_m = 0.01;

glm::dmat4 body_to_eye_world(const sim::AircraftState& state, const glm::dvec3& eye_m) {
    glm::dmat4 matrix(glm::mat3_cast(state.body_to_world));
    matrix[3] = glm::dvec4(state.position_m - eye_m, 1.0);
    return matrix;
}

/// The state as it is seen over a round earth: sunk as the ground below it.
sim::AircraftState sunk(sim::AircraftState state, const glm::dvec3& eye_m, double earth_radius_m) {
    if (earth_radius_m > 0.0) {
        const glm::dvec2 level_m(state.position_m - eye_m);
        state.position_m.z -= glm::dot(level_m, level_m) / (2.0 * earth_radius_m);
    }
    return state;
}

double distance_to_edge_m(const Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

} // namespace

Planner::Planner(Scene& scene, const Settings& settings)
    : scene_(scene)
    , settings_(settings)
    , aspect_(static_cast<double>(settings.size_px.x) / settings.size_px.y)
    , to_sun_(direction_to_sun(settings))
    , shadows_(to_sun_)
    , steps_(plan_) {
    plan_.background = settings.background;
    plan_.haze = {settings.background, static_cast<float>(settings.visibility_m)};
    plan_.hidden_surface = settings.hidden_surface;
    plan_.mesh_look = settings.show_mesh;
    plan_.sample_spacing_m = std::max(static_cast<float>(scene.ground->spacing_m()), 1e-3F);
    plan_.to_sun = glm::vec3(to_sun_);
    plan_.ambient = glm::vec3(ambient_light);
    plan_.sunlight = glm::vec3(sun_light);
    const auto add = [&](std::uint32_t model) {
        PlacedAircraft& aircraft = placed_.emplace_back();
        aircraft.model = &scene.models[model];
        aircraft.model_index = model;
        aircraft.first_part = static_cast<std::uint32_t>(parts_.size());
        parts_.resize(parts_.size() + aircraft.model->polygons.pivots.size() + 1);
    };
    for (const std::uint32_t model : scene.aircraft) {
        add(model);
    }
    if (scene.cockpit && settings.view == View::Cockpit) {
        add(*scene.cockpit);
    }
    for (PlacedAircraft& aircraft : placed_) {
        aircraft.parts = std::span(parts_).subspan(
            aircraft.first_part, aircraft.model->polygons.pivots.size() + 1);
    }
    hulls_.resize(scene.aircraft.size());
    near_to_far_.resize(scene.aircraft.size());
}

void Planner::settle(const Camera& camera) {
    scene_.ground->settle(camera, aspect_);
}

void Planner::prepare(const Camera& camera) {
    scene_.ground->prepare(camera, aspect_);
}

void Planner::set_triangle_target(int triangles) {
    scene_.ground->set_triangle_target(triangles);
}

const FramePlan& Planner::plan(
    const Camera& camera, std::span<const sim::AircraftState> states, PlanCounts& counts) {
    plan_.world_to_view = world_to_view(camera);
    plan_.view_to_clip = view_to_clip(camera, aspect_);
    pixel_rad_ = 2.0 * std::tan(camera.vertical_fov_rad / 2.0) / settings_.size_px.y;
    frustum_ = frustum_normals(camera, aspect_);
    if (scene_.ground_texture) {
        plan_.ground_texture = texture_places(*scene_.ground_texture, camera.eye_m);
    }
    plan_.aircraft.clear();
    plan_.steps.clear();
    plan_.clips.clear();
    plan_.repaint_indices.clear();
    plan_.overlay = {};
    GroundCounts ground_counts;
    ground_ = {scene_.ground->triangles(camera, aspect_, ground_counts), {}, {}};
    counts = {};
    counts.ground = ground_counts;
    place_aircraft(camera, states);
    write_parts();
    cast_shadows(camera);
    plan_ground();
    plan_sky(camera);
    if (settings_.view == View::Cockpit && settings_.head_up_display) {
        plan_head_up_display(camera, states.front());
    }
    count_aircraft(counts);
    counts.shadow_triangles = static_cast<int>(ground_.shadow_indices.size() / 3);
    if (settings_.hidden_surface == HiddenSurface::DepthBuffer) {
        paint_nearest_first();
    } else {
        paint_knots(camera, counts);
    }
    return plan_;
}

void Planner::plan_sky(const Camera& camera) {
    if (!settings_.sky) {
        return;
    }
    const Ground& ground = *scene_.ground;
    plan_.sky = sky_.around(
        {camera.eye_m.z - ground.mean_height_m(),
         distance_to_edge_m(ground, camera.eye_m),
         scene_.ground_texture ? scene_.ground_texture->mean_colour : ground.mean_colour(),
         ground.earth_radius_m()},
        plan_.haze);
}

/// Where each aircraft is, which list it is painted by and the box that stands in for it.
void Planner::place_aircraft(const Camera& camera, std::span<const sim::AircraftState> states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
        const sim::AircraftState state =
            sunk(states[i], camera.eye_m, scene_.ground->earth_radius_m());
        place(placed_[i], state, camera.eye_m);
        const glm::dvec3 position_m = state.position_m - camera.eye_m;
        const double margin_m =
            hull_margin_m + hull_margin_px * pixel_rad_ * glm::length(position_m);
        hulls_[i] = placed_hull(placed_[i].model->hull, position_m, state.body_to_world, margin_m);
    }
    if (placed_.size() > states.size()) {
        sim::AircraftState around_eye = states.front();
        around_eye.position_m = camera.eye_m;
        place(placed_.back(), around_eye, camera.eye_m);
    }
}

void Planner::place(
    PlacedAircraft& aircraft, const sim::AircraftState& state, const glm::dvec3& eye_m) {
    const AircraftModel& model = *aircraft.model;
    place_parts(
        model.polygons,
        body_to_eye_world(state, eye_m),
        state.time_s,
        std::span(parts_).subspan(aircraft.first_part, model.polygons.pivots.size() + 1));
    const int cell =
        model.order.cell_of(draworder::eye_in_body(eye_m, state.position_m, state.body_to_world));
    const bool by_cell = settings_.hidden_surface == HiddenSurface::Octant;
    aircraft.polygons = by_cell ? model.order.polygons_of(cell) : model.file_list;
    aircraft.range = by_cell ? model.cells[static_cast<std::size_t>(cell)] : model.file_order;
    aircraft.cell = cell;
}

void Planner::write_parts() {
    plan_.parts.resize(parts_.size());
    std::ranges::transform(
        parts_, plan_.parts.begin(), [](const glm::dmat4& part) { return glm::mat4(part); });
}

void Planner::cast_shadows(const Camera& camera) {
    shadows_.begin(ground_.all, plan_.shadow_vertices);
    if (settings_.shadows) {
        const ShadowView view{camera.eye_m, frustum_, pixel_rad_};
        for (std::size_t i = 0; i < hulls_.size(); ++i) {
            shadows_.cast(placed_[i], hulls_[i], *scene_.ground, view);
        }
        shadows_.sort_pieces();
    }
    ground_.shadows = shadows_.pieces();
    ground_.shadow_indices = shadows_.indices();
}

void Planner::plan_ground() {
    plan_.shadow_indices.clear();
    if (settings_.hidden_surface == HiddenSurface::DepthBuffer) {
        plan_.ground =
            facing_first(ground_.all, pixel_rad_, facing_indices_, plan_.edge_on_indices);
        plan_.shadow_indices.assign(ground_.shadow_indices.begin(), ground_.shadow_indices.end());
    } else {
        plan_.ground = facing_the_eye(ground_, pixel_rad_, facing_indices_);
    }
}

/// The cockpit, if any, is nearer than all.
void Planner::paint_nearest_first() {
    std::iota(near_to_far_.begin(), near_to_far_.end(), 0U);
    const auto distance2_m2 = [&](std::uint32_t i) {
        return glm::dot(hulls_[i].centre_m, hulls_[i].centre_m);
    };
    std::ranges::sort(near_to_far_, [&](std::uint32_t a, std::uint32_t b) {
        const double a_m2 = distance2_m2(a);
        const double b_m2 = distance2_m2(b);
        return a_m2 != b_m2 ? a_m2 < b_m2 : a < b;
    });
    if (placed_.size() > hulls_.size()) {
        steps_.paint(draw_of(placed_.back()));
    }
    for (const std::uint32_t i : near_to_far_) {
        steps_.paint(draw_of(placed_[i]));
    }
}

void Planner::paint_knots(const Camera& camera, PlanCounts& counts) {
    order_.arrange(hulls_);
    for (const Knot& knot : order_.knots()) {
        paint_knot(knot, camera, counts);
    }
    if (placed_.size() > hulls_.size()) {
        steps_.paint(draw_of(placed_.back()));
    }
}

/// Paints a knot and again what lies before it; nothing again where it is out of view.
void Planner::paint_knot(const Knot& knot, const Camera& camera, PlanCounts& counts) {
    members_.clear();
    for (const std::uint32_t member : order_.members(knot)) {
        members_.push_back(&placed_[member]);
    }
    if (!in_view(knot.box.centre_m, radius_m(knot.box), frustum_)) {
        for (const PlacedAircraft* member : members_) {
            steps_.paint(draw_of(*member));
        }
        return;
    }
    in_front_.find(knot.box, *scene_.ground, ground_.all, camera.eye_m);
    if (!in_front_.meeting().empty() || members_.size() > 1) {
        ++counts.knots;
        counts.cuts += repaint_.paint(
            members_, knot.box, ground_, in_front_.meeting(), rounding_px * pixel_rad_, steps_);
        counts.unordered += repaint_.given_up();
    } else {
        steps_.paint(draw_of(*members_.front()));
    }
    if (in_front_.found().empty() || holds_eye(knot.box)) {
        return;
    }
    // Not in the cone of a knot's box: between the members a farther knot may be seen before the
    // ground. What was painted earlier and is seen in a member's cone lies behind the member.
    for (const std::uint32_t member : order_.members(knot)) {
        steps_.paint_before(ground_, in_front_.found(), knot.box, cone_of(hulls_[member]));
        counts.cuts += static_cast<int>(in_front_.found().size());
    }
}

void Planner::plan_head_up_display(const Camera& camera, const sim::AircraftState& state) {
    HeadUpInputs inputs{state, state.position_m.z, {}};
    if (const auto ground_m = scene_.ground->height_at(state.position_m.x, state.position_m.y)) {
        inputs.height_above_ground_m = state.position_m.z - *ground_m;
    }
    plan_.overlay = head_up_display_.draw(inputs, camera, settings_.size_px);
}

void Planner::count_aircraft(PlanCounts& counts) const {
    for (const PlacedAircraft& aircraft : placed_) {
        counts.aircraft_polygons += aircraft.range.polygons;
    }
    counts.draw_cell = placed_.empty() ? 0 : placed_.front().cell;
}

} // namespace octant::visuals::scene
