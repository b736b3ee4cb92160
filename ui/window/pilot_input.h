#pragma once

#include "sim/hand_flight.h"

#include <glm/vec2.hpp>

#include <array>
#include <optional>

namespace octant::ui::window {

/// A gamepad in the standard layout, axes and buttons in the order of GLFWgamepadstate: left x,
/// left y (down is positive), right x, right y, left and right trigger (-1 let go, 1 pressed). The
/// bumpers are keys for the rudder.
struct GamepadState {
    std::array<float, 6> axes{0.0F, 0.0F, 0.0F, 0.0F, -1.0F, -1.0F};
    std::array<unsigned char, 15> buttons{}; ///< not 0: pressed
};

/// A joystick that is no gamepad, as it reports itself: x, y (pulled is positive), and either the
/// throttle or, with four axes or more, twist and throttle (-1 is full). More axes are not used.
struct JoystickState {
    std::array<float, 4> axes{};
    int axis_count = 0; ///< without the y axis it is no stick
};

/// Which keys are held.
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

/// The pointer as a stick.
struct CursorState {
    glm::dvec2 from_centre_px{0.0}; ///< x to the right, y down (pulls)
    double full_px = 1.0;           ///< as far from the centre the stick is at its stop; above zero
};

/// What a pilot has in hand. More than one may be there: held keys go before the stick, of sticks
/// the gamepad goes before the joystick, and that before the pointer.
struct PilotDevices {
    PilotKeys keys;
    std::optional<GamepadState> gamepad;
    std::optional<JoystickState> joystick;
    std::optional<CursorState> cursor;
};

/// The controls `passed_s` after `before`. Sticks are taken as they stand, with a dead zone and
/// finer about the centre; held keys move the stick to its stop in half a second or so, and it goes
/// back to the centre when they are let go. The throttle stays where it is put: keys and triggers
/// move it, a joystick's lever is its place. Depends on nothing else; all controls are within their
/// ranges whatever the devices report. Of more than a tenth of a second only that counts.
sim::PilotControls
controls_after(const sim::PilotControls& before, const PilotDevices& devices, double passed_s);

/// An axis with its dead zone taken out and finer about the centre: 0 within the dead zone, odd,
/// rising, 1 at 1. Not-a-numbers are 0.
double shaped_axis(double axis);

} // namespace octant::ui::window
