#pragma once

#include "sim/piloted_flight.h"

#include <glm/vec2.hpp>

#include <array>
#include <optional>

namespace octant::ui::window {

/// The buttons of a gamepad, in the order of GLFWgamepadstate; one is pressed where it is not 0.
using GamepadButtons = std::array<unsigned char, 15>;

/// A gamepad in the standard layout. Axes and buttons are in the order of GLFWgamepadstate: left x, left y (down is
/// positive), right x, right y, left and right trigger (-1 let go, 1 pressed). The bumpers move the rudder.
struct GamepadState {
    std::array<float, 6> axes{0.0F, 0.0F, 0.0F, 0.0F, -1.0F, -1.0F};
    GamepadButtons buttons{};
};

/// A joystick that is no gamepad, with the axes that it reports: x, y (pulled is positive), and either the throttle or,
/// with four axes or more, twist and throttle (-1 is full). Further axes are not used.
struct JoystickState {
    std::array<float, 4> axes{};
    /// A device with fewer than two axes is no stick and is ignored.
    int axis_count = 0;
};

/// The flight controls whose keys are held.
struct PilotKeys {
    bool pull = false;
    bool push = false;
    bool roll_left = false;
    bool roll_right = false;
    bool yaw_left = false;
    bool yaw_right = false;
    bool throttle_up = false;
    bool throttle_down = false;
};

/// The pointer when it is used as a stick.
struct CursorState {
    /// Place of the pointer, x to the right and y down, which pulls.
    glm::dvec2 from_centre_px{0.0};
    /// Distance from the centre, above zero, at which the stick is at its stop.
    double full_px = 1.0;
};

/// All devices that a pilot may use at once. Held keys take precedence over the gamepad, that over the joystick, and
/// that over the pointer.
struct PilotDevices {
    PilotKeys keys;
    std::optional<GamepadState> gamepad;
    std::optional<JoystickState> joystick;
    std::optional<CursorState> cursor;
};

/// Returns the controls `passed_s` seconds after `before`; of more than 0.1 s only that much counts. Sticks act as they
/// stand, with a dead zone and finer about the centre. Held keys move the stick to its stop in about half a second, and
/// it returns to the centre when they are let go. The throttle stays where it is put: keys and triggers move it, and a
/// joystick's lever sets it. The result depends on the arguments alone, and all controls are within their ranges
/// whatever the devices report.
sim::PilotControls controls_after(const sim::PilotControls& before, const PilotDevices& devices, double passed_s);

/// Whether a pilot's hand is on any of the devices: a key held, or a stick or trigger out of its dead zone.
bool moves_controls(const PilotDevices& devices);

/// Returns an axis of a stick without its dead zone and finer about the centre: an odd, rising function that is 0
/// within the dead zone and 1 at 1. NaN gives 0.
double shaped_axis(double axis);

} // namespace octant::ui::window
