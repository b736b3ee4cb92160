// The pictures that a host of CIGI asks for: its views from its entities.

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "ui/flight/live_flight.h"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <fmt/format.h>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

/// Right and upper side of a usual picture's plane at distance 1.
glm::dvec2 default_half_tangent(double aspect) {
    const double high = std::tan(0.5 * scene::Camera().vertical_fov_rad);
    return {high * aspect, high};
}

/// Gives a camera the frustum of a host's view; sides that the host has not told are the usual ones. Leaves it as it is
/// where sides meet.
void set_frustum(const sim::links::CigiViewDefinition& definition, double aspect, scene::Camera& camera) {
    const glm::dvec2 half = default_half_tangent(aspect);
    const auto side = [](bool is_given, double angle_rad, double default_camera) {
        return is_given ? std::tan(angle_rad) : default_camera;
    };
    const glm::dvec2 least(
        side(definition.sets.x, definition.left_rad, -half.x), side(definition.sets.w, definition.bottom_rad, -half.y));
    const glm::dvec2 most(
        side(definition.sets.y, definition.right_rad, half.x), side(definition.sets.z, definition.top_rad, half.y));
    const glm::dvec2 size = most - least;
    constexpr double narrowest = 1e-3;
    if (size.x < narrowest || size.y < narrowest) { return; }
    camera.vertical_fov_rad = 2.0 * std::atan(0.5 * size.y);
    camera.middle = 0.5 * (least + most);
    camera.pixel_aspect = size.x / (size.y * aspect);
}

double width_rad(const scene::Camera& camera, double aspect) {
    const double half = std::tan(0.5 * camera.vertical_fov_rad) * camera.pixel_aspect * aspect;
    return 2.0 * std::atan(half);
}

} // namespace

/// The host's camera or the usual one, turned to this channel's side.
scene::Camera LiveFlight::camera(
    std::span<const sim::AircraftState> states, const scene::Camera& default_camera, double aspect) const {
    const auto number = shown_view();
    scene::Camera camera = (number ? camera_of_view(*number, states, aspect) : std::nullopt).value_or(default_camera);
    if (options_.channel != LiveChannel::Front) {
        const double side = options_.channel == LiveChannel::Left ? 1.0 : -1.0;
        camera.view_to_world =
            camera.view_to_world * glm::angleAxis(side * width_rad(camera, aspect), glm::dvec3(0.0, 1.0, 0.0));
    }
    return camera;
}

/// The host's next view, where there is one.
scene::Camera LiveFlight::inset_camera(
    std::span<const sim::AircraftState> states, const scene::Camera& default_camera, double aspect) const {
    const auto& views = traffic_.cigi().views();
    const auto number = shown_view();
    const auto next = number ? views.upper_bound(*number) : views.end();
    return (next == views.end() ? std::nullopt : camera_of_view(next->first, states, aspect)).value_or(default_camera);
}

/// The view that was asked for or the lowest that the host has told.
std::optional<std::uint16_t> LiveFlight::shown_view() const {
    const auto& views = traffic_.cigi().views();
    if (options_.view) { return static_cast<std::uint16_t>(*options_.view); }
    return views.empty() ? std::nullopt : std::optional(views.begin()->first);
}

/// A view from its entity, turned and moved, with its frustum.
std::optional<scene::Camera> LiveFlight::camera_of_view(
    std::uint16_t number, std::span<const sim::AircraftState> states, double aspect) const {
    const auto& views = traffic_.cigi().views();
    const auto& definitions = traffic_.cigi().definitions();
    const auto definition = views.find(number);
    const auto aircraft = definition == views.end() ? std::nullopt : aircraft_of(definition->second.entity);
    if (!aircraft) { return std::nullopt; }
    const sim::links::CigiViewControl& view = definition->second;
    const sim::AircraftState& state = states[*aircraft];
    scene::Camera camera;
    if (const auto defined = definitions.find(number); defined != definitions.end()) {
        set_frustum(defined->second, aspect, camera);
    }
    // Body axes of the view (ahead, right, down) within those of the entity, then those of OpenGL.
    const glm::dquat north_up = body_to_world_from_euler({});
    const glm::dquat turned = glm::conjugate(north_up) * body_to_world_from_euler(view.angles);
    const glm::dquat view_to_world = state.body_to_world * turned;
    camera.view_to_world = glm::normalize(view_to_world * scene::body_from_view());
    camera.eye_m = state.position_m + state.body_to_world * view.offset_m;
    return camera;
}

/// Where the host wants a picture of another shape, or of another kind, than this is.
std::optional<std::string> LiveFlight::frustum_line() const {
    const auto number = shown_view();
    const auto& definitions = traffic_.cigi().definitions();
    const auto defined = number ? definitions.find(*number) : definitions.end();
    if (defined == definitions.end()) { return std::nullopt; }
    if (defined->second.parallel) {
        return fmt::format("CIGI: view {} is orthographic; it is shown in perspective", *number);
    }
    scene::Camera camera;
    set_frustum(defined->second, aspect_, camera);
    constexpr double same = 0.02;
    if (std::abs(camera.pixel_aspect - 1.0) <= same) { return std::nullopt; }
    return fmt::format("CIGI: view {} has the shape {:.2f}:1, this picture {:.2f}:1; pixels are {:.2f} times as "
                       "wide as high",
        *number, camera.pixel_aspect * aspect_, aspect_, camera.pixel_aspect);
}

} // namespace octant::ui::flight
