#pragma once

#include "sim/aircraft_state.h"

namespace octant::ui {

/// Where wingmen fly: nearly abreast of the leader, alternately to the right and left of him, level
/// and in the same attitude, far enough apart for the largest of them.
class Formation {
public:
    /// `aircraft` >= 1 with the leader; `largest_radius_m` of any of them.
    Formation(int aircraft, double largest_radius_m);

    /// State of wingman `number` (from 1) beside the leader.
    sim::AircraftState wingman_of(const sim::AircraftState& leader, int number) const;

    /// Radius of the sphere that a chase camera should frame, so that all are in its picture: the
    /// leader's own radius unless the formation is too wide for it.
    double framed_radius_m(double leader_radius_m) const;

private:
    int ranks_;
    double aside_m_; ///< for each rank
    double back_m_;  ///< for each rank
};

} // namespace octant::ui
