#pragma once

#include "flightpaths/track_inference.h"
#include "sim/base/axes.h"
#include "sim/trajectory.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

/// A time on the ground, and what its recorded heights lack there.
struct GroundContactSpan {
    double from_s = 0.0;
    double to_s = 0.0;
    /// Added to the recorded heights, where it begins and ends.
    double added_from_m = 0.0;
    double added_to_m = 0.0;
};

struct GroundContactReport {
    std::vector<GroundContactSpan> contacts;
    /// Altimeter settings under which recorded pressure heights are those of the ground, where the first flight begins
    /// and the last one ends.
    std::optional<double> qnh_take_off_hpa;
    std::optional<double> qnh_landing_hpa;
    /// The most that a flight was lifted, where it met the ground.
    double lifted_m = 0.0;
};

struct GroundContactOptions {
    /// How far the aircraft reaches below its reference point.
    double reach_below_m = 0.0;
    /// Heights were recorded by pressure, or nothing is known of them: larger differences are believed.
    bool by_pressure = false;
    /// Only this part is flown.
    double from_s = -std::numeric_limits<double>::infinity();
    double to_s = std::numeric_limits<double>::infinity();
};

struct LaidTrack {
    sim::Trajectory trajectory;
    GroundContactReport report;
    std::vector<std::string> notes;
};

/// Lays what a track does on the ground onto this ground: there its heights are those of the ground, smoothed upwards
/// within a second, plus the reach of the aircraft, and attitudes that were inferred are those of the ground. Between
/// two such times heights are changed by what lies between the two differences, before the first and after the last by
/// a constant, and near contact so that the path meets the ground without a bend. Where the flight is then still in the
/// ground by no more than its errors it is lifted smoothly. Differences too large to be errors are left alone, with a
/// note. Places, times and speeds over the ground stay. Where there is no ground nothing is changed.
LaidTrack laid_on_ground(const sim::Trajectory& track, const TrackInference& inference, const GroundHeight& ground,
    const GroundContactOptions& options);

/// The altimeter setting under which a pressure height reads as a height above the sea; standard atmosphere.
double qnh_hpa(double pressure_height_m, double height_m);

} // namespace octant::flightpaths
