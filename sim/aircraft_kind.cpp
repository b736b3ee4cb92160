#include "sim/aircraft_kind.h"

#include "sim/base/error.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace octant::sim {

namespace {

// Limits of the F-15C: -3..+7.33 g without the overload warning system, about 200 deg/s of roll, g
// onset of 6 g/s (general knowledge); 800 kt low down; climb of the 50,000 ft/min class. 120 m/s is
// well above its stall. Eye: 5.0 m behind the nose tip (Zaretto F-15vsp.xml) and 0.94 m above the
// reference line (JSBSim f15.xml); the origin is 10.4 m behind the nose.
constexpr AircraftKind f15{
    .name = "f15",
    .limits =
        {.least_load_factor = -3.0,
         .most_load_factor = 7.33,
         .load_factor_rate_gps = 6.0,
         .roll_rate_radps = rad_from_deg(200.0),
         .bank_rad = pi,
         .least_speed_mps = 80.0,
         .most_speed_mps = mps_from_kt(800.0),
         .climb_rate_mps = 254.0,
         .acceleration_mps2 = 8.0},
    .flight_model = FlightModel::FixedWing,
    .slowest_handed_over_mps = 120.0,
    .pilot_eye_m = {5.4, 0.0, -0.94},
    .tacview_type = "Air+FixedWing",
    .tacview_name = "F-15C",
    .model_file = "f15.obj",
    .cockpit_file = "f15-cockpit.obj"};

// Limits of the 500MD: never-exceed speed 152 kt and 8.6 m/s of climb (published data sheets),
// 0.3..2.0 g and 60 degrees of bank (general knowledge of the type's handling). A zoom trades speed
// for height, so the sustained climb limit does not hold it back; see flightpaths/fly_script.h.
// Eye: front seat on the left, 1.2 m behind the nose and 1.5 m above the skids; the origin is on
// the mast axis, 1.2 m above the skids.
constexpr AircraftKind md500{
    .name = "500md",
    .limits =
        {.least_load_factor = 0.3,
         .most_load_factor = 2.0,
         .load_factor_rate_gps = 2.0,
         .roll_rate_radps = rad_from_deg(60.0),
         .bank_rad = rad_from_deg(60.0),
         .least_speed_mps = 0.0,
         .most_speed_mps = mps_from_kt(152.0),
         .climb_rate_mps = 8.6,
         .acceleration_mps2 = 3.0},
    .flight_model = FlightModel::Helicopter,
    .slowest_handed_over_mps = 0.0,
    .pilot_eye_m = {0.75, -0.33, -0.3},
    .tacview_type = "Air+Rotorcraft",
    .tacview_name = "500MD",
    .model_file = "500md.obj",
    .cockpit_file = "500md-cockpit.obj"};

constexpr std::array kinds{f15, md500};

} // namespace

std::span<const AircraftKind> aircraft_kinds() {
    return kinds;
}

const AircraftKind* find_aircraft_kind(std::string_view name) {
    const auto found = std::ranges::find(kinds, name, &AircraftKind::name);
    return found == kinds.end() ? nullptr : &*found;
}

const AircraftKind& aircraft_kind(std::string_view name) {
    if (const AircraftKind* kind = find_aircraft_kind(name)) {
        return *kind;
    }
    std::string names;
    for (const AircraftKind& kind : kinds) {
        names += names.empty() ? "" : " or ";
        names += kind.name;
    }
    throw Error(fmt::format("expected aircraft {}, got '{}'", names, printable(std::string(name))));
}

} // namespace octant::sim
