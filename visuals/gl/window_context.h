#pragma once

#include "visuals/gl/context.h"

#include <glm/vec2.hpp>

#include <memory>
#include <string>

struct GLFWwindow;

namespace octant::visuals::gl {

/// How a window is opened.
struct WindowOptions {
    glm::ivec2 size{1280, 720}; ///< in the display's own units
    std::string title = "Octant";
    bool visible = true;
};

/// A context that draws into a window of the display. One at a time in a process.
class WindowContext : public Context {
public:
    virtual GLFWwindow* window() const = 0;

    /// Whether swap_buffers() waits for the display's next refresh, where the driver can.
    virtual void wait_for_refresh(bool wait) = 0;

    /// Shows what was drawn into framebuffer 0.
    virtual void swap_buffers() = 0;

protected:
    WindowContext() = default;
};

/// Opens a window, current in this thread. Throws Error where there is no display or the driver has no OpenGL 4.5.
std::unique_ptr<WindowContext> make_window_context(const WindowOptions& options);

} // namespace octant::visuals::gl
