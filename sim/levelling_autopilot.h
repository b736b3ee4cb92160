#pragma once

#include "sim/piloted_flight.h"

namespace octant::sim {

/// Flies an aircraft by its controls, as a pilot would, until it is level and in trim: wings level first, then out of
/// the climb or dive, at the speed it has, or at the slowest that is handed to a pilot where it is slower. The same
/// states give the same controls.
class LevellingAutopilot {
public:
    /// `kind` must outlive it.
    LevellingAutopilot(const AircraftKind& kind, const AircraftState& start);

    /// Controls for the next step from this state, once a step. Once it is done, those that keep it as it is.
    PilotControls controls(const AircraftState& state);

    /// Whether it has been level and unturning for half a second.
    bool is_done() const;

private:
    PilotControls fixed_wing(const AircraftState& state) const;
    PilotControls helicopter(const AircraftState& state) const;
    double trim_throttle(const AircraftState& state, double speed_mps) const;

    const AircraftKind& kind_;
    /// The speed that is to be held.
    double speed_mps_ = 0.0;
    int level_steps_ = 0;
};

} // namespace octant::sim
