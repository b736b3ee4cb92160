#pragma once

#include "sim/aircraft_state.h"

#include <span>
#include <vector>

namespace octant::sim {

/// How the heights of a path are laid over ground.
enum class HeightMode {
    /// The whole path is lifted (or lowered) by one height, so that its lowest clearance over the ground is the wanted
    /// one.
    Clear,
    /// Heights are heights over a smoothed ground; where the aircraft cannot follow any, the whole path is lifted by
    /// one height, and a note says so.
    Follow,
    /// Heights stay as they are; with place 0, 0 and heading 0 all of the path is as it was, to the last bit.
    Datum
};

/// The state at a time between two samples, time_s of `a` before that of `b`: position along the cubic Hermite curve
/// through both positions and velocities, attitude turned at a constant rate.
AircraftState state_between(const AircraftState& a, const AircraftState& b, double time_s);

/// The mean turn rate about the body axes from one state to a later one, rad/s; a chord in place of the arc, which is
/// 1 % less at half a radian.
glm::dvec3 turn_rate_radps(const AircraftState& a, const AircraftState& b);

/// A flight as samples in time order with a state for every time between them.
///
/// Positions run along cubic Hermite curves through the samples' positions and velocities, so position and velocity are
/// continuous; attitudes turn at a constant rate between samples (slerp).
class Trajectory {
public:
    /// At least one sample, times strictly increasing (asserted; readers check before). Fills in the samples'
    /// speed_rate_mps2 from their velocities and turn_rate_radps from their attitudes.
    explicit Trajectory(std::vector<AircraftState> samples);

    std::span<const AircraftState> samples() const { return samples_; }

    double start_s() const { return samples_.front().time_s; }

    double end_s() const { return samples_.back().time_s; }

    /// State at `time_s`; before the start the first sample and after the end the last one as it is, with its own time
    /// and velocity. O(log samples).
    AircraftState state_at(double time_s) const;

private:
    std::vector<AircraftState> samples_;
};

} // namespace octant::sim
