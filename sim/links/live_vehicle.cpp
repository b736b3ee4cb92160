#include "sim/links/live_vehicle.h"

#include "sim/base/axes.h"
#include "sim/links/parabola_fit.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

namespace octant::sim::links {

namespace {

constexpr double slow_clock_mps = 0.5;    ///< below, the way is no measure of time
constexpr double slow_to_judge_mps = 3.0; ///< below, places that scatter do not refute a velocity
constexpr int repeats_that_stand = 3;
constexpr double max_velocity_error = 0.3;

glm::dvec3 world_from_ned(const glm::dvec3& ned) {
    return {ned.y, ned.x, -ned.z};
}

/// How long a way takes at a velocity, where the way runs along it.
std::optional<double> time_along(const glm::dvec3& distance_m, const glm::dvec3& velocity_mps) {
    const double speed2 = glm::dot(velocity_mps, velocity_mps);
    if (speed2 < slow_clock_mps * slow_clock_mps) {
        return std::nullopt;
    }
    const double time_s = glm::dot(distance_m, velocity_mps) / speed2;
    const double aside_m = glm::length(distance_m - time_s * velocity_mps);
    constexpr double max_aside = 0.2;
    constexpr double min_aside_m = 0.05;
    const bool along = aside_m <= max_aside * glm::length(distance_m) + min_aside_m;
    return along ? std::optional(time_s) : std::nullopt;
}

bool moves(const glm::dvec3& velocity) {
    return glm::length(velocity) > 1e-3;
}

/// The motion through the places of the last half second, of six samples at least where there are
/// as many, up to the newest one. Without others there is none.
Parabola<glm::dvec3> motion_of(const std::deque<LiveSample>& before, const LiveSample& newest) {
    constexpr double length_s = 0.5;
    constexpr std::size_t min_count = 6;
    constexpr double min_length_s = 0.1;
    constexpr double min_curved_length_s = 0.3;
    constexpr std::size_t min_curved_count = 5;
    ParabolaFit<glm::dvec3> fit;
    fit.add(0.0, glm::dvec3(0.0));
    std::size_t count = 1;
    double fitted_s = 0.0;
    for (auto each = before.rbegin(); each != before.rend(); ++each, ++count) {
        const double passed_s = newest.state.time_s - each->state.time_s;
        if (passed_s > length_s && count >= min_count) {
            break;
        }
        fit.add(-passed_s, each->state.position_m - newest.state.position_m);
        fitted_s = passed_s;
    }
    const bool is_curved = count >= min_curved_count && fitted_s >= min_curved_length_s;
    const auto motion = fitted_s < min_length_s ? std::nullopt
                        : is_curved             ? fit.parabola()
                                                : fit.line();
    return motion.value_or(Parabola<glm::dvec3>{});
}

} // namespace

/// Whether the fix says of a moving vehicle what the last one said, as senders do whose places
/// change less often than they send, networks that double packets, and senders that are paused.
/// Those are told by how often it happens in a row.
bool LiveVehicle::is_repeated(const Fix& fix, const glm::dvec3& world_m, double arrival_s) {
    const bool same = !track_.empty() && world_m == track_.last().state.position_m &&
                      body_to_world_from_euler(fix.attitude) == track_.last().state.body_to_world;
    if (!same) {
        constexpr double max_hold_s = 1.0;
        const bool held = arrival_s - moved_at_s_ < max_hold_s;
        typical_repeats_ = held ? std::max(repeats_, typical_repeats_ - 1) : 0;
        repeats_ = 0;
        moved_at_s_ = arrival_s;
        return false;
    }
    ++repeats_;
    return !is_stationary() && glm::length(track_.last().state.velocity_mps) > slow_clock_mps;
}

bool LiveVehicle::is_stationary() const {
    return repeats_ >= repeats_that_stand + 2 * typical_repeats_;
}

/// The way, negative where it runs back; nothing where a second of places has no direction, as
/// those of a vehicle that hovers.
std::optional<double> LiveVehicle::distance_along_track(const glm::dvec3& distance_m) const {
    constexpr double length_s = 1.0;
    constexpr double heading_s = 0.3;
    constexpr std::size_t heading_samples = 4;
    constexpr double min_directed = 0.8;
    const auto& samples = track_.samples();
    const AircraftState& last = samples.back().state;
    const auto way_from = [&](std::size_t i) {
        return last.position_m - samples[i].state.position_m;
    };
    const auto passed_from = [&](std::size_t i) { return last.time_s - samples[i].state.time_s; };
    double path_m = 0.0;
    std::size_t first = samples.size() - 1;
    std::size_t heading_first = first;
    for (; first > 0 && passed_from(first - 1) < length_s; --first) {
        path_m +=
            glm::distance(samples[first - 1].state.position_m, samples[first].state.position_m);
        if (passed_from(first) < heading_s || samples.size() - first < heading_samples) {
            heading_first = first - 1;
        }
    }
    if (glm::length(way_from(first)) < min_directed * path_m) {
        return std::nullopt;
    }
    const bool back = glm::dot(distance_m, way_from(heading_first)) < 0.0;
    return back ? -glm::length(distance_m) : glm::length(distance_m);
}

TimingEvidence LiveVehicle::timing_evidence_of(const Fix& fix, const glm::dvec3& world_m) {
    TimingEvidence clue{
        .sent_s = fix.sent_s, .ticks = fix.ticks, .tick_s = fix.tick_s, .moved_s = {}, .distance_m = {}};
    if (track_.empty()) {
        return clue;
    }
    if (is_stationary()) {
        // A sender that is paused goes on to send, with a clock that stands.
        const bool runs =
            fix.sent_s ? fix.sent_s > last_fix_->sent_s : fix.ticks != last_fix_->ticks;
        return runs ? clue : TimingEvidence{};
    }
    const glm::dvec3 distance_m = world_m - track_.last().state.position_m;
    const bool told = fix.velocity_ned_mps && last_fix_->velocity_ned_mps;
    if (told && velocity_error_ < max_velocity_error) {
        const glm::dvec3 mean_ned_mps =
            0.5 * (*fix.velocity_ned_mps + *last_fix_->velocity_ned_mps);
        clue.moved_s = time_along(distance_m, world_from_ned(mean_ned_mps));
    }
    clue.distance_m = distance_along_track(distance_m);
    return clue;
}

/// Whether the sender's velocity agrees with its positions.
bool LiveVehicle::trusts_velocity(const Fix& fix, const LiveSample& sample, double step_s) {
    if (fix.velocity_is_commanded || track_.empty() || step_s <= 0.0) {
        return true;
    }
    const glm::dvec3 moved_mps =
        (sample.state.position_m - track_.last().state.position_m) / step_s;
    const glm::dvec3& told_mps = sample.state.velocity_mps;
    const double max_mps = std::max(glm::length(moved_mps), glm::length(told_mps));
    if (max_mps > slow_to_judge_mps) {
        constexpr double share = 0.05;
        const double error = glm::length(moved_mps - told_mps) / max_mps;
        velocity_error_ += share * (error - velocity_error_);
    }
    const bool told = fix.velocity_ned_mps && (moves(told_mps) || !moves(moved_mps));
    return told && velocity_error_ < max_velocity_error;
}

/// Sets velocity, rate of turn and acceleration of a sample whose time, place and attitude are
/// set: what the sender tells, or what the places of the last half second say.
void LiveVehicle::set_motion(const Fix& fix, LiveSample& sample, double step_s) {
    sample.world_radps = turn_of(fix, sample);
    sample.world_mps2 = world_from_ned(fix.acceleration_ned_mps2);
    sample.state.velocity_mps = world_from_ned(fix.velocity_ned_mps.value_or(glm::dvec3(0.0)));
    if (fix.extrapolation_limit_s > 0.0) {
        sample.extrapolation_limit_s = fix.extrapolation_limit_s;
        sample.accelerated_s = fix.extrapolation_limit_s;
    } else {
        constexpr double periods = 5.0;
        constexpr double max_carried_on_s = 2.0;
        sample.extrapolation_limit_s =
            std::clamp(periods * clock_.period_s(), LiveSample{}.extrapolation_limit_s, max_carried_on_s);
    }
    if (is_stationary()) {
        sample.state.velocity_mps = glm::dvec3(0.0);
        sample.world_mps2 = glm::dvec3(0.0);
        return;
    }
    if (!trusts_velocity(fix, sample, step_s)) {
        const Parabola<glm::dvec3> motion = motion_of(track_.samples(), sample);
        sample.state.velocity_mps = motion.slope;
        sample.world_mps2 = 2.0 * motion.bend;
    }
}

glm::dvec3 LiveVehicle::turn_of(const Fix& fix, const LiveSample& sample) const {
    if (is_stationary()) {
        return glm::dvec3(0.0);
    }
    const glm::dquat& attitude = sample.state.body_to_world;
    if (fix.body_rates_radps && *fix.body_rates_radps != glm::dvec3(0.0)) {
        return attitude * *fix.body_rates_radps;
    }
    if (track_.empty() || fix.velocity_is_commanded) {
        return glm::dvec3(0.0);
    }
    // Over a tenth of a second at least: what delays do to times of packets matters less.
    constexpr double min_length_s = 0.1;
    const auto& samples = track_.samples();
    std::size_t from = samples.size() - 1;
    while (from > 0 && sample.state.time_s - samples[from].state.time_s < min_length_s) {
        --from;
    }
    glm::dquat turn = attitude * glm::conjugate(samples[from].state.body_to_world);
    turn = turn.w < 0.0 ? -turn : turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    constexpr double min_sine = 1e-9;
    constexpr double max_radps = 10.0;
    if (sine < min_sine) {
        return glm::dvec3(0.0);
    }
    const double length_s = sample.state.time_s - samples[from].state.time_s;
    return axis * (std::min(2.0 * std::atan2(sine, turn.w) / length_s, max_radps) / sine);
}

/// Whether no flight leads from the last place to this one.
bool LiveVehicle::has_jumped(const Fix& fix, const glm::dvec3& world_m, double arrival_s) const {
    constexpr double unknown_mps = 400.0;
    constexpr std::size_t min_samples = 4;
    constexpr double times_speed = 5.0;
    constexpr double more_s = 0.5;
    constexpr double more_m = 50.0;
    if (track_.empty()) {
        return false;
    }
    const AircraftState& last = track_.last().state;
    const double told_mps = glm::length(fix.velocity_ned_mps.value_or(glm::dvec3(0.0)));
    const double known_mps = std::max(told_mps, glm::length(last.velocity_mps));
    const double speed_mps =
        track_.samples().size() < min_samples ? std::max(known_mps, unknown_mps) : known_mps;
    const double passed_s = arrival_s - last_arrival_s_ + more_s;
    return glm::distance(world_m, last.position_m) > times_speed * speed_mps * passed_s + more_m;
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
    if (has_jumped(fix, world_m, arrival_s)) {
        track_.clear();
    }
    if (is_repeated(fix, world_m, arrival_s)) {
        last_arrival_s_ = arrival_s;
        hidden_ = false;
        ++taken_;
        return true;
    }
    const double before_s = clock_.sender_s();
    const SenderClock::Order order = clock_.take(arrival_s, timing_evidence_of(fix, world_m));
    last_arrival_s_ = arrival_s;
    if (order == SenderClock::Order::Late) {
        ++late_;
        return false;
    }
    if (order == SenderClock::Order::Restarts) {
        track_.clear();
        velocity_error_ = 0.0;
    }
    LiveSample sample;
    sample.state.time_s = clock_.sender_s();
    sample.state.position_m = world_m;
    sample.state.body_to_world = body_to_world_from_euler(fix.attitude);
    const double step_s = clock_.sender_s() - before_s;
    set_motion(fix, sample, step_s);
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
