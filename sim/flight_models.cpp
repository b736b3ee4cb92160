#include "sim/flight_models.h"

#include "sim/base/units.h"
#include "sim/fixed_wing_flight.h"
#include "sim/helicopter_flight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::sim {

std::unique_ptr<PilotedFlight> make_piloted_flight(const AircraftKind& kind, const AircraftState& start) {
    if (kind.flight_model == FlightModel::Helicopter) { return std::make_unique<HelicopterFlight>(kind.limits, start); }
    return std::make_unique<FixedWingFlight>(kind.limits, start);
}

AircraftState trimmed_state(
    const AircraftKind& kind, const glm::dvec3& position_m, double heading_rad, double speed_mps) {
    return kind.flight_model == FlightModel::Helicopter ? trimmed_helicopter(position_m, heading_rad, speed_mps)
                                                        : trimmed_fixed_wing(position_m, heading_rad, speed_mps);
}

double reheat_fraction(const AircraftKind* kind, const AircraftState& state) {
    const double speed_mps = glm::length(state.velocity_mps);
    if (speed_mps < 1.0 || (kind != nullptr && kind->flight_model != FlightModel::FixedWing)) { return 0.0; }
    const Air air = standard_air(state.position_m.z);
    const double mach = speed_mps / air.speed_of_sound_mps;
    const double scale_n = 0.5 * air.density_kgpm3 * speed_mps * speed_mps * f15::wing_m2;
    const double lift_n = state.load_factor * f15::mass_kg * gravity_mps2;
    const double alpha_rad =
        f15::alpha_for_lift(std::clamp(lift_n / scale_n, -f15::max_lift_coefficient, f15::max_lift_coefficient));
    const double drag_n = scale_n * f15::drag_coefficient(alpha_rad, 0.0, mach);
    const double along_mps2 = state.speed_rate_mps2 + gravity_mps2 * state.velocity_mps.z / speed_mps;
    const double thrust_n = (drag_n + f15::mass_kg * along_mps2) / std::cos(alpha_rad);
    return f15::reheat_from_lever(f15::lever_for_thrust(thrust_n, mach, air));
}

} // namespace octant::sim
