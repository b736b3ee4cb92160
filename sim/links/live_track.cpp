#include "sim/links/live_track.h"

#include "sim/flight_steps.h"
#include "sim/trajectory.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace octant::sim::links {

namespace {

constexpr double kept_s = 6.0;        ///< longer than any delay
constexpr double min_apart_s = 0.005; ///< of kept samples, but for the newest
constexpr double blend_s = 0.05;      ///< time constant: 95 % within 0.15 s
constexpr double min_snap_m = 15.0;
constexpr double snap_after_s = 0.25; ///< of flight at the sample's speed
constexpr double slow_mps = 0.3;      ///< what is slower may move backwards
constexpr double max_slowdown = 0.6;  ///< of the way of a picture, where what is shown waits
constexpr double max_wait_s = 1.0;    ///< of flight
constexpr double snap_cosine = 0.7;   ///< of half the angle: 90 degrees

} // namespace

void LiveTrack::add(const LiveSample& sample) {
    assert(samples_.empty() || samples_.back().state.time_s < sample.state.time_s);
    const std::size_t count = samples_.size();
    if (count > 1 && sample.state.time_s - samples_[count - 2].state.time_s < min_apart_s) {
        samples_.pop_back();
    }
    samples_.push_back(sample);
    while (samples_.size() > 2 && samples_[1].state.time_s < sample.state.time_s - kept_s) {
        samples_.pop_front();
    }
}

void LiveTrack::clear() {
    samples_.clear();
    shown_.reset();
}

AircraftState LiveTrack::beyond(double sender_s) const {
    const LiveSample& last = samples_.back();
    const double ahead_s = std::clamp(sender_s - last.state.time_s, 0.0, last.extrapolation_limit_s);
    const double accelerated_s = std::min(ahead_s, last.accelerated_s);
    AircraftState state = last.state;
    state.velocity_mps += accelerated_s * last.world_mps2;
    state.position_m +=
        ahead_s * state.velocity_mps - 0.5 * accelerated_s * accelerated_s * last.world_mps2;
    state.body_to_world = turned(state.body_to_world, last.world_radps, ahead_s);
    return state;
}

AircraftState LiveTrack::raw_at(double sender_s) const {
    if (sender_s >= samples_.back().state.time_s) {
        return beyond(sender_s);
    }
    const auto next = std::upper_bound(
        samples_.begin(), samples_.end(), sender_s, [](double t, const LiveSample& sample) {
            return t < sample.state.time_s;
        });
    if (next == samples_.begin()) {
        return next->state;
    }
    return state_between((next - 1)->state, next->state, sender_s);
}

/// Goes from what was shown on, `passed_s` ago, towards this state.
void LiveTrack::blend(AircraftState& state, double sender_s, double passed_s) {
    // Where it was shown, less where it would have been shown by what is known now.
    const AircraftState then = raw_at(sender_s - passed_s);
    const glm::dvec3 error_m = shown_->position_m - then.position_m;
    glm::dquat turn = shown_->body_to_world * glm::conjugate(then.body_to_world);
    turn = turn.w < 0.0 ? -turn : turn;
    const double speed_mps = glm::length(state.velocity_mps);
    const bool flies = speed_mps > slow_mps;
    const glm::dvec3 ahead = flies ? state.velocity_mps / speed_mps : glm::dvec3(0.0);
    const double ahead_m = glm::dot(error_m, ahead);
    const double moved_m = std::max(glm::dot(state.position_m - then.position_m, ahead), 0.0);
    const bool waits = ahead_m > 0.0 && ahead_m < max_wait_s * speed_mps;
    const double far_m = glm::length(waits ? error_m - ahead_m * ahead : error_m);
    if (far_m > std::max(min_snap_m, snap_after_s * speed_mps) || turn.w < snap_cosine) {
        ++snaps_;
        return;
    }
    const double left = std::exp(-std::max(passed_s, 0.0) / blend_s);
    const glm::dquat none(1.0, 0.0, 0.0, 0.0);
    // What stands for want of samples stands altogether.
    const bool rests = stale_ && state.position_m == then.position_m;
    state.position_m += rests ? error_m : left * error_m;
    if (waits && !rests) {
        state.position_m +=
            std::max(ahead_m - max_slowdown * moved_m - left * ahead_m, 0.0) * ahead;
    }
    state.body_to_world = glm::normalize(glm::slerp(none, turn, left) * state.body_to_world);
}

AircraftState LiveTrack::show(double sender_s, double passed_s) {
    assert(!samples_.empty());
    stale_ = sender_s > samples_.back().state.time_s + samples_.back().extrapolation_limit_s;
    AircraftState state = raw_at(sender_s);
    if (shown_) {
        blend(state, sender_s, passed_s);
    }
    state.time_s = sender_s;
    shown_ = state;
    return state;
}

} // namespace octant::sim::links
