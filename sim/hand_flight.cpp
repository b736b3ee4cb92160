#include "sim/hand_flight.h"

#include "sim/fixed_wing_flight.h"
#include "sim/helicopter_flight.h"

namespace octant::sim {

std::unique_ptr<HandFlight> hand_flight(std::string_view aircraft, const AircraftState& start) {
    if (aircraft == "500md") {
        return std::make_unique<HelicopterFlight>(start);
    }
    return std::make_unique<FixedWingFlight>(start);
}

AircraftState trimmed_state(
    std::string_view aircraft, const glm::dvec3& position_m, double heading_rad, double speed_mps) {
    return aircraft == "500md" ? trimmed_helicopter(position_m, heading_rad, speed_mps)
                               : trimmed_fixed_wing(position_m, heading_rad, speed_mps);
}

} // namespace octant::sim
