#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

struct ImDrawData;

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

} // namespace octant::ui::window
