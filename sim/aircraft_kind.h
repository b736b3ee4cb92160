#pragma once

#include "sim/aircraft_limits.h"

#include <glm/vec3.hpp>

#include <span>
#include <string_view>

namespace octant::sim {

/// How an aircraft moves when a pilot flies it by hand (flight_models.h).
enum class FlightModel { FixedWing, Helicopter };

/// All that the program knows of one type of aircraft. Whatever depends on the type is a field
/// here, never a comparison of names elsewhere.
struct AircraftKind {
    /// As options, path files and the files of built-in paths name it.
    std::string_view name;
    AircraftLimits limits;
    FlightModel flight_model = FlightModel::FixedWing;
    /// Slowest level flight that is handed to a pilot; not below limits.least_speed_mps.
    double slowest_handed_over_mps = 0.0;
    /// Where the pilot's eye is, in body axes.
    glm::dvec3 pilot_eye_m{0.0};
    /// What Tacview calls such an aircraft: its tags ("Air+FixedWing") and its name.
    std::string_view tacview_type;
    std::string_view tacview_name;
    /// OBJ files in the program's folder of models.
    std::string_view model_file;
    std::string_view cockpit_file;
};

/// All types that are known, in the order in which messages list them.
std::span<const AircraftKind> aircraft_kinds();

/// The type of a name; null for a name that none has.
const AircraftKind* find_aircraft_kind(std::string_view name);

/// The type of a name. Throws Error "expected aircraft f15 or 500md, got ..." for a name that none
/// has.
const AircraftKind& aircraft_kind(std::string_view name);

} // namespace octant::sim
