#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <utility>

namespace octant::visuals::overlay {

/// A few letters on the stack, at most 16; what is longer is cut.
class ShortText {
public:
    template <typename... Values>
    explicit ShortText(fmt::format_string<Values...> format, Values&&... values) {
        const auto written =
            fmt::format_to_n(letters_.data(), letters_.size(), format, std::forward<Values>(values)...);
        size_ = std::min(written.size, letters_.size());
    }

    std::string_view text() const { return {letters_.data(), size_}; }

private:
    std::array<char, 16> letters_{};
    std::size_t size_ = 0;
};

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
