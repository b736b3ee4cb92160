#pragma once

#include "visuals/gl/context.h"
#include "visuals/gl/object.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::gl {

/// A corner of a panel's triangle. 20 bytes.
struct PanelVertex {
    glm::vec2 at{0.0F};       ///< from the window's upper left corner, in its own units
    glm::vec2 atlas_at{0.0F}; ///< shares of the atlas's width and height
    std::uint32_t colour = 0; ///< as ColourVertex::colour
};

/// Indices of one list that are seen through one rectangle of the window.
struct PanelDraw {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint32_t first_vertex = 0;
    glm::vec2 min{0.0F}; ///< corners of the rectangle, in the window's own units
    glm::vec2 max{0.0F};
};

/// A window's framebuffer and how its pixels lie in the window's own units.
struct PanelSurface {
    GLuint framebuffer = 0;
    glm::ivec2 size_px{1};
    glm::vec2 size{1.0F}; ///< in the window's own units
};

/// Draws user-interface triangles over a window. Makes the window's context current by itself.
class PanelPainter {
public:
    /// `atlas`: one byte a texel, `size` of them, row by row: how much is covered. Not filtered: glyphs are to lie on
    /// whole pixels. The context must outlive the painter.
    PanelPainter(Context& context, std::span<const std::uint8_t> atlas, const glm::ivec2& size);
    ~PanelPainter();
    PanelPainter(const PanelPainter&) = delete;
    PanelPainter& operator=(const PanelPainter&) = delete;
    PanelPainter(PanelPainter&&) = delete;
    PanelPainter& operator=(PanelPainter&&) = delete;

    /// To be called before the draw()s of a picture and after them, with nothing drawn otherwise between.
    void begin(const PanelSurface& surface);
    void end();

    /// One list of triangles.
    void draw(std::span<const PanelVertex> vertices, std::span<const std::uint16_t> indices,
        std::span<const PanelDraw> draws);

private:
    Context& context_;
    const Functions& gl_;
    Object program_;
    Object atlas_;
    StreamMesh mesh_;
    PanelSurface surface_;
};

} // namespace octant::visuals::gl
