#include "ui/window/pilot_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::ui::window {

namespace {

constexpr double dead_zone = 0.10;
/// Share of the cubic term in the curve of an axis. The slope at the centre is 1 minus this.
constexpr double cubed_share = 0.6;
constexpr double press_per_s = 2.0;
constexpr double key_release_per_s = 3.0;
/// How fast the controls return to the centre when a stick has come back to its dead zone.
constexpr double stick_release_per_s = 8.0;
constexpr double key_throttle_per_s = 0.4;
constexpr double trigger_throttle_per_s = 0.6;
constexpr double longest_s = 0.1;
constexpr std::size_t left_bumper = 4;
constexpr std::size_t right_bumper = 5;

/// The position of a stick, and how fast the controls return to the centre while it is centred.
struct StickPosition {
    double pitch = 0.0;
    double roll = 0.0;
    double yaw = 0.0;
    double release_per_s = stick_release_per_s;
};

double number_or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

/// Returns how far a trigger is pressed, from 0 to 1.
double trigger(float axis) { return std::clamp(0.5 * (number_or_zero(static_cast<double>(axis)) + 1.0), 0.0, 1.0); }

double shaped_stick_axis(float axis) { return shaped_axis(static_cast<double>(axis)); }

StickPosition stick_position_of(const PilotDevices& devices) {
    if (devices.gamepad) {
        const auto& axes = devices.gamepad->axes;
        return StickPosition{shaped_stick_axis(axes[1]), shaped_stick_axis(axes[0]), shaped_stick_axis(axes[2])};
    }
    if (devices.joystick && devices.joystick->axis_count >= 2) {
        const auto& axes = devices.joystick->axes;
        const bool twists = devices.joystick->axis_count >= 4;
        return StickPosition{
            shaped_stick_axis(axes[1]), shaped_stick_axis(axes[0]), twists ? shaped_stick_axis(axes[2]) : 0.0};
    }
    if (devices.cursor) {
        const glm::dvec2 offset = devices.cursor->from_centre_px / devices.cursor->full_px;
        return StickPosition{shaped_axis(offset.y), shaped_axis(offset.x), 0.0};
    }
    return {.release_per_s = key_release_per_s};
}

double moved(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

/// Returns the direction, -1, 0 or 1, in which two keys move an axis.
double key_axis(bool less, bool more) { return (more ? 1.0 : 0.0) - (less ? 1.0 : 0.0); }

/// Returns one axis after `passed_s`. Held keys move it first, else the stick sets it, else it returns to the centre.
double axis_after(double before, double keys, double stick, double release_per_s, double passed_s) {
    if (keys != 0.0) {
        const double back = before * keys < 0.0 ? key_release_per_s : 0.0;
        return moved(before, keys, (press_per_s + back) * passed_s);
    }
    return stick != 0.0 ? stick : moved(before, 0.0, release_per_s * passed_s);
}

double throttle_after(double before, const PilotDevices& devices, double passed_s) {
    const PilotKeys& keys = devices.keys;
    const double by_keys = key_axis(keys.throttle_down, keys.throttle_up);
    if (by_keys != 0.0) { return before + by_keys * key_throttle_per_s * passed_s; }
    if (devices.gamepad) {
        const auto& axes = devices.gamepad->axes;
        const double up = shaped_axis(trigger(axes[5])) - shaped_axis(trigger(axes[4]));
        return before + up * trigger_throttle_per_s * passed_s;
    }
    if (devices.joystick && devices.joystick->axis_count >= 3) {
        const auto& axes = devices.joystick->axes;
        return 1.0 - trigger(devices.joystick->axis_count >= 4 ? axes[3] : axes[2]);
    }
    return before;
}

} // namespace

bool moves_controls(const PilotDevices& devices) {
    const PilotKeys& keys = devices.keys;
    const bool by_keys = keys.pull || keys.push || keys.roll_left || keys.roll_right || keys.yaw_left ||
                         keys.yaw_right || keys.throttle_up || keys.throttle_down;
    const StickPosition stick = stick_position_of(devices);
    const bool by_stick = stick.pitch != 0.0 || stick.roll != 0.0 || stick.yaw != 0.0;
    const bool by_pad =
        devices.gamepad && (devices.gamepad->buttons[left_bumper] != 0 || devices.gamepad->buttons[right_bumper] != 0 ||
                               shaped_axis(trigger(devices.gamepad->axes[4])) != 0.0 ||
                               shaped_axis(trigger(devices.gamepad->axes[5])) != 0.0);
    return by_keys || by_stick || by_pad;
}

double shaped_axis(double axis) {
    const double size = std::min(std::isnan(axis) ? 0.0 : std::abs(axis), 1.0);
    if (size <= dead_zone) { return 0.0; }
    const double live = (size - dead_zone) / (1.0 - dead_zone);
    return std::copysign((1.0 - cubed_share) * live + cubed_share * live * live * live, axis);
}

sim::PilotControls controls_after(const sim::PilotControls& before, const PilotDevices& devices, double passed_s) {
    const double time_s = std::clamp(number_or_zero(passed_s), 0.0, longest_s);
    const PilotKeys& keys = devices.keys;
    const bool pad = devices.gamepad.has_value();
    const double yaw_keys = key_axis(keys.yaw_left || (pad && devices.gamepad->buttons[left_bumper] != 0),
        keys.yaw_right || (pad && devices.gamepad->buttons[right_bumper] != 0));
    const StickPosition stick = stick_position_of(devices);
    const auto axis = [&](double from, double by_keys, double by_stick) {
        const double after = axis_after(number_or_zero(from), by_keys, by_stick, stick.release_per_s, time_s);
        return std::clamp(after, -1.0, 1.0);
    };
    const double throttle = throttle_after(number_or_zero(before.throttle), devices, time_s);
    return {axis(before.pitch, key_axis(keys.push, keys.pull), stick.pitch),
        axis(before.roll, key_axis(keys.roll_left, keys.roll_right), stick.roll), axis(before.yaw, yaw_keys, stick.yaw),
        std::clamp(throttle, 0.0, 1.0)};
}

} // namespace octant::ui::window
