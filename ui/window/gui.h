#pragma once

#include "visuals/gl/panel_painter.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <vector>

struct ImDrawData;

namespace octant::visuals::gl {
class WindowContext;
}

namespace octant::ui::window {

/// Draws Dear ImGui's triangles without OpenGL, over a picture in memory.
class PanelRasterizer {
public:
    /// `atlas`: one byte a texel, `size` of them, row by row: how much is covered. Not filtered: glyphs are to lie on
    /// whole pixels.
    PanelRasterizer(const std::uint8_t* atlas, const glm::ivec2& size);

    /// Blends all lists over `pixels`: blue, green, red and a byte that is kept for each of `size_px`, rows from the
    /// top, no gaps.
    void draw(const ImDrawData& panels, std::uint8_t* pixels, const glm::ivec2& size_px) const;

private:
    std::vector<std::uint8_t> atlas_;
    glm::ivec2 atlas_size_;
};

/// Dear ImGui over a window: its context, input and drawing. One at a time in a process.
class Gui {
public:
    /// The window must outlive it.
    explicit Gui(visuals::gl::WindowContext& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
    Gui(Gui&&) = delete;
    Gui& operator=(Gui&&) = delete;

    /// Begins a frame: panels may be made until end_frame().
    void begin_frame();
    void end_frame();

    /// Draws the last frame's panels over the window's framebuffer of `size_px`. Draws nothing where there are no
    /// panels.
    void draw(const glm::ivec2& size_px);

    /// The same over a picture in memory, as PanelRasterizer has it.
    void draw_into(std::uint8_t* pixels, const glm::ivec2& size_px) const;

    /// Returns how many vertices the last frame's panels have; 0 where there are no panels.
    int vertices() const;

    /// Whether a panel uses the pointer, so that the view must not.
    bool wants_pointer() const;
    /// Whether a panel uses the keyboard, as while text is typed.
    bool wants_keys() const;

private:
    std::optional<visuals::gl::PanelPainter> painter_;
    std::optional<PanelRasterizer> pixels_;
    std::vector<visuals::gl::PanelDraw> draws_;
};

} // namespace octant::ui::window
