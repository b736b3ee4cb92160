#include "sim/links/live_traffic.h"

#include "sim/base/axes.h"
#include "sim/flight_steps.h"
#include "sim/links/dis_entity.h"
#include "sim/links/fix.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/packet_kind.h"
#include "sim/trajectory.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <deque>
#include <fmt/format.h>
#include <utility>

namespace octant::sim::links {

namespace {

constexpr double kept_s = 6.0;        ///< longer than any delay
constexpr double min_apart_s = 0.005; ///< of kept samples, but for the newest
constexpr double blend_s = 0.05;      ///< time constant: 95 % within 0.15 s
constexpr double min_snap_m = 15.0;
constexpr double snap_after_s = 0.25; ///< of flight at the sample's speed
constexpr double slow_mps = 0.3;      ///< slower vehicles may move backwards
constexpr double max_slowdown = 0.6;  ///< share of the distance of a picture by which shown motion slows down
constexpr double max_wait_s = 1.0;    ///< of flight
constexpr double snap_cosine = 0.7;   ///< of half the angle: 90 degrees

} // namespace

void LiveTrack::add(const LiveSample& sample) {
    assert(samples_.empty() || samples_.back().state.time_s < sample.state.time_s);
    const std::size_t count = samples_.size();
    if (count > 1 && sample.state.time_s - samples_[count - 2].state.time_s < min_apart_s) { samples_.pop_back(); }
    samples_.push_back(sample);
    AircraftState& state = samples_.back().state;
    state.turn_rate_radps = glm::conjugate(state.body_to_world) * sample.world_radps;
    while (samples_.size() > 2 && samples_[1].state.time_s < sample.state.time_s - kept_s) { samples_.pop_front(); }
}

void LiveTrack::clear() {
    samples_.clear();
    shown_.reset();
}

AircraftState LiveTrack::beyond(double sender_s) const {
    const LiveSample& last = samples_.back();
    const double ahead_s = std::clamp(sender_s - last.state.time_s, 0.0, last.extrapolation_limit_s);
    const double accelerated_s = std::min(ahead_s, last.acceleration_limit_s);
    AircraftState state = last.state;
    state.velocity_mps += accelerated_s * last.world_mps2;
    state.position_m += ahead_s * state.velocity_mps - 0.5 * accelerated_s * accelerated_s * last.world_mps2;
    state.body_to_world = turned(state.body_to_world, last.world_radps, ahead_s);
    return state;
}

AircraftState LiveTrack::raw_at(double sender_s) const {
    if (sender_s >= samples_.back().state.time_s) { return beyond(sender_s); }
    const auto next = std::upper_bound(samples_.begin(), samples_.end(), sender_s,
        [](double t, const LiveSample& sample) { return t < sample.state.time_s; });
    if (next == samples_.begin()) { return next->state; }
    return state_between((next - 1)->state, next->state, sender_s);
}

/// Blends from the state shown `passed_s` ago towards this state.
void LiveTrack::blend(AircraftState& state, double sender_s, double passed_s) {
    // Difference between the shown position and the position by the newest samples.
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
    // A vehicle without new samples stops completely.
    const bool rests = stale_ && state.position_m == then.position_m;
    state.position_m += rests ? error_m : left * error_m;
    if (waits && !rests) {
        state.position_m += std::max(ahead_m - max_slowdown * moved_m - left * ahead_m, 0.0) * ahead;
    }
    state.body_to_world = glm::normalize(glm::slerp(none, turn, left) * state.body_to_world);
}

AircraftState LiveTrack::show(double sender_s, double passed_s) {
    assert(!samples_.empty());
    stale_ = sender_s > samples_.back().state.time_s + samples_.back().extrapolation_limit_s;
    AircraftState state = raw_at(sender_s);
    if (shown_) { blend(state, sender_s, passed_s); }
    state.time_s = sender_s;
    shown_ = state;
    return state;
}

namespace {

constexpr double slow_clock_mps = 0.5;    ///< below, the distance is no measure of time
constexpr double slow_to_judge_mps = 3.0; ///< below, scattered positions do not contradict a velocity
constexpr int repeats_that_stand = 3;
constexpr double max_velocity_error = 0.3;

glm::dvec3 world_from_ned(const glm::dvec3& ned) { return {ned.y, ned.x, -ned.z}; }

/// Time to cover a distance at a velocity, if the distance is along it.
std::optional<double> time_along(const glm::dvec3& distance_m, const glm::dvec3& velocity_mps) {
    const double speed2 = glm::dot(velocity_mps, velocity_mps);
    if (speed2 < slow_clock_mps * slow_clock_mps) { return std::nullopt; }
    const double time_s = glm::dot(distance_m, velocity_mps) / speed2;
    const double aside_m = glm::length(distance_m - time_s * velocity_mps);
    constexpr double max_aside = 0.2;
    constexpr double min_aside_m = 0.05;
    const bool along = aside_m <= max_aside * glm::length(distance_m) + min_aside_m;
    return along ? std::optional(time_s) : std::nullopt;
}

bool moves(const glm::dvec3& velocity) { return glm::length(velocity) > 1e-3; }

/// Motion through the positions of the last half second, at least six samples if there are as many, up to the newest
/// one. Nothing without other samples.
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
        if (passed_s > length_s && count >= min_count) { break; }
        fit.add(-passed_s, each->state.position_m - newest.state.position_m);
        fitted_s = passed_s;
    }
    const bool is_curved = count >= min_curved_count && fitted_s >= min_curved_length_s;
    const auto motion = fitted_s < min_length_s ? std::nullopt : is_curved ? fit.parabola() : fit.line();
    return motion.value_or(Parabola<glm::dvec3>{});
}

} // namespace

