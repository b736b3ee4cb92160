#include "ui/flight/live_flight.h"

#include "sim/hidden_height.h"
#include "ui/flight/cigi_atmosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

constexpr std::size_t no_aircraft = std::numeric_limits<std::size_t>::max();

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
    , world_(world)
    , place_(world, options.height)
    , cigi_ground_(world, place_)
    , traffic_(
          [this](const sim::links::VehicleKey& key, const sim::links::Fix& fix) {
              return place_.world_position(key, fix);
          },
          &cigi_ground_,
          ellipsoid_below(world.ground_place)) {}

void LiveFlight::states_at(double time_s, std::span<sim::AircraftState> states) {
    vehicle_states_.resize(states.size());
    const std::size_t shown = options_.step ? traffic_.show_newest(time_s, vehicle_states_)
                                            : traffic_.show(time_s, options_.delay_s, vehicle_states_);
    assign_aircraft(shown);
    for (std::size_t i = 1; i < states.size(); ++i) {
        states[i].position_m = glm::dvec3(0.0, 0.0, sim::absent_height_m);
    }
    for (std::size_t i = 0; i < shown; ++i) {
        states[slots_[i].aircraft] = vehicle_states_[i];
    }
    for (sim::AircraftState& state : states) {
        state.time_s = time_s;
    }
    turn_parts(time_s);
}

bool LiveFlight::is_flown(std::size_t aircraft) const {
    return std::ranges::find(slots_, aircraft, &VehicleSlot::aircraft) != slots_.end();
}

/// The aircraft that shows what this vehicle is said to be: the free ones from its own number on,
/// for entities of a type that has a shape those of that shape first.
std::size_t
LiveFlight::free_aircraft(const sim::links::VehicleKey& key, std::optional<std::uint16_t> type) const {
    const std::vector<std::uint32_t>& models = world_.scene.aircraft;
    const bool has_number =
        key.protocol == sim::links::Protocol::Cigi && key.vehicle < models.size();
    const std::size_t first = has_number ? static_cast<std::size_t>(key.vehicle) : 0;
    std::optional<std::size_t> any;
    const auto shape = type ? options_.shapes.find(*type) : options_.shapes.end();
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::size_t place = (first + i) % models.size();
        if (is_flown(place)) {
            continue;
        }
        if (shape == options_.shapes.end() || models[place] == models.at(shape->second)) {
            return place;
        }
        any = any.value_or(place);
    }
    return *any;
}

/// Gives the first vehicles an aircraft each; those that have one keep it while they are of one
/// type.
void LiveFlight::assign_aircraft(std::size_t vehicles) {
    for (std::size_t i = 0; i < vehicles; ++i) {
        const sim::links::VehicleKey& key = traffic_.vehicles()[i].key();
        const bool is_entity = key.protocol == sim::links::Protocol::Cigi;
        const auto type = is_entity
                              ? traffic_.cigi().type_of(static_cast<std::uint16_t>(key.vehicle))
                              : std::nullopt;
        if (i == slots_.size()) {
            slots_.push_back({no_aircraft, type});
            slots_[i].aircraft = free_aircraft(key, type);
        } else if (type && type != slots_[i].type && !options_.shapes.empty()) {
            slots_[i] = {no_aircraft, type};
            slots_[i].aircraft = free_aircraft(key, type);
        }
    }
}

/// The aircraft that shows an entity of a CIGI host.
std::optional<std::size_t> LiveFlight::aircraft_of(std::uint16_t entity) const {
    const auto vehicles = traffic_.vehicles();
    const auto found =
        std::ranges::find_if(vehicles, [entity](const sim::links::LiveVehicle& vehicle) {
            return vehicle.key().protocol == sim::links::Protocol::Cigi &&
                   vehicle.key().vehicle == entity;
        });
    const auto number = static_cast<std::size_t>(found - vehicles.begin());
    return number < slots_.size() ? std::optional(slots_[number].aircraft) : std::nullopt;
}

/// Turns the articulated parts; in steps as far as their packets say and no further.
void LiveFlight::turn_parts(double time_s) {
    turned_.clear();
    const double times_s = options_.step ? 0.0 : time_s - options_.delay_s;
    for (const sim::links::CigiPartPose& part : traffic_.cigi().parts().turned(times_s)) {
        if (const auto aircraft = aircraft_of(part.entity)) {
            turned_.push_back(
                {static_cast<std::uint32_t>(*aircraft), part.part, part.turn, part.offset_m});
        }
    }
}

scene::AirSettings LiveFlight::air_of(const scene::AirSettings& own) const {
    const sim::links::CigiImageGenerator& cigi = traffic_.cigi();
    return air_from_cigi(own, cigi.atmosphere(), cigi.celestial(), place_.origin());
}

std::vector<std::string> LiveFlight::lines() const {
    std::vector<std::string> lines = traffic_.lines();
    const std::vector<std::string> of_place = place_.lines();
    lines.insert(lines.end(), of_place.begin(), of_place.end());
    for (const VehicleSlot& place : slots_) {
        if (place.type && !options_.shapes.empty() && !options_.shapes.contains(*place.type)) {
            lines.push_back(fmt::format(
                "CIGI: --entities has no entity type {}: it is shown as {}",
                *place.type,
                world_.scene.model_of(place.aircraft).polygons.name));
            break;
        }
    }
    if (const auto line = frustum_line()) {
        lines.push_back(*line);
    }
    return lines;
}

void LiveFlight::fill_in(report::FrameRecord& record, double finished_s) {
    const sim::links::TrafficCounts& now = traffic_.counts();
    const auto since = [&](long sim::links::TrafficCounts::*count) {
        return static_cast<int>(now.*count - reported_counts_.*count);
    };
    record.packets = since(&sim::links::TrafficCounts::accepted);
    if (now.lost) {
        record.packets_lost = static_cast<double>(*now.lost - reported_counts_.lost.value_or(0));
    }
    record.packets_late = since(&sim::links::TrafficCounts::late);
    record.packets_wrong = since(&sim::links::TrafficCounts::wrong);
    reported_counts_ = now;
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
