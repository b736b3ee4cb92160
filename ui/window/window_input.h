#pragma once

#include "ui/window/pilot_input.h"

#include <glm/vec2.hpp>

#include <vector>

struct GLFWwindow;

namespace octant::ui::window {

/// What a person did to a window since it was last asked.
struct WindowEvents {
    struct Key {
        int key = 0;          ///< GLFW_KEY_...
        bool repeats = false; ///< it was held
    };

    std::vector<Key> keys;     ///< pressed, in order
    glm::vec2 dragged{0.0F};   ///< with the left button down, in the window's units
    double wheel_clicks = 0.0; ///< towards the screen
};

/// Collects a window's events. Made before anything else that listens to the window, which must
/// call on.
class WindowInput {
public:
    explicit WindowInput(GLFWwindow* window);
    ~WindowInput() = default;
    WindowInput(const WindowInput&) = delete;
    WindowInput& operator=(const WindowInput&) = delete;
    WindowInput(WindowInput&&) = delete;
    WindowInput& operator=(WindowInput&&) = delete;

    /// Events since the last call.
    WindowEvents take();

    bool is_down(int key) const;

    /// What a pilot holds: keys, and the first gamepad or joystick.
    PilotDevices pilot_devices() const;

    /// Size of the window's picture in pixels, 0 while it is minimised, and in its own units.
    glm::ivec2 size_px() const;
    glm::ivec2 size() const;

private:
    void move_pointer(const glm::vec2& to);

    GLFWwindow* window_;
    WindowEvents events_;
    glm::vec2 pointer_{0.0F};

    friend struct WindowCallbacks;
};

} // namespace octant::ui::window
