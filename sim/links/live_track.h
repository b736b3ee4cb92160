#pragma once

#include "sim/aircraft_state.h"

#include <glm/vec3.hpp>

#include <deque>
#include <optional>

namespace octant::sim::links {

/// One packet's motion in world axes. state.time_s is the sender's time.
struct LiveSample {
    AircraftState state;
    glm::dvec3 world_radps{0.0}; ///< rate of turn in world axes
    glm::dvec3 world_mps2{0.0};  ///< acceleration
    double extrapolation_limit_s = 0.5;   ///< how long the motion may go on beyond it
    double accelerated_s = 0.5;  ///< how long it accelerates beyond it
};

/// The motion of one vehicle, put together from samples that come late, in bursts or not at all.
/// Between samples it lies on their curve; beyond the last one it goes on by velocity and rate of
/// turn for as long as that sample allows, then it stands. What new samples put right is blended in
/// over about 0.15 s, unless it is too far for that; what lies behind along the flight is waited
/// for at less speed, so that nothing flies backwards.
class LiveTrack {
public:
    /// A sample after all others (asserted). Those that are near one another in time give way, so
    /// that memory is bounded.
    void add(const LiveSample& sample);

    bool empty() const { return samples_.empty(); }

    const LiveSample& last() const { return samples_.back(); }

    /// Those of the last seconds, in the order of time.
    const std::deque<LiveSample>& samples() const { return samples_; }

    /// Forgets all: the next sample begins another motion.
    void clear();

    /// What is to be shown `passed_s` after what was shown last, at a time of the sender's clock.
    /// There must be a sample (asserted). time_s of what it gives is `sender_s`.
    AircraftState show(double sender_s, double passed_s);

    /// Whether the last picture is so far beyond the last sample that the motion stands.
    bool is_stale() const { return stale_; }

    /// How often a correction was too far to be blended in.
    long snaps() const { return snaps_; }

private:
    AircraftState raw_at(double sender_s) const;
    AircraftState beyond(double sender_s) const;
    void blend(AircraftState& state, double sender_s, double passed_s);

    std::deque<LiveSample> samples_;
    std::optional<AircraftState> shown_;
    bool stale_ = false;
    long snaps_ = 0;
};

} // namespace octant::sim::links
