#pragma once

#include "flightpaths/path_script.h"
#include "sim/aircraft_kind.h"
#include "sim/trajectory.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::flightpaths {

/// The time at which a leg began, for bookmarks in a recording.
struct LegStart {
    double time_s = 0.0;
    /// The leg's label, or its kind.
    std::string label;
};

struct FlownPath {
    /// Exactly script.samples samples, the first at 0 s.
    sim::Trajectory trajectory;
    std::vector<std::string> notes;
    std::vector<LegStart> legs;
};

/// Flies a path in steps of sim::step_s and samples it at its rate. World: the path's origin is the world's origin.
///
/// Throws Error with file and line of the leg that asks for more than the aircraft can give (load factor, bank, roll
/// rate, onset, speed, change of speed, sustained climb); with `lenient` such a leg is clipped and a note says so. A
/// climb is judged by energy: a steeper one is within the limits as long as the speed that it loses pays for what goes
/// beyond the sustained climb rate.
///
/// Legs that end up to 1 s before the last sample: the last leg goes on. Legs that end earlier: Error. Legs that last
/// longer are cut, and a leg that is never begun gives a note.
FlownPath fly(const PathScript& script, const sim::AircraftKind& kind, bool lenient);

} // namespace octant::flightpaths
