#include "ui/window/pilot_input.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace octant::ui::window;
using octant::sim::PilotControls;

namespace {

constexpr double frame_s = 1.0 / 60.0;
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Controls after holding the devices as they are for a time.
PilotControls after(PilotControls controls, const PilotDevices& devices, double seconds, double step_s = frame_s) {
    for (long step = 0; step < std::lround(seconds / step_s); ++step) {
        controls = controls_after(controls, devices, step_s);
    }
    return controls;
}

PilotDevices keys(const PilotKeys& held) {
    PilotDevices devices;
    devices.keys = held;
    return devices;
}

PilotDevices gamepad(std::array<float, 6> axes) {
    PilotDevices devices;
    devices.gamepad = GamepadState{axes, {}};
    return devices;
}

PilotDevices joystick(std::array<float, 4> axes, int count) {
    PilotDevices devices;
    devices.joystick = JoystickState{axes, count};
    return devices;
}

} // namespace

TEST_CASE("a hand on any device is noticed, one that only lies there is not") {
    PilotDevices devices;
    CHECK_FALSE(moves_controls(devices));
    devices.gamepad.emplace();
    devices.joystick.emplace();
    devices.joystick->axis_count = 4;
    devices.joystick->axes[3] = -0.7F; // its lever
    CHECK_FALSE(moves_controls(devices));
    devices.gamepad->axes[0] = 0.05F;
    CHECK_FALSE(moves_controls(devices));
    devices.gamepad->axes[0] = 0.5F;
    CHECK(moves_controls(devices));
    devices.gamepad.emplace().axes[5] = 0.0F; // half pressed
    CHECK(moves_controls(devices));
    devices.gamepad.emplace().buttons[4] = 1;
    CHECK(moves_controls(devices));
    devices.gamepad.reset();
    devices.keys.throttle_up = true;
    CHECK(moves_controls(devices));
}

TEST_CASE("an axis has a dead zone, is fine about the centre and reaches its stops") {
    CHECK(shaped_axis(0.0) == 0.0);
    CHECK(shaped_axis(0.09) == 0.0);
    CHECK(shaped_axis(-0.09) == 0.0);
    CHECK(shaped_axis(1.0) == Approx(1.0));
    CHECK(shaped_axis(-1.0) == Approx(-1.0));
    CHECK(shaped_axis(0.5) > 0.1);
    CHECK(shaped_axis(0.5) < 0.35);
    CHECK(shaped_axis(0.11) < 0.01); // no jump at the edge
    for (double axis = -0.999; axis < 1.0; axis += 0.01) {
        CHECK(shaped_axis(axis + 0.01) >= shaped_axis(axis));
        CHECK(shaped_axis(-axis) == -shaped_axis(axis));
    }
    CHECK(shaped_axis(not_a_number) == 0.0);
    CHECK(shaped_axis(7.0) == Approx(1.0));
    CHECK(shaped_axis(-std::numeric_limits<double>::infinity()) == Approx(-1.0));
}

TEST_CASE("the left stick of a gamepad is the stick, the right one the rudder") {
    const PilotControls controls = controls_after({0, 0, 0, 0.4}, gamepad({-1, 1, 0.7F, 0.9F, -1, -1}), frame_s);
    CHECK(controls.roll == Approx(-1));
    CHECK(controls.pitch == Approx(1)); // pulled back, which a gamepad reports as down
    CHECK(controls.yaw == Approx(shaped_axis(0.7)).epsilon(1e-6));
    CHECK(controls.throttle == 0.4);
}

TEST_CASE("the bumpers of a gamepad push the rudder by and by") {
    PilotDevices devices = gamepad({0, 0, 0, 0, -1, -1});
    devices.gamepad->buttons[5] = 1;
    CHECK(after({}, devices, 0.1).yaw == Approx(0.2));
    devices.gamepad->buttons[5] = 0;
    devices.gamepad->buttons[4] = 1;
    CHECK(after({}, devices, 1.0).yaw == -1.0);
}

