#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/piloted_flight.h"
#include "ui/flight/session.h"
#include "ui/window/view_state.h"

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::window {

/// A named value shown during manual flight.
struct FlightReadout {
    std::string name;
    std::string value;
};

/// Returns throttle or collective, speed, height, climb rate, angle of attack and load factor.
std::vector<FlightReadout> flight_readouts(
    const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls);

/// A word of the status line, which is visible even while panels are hidden.
struct StatusMark {
    std::string text;
    bool warns = false;
};

/// The state of a manual flight for the status line.
struct ManualFlightStatus {
    sim::FlightWarnings warnings;
    /// The flight has ended: the aircraft left the map or met the ground.
    bool ended = false;
    /// The flight ended because the aircraft left the map.
    bool off_the_map = false;
    /// The aircraft is levelling off (Simulation::level_off).
    bool levelling = false;
};

/// Returns the marks that apply, in this order: "REC folder", "paused", "x0.5", "x0.67 of real time", "by hand",
/// "STALL", ...
std::vector<StatusMark> status_marks(const ViewState& state, const std::optional<ManualFlightStatus>& manual_flight);

// Each function makes the widgets of one panel if it is open, to be called between ImGui::NewFrame and ImGui::Render.
// Panels read the session and change only ViewState: settings in `next_settings`, everything else in `requests`.

void flight_panel(ViewState& state, flight::Session& session);
void timing_panel(ViewState& state);
void settings_panel(ViewState& state);
void help_panel(ViewState& state);
void first_steps_panel(ViewState& state);

/// Draws the status marks and the last message between the columns of panels, at the top of the window; at the bottom
/// during a live flight, whose picture has text at the top. Returns the height used at the top of the window.
float status_line(const ViewState& state, flight::Session& session, double now_s);

/// Draws the painting order of the first aircraft's polygons as numbers on the polygons that face the eye.
void write_order_numbers(const flight::Session& session);

/// Makes all open panels.
void all_panels(ViewState& state, flight::Session& session, double now_s);

} // namespace octant::ui::window
