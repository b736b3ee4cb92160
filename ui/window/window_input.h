#pragma once

#include "ui/window/key_map.h"
#include "ui/window/pilot_input.h"

#include <glm/vec2.hpp>

#include <vector>

struct GLFWwindow;

namespace octant::ui::window {

/// What a person did in a window since the last call of WindowInput::take().
struct WindowEvents {
    struct Key {
        /// One of GLFW_KEY_...
        int key = 0;
        /// The key is being held, and this is not its first event.
        bool repeats = false;
    };

    /// Keys in the order in which they were pressed.
    std::vector<Key> keys;
    /// How far the pointer was dragged, in the window's units.
    glm::vec2 dragged{0.0F};
    /// How far the wheel was turned towards the screen.
    double wheel_clicks = 0.0;
};

/// Collects a window's events. It must be made before anything else that sets callbacks of the window, and those must
/// call the callbacks that were set before.
class WindowInput {
public:
    explicit WindowInput(GLFWwindow* window);
    ~WindowInput() = default;
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;
    WindowInput(WindowInput&&) = delete;
    WindowInput& operator=(WindowInput&&) = delete;

    /// Returns the events since the last call.
    WindowEvents take();

    /// The pointer drags the view while this button, GLFW_MOUSE_BUTTON_..., is held.
    void set_look_button(int button) { look_button_ = button; }

    /// False for a key that there is not.
    bool is_down(int key) const;

    /// Returns the state of the keys that fly, and of the first gamepad or joystick, whose axes stand where those of
    /// the usual ones do.
    PilotDevices pilot_devices(const KeyMap& keys) const;

    /// Returns which buttons of the first gamepad are pressed; none where there is no gamepad.
    GamepadButtons pad_buttons() const;

    /// Returns the size of the window's picture in pixels, which is 0 while it is minimised.
    glm::ivec2 size_px() const;
    /// Returns the size of the window in the display's units.
    glm::ivec2 size() const;

private:
    void move_pointer(const glm::vec2& to);

    GLFWwindow* window_;
    WindowEvents events_;
    glm::vec2 pointer_{0.0F};
    int look_button_ = 0;

    friend struct WindowCallbacks;
};

} // namespace octant::ui::window
