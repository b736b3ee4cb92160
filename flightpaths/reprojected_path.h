#pragma once

#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

namespace octant::flightpaths {

/// A path in the axes of one frame, brought to those of another one, counted from where the origin of the first lies in
/// it: each sample stays over its place on the earth, and attitude and velocity keep their directions from true north.
/// Where the frames' planets differ in size, speed over the ground is stretched as the distances are.
sim::Trajectory reprojected(const sim::Trajectory& path, const EarthFrame& from, const EarthFrame& to);

} // namespace octant::flightpaths
