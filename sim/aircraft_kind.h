#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/units.h"

#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <string_view>

namespace octant::sim {

/// How an aircraft moves when a pilot flies it by hand (flight_models.h).
enum class FlightModel { FixedWing, Helicopter };

/// All that the program knows of one type of aircraft. Whatever depends on the type is a field here, never a comparison
/// of names elsewhere.
struct AircraftKind {
    /// As options, path files and the files of built-in paths name it.
    std::string_view name;
    AircraftLimits limits;
    FlightModel flight_model = FlightModel::FixedWing;
    /// Slowest level flight that is handed to a pilot; not below limits.min_speed_mps.
    double min_handover_speed_mps = 0.0;
    /// Where the pilot's eye is, in body axes.
    glm::dvec3 pilot_eye_m{0.0};
    /// What Tacview calls such an aircraft: its tags ("Air+FixedWing") and its name.
    std::string_view tacview_type;
    std::string_view tacview_name;
    /// OBJ files in the program's folder of models.
    std::string_view model_file;
    std::string_view cockpit_file;
    /// The plain aircraft of the same type, whose built-in paths it flies and as which it is drawn far away; empty = it
    /// is one. No point of one model is farther than `simple_model_error_m` from the other.
    std::string_view simple_type_name = {};
    double simple_model_error_m = 0.0;
};

/// The same type in more detail: its model near, the plain one far away.
constexpr AircraftKind detailed_variant(
    AircraftKind kind, std::string_view name, std::string_view file, double simple_model_error_m) {
    kind.simple_type_name = kind.name;
    kind.simple_model_error_m = simple_model_error_m;
    kind.name = name;
    kind.model_file = file;
    return kind;
}

// Limits of the F-15C: -3..+7.33 g without the overload warning system, about 200 deg/s of roll, g onset of 6 g/s
// (general knowledge); 800 kt low down; climb of the 50,000 ft/min class. 120 m/s is well above its stall. Eye: 5.0 m
// behind the nose tip (Zaretto F-15vsp.xml) and 0.94 m above the reference line (JSBSim f15.xml); the origin is 10.4 m
// behind the nose.
inline constexpr AircraftKind f15_kind{.name = "f15",
    .limits = {.min_load_factor = -3.0,
        .max_load_factor = 7.33,
        .load_factor_rate_gps = 6.0,
        .roll_rate_radps = rad_from_deg(200.0),
        .bank_rad = pi,
        .min_speed_mps = 80.0,
        .max_speed_mps = mps_from_kt(800.0),
        .climb_rate_mps = 254.0,
        .acceleration_mps2 = 8.0},
    .flight_model = FlightModel::FixedWing,
    .min_handover_speed_mps = 120.0,
    .pilot_eye_m = {5.4, 0.0, -0.94},
    .tacview_type = "Air+FixedWing",
    .tacview_name = "F-15C",
    .model_file = "f15.obj",
    .cockpit_file = "f15-cockpit.obj"};

// Limits of the 500MD: never-exceed speed 152 kt and 8.6 m/s of climb (published data sheets), 0.3..2.0 g and 60
// degrees of bank (general knowledge of the type's handling). A zoom trades speed for height, so the sustained climb
// limit does not hold it back; see flightpaths/fly_script.h. Eye: front seat on the left, 1.2 m behind the nose and 1.5
// m above the skids; the origin is on the mast axis, 1.2 m above the skids.
inline constexpr AircraftKind md500_kind{.name = "500md",
    .limits = {.min_load_factor = 0.3,
        .max_load_factor = 2.0,
        .load_factor_rate_gps = 2.0,
        .roll_rate_radps = rad_from_deg(60.0),
        .bank_rad = rad_from_deg(60.0),
        .min_speed_mps = 0.0,
        .max_speed_mps = mps_from_kt(152.0),
        .climb_rate_mps = 8.6,
        .acceleration_mps2 = 3.0},
    .flight_model = FlightModel::Helicopter,
    .min_handover_speed_mps = 0.0,
    .pilot_eye_m = {0.75, -0.33, -0.3},
    .tacview_type = "Air+Rotorcraft",
    .tacview_name = "500MD",
    .model_file = "500md.obj",
    .cockpit_file = "500md-cockpit.obj"};

/// The types that the program knows, one row each, in the order in which lists name them. A new type is a row here and
/// its files: models, and paths of its name in flightpaths.
inline constexpr std::array aircraft_table{f15_kind, md500_kind,
    detailed_variant(f15_kind, "f15-detailed", "f15-detailed.obj", 0.66),
    detailed_variant(md500_kind, "500md-detailed", "500md-detailed.obj", 0.69)};

/// All types that are known, in the order in which messages list them.
std::span<const AircraftKind> aircraft_kinds();

/// The type of a name; null for a name that none has.
const AircraftKind* find_aircraft_kind(std::string_view name);

/// The type of a name. Throws Error "expected aircraft f15 or 500md or ..., got ..." for a name that none has.
const AircraftKind& aircraft_kind(std::string_view name);

} // namespace octant::sim