/// True if the fix of a moving vehicle repeats the last one. That happens with senders whose positions change less
/// often than they send, with networks that double packets, and with paused senders. The number of repetitions in a row
/// tells them apart.
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

bool LiveVehicle::is_stationary() const { return repeats_ >= repeats_that_stand + 2 * typical_repeats_; }

/// Distance along the track, negative if backwards; nothing if the positions of a second have no direction, as those of
/// a hovering vehicle.
std::optional<double> LiveVehicle::distance_along_track(const glm::dvec3& distance_m) const {
    constexpr double length_s = 1.0;
    constexpr double heading_s = 0.3;
    constexpr std::size_t heading_samples = 4;
    constexpr double min_directed = 0.8;
    const auto& samples = track_.samples();
    const AircraftState& last = samples.back().state;
    const auto way_from = [&](std::size_t i) { return last.position_m - samples[i].state.position_m; };
    const auto passed_from = [&](std::size_t i) { return last.time_s - samples[i].state.time_s; };
    double path_m = 0.0;
    std::size_t first = samples.size() - 1;
    std::size_t heading_first = first;
    for (; first > 0 && passed_from(first - 1) < length_s; --first) {
        path_m += glm::distance(samples[first - 1].state.position_m, samples[first].state.position_m);
        if (passed_from(first) < heading_s || samples.size() - first < heading_samples) { heading_first = first - 1; }
    }
    if (glm::length(way_from(first)) < min_directed * path_m) { return std::nullopt; }
    const bool back = glm::dot(distance_m, way_from(heading_first)) < 0.0;
    return back ? -glm::length(distance_m) : glm::length(distance_m);
}

