#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"

namespace octant::sim {

/// What a pilot asks of the aircraft. F-15: stick, rudder, throttle. 500MD: cyclic, pedals, collective. Values outside
/// their range are clamped, not-a-numbers count as 0.
struct PilotControls {
    /// From -1, pushed, to 1, pulled.
    double pitch = 0.0;
    /// From -1, left, to 1, right.
    double roll = 0.0;
    /// From -1, left, to 1, right.
    double yaw = 0.0;
    /// From 0, idle or the lowest collective, to 1, full.
    double throttle = 0.0;
};

/// Why a flight by hand is not quite in its pilot's hands.
struct FlightWarnings {
    /// Whether more lift was asked for than the wing has.
    bool stalled = false;
    /// Whether load factor, roll rate, bank, speed or climb is held at its limit.
    bool is_at_limit = false;
};

/// An aircraft flown by hand: a point mass with attitude, in fixed steps of sim::step_s. The same start and controls
/// give the same states to the last bit.
class PilotedFlight {
public:
    PilotedFlight() = default;
    virtual ~PilotedFlight() = default;
    PilotedFlight(const PilotedFlight&) = delete;
    PilotedFlight& operator=(const PilotedFlight&) = delete;
    PilotedFlight(PilotedFlight&&) = delete;
    PilotedFlight& operator=(PilotedFlight&&) = delete;

    /// One fixed step on. AircraftState::time_s is that of the start plus the steps.
    virtual void step(const PilotControls& controls) = 0;

    virtual const AircraftState& state() const = 0;

    virtual FlightWarnings warnings() const = 0;

    /// Throttle that holds speed and height from the start on with centred stick.
    virtual double trim_throttle() const = 0;
};

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
