#include "ui/window/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace octant::ui::window {

struct WindowCallbacks {
    static WindowInput& input_of(GLFWwindow* window) {
        return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
    }

    static void key(GLFWwindow* window, int key, int /*scan_code*/, int action, int /*mods*/) {
        if (action != GLFW_RELEASE) { input_of(window).events_.keys.push_back({key, action == GLFW_REPEAT}); }
    }

    static void wheel(GLFWwindow* window, double /*x*/, double y) { input_of(window).events_.wheel_clicks += y; }

    static void pointer(GLFWwindow* window, double x, double y) {
        input_of(window).move_pointer(glm::vec2(static_cast<float>(x), static_cast<float>(y)));
    }
};

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, WindowCallbacks::key);
    glfwSetScrollCallback(window, WindowCallbacks::wheel);
    glfwSetCursorPosCallback(window, WindowCallbacks::pointer);
}

void WindowInput::move_pointer(const glm::vec2& to) {
    if (glfwGetMouseButton(window_, look_button_) == GLFW_PRESS) { events_.dragged += to - pointer_; }
    pointer_ = to;
}

WindowEvents WindowInput::take() { return std::exchange(events_, {}); }

bool WindowInput::is_down(int key) const { return key != GLFW_KEY_UNKNOWN && glfwGetKey(window_, key) == GLFW_PRESS; }

GamepadButtons WindowInput::pad_buttons() const {
    GamepadButtons buttons{};
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
        GLFWgamepadstate gamepad;
        if (glfwGetGamepadState(id, &gamepad) == GLFW_TRUE) {
            std::ranges::copy(gamepad.buttons, buttons.begin());
            break;
        }
    }
    return buttons;
}

PilotDevices WindowInput::pilot_devices(const KeyMap& keys) const {
    PilotDevices devices;
    const auto is_held = [&](HeldAction action) { return is_down(keys.key_of(action)); };
    devices.keys = {.pull = is_held(HeldAction::Pull),
        .push = is_held(HeldAction::Push),
        .roll_left = is_held(HeldAction::RollLeft),
        .roll_right = is_held(HeldAction::RollRight),
        .yaw_left = is_held(HeldAction::YawLeft),
        .yaw_right = is_held(HeldAction::YawRight),
        .throttle_up = is_held(HeldAction::ThrottleUp),
        .throttle_down = is_held(HeldAction::ThrottleDown)};
    if (glfwGetMouseButton(window_, keys.stick_button) == GLFW_PRESS) {
        constexpr double full_share = 0.4;
        const glm::dvec2 window(size());
        devices.cursor = {glm::dvec2(pointer_) - 0.5 * window, full_share * std::max(window.y, 1.0)};
    }
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
        GLFWgamepadstate gamepad;
        if (!devices.gamepad && glfwGetGamepadState(id, &gamepad) == GLFW_TRUE) {
            devices.gamepad.emplace();
            devices.gamepad->axes = gamepad_axes(keys, gamepad.axes);
            devices.gamepad->buttons = flying_buttons(keys, pad_buttons());
        } else if (!devices.joystick && glfwJoystickPresent(id) == GLFW_TRUE) {
            int axes = 0;
            const float* const values = glfwGetJoystickAxes(id, &axes);
            devices.joystick = mapped_joystick(keys, std::span(values, static_cast<std::size_t>(std::max(axes, 0))));
        }
    }
    return devices;
}

glm::ivec2 WindowInput::size_px() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 WindowInput::size() const {
    glm::ivec2 size{0};
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

} // namespace octant::ui::window
