#include "sim/aircraft_limits.h"

#include "sim/base/units.h"

namespace octant::sim {

// F-15C: -3..+7.33 g without the overload warning system, about 200 deg/s of roll, g onset of 6 g/s
// (general knowledge); 800 kt low down; climb of the 50,000 ft/min class.
// 500MD: never-exceed speed 152 kt and 8.6 m/s of climb (published data sheets), 0.3..2.0 g and 60
// degrees of bank (general knowledge of the type's handling). A zoom trades speed for height, so
// the sustained climb limit does not hold it back; see flightpaths/fly_script.h.
std::optional<AircraftLimits> limits_of(std::string_view aircraft) {
    if (aircraft == "f15") {
        return AircraftLimits{
            .name = "f15",
            .least_load_factor = -3.0,
            .most_load_factor = 7.33,
            .load_factor_rate_gps = 6.0,
            .roll_rate_radps = rad_from_deg(200.0),
            .bank_rad = pi,
            .least_speed_mps = 80.0,
            .most_speed_mps = mps_from_kt(800.0),
            .climb_rate_mps = 254.0,
            .acceleration_mps2 = 8.0};
    }
    if (aircraft == "500md") {
        return AircraftLimits{
            .name = "500md",
            .least_load_factor = 0.3,
            .most_load_factor = 2.0,
            .load_factor_rate_gps = 2.0,
            .roll_rate_radps = rad_from_deg(60.0),
            .bank_rad = rad_from_deg(60.0),
            .least_speed_mps = 0.0,
            .most_speed_mps = mps_from_kt(152.0),
            .climb_rate_mps = 8.6,
            .acceleration_mps2 = 3.0};
    }
    return std::nullopt;
}

} // namespace octant::sim