TEST_CASE("the triggers of a gamepad move the throttle by and by, and it stays") {
    PilotControls controls{0, 0, 0, 0.5};
    controls = after(controls, gamepad({0, 0, 0, 0, -1, 1}), 0.5);
    CHECK(controls.throttle == Approx(0.8).margin(0.02));
    const double kept = controls.throttle;
    controls = after(controls, gamepad({0, 0, 0, 0, -1, -1}), 2.0);
    CHECK(controls.throttle == kept);
    controls = after(controls, gamepad({0, 0, 0, 0, 1, -1}), 5.0);
    CHECK(controls.throttle == 0.0);
    controls = after(controls, gamepad({0, 0, 0, 0, 0, 0}), 1.0); // both alike
    CHECK(controls.throttle == 0.0);
}

TEST_CASE("a stick let go comes back to the centre at once or nearly") {
    const PilotControls pulled = controls_after({}, gamepad({1, 1, 0, 0, -1, -1}), frame_s);
    const PilotControls let_go = after(pulled, gamepad({0.05F, 0.02F, 0, 0, -1, -1}), 0.15);
    CHECK(let_go.pitch == 0.0);
    CHECK(let_go.roll == 0.0);
}

TEST_CASE("a joystick has its throttle on the third axis, or with a twist on the fourth") {
    const PilotControls three = controls_after({0, 0, 0, 0.3}, joystick({1, -1, -1, 0}, 3), frame_s);
    CHECK(three.roll == Approx(1));
    CHECK(three.pitch == Approx(-1));
    CHECK(three.yaw == 0.0);
    CHECK(three.throttle == 1.0);
    const PilotControls four = controls_after({0, 0, 0, 0.3}, joystick({0, 0, -1, 1}, 4), frame_s);
    CHECK(four.yaw == Approx(-1));
    CHECK(four.throttle == 0.0);
    const PilotControls two = controls_after({0, 0, 0, 0.3}, joystick({0, 1, 1, 1}, 2), frame_s);
    CHECK(two.pitch == Approx(1));
    CHECK(two.yaw == 0.0);
    CHECK(two.throttle == 0.3);
    const PilotControls none = controls_after({0, 0, 0, 0.3}, joystick({1, 1, 1, 1}, 1), frame_s);
    CHECK(none.roll == 0.0);
    CHECK(none.throttle == 0.3);
}

TEST_CASE("held keys move the stick smoothly to its stop, let go it returns") {
    const PilotKeys held{.pull = true, .roll_left = true, .yaw_right = true};
    PilotControls controls = after({}, keys(held), 0.1);
    CHECK(controls.pitch == Approx(0.2));
    CHECK(controls.roll == Approx(-0.2));
    CHECK(controls.yaw == Approx(0.2));
    controls = after(controls, keys(held), 1.0);
    CHECK(controls.pitch == 1.0);
    CHECK(controls.roll == -1.0);
    controls = after(controls, keys({}), 0.1);
    CHECK(controls.pitch == Approx(0.7));
    controls = after(controls, keys({}), 0.5);
    CHECK(controls.pitch == 0.0);
    CHECK(controls.roll == 0.0);
    CHECK(controls.yaw == 0.0);
}

TEST_CASE("the other key brings the stick over faster than letting go, both keys are none") {
    const PilotKeys push{.push = true};
    PilotKeys both = push;
    both.pull = true;
    const PilotControls pulled{0.8, 0, 0, 0};
    CHECK(controls_after(pulled, keys(push), 0.05).pitch < controls_after(pulled, keys({}), 0.05).pitch);
    CHECK(controls_after(pulled, keys(both), 0.05).pitch == controls_after(pulled, keys({}), 0.05).pitch);
}

