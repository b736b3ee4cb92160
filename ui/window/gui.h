#pragma once

#include "visuals/gl/functions.h"
#include "visuals/gl/panel_painter.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace octant::ui::window {

/// Dear ImGui over a window: its context, input and drawing. One at a time in a process.
class Gui {
public:
    /// `layout_file`: where the places of panels are kept; empty = nowhere. The window's context
    /// must be current in every call.
    Gui(GLFWwindow* window,
        const visuals::gl::Functions& gl,
        const std::filesystem::path& layout_file);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
    Gui(Gui&&) = delete;
    Gui& operator=(Gui&&) = delete;

    /// Between these panels may be made.
    void begin_frame();
    void end_frame();

    /// Draws the last frame's panels over a framebuffer of the window. Nothing where there are
    /// none.
    void draw(const glm::ivec2& size_px);

    /// Corners of the last frame's panels; 0 = there are none.
    int vertices() const;

    /// The pointer or the keys belong to a panel.
    bool wants_pointer() const;
    bool wants_keys() const;

private:
    std::string layout_file_;
    std::optional<visuals::gl::PanelPainter> painter_;
    std::vector<visuals::gl::PanelDraw> draws_;
};

} // namespace octant::ui::window
