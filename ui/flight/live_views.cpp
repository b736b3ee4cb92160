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

constexpr double usual_fov_rad = 0.785398163397448;

double horizontal_fov_rad(double vertical_fov_rad, double aspect) {
    return 2.0 * std::atan(std::tan(0.5 * vertical_fov_rad) * aspect);
}

} // namespace

/// The host's camera or the usual one, turned to this channel's side.
scene::Camera LiveFlight::camera(
    std::span<const sim::AircraftState> states, const scene::Camera& usual, double aspect) const {
    const auto number = shown_view();
    scene::Camera camera =
        (number ? camera_of_view(*number, states) : std::nullopt).value_or(usual);
    if (options_.channel != LiveChannel::Front) {
        const double width_rad = horizontal_fov_rad(camera.vertical_fov_rad, aspect);
        const double side = options_.channel == LiveChannel::Left ? 1.0 : -1.0;
        camera.view_to_world =
            camera.view_to_world * glm::angleAxis(side * width_rad, glm::dvec3(0.0, 1.0, 0.0));
    }
    return camera;
}

/// The host's next view, where there is one.
scene::Camera LiveFlight::inset_camera(
    std::span<const sim::AircraftState> states,
    const scene::Camera& usual,
    double /*aspect*/) const {
    const auto& views = traffic_.cigi().views();
    const auto number = shown_view();
    const auto next = number ? views.upper_bound(*number) : views.end();
    return (next == views.end() ? std::nullopt : camera_of_view(next->first, states))
        .value_or(usual);
}

/// The view that was asked for or the lowest that the host has told.
std::optional<std::uint16_t> LiveFlight::shown_view() const {
    const auto& views = traffic_.cigi().views();
    if (options_.view) {
        return static_cast<std::uint16_t>(*options_.view);
    }
    return views.empty() ? std::nullopt : std::optional(views.begin()->first);
}

/// A view from its entity, turned and moved, with the middle of its frustum ahead.
std::optional<scene::Camera>
LiveFlight::camera_of_view(std::uint16_t number, std::span<const sim::AircraftState> states) const {
    const auto& views = traffic_.cigi().views();
    const auto& definitions = traffic_.cigi().definitions();
    const auto told = views.find(number);
    const auto aircraft = told == views.end() ? std::nullopt : aircraft_of(told->second.entity);
    if (!aircraft) {
        return std::nullopt;
    }
    const sim::links::CigiViewControl& view = told->second;
    const sim::AircraftState& state = states[*aircraft];
    EulerAngles angles = view.angles;
    scene::Camera camera;
    camera.vertical_fov_rad = usual_fov_rad;
    if (const auto defined = definitions.find(number); defined != definitions.end()) {
        const sim::links::CigiViewDefinition& frustum = defined->second;
        camera.vertical_fov_rad = frustum.top_rad - frustum.bottom_rad;
        angles.heading_rad += 0.5 * (frustum.left_rad + frustum.right_rad);
        angles.pitch_rad += 0.5 * (frustum.top_rad + frustum.bottom_rad);
    }
    // Body axes of the view (ahead, right, down) within those of the entity, then those of OpenGL.
    const glm::dquat north_up = body_to_world_from_euler({});
    const glm::dquat turned = glm::conjugate(north_up) * body_to_world_from_euler(angles);
    const glm::dquat view_to_world = state.body_to_world * turned;
    const glm::dmat3 body_from_gl(
        glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(-1.0, 0.0, 0.0));
    camera.view_to_world = glm::normalize(view_to_world * glm::quat_cast(body_from_gl));
    camera.eye_m = state.position_m + state.body_to_world * view.offset_m;
    return camera;
}

/// Where the host wants another shape of the picture than it has: it is as high as he says.
std::optional<std::string> LiveFlight::frustum_line() const {
    const auto number = shown_view();
    const auto& definitions = traffic_.cigi().definitions();
    const auto defined = number ? definitions.find(*number) : definitions.end();
    if (defined == definitions.end()) {
        return std::nullopt;
    }
    const sim::links::CigiViewDefinition& frustum = defined->second;
    const double high_rad = frustum.top_rad - frustum.bottom_rad;
    const double wanted_rad = frustum.right_rad - frustum.left_rad;
    const double wide_rad = horizontal_fov_rad(high_rad, aspect_);
    constexpr double same = 0.02;
    if (std::abs(wide_rad - wanted_rad) <= same * wanted_rad) {
        return std::nullopt;
    }
    return fmt::format(
        "CIGI: view {} is {:.1f} degrees wide and {:.1f} high; this picture is {:.1f} wide",
        *number,
        deg_from_rad(wanted_rad),
        deg_from_rad(high_rad),
        deg_from_rad(wide_rad));
}

} // namespace octant::ui::flight