TimingEvidence LiveVehicle::timing_evidence_of(const Fix& fix, const glm::dvec3& world_m) {
    TimingEvidence clue{
        .sent_s = fix.sent_s, .ticks = fix.ticks, .tick_s = fix.tick_s, .moved_s = {}, .distance_m = {}};
    if (track_.empty()) { return clue; }
    if (is_stationary()) {
        // A paused sender continues to send with a clock that stands still.
        const bool runs = fix.sent_s ? fix.sent_s > last_fix_->sent_s : fix.ticks != last_fix_->ticks;
        return runs ? clue : TimingEvidence{};
    }
    const glm::dvec3 distance_m = world_m - track_.last().state.position_m;
    const bool has_velocities = fix.velocity_ned_mps && last_fix_->velocity_ned_mps;
    if (has_velocities && velocity_error_ < max_velocity_error) {
        const glm::dvec3 mean_ned_mps = 0.5 * (*fix.velocity_ned_mps + *last_fix_->velocity_ned_mps);
        clue.moved_s = time_along(distance_m, world_from_ned(mean_ned_mps));
    }
    clue.distance_m = distance_along_track(distance_m);
    return clue;
}

/// True if the velocity of the sender agrees with its positions.
bool LiveVehicle::trusts_velocity(const Fix& fix, const LiveSample& sample, double step_s) {
    if (fix.velocity_is_commanded || track_.empty() || step_s <= 0.0) { return true; }
    const glm::dvec3 moved_mps = (sample.state.position_m - track_.last().state.position_m) / step_s;
    const glm::dvec3& reported_mps = sample.state.velocity_mps;
    const double max_mps = std::max(glm::length(moved_mps), glm::length(reported_mps));
    if (max_mps > slow_to_judge_mps) {
        constexpr double share = 0.05;
        const double error = glm::length(moved_mps - reported_mps) / max_mps;
        velocity_error_ += share * (error - velocity_error_);
    }
    const bool is_reported = fix.velocity_ned_mps && (moves(reported_mps) || !moves(moved_mps));
    return is_reported && velocity_error_ < max_velocity_error;
}

