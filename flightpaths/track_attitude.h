#pragma once

#include "flightpaths/track_phases.h"
#include "flightpaths/track_recording.h"
#include "flightpaths/track_wind.h"
#include "sim/base/axes.h"

#include <vector>

namespace octant::flightpaths {

/// Attitudes that a motion asks for, one for each time of the path: see motion_of().
std::vector<EulerAngles> inferred_attitudes(
    const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind);

/// One angle of a recording at those times, rad; NaN where it was not measured.
using MeasuredAngle = std::vector<double>;

/// Puts measured values of one angle in place of inferred ones; between measured ones the difference is interpolated,
/// and beyond half a minute from them it goes to zero.
void take_measured(std::span<const double> times_s, const MeasuredAngle& measured, double EulerAngles::*angle,
    std::vector<EulerAngles>& attitudes);

} // namespace octant::flightpaths
