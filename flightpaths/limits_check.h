#pragma once

#include "flightpaths/path_script.h"
#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/trajectory.h"

#include <string>
#include <vector>

namespace octant::flightpaths {

/// Judges what legs ask for against what an aircraft can give. Strict: throws Error "file:line: expected a load factor
/// of at most 2.0 for 500md, got 3.5". Lenient: brings the value to the limit and adds a note of the same content.
class LimitsCheck {
public:
    LimitsCheck(const PathScript& script, const sim::AircraftKind& kind, bool lenient, std::vector<std::string>& notes);

    /// `what` names the value, `unit` follows the numbers (" deg", " m/s" or empty).
    struct Subject {
        int line = 0;
        const char* what = "";
        const char* unit = "";
    };

    double at_most(double value, double limit, const Subject& subject) const;
    double at_least(double value, double limit, const Subject& subject) const;

    /// The leg as it may be flown: load factor, bank, roll rate, acceleration, speed and, for a weave, the peaks of
    /// bank, roll rate, load factor and its onset.
    Leg checked(const Leg& leg) const;

private:
    /// The limit, and a note of it; where limits are not to be clipped an error.
    double clipped(double value, double limit, const char* which, const Subject& subject) const;
    void check_turn(Leg& leg) const;
    void check_weave(Leg& leg) const;
    std::string weave_error(const Leg& leg) const;

    const PathScript& script_;
    const sim::AircraftKind& kind_;
    const sim::AircraftLimits& limits_;
    bool lenient_;
    std::vector<std::string>& notes_;
};

/// The slowest speed that legs may be flown at: lift bends the path of a point mass only while it moves, so a hover is
/// no leg.
double min_flown_speed_mps(const sim::AircraftLimits& limits);

/// What of a motion lies more than 5 % beyond the limits of an aircraft that it was not made for, as "speed in kt up to
/// 486 (at most 152), load factor up to 4 (at most 2)"; empty where all is within. `is_smooth`: load factors, bank and
/// the lowest speed count, too. In a recorded track the first two are mostly noise, and the last one is its taxiing.
std::string limits_violation(const sim::AircraftLimits& limits, const sim::Trajectory& path, bool is_smooth);

} // namespace octant::flightpaths
