#include "sim/flight_models.h"

#include "sim/fixed_wing_flight.h"
#include "sim/helicopter_flight.h"

namespace octant::sim {

std::unique_ptr<HandFlight> hand_flight(const AircraftKind& kind, const AircraftState& start) {
    if (kind.flight_model == FlightModel::Helicopter) {
        return std::make_unique<HelicopterFlight>(kind.limits, start);
    }
    return std::make_unique<FixedWingFlight>(kind.limits, start);
}

AircraftState trimmed_state(
    const AircraftKind& kind, const glm::dvec3& position_m, double heading_rad, double speed_mps) {
    return kind.flight_model == FlightModel::Helicopter
               ? trimmed_helicopter(position_m, heading_rad, speed_mps)
               : trimmed_fixed_wing(position_m, heading_rad, speed_mps);
}

} // namespace octant::sim