TEST_CASE("throttle keys move the throttle between its stops and nothing moves it back") {
    const PilotKeys up{.throttle_up = true};
    const PilotKeys down{.throttle_down = true};
    PilotControls controls = after({0, 0, 0, 0.5}, keys(up), 0.5);
    CHECK(controls.throttle == Approx(0.7));
    controls = after(controls, keys({}), 5.0);
    CHECK(controls.throttle == Approx(0.7));
    CHECK(after(controls, keys(up), 5.0).throttle == 1.0);
    CHECK(after(controls, keys(down), 5.0).throttle == 0.0);
}

TEST_CASE("what keys do depends on the time that passed and not on how it is cut up") {
    const PilotKeys held{.pull = true, .throttle_up = true};
    const PilotControls coarse = after({}, keys(held), 0.3, 0.05);
    const PilotControls fine = after({}, keys(held), 0.3, 0.001);
    CHECK(coarse.pitch == Approx(fine.pitch));
    CHECK(coarse.throttle == Approx(fine.throttle));
}

TEST_CASE("keys go before the stick, axis by axis") {
    PilotDevices devices = gamepad({1, 1, 0, 0, -1, -1});
    devices.keys.roll_left = true;
    const PilotControls controls = controls_after({}, devices, frame_s);
    CHECK(controls.roll < 0);
    CHECK(controls.pitch == Approx(1));
}

TEST_CASE("a gamepad goes before a joystick, and that before the pointer") {
    PilotDevices devices;
    devices.cursor = CursorState{{0, 200}, 200};
    CHECK(controls_after({}, devices, frame_s).pitch == Approx(1));
    devices.joystick = JoystickState{{0, -1, 0, 0}, 4};
    CHECK(controls_after({}, devices, frame_s).pitch == Approx(-1));
    devices.gamepad = GamepadState{{0, 0.5F, 0, 0, -1, -1}, {}};
    CHECK(controls_after({}, devices, frame_s).pitch == Approx(shaped_axis(0.5)));
}

TEST_CASE("the pointer is a stick: right rolls right, down pulls, beyond its reach is its stop") {
    PilotDevices devices;
    devices.cursor = CursorState{{100, -50}, 200};
    const PilotControls controls = controls_after({0, 0, 0, 0.6}, devices, frame_s);
    CHECK(controls.roll == Approx(shaped_axis(0.5)));
    CHECK(controls.pitch == Approx(shaped_axis(-0.25)));
    CHECK(controls.throttle == 0.6);
    devices.cursor = CursorState{{-900, 0}, 200};
    CHECK(controls_after({}, devices, frame_s).roll == Approx(-1));
}

TEST_CASE("no time, odd times and odd numbers leave controls in their ranges") {
    const PilotKeys held{.pull = true, .throttle_up = true};
    const PilotControls before{0.3, -0.2, 0.1, 0.5};
    for (const double passed_s : {0.0, -1.0, not_a_number}) {
        const PilotControls controls = controls_after(before, keys(held), passed_s);
        CHECK(controls.pitch == 0.3);
        CHECK(controls.roll == -0.2);
        CHECK(controls.throttle == 0.5);
    }
    // A picture that took long does not throw the stick to its stop.
    CHECK(controls_after({}, keys(held), 3.0).pitch == Approx(0.2));
    const float odd = std::numeric_limits<float>::quiet_NaN();
    for (const PilotDevices& devices :
        {gamepad({odd, odd, odd, odd, odd, odd}), gamepad({9, -9, 9, -9, 9, -9}), joystick({odd, 9, -9, odd}, 4)}) {
        const PilotControls controls = controls_after({not_a_number, 5, -5, not_a_number}, devices, frame_s);
        CHECK(std::abs(controls.pitch) <= 1.0);
        CHECK(std::abs(controls.roll) <= 1.0);
        CHECK(std::abs(controls.yaw) <= 1.0);
        CHECK(controls.throttle >= 0.0);
        CHECK(controls.throttle <= 1.0);
    }
}
