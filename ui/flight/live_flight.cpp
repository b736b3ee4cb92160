#include "ui/flight/live_flight.h"

#include "sim/base/axes.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

/// Where nobody sees an aircraft that nobody flies.
constexpr glm::dvec3 out_of_sight_m(0.0, 0.0, sim::links::LiveTraffic::hidden_m);
constexpr double usual_fov_rad = 0.785398163397448;

constexpr std::array<std::pair<LiveChannel, std::string_view>, 3> channels{
    {{LiveChannel::Front, "front"}, {LiveChannel::Left, "left"}, {LiveChannel::Right, "right"}}};

} // namespace

std::optional<LiveChannel> live_channel_from(std::string_view name) {
    const auto found =
        std::ranges::find(channels, name, [](const auto& each) { return each.second; });
    return found == channels.end() ? std::nullopt : std::optional(found->first);
}

std::string_view name_of(LiveChannel channel) {
    return channels.at(static_cast<std::size_t>(channel)).second;
}

LiveFlight::LiveFlight(const LiveOptions& options, const world::World& world)
    : options_(options)
    , place_(world, options.height)
    , cigi_ground_(world, place_)
    , traffic_(
          [this](const sim::links::VehicleKey& key, const sim::links::Fix& fix) {
              return place_.world_from(key, fix);
          },
          &cigi_ground_) {}

void LiveFlight::states_at(double time_s, std::span<sim::AircraftState> states) {
    of_vehicles_.resize(states.size());
    const std::size_t shown = options_.step ? traffic_.show_newest(time_s, of_vehicles_)
                                            : traffic_.show(time_s, options_.delay_s, of_vehicles_);
    give_places(shown, states.size());
    for (std::size_t i = 1; i < states.size(); ++i) {
        states[i].position_m = out_of_sight_m;
    }
    for (std::size_t i = 0; i < shown; ++i) {
        states[places_[i]] = of_vehicles_[i];
    }
    for (sim::AircraftState& state : states) {
        state.time_s = time_s;
    }
}

/// Gives the first vehicles an aircraft each; those that have one keep it.
void LiveFlight::give_places(std::size_t vehicles, std::size_t aircraft) {
    const auto is_taken = [this](std::size_t place) {
        return std::ranges::find(places_, place) != places_.end();
    };
    while (places_.size() < vehicles) {
        const sim::links::VehicleKey& key = traffic_.vehicles()[places_.size()].key();
        std::size_t place = 0;
        if (key.protocol == sim::links::Protocol::Cigi && key.vehicle < aircraft) {
            place = static_cast<std::size_t>(key.vehicle);
        }
        for (; is_taken(place); place = (place + 1) % aircraft) {
        }
        places_.push_back(place);
    }
}

/// The host's camera or the usual one, turned to this channel's side.
scene::Camera LiveFlight::camera(
    std::span<const sim::AircraftState> states, const scene::Camera& usual, double aspect) const {
    scene::Camera camera = camera_of_host(states).value_or(usual);
    if (options_.channel != LiveChannel::Front) {
        const double width_rad = 2.0 * std::atan(std::tan(0.5 * camera.vertical_fov_rad) * aspect);
        const double side = options_.channel == LiveChannel::Left ? 1.0 : -1.0;
        camera.view_to_world =
            camera.view_to_world * glm::angleAxis(side * width_rad, glm::dvec3(0.0, 1.0, 0.0));
    }
    return camera;
}

/// The lowest of a CIGI host's views, where he has told one: from its entity, turned and moved,
/// with the middle of its frustum ahead.
std::optional<scene::Camera>
LiveFlight::camera_of_host(std::span<const sim::AircraftState> states) const {
    const auto& views = traffic_.cigi().views();
    const auto& definitions = traffic_.cigi().definitions();
    if (views.empty()) {
        return std::nullopt;
    }
    const auto& [number, view] = *views.begin();
    const auto vehicles = traffic_.vehicles();
    const std::uint16_t entity = view.entity;
    const auto of_entity =
        std::ranges::find_if(vehicles, [entity](const sim::links::LiveVehicle& vehicle) {
            return vehicle.key().protocol == sim::links::Protocol::Cigi &&
                   vehicle.key().vehicle == entity;
        });
    const auto vehicle = static_cast<std::size_t>(of_entity - vehicles.begin());
    if (of_entity == vehicles.end() || vehicle >= places_.size()) {
        return std::nullopt;
    }
    const std::size_t index = places_[vehicle];
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
    const glm::dquat view_to_world = states[index].body_to_world * turned;
    const glm::dmat3 body_from_gl(
        glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(-1.0, 0.0, 0.0));
    camera.view_to_world = glm::normalize(view_to_world * glm::quat_cast(body_from_gl));
    camera.eye_m = states[index].position_m + states[index].body_to_world * view.offset_m;
    return camera;
}

std::vector<std::string> LiveFlight::lines() const {
    std::vector<std::string> lines = traffic_.lines();
    const std::vector<std::string> of_place = place_.lines();
    lines.insert(lines.end(), of_place.begin(), of_place.end());
    return lines;
}

void LiveFlight::fill_in(report::FrameRecord& record, double finished_s) {
    const sim::links::TrafficCounts& now = traffic_.counts();
    const auto since = [&](long sim::links::TrafficCounts::*count) {
        return static_cast<int>(now.*count - counted_.*count);
    };
    record.packets = since(&sim::links::TrafficCounts::accepted);
    record.packets_lost = since(&sim::links::TrafficCounts::lost);
    record.packets_late = since(&sim::links::TrafficCounts::late);
    record.packets_wrong = since(&sim::links::TrafficCounts::wrong);
    counted_ = now;
    if (traffic_.cigi().has_host()) {
        constexpr std::uint32_t positive = 0x7fffffff;
        record.host_frame = static_cast<int>(traffic_.cigi().host_frame() & positive);
    }
    record.stale = traffic_.is_stale() ? 1 : 0;
    if (!traffic_.vehicles().empty()) {
        record.jitter_ms = 1000.0 * traffic_.vehicles().front().clock().jitter_s();
    }
    if (record.packets > 0 && traffic_.newest_s() > newest_s_) {
        newest_s_ = traffic_.newest_s();
        record.latency_ms = 1000.0 * (finished_s - newest_s_);
    }
}

} // namespace octant::ui::flight
