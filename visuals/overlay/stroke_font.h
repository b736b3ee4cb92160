#pragma once

#include <cstddef>
#include <span>

namespace octant::visuals::overlay {

// A vector font of straight strokes: digits, capitals, . , - + / : ; _ = ( ) ' % and the degree sign (as '^'), each on
// a grid of 4 x 6 steps, x to the right and y up from the lower left corner.

inline constexpr int glyph_width = 4;   ///< grid steps
inline constexpr int glyph_height = 6;  ///< grid steps
inline constexpr int glyph_advance = 6; ///< grid steps from one letter to the next

struct GlyphPoint {
    int x = 0;
    int y = 0;
    bool begins_stroke = false; ///< else a line leads here from the point before
};

/// The strokes of a letter, one behind the other; none for a space and for what the font lacks.
std::span<const GlyphPoint> glyph_strokes(char letter);

/// Grid steps that so many letters take from the left edge of the first to the right of the last.
constexpr int text_width(std::size_t letters) {
    return letters == 0 ? 0 : static_cast<int>(letters) * glyph_advance - (glyph_advance - glyph_width);
}

} // namespace octant::visuals::overlay
