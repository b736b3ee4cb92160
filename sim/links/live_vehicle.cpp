#include "sim/links/live_vehicle.h"

#include "sim/base/axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::sim::links {

namespace {

constexpr double slowest_clock_mps = 3.0; ///< below, the way is no measure of time
constexpr int repeats_that_stand = 3;
constexpr double most_velocity_error = 0.3;

glm::dvec3 world_from_ned(const glm::dvec3& ned) {
    return {ned.y, ned.x, -ned.z};
}

/// How long a way takes at a velocity, where the way runs along it.
std::optional<double> time_along(const glm::dvec3& way_m, const glm::dvec3& velocity_mps) {
    const double speed2 = glm::dot(velocity_mps, velocity_mps);
    if (speed2 < slowest_clock_mps * slowest_clock_mps) {
        return std::nullopt;
    }
    const double time_s = glm::dot(way_m, velocity_mps) / speed2;
    const double aside_m = glm::length(way_m - time_s * velocity_mps);
    constexpr double most_aside = 0.2;
    constexpr double least_aside_m = 0.05;
    const bool along = aside_m <= most_aside * glm::length(way_m) + least_aside_m;
    return along ? std::optional(time_s) : std::nullopt;
}

bool moves(const glm::dvec3& velocity) {
    return glm::length(velocity) > 1e-3;
}

} // namespace

TimeClue LiveVehicle::clue_of(const Fix& fix, const glm::dvec3& world_m) {
    TimeClue clue{.sent_s = fix.sent_s, .ticks = fix.ticks, .tick_s = fix.tick_s, .moved_s = {}};
    if (track_.empty()) {
        return clue;
    }
    const LiveSample& last = track_.last();
    const glm::dvec3 way_m = world_m - last.state.position_m;
    const bool same_ticks = last_fix_ && fix.ticks == last_fix_->ticks;
    const bool repeated = way_m == glm::dvec3(0.0) && same_ticks && !fix.sent_s;
    repeats_ = repeated ? repeats_ + 1 : 0;
    if (repeats_ >= repeats_that_stand) {
        return {}; // A sender that is paused goes on to send.
    }
    if (fix.velocity_ned_mps && velocity_error_ < most_velocity_error) {
        const glm::dvec3 now_mps = world_from_ned(*fix.velocity_ned_mps);
        clue.moved_s = time_along(way_m, 0.5 * (now_mps + last.state.velocity_mps));
    }
    return clue;
}

/// The sender's velocity, or what positions say where it gives none or a wrong one.
glm::dvec3 LiveVehicle::velocity_of(const Fix& fix, const glm::dvec3& world_m, double step_s) {
    if (repeats_ >= repeats_that_stand) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 told_mps =
        fix.velocity_ned_mps ? world_from_ned(*fix.velocity_ned_mps) : glm::dvec3(0.0);
    if (track_.empty() || step_s <= 0.0) {
        return told_mps;
    }
    if (fix.velocity_is_meant) {
        return told_mps;
    }
    const glm::dvec3 moved_mps = (world_m - track_.last().state.position_m) / step_s;
    const double most_mps = std::max(glm::length(moved_mps), glm::length(told_mps));
    if (most_mps > slowest_clock_mps) {
        constexpr double share = 0.05;
        const double error = glm::length(moved_mps - told_mps) / most_mps;
        velocity_error_ += share * (error - velocity_error_);
    }
    const bool told = fix.velocity_ned_mps && (moves(told_mps) || !moves(moved_mps));
    if (told && velocity_error_ < most_velocity_error) {
        return told_mps;
    }
    constexpr double newer = 0.5;
    return glm::mix(track_.last().state.velocity_mps, moved_mps, newer);
}

glm::dvec3
LiveVehicle::turn_of(const Fix& fix, const glm::dquat& body_to_world, double step_s) const {
    if (repeats_ >= repeats_that_stand) {
        return glm::dvec3(0.0);
    }
    if (fix.body_rates_radps && *fix.body_rates_radps != glm::dvec3(0.0)) {
        return body_to_world * *fix.body_rates_radps;
    }
    if (track_.empty() || step_s <= 0.0) {
        return glm::dvec3(0.0);
    }
    glm::dquat turn = body_to_world * glm::conjugate(track_.last().state.body_to_world);
    turn = turn.w < 0.0 ? -turn : turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    constexpr double least_sine = 1e-9;
    constexpr double fastest_radps = 10.0;
    if (sine < least_sine) {
        return glm::dvec3(0.0);
    }
    const double rate_radps = std::min(2.0 * std::atan2(sine, turn.w) / step_s, fastest_radps);
    return axis * (rate_radps / sine);
}

/// The change of speed since the sample before, filtered over half a second.
double LiveVehicle::speed_rate_of(const glm::dvec3& velocity_mps, double step_s) const {
    if (track_.empty() || step_s <= 0.0) {
        return 0.0;
    }
    constexpr double filter_s = 0.5;
    const AircraftState& last = track_.last().state;
    const double gained_mps = glm::length(velocity_mps) - glm::length(last.velocity_mps);
    const double newer = 1.0 - std::exp(-step_s / filter_s);
    return glm::mix(last.speed_rate_mps2, gained_mps / step_s, newer);
}

bool LiveVehicle::add(const Fix& fix, const glm::dvec3& world_m, double arrival_s) {
    const double before_s = clock_.sender_s();
    const SenderClock::Order order = clock_.take(arrival_s, clue_of(fix, world_m));
    last_arrival_s_ = arrival_s;
    if (order == SenderClock::Order::Late) {
        ++late_;
        return false;
    }
    if (order == SenderClock::Order::Restarts) {
        track_.clear();
        velocity_error_ = 0.0;
    }
    const double step_s = clock_.sender_s() - before_s;
    LiveSample sample;
    sample.state.time_s = clock_.sender_s();
    sample.state.position_m = world_m;
    sample.state.body_to_world = body_to_world_from_euler(fix.attitude);
    sample.state.velocity_mps = velocity_of(fix, world_m, step_s);
    sample.world_radps = turn_of(fix, sample.state.body_to_world, step_s);
    sample.world_mps2 = world_from_ned(fix.acceleration_ned_mps2);
    sample.state.speed_rate_mps2 = speed_rate_of(sample.state.velocity_mps, step_s);
    track_.add(sample);
    last_fix_ = fix;
    hidden_ = false;
    ++taken_;
    return true;
}

AircraftState LiveVehicle::show(double now_s, double delay_s, double passed_s) {
    return track_.show(clock_.sender_from_ours_s(now_s - delay_s), passed_s);
}

} // namespace octant::sim::links