/// Sets velocity, turn rate and acceleration of a sample whose time, position and attitude are set: from the sender or
/// from the positions of the last half second.
void LiveVehicle::set_motion(const Fix& fix, LiveSample& sample, double step_s) {
    sample.world_radps = turn_of(fix, sample);
    sample.world_mps2 = world_from_ned(fix.acceleration_ned_mps2);
    sample.state.velocity_mps = world_from_ned(fix.velocity_ned_mps.value_or(glm::dvec3(0.0)));
    if (fix.extrapolation_limit_s > 0.0) {
        sample.extrapolation_limit_s = fix.extrapolation_limit_s;
        sample.acceleration_limit_s = fix.extrapolation_limit_s;
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
    if (is_stationary()) { return glm::dvec3(0.0); }
    const glm::dquat& attitude = sample.state.body_to_world;
    if (fix.body_rates_radps && *fix.body_rates_radps != glm::dvec3(0.0)) { return attitude * *fix.body_rates_radps; }
    if (track_.empty() || fix.velocity_is_commanded) { return glm::dvec3(0.0); }
    // At least a tenth of a second, so that delays of packets matter less.
    constexpr double min_length_s = 0.1;
    const auto& samples = track_.samples();
    std::size_t from = samples.size() - 1;
    while (from > 0 && sample.state.time_s - samples[from].state.time_s < min_length_s) { --from; }
    glm::dquat turn = attitude * glm::conjugate(samples[from].state.body_to_world);
    turn = turn.w < 0.0 ? -turn : turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    constexpr double min_sine = 1e-9;
    constexpr double max_radps = 10.0;
    if (sine < min_sine) { return glm::dvec3(0.0); }
    const double length_s = sample.state.time_s - samples[from].state.time_s;
    return axis * (std::min(2.0 * std::atan2(sine, turn.w) / length_s, max_radps) / sine);
}

/// True if no flight leads from the last position to this one.
bool LiveVehicle::has_jumped(const Fix& fix, const glm::dvec3& world_m, double arrival_s) const {
    constexpr double unknown_mps = 400.0;
    constexpr std::size_t min_samples = 4;
    constexpr double times_speed = 5.0;
    constexpr double more_s = 0.5;
    constexpr double more_m = 50.0;
    if (track_.empty()) { return false; }
    const AircraftState& last = track_.last().state;
    const double reported_mps = glm::length(fix.velocity_ned_mps.value_or(glm::dvec3(0.0)));
    const double known_mps = std::max(reported_mps, glm::length(last.velocity_mps));
    const double speed_mps = track_.samples().size() < min_samples ? std::max(known_mps, unknown_mps) : known_mps;
    const double passed_s = arrival_s - last_arrival_s_ + more_s;
    return glm::distance(world_m, last.position_m) > times_speed * speed_mps * passed_s + more_m;
}

/// The change of speed since the sample before, filtered over half a second.
double LiveVehicle::speed_rate_of(const glm::dvec3& velocity_mps, double step_s) const {
    if (track_.empty() || step_s <= 0.0) { return 0.0; }
    constexpr double filter_s = 0.5;
    const AircraftState& last = track_.last().state;
    const double gained_mps = glm::length(velocity_mps) - glm::length(last.velocity_mps);
    const double newer = 1.0 - std::exp(-step_s / filter_s);
    return glm::mix(last.speed_rate_mps2, gained_mps / step_s, newer);
}

bool LiveVehicle::add(const Fix& fix, const glm::dvec3& world_m, double arrival_s) {
    if (has_jumped(fix, world_m, arrival_s)) { track_.clear(); }
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

namespace {

/// Time for which a fault is shown.
constexpr double wrong_said_s = 5.0;

std::string motion_text(
    const LiveVehicle& vehicle, const std::string& name, const std::optional<long>& lost, bool is_shown) {
    const double period_s = vehicle.clock().period_s();
    return fmt::format("{} {}: {:.1f}/s, {}, {} late, jitter {:.0f} ms{}{}", text_of(vehicle.key().source), name,
        period_s > 0.0 ? 1.0 / period_s : 0.0, lost ? fmt::format("{} lost", *lost) : "losses unknown", vehicle.late(),
        1000.0 * vehicle.clock().jitter_s(), is_shown && vehicle.is_stale() ? ", stale" : "",
        is_shown ? "" : ", not shown: no --aircraft left for it");
}

constexpr std::size_t max_streams = 64;

/// The state of a stream. A new stream gets a place if there is one; in a full table it replaces the stream that was
/// silent longest, if that was silent for `gone_s`. Null if there is no place.
template <class Streams>
typename Streams::mapped_type* stream_of(
    Streams& streams, const typename Streams::key_type& key, double arrival_s, double gone_s) {
    auto known = streams.find(key);
    if (known == streams.end()) {
        if (streams.size() >= max_streams) {
            const auto silent =
                std::ranges::min_element(streams, {}, [](const auto& stream) { return stream.second.last_s; });
            if (arrival_s - silent->second.last_s < gone_s) { return nullptr; }
            streams.erase(silent);
        }
        known = streams.try_emplace(key).first;
    }
    known->second.last_s = arrival_s;
    return &known->second;
}

std::string result_text(Protocol protocol, const DecodeResult& result) {
    if (result.fault == PacketError::OtherKind) { return std::string(text_of(PacketKind{result.got})); }
    switch (protocol) {
    case Protocol::Lines:
        return NamedColumns::text_of(result);
    case Protocol::XPlane:
        return xplane_text(result);
    case Protocol::MavLink:
        return mavlink_text(result);
    case Protocol::Dis:
        return dis_text(result);
    case Protocol::Cigi:
        return cigi_text(result);
    default:
        return fdm_text(result);
    }
}

/// The result for a packet that its decoder refused: its true kind if its form tells it. For the DIS decoder a CIGI 3
/// message is a PDU of another type.
DecodeResult identified(const Datagram& datagram, const DecodeResult& result) {
    const auto kind = result.fault != PacketError::None && datagram.protocol != Protocol::Lines
                          ? packet_kind(datagram.bytes)
                          : std::nullopt;
    if (!kind || protocol_of(*kind) == datagram.protocol) { return result; }
    return {PacketError::OtherKind, static_cast<std::uint32_t>(*kind), 0};
}

} // namespace

std::string name_of(const VehicleKey& key) {
    switch (key.protocol) {
    case Protocol::Dis:
        return fmt::format("{}:{}:{}", key.vehicle >> 32U, key.vehicle >> 16U & 0xffffU, key.vehicle & 0xffffU);
    case Protocol::MavLink:
        return fmt::format("system {}", key.vehicle);
    case Protocol::Cigi:
        return fmt::format("entity {}", key.vehicle);
    case Protocol::Lines:
        return fmt::format("id {}", key.vehicle);
    default:
        return "aircraft";
    }
}

LiveVehicle* LiveTraffic::vehicle_of(const VehicleKey& key, double arrival_s) {
    if (const auto known = numbers_.find(key); known != numbers_.end()) { return &vehicles_[known->second]; }
    const auto silent_for = [arrival_s](double min_s) {
        return [arrival_s, min_s](const LiveVehicle& vehicle) { return arrival_s - vehicle.last_arrival_s() > min_s; };
    };
    const auto is_restarted = [&](const LiveVehicle& vehicle) {
        const VehicleKey& old = vehicle.key();
        return old.protocol == key.protocol && old.source.address == key.source.address && old.vehicle == key.vehicle &&
               silent_for(restarted_after_s)(vehicle);
    };
    auto gone = std::ranges::find_if(vehicles_, is_restarted);
    if (gone == vehicles_.end()) { gone = std::ranges::find_if(vehicles_, silent_for(gone_after_s)); }
    if (gone != vehicles_.end()) {
        numbers_.erase(gone->key());
        numbers_.emplace(key, static_cast<std::size_t>(gone - vehicles_.begin()));
        *gone = LiveVehicle(key);
        return &*gone;
    }
    if (vehicles_.size() == max_vehicles) { return nullptr; }
    numbers_.emplace(key, vehicles_.size());
    return &vehicles_.emplace_back(key);
}

/// Updates the report of a vehicle.
void LiveTraffic::report(const VehicleKey& key, const Fix& fix, const std::string& marking) {
    auto known = reports_.find(key);
    if (known == reports_.end()) {
        if (reports_.size() >= max_reported) { return; }
        known = reports_.try_emplace(key).first;
    }
    VehicleReport& report = known->second;
    ++report.packets;
    report.latitude_deg = fix.latitude_deg;
    report.longitude_deg = fix.longitude_deg;
    report.altitude_m = fix.altitude_m;
    if (report.marking != marking) { report.marking = marking; }
}

LiveTraffic::PacketOutcome LiveTraffic::move(const Datagram& datagram, const Fix& fix, const std::string& marking) {
    const VehicleKey key{datagram.protocol, datagram.source, fix.vehicle};
    report(key, fix, marking);
    LiveVehicle* const vehicle = vehicle_of(key, datagram.arrival_s);
    if (vehicle == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Right;
    }
    const WorldPosition place = world_from_fix_(key, fix);
    const bool taken = vehicle->add(with_rotated_axes(fix, place.north_bearing_rad), place.at_m, datagram.arrival_s);
    if (!taken) {
        ++counts_.late;
        return PacketOutcome::Right;
    }
    ++counts_.accepted;
    newest_s_ = datagram.arrival_s;
    return PacketOutcome::Moved;
}

/// Counts a packet and stores it for the status lines. Never returns Moved.
LiveTraffic::PacketOutcome LiveTraffic::count(const Datagram& datagram, const DecodeResult& decoded) {
    const DecodeResult result = identified(datagram, decoded);
    const bool wrong = result.fault != PacketError::None && result.fault != PacketError::Unused;
    if (result.fault == PacketError::Unused) {
        ++counts_.unused;
    } else {
        (wrong ? last_rejected_ : last_accepted_) = {datagram.protocol, datagram.source, result, datagram.arrival_s};
    }
    counts_.wrong += wrong ? 1 : 0;
    tally(datagram, result);
    return wrong ? PacketOutcome::Wrong : PacketOutcome::Right;
}

/// Counts a packet by its kind. A new kind gives a message, up to limits.
void LiveTraffic::tally(const Datagram& datagram, const DecodeResult& result) {
    constexpr std::size_t max_first = 200; // kinds of a fault that are the first of their sender
    constexpr std::size_t max_in_all = 100;
    constexpr std::ptrdiff_t max_of_sender = 16;
    const bool got_is_size = result.fault == PacketError::WrongSize || result.fault == PacketError::NotOurs;
    const PacketErrorKey form{result.fault, datagram.source, datagram.protocol, got_is_size ? 0U : result.got};
    const auto known = packet_tallies_.find(form);
    if (known != packet_tallies_.end()) {
        ++known->second.packets;
        known->second.is_uniform = known->second.is_uniform && known->second.first == result;
        return;
    }
    constexpr Protocol first_protocol{};
    const auto begin = packet_tallies_.lower_bound({result.fault, datagram.source, first_protocol, 0});
    const auto end = std::find_if(begin, packet_tallies_.end(),
        [&](const auto& heard) { return heard.first.fault != result.fault || heard.first.source != datagram.source; });
    const auto of_sender = std::distance(begin, end);
    std::size_t& forms = error_keys_[result.fault];
    if (forms >= (of_sender == 0 ? max_first : max_in_all) || of_sender >= max_of_sender) {
        ++counts_.unreported;
        return;
    }
    ++forms;
    packet_tallies_.emplace(form, PacketTally{result, 1});
    messages_.push_back(fmt::format("{}: {}", text_of(datagram.source), result_text(datagram.protocol, result)));
}

/// Counts lost packets by the sequence number of a packet in a stream of its sender.
void LiveTraffic::number(const Datagram& datagram, std::uint16_t stream, std::uint32_t number, int bits) {
    auto* const known =
        stream_of(sequences_, {datagram.protocol, datagram.source, stream}, datagram.arrival_s, gone_after_s);
    if (known == nullptr) { return; }
    SequenceCount& sequence = known->value;
    const long before = sequence.lost();
    sequence.add(number, bits, datagram.arrival_s);
    if (sequence.is_numbered()) { counts_.lost = counts_.lost.value_or(0); }
    if (counts_.lost) { *counts_.lost += sequence.lost() - before; }
}

/// Packets lost by the sender of a vehicle in its numbered streams; nothing if it has none.
std::optional<long> LiveTraffic::lost_of(const VehicleKey& key) const {
    std::optional<long> lost;
    for (const auto& [stream, sequence] : sequences_) {
        const auto& [protocol, source, number] = stream;
        const bool is_its_own = key.protocol != Protocol::MavLink || number >> 8U == key.vehicle;
        if (protocol == key.protocol && source == key.source && is_its_own && sequence.value.is_numbered()) {
            lost = lost.value_or(0) + sequence.value.lost();
        }
    }
    return lost;
}

LiveTraffic::PacketOutcome LiveTraffic::take_fdm(const Datagram& datagram) {
    Fix fix;
    const DecodeResult result = decode_fdm(datagram.bytes, fix);
    const PacketOutcome counted = count(datagram, result);
    return result.fault == PacketError::None ? move(datagram, fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_line(const Datagram& datagram) {
    // At most that many clients are connected, so the one that was silent longest has disconnected.
    auto* const stream = stream_of(columns_, datagram.source, datagram.arrival_s, 0.0);
    if (stream == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
    Fix fix;
    const DecodeResult result = stream->value.take(datagram.bytes, fix);
    DecodeResult kind = result;
    kind.size = 0; // Lines differ in length and count as one kind.
    const PacketOutcome counted = count(datagram, kind);
    return result.fault == PacketError::None ? move(datagram, fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_mavlink(const Datagram& datagram) {
    PacketOutcome taken = PacketOutcome::Wrong;
    for (Bytes rest = datagram.bytes; !rest.empty();) {
        const MavLinkParse parse = parse_mavlink(rest);
        DecodeResult kind = parse.result;
        kind.size = kind.fault == PacketError::NotOurs ? kind.size : 0;
        taken = std::max(taken, count(datagram, kind));
        if (identified(datagram, kind).fault == PacketError::OtherKind) { break; }
        if (kind.fault == PacketError::None || kind.fault == PacketError::Unused) {
            const unsigned component = unsigned{parse.system} << 8U | parse.component;
            number(datagram, static_cast<std::uint16_t>(component), parse.sequence, 8);
        }
        auto* const stream =
            parse.frame ? stream_of(poses_, {datagram.source, parse.frame->system}, datagram.arrival_s, gone_after_s)
                        : nullptr;
        if (stream != nullptr) {
            if (const auto fix = stream->value.take(*parse.frame, ellipsoid_)) {
                taken = std::max(taken, move(datagram, *fix));
            }
        }
        rest = rest.subspan(parse.length);
    }
    return taken;
}

LiveTraffic::PacketOutcome LiveTraffic::take_dis(const Datagram& datagram) {
    if (!ellipsoid_.is_earth() && !std::exchange(has_reported_dis_, true)) {
        messages_.push_back(
            fmt::format("DIS: places count from the centre of the earth (WGS 84), as its standard has it; on "
                        "{} their latitudes, longitudes and heights count",
                name_of_body(ellipsoid_)));
    }
    DisEntity entity;
    const DecodeResult result = decode_dis(datagram.bytes, entity);
    const PacketOutcome counted = count(datagram, result);
    return result.fault == PacketError::None ? move(datagram, entity.fix, marking_of(entity)) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_xplane(const Datagram& datagram) {
    std::optional<Fix> fix;
    if (packet_kind(datagram.bytes) != PacketKind::XPlane) {
        return count(datagram, XPlanePose().take(datagram.bytes, fix)); // takes no stream
    }
    auto* const stream = stream_of(xplanes_, datagram.source, datagram.arrival_s, gone_after_s);
    if (stream == nullptr) {
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
    const PacketOutcome counted = count(datagram, stream->value.take(datagram.bytes, fix));
    return fix ? move(datagram, *fix) : counted;
}

LiveTraffic::PacketOutcome LiveTraffic::take_cigi(const Datagram& datagram) {
    std::vector<Fix> moved;
    DecodeResult result = cigi_.take(datagram.bytes, moved, datagram.arrival_s);
    if (result.fault == PacketError::None) {
        result.size = 0; // Messages differ in length and count as one kind.
    }
    const PacketOutcome counted = count(datagram, result);
    if (result.fault != PacketError::None) { return counted; }
    number(datagram, 0, cigi_.host_frame(), 32);
    for (const Fix& fix : moved) { move(datagram, fix); }
    for (const std::uint16_t entity : cigi_.take_removed()) {
        const VehicleKey key{Protocol::Cigi, datagram.source, entity};
        if (const auto known = numbers_.find(key); known != numbers_.end()) { vehicles_[known->second].hide(); }
    }
    return PacketOutcome::Moved; // A host's message is a frame, whatever moves in it.
}

LiveTraffic::PacketOutcome LiveTraffic::take(const Datagram& datagram) {
    switch (datagram.protocol) {
    case Protocol::Fdm:
        return take_fdm(datagram);
    case Protocol::Lines:
        return take_line(datagram);
    case Protocol::MavLink:
        return take_mavlink(datagram);
    case Protocol::Dis:
        return take_dis(datagram);
    case Protocol::Cigi:
        return take_cigi(datagram);
    case Protocol::XPlane:
        return take_xplane(datagram);
    default:
        ++counts_.unused;
        return PacketOutcome::Wrong;
    }
}

std::size_t LiveTraffic::show_newest(double now_s, std::span<AircraftState> states) {
    shown_ = std::min(states.size(), vehicles_.size());
    for (std::size_t i = 0; i < shown_; ++i) { states[i] = vehicles_[i].newest(); }
    remove_hidden(states.first(shown_));
    shown_s_ = now_s;
    return shown_;
}

std::size_t LiveTraffic::show(double now_s, double delay_s, std::span<AircraftState> states) {
    const double passed_s = has_shown_ ? now_s - shown_s_ : 0.0;
    shown_ = std::min(states.size(), vehicles_.size());
    counts_.snaps = 0;
    for (std::size_t i = 0; i < shown_; ++i) {
        states[i] = vehicles_[i].show(now_s, delay_s, passed_s);
        counts_.snaps += vehicles_[i].snaps();
    }
    remove_hidden(states.first(shown_));
    shown_s_ = now_s;
    has_shown_ = true;
    return shown_;
}

void LiveTraffic::remove_hidden(std::span<AircraftState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) { states[i].is_present = !vehicles_[i].is_hidden(); }
}

bool LiveTraffic::is_stale() const {
    return std::any_of(vehicles_.begin(), vehicles_.begin() + static_cast<std::ptrdiff_t>(shown_),
        [](const LiveVehicle& vehicle) { return vehicle.is_stale() && !vehicle.is_hidden(); });
}

std::vector<std::string> LiveTraffic::take_new_messages() { return std::exchange(messages_, {}); }

std::vector<std::string> LiveTraffic::lines() const {
    std::vector<std::string> lines;
    if (last_accepted_.at_s >= 0.0) {
        lines.push_back(fmt::format(
            "{}: {}", text_of(last_accepted_.source), result_text(last_accepted_.protocol, last_accepted_.result)));
    }
    constexpr std::size_t max_lines = 4;
    for (std::size_t i = 0; i < std::min(vehicles_.size(), max_lines); ++i) {
        const VehicleKey& key = vehicles_[i].key();
        const auto known = reports_.find(key);
        const std::string marking = known == reports_.end() ? "" : known->second.marking;
        lines.push_back(
            motion_text(vehicles_[i], marking.empty() ? name_of(key) : fmt::format("{} {}", name_of(key), marking),
                lost_of(key), i < shown_ || shown_ == 0));
    }
    if (vehicles_.size() > max_lines) {
        lines.push_back(fmt::format("and {} vehicles more", vehicles_.size() - max_lines));
    }
    if (last_rejected_.at_s >= 0.0 && shown_s_ - last_rejected_.at_s < wrong_said_s) {
        lines.push_back(fmt::format("{}: {}; {} wrong packets so far", text_of(last_rejected_.source),
            result_text(last_rejected_.protocol, last_rejected_.result), counts_.wrong));
    }
    if (vehicles_.size() == max_vehicles) {
        lines.push_back(
            fmt::format("{} vehicles in all, {} are followed, {} shown", reports_.size(), vehicles_.size(), shown_));
    }
    return lines;
}

std::vector<VehicleReport> LiveTraffic::vehicle_reports() const {
    std::vector<VehicleReport> all;
    all.reserve(reports_.size());
    for (const auto& [key, counted] : reports_) {
        const auto known = numbers_.find(key);
        VehicleReport& report = all.emplace_back(counted);
        report.name = name_of(key);
        report.protocol = key.protocol;
        report.source = key.source;
        report.is_shown = known != numbers_.end() && known->second < shown_;
    }
    return all;
}

std::vector<PacketReport> LiveTraffic::packet_reports() const {
    std::vector<PacketReport> all;
    for (const auto& [form, heard] : packet_tallies_) {
        all.push_back(
            {form.source, result_text(form.protocol, heard.first) + (heard.is_uniform ? "" : " (the first of them)"),
                heard.packets, form.fault != PacketError::None && form.fault != PacketError::Unused});
    }
    return all;
}

} // namespace octant::sim::links
