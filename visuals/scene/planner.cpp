#include "visuals/scene/planner.h"

#include "visuals/draworder/octant_order.h"
#include "visuals/scene/facing.h"
#include "visuals/scene/ground_colours.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::scene {

namespace {

glm::mat4 body_to_eye_world(const sim::AircraftState& state, const glm::dvec3& eye_m) {
    glm::mat4 matrix(glm::mat3_cast(glm::quat(state.body_to_world)));
    matrix[3] = glm::vec4(glm::vec3(state.position_m - eye_m), 1.0F);
    return matrix;
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
    , to_sun_(direction_to_sun(settings)) {
    plan_.background = settings.background;
    plan_.haze = {settings.background, static_cast<float>(settings.visibility_m)};
    plan_.hidden_surface = settings.hidden_surface;
    plan_.ground_is_ordered = scene.ground->is_ordered();
    plan_.ambient = glm::vec3(ambient_light);
    plan_.sunlight = glm::vec3(sun_light);
    plan_.aircraft.reserve(scene.aircraft.size() + 1);
}

void Planner::settle(const Camera& camera) {
    scene_.ground->settle(camera, aspect_);
}

const FramePlan& Planner::plan(
    const Camera& camera, std::span<const sim::AircraftState> states, PlanCounts& counts) {
    plan_.world_to_view = world_to_view(camera);
    plan_.view_to_clip = view_to_clip(camera, aspect_);
    plan_.ground = scene_.ground->triangles(camera, aspect_, counts.ground);
    if (!plan_.ground_is_ordered) {
        const double pixel_rad =
            2.0 * std::tan(camera.vertical_fov_rad / 2.0) / settings_.size_px.y;
        plan_.ground = facing_the_eye(plan_.ground, pixel_rad, facing_indices_);
    }
    plan_sky(camera);
    plan_aircraft(camera, states, counts);
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
         ground.mean_colour()},
        plan_.haze);
}

void Planner::plan_aircraft(
    const Camera& camera, std::span<const sim::AircraftState> states, PlanCounts& counts) {
    plan_.aircraft.clear();
    counts.aircraft_polygons = 0;
    const auto add = [&](std::uint32_t model,
                         const IndexRange& range,
                         const sim::AircraftState& state,
                         glm::mat4 matrix) {
        const glm::vec3 sun(glm::inverse(state.body_to_world) * to_sun_);
        plan_.aircraft.push_back({model, range.first_index, range.index_count, matrix, sun, 0, 0});
        counts.aircraft_polygons += range.polygons;
    };
    for (std::size_t i = 0; i < states.size(); ++i) {
        const sim::AircraftState& state = states[i];
        const AircraftModel& model = scene_.models[scene_.aircraft[i]];
        const int cell = model.order.cell_of(
            draworder::eye_in_body(camera.eye_m, state.position_m, state.body_to_world));
        counts.draw_cell = i == 0 ? cell : counts.draw_cell;
        const bool ordered = settings_.hidden_surface == HiddenSurface::Octant;
        add(scene_.aircraft[i],
            ordered ? model.cells[static_cast<std::size_t>(cell)] : model.file_order,
            state,
            body_to_eye_world(state, camera.eye_m));
    }
    // Farthest first.
    std::sort(
        plan_.aircraft.begin(),
        plan_.aircraft.end(),
        [](const AircraftDraw& a, const AircraftDraw& b) {
            const glm::vec3 pa(a.body_to_eye_world[3]);
            const glm::vec3 pb(b.body_to_eye_world[3]);
            return glm::dot(pa, pa) > glm::dot(pb, pb);
        });
    if (scene_.cockpit && settings_.view == View::Cockpit) {
        sim::AircraftState around_eye = states.front();
        around_eye.position_m = camera.eye_m;
        add(*scene_.cockpit,
            scene_.models[*scene_.cockpit].file_order,
            around_eye,
            body_to_eye_world(around_eye, camera.eye_m));
    }
}

} // namespace octant::visuals::scene
