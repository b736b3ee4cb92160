#include "visuals/overlay/overlay.h"
#include "visuals/overlay/stroke_font.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace octant::visuals::overlay {

namespace {

constexpr float lines_per_picture_height = 60.0F; ///< heights of a capital, one above the other
constexpr float min_text_px = 7.0F;
constexpr float line_spacing = 1.8F; ///< heights of a capital
constexpr std::uint32_t text_halo_colour = 0xb0000000U;
constexpr std::uint32_t colour = 0xffb4f0ffU;

constexpr std::string_view indent = "  "; ///< of what goes on from the line above

char upper_case(char letter) { return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter; }

/// How many letters stand beside each other in a width; more than the indent.
std::size_t characters_per_line(float width_px, float letter_px) {
    const float step_px = letter_px / glyph_height;
    std::size_t count = indent.size() + 1;
    while (static_cast<float>(text_width(count + 1)) * step_px <= width_px) { ++count; }
    return count;
}

/// Takes from the front of a text, and returns, what fits into so many letters: whole words where a space is among
/// them.
std::string split_at_width(std::string_view& text, std::size_t max_letters) {
    std::size_t count = text.size();
    if (count > max_letters) {
        const std::size_t space = text.rfind(' ', max_letters);
        count = space == std::string_view::npos || space == 0 ? max_letters : space;
    }
    std::string taken(text.substr(0, count));
    std::ranges::transform(taken, taken.begin(), upper_case);
    text.remove_prefix(std::min(text.find_first_not_of(' ', count), text.size()));
    return taken;
}

} // namespace

scene::OverlayDraw draw_text(OverlayCanvas& canvas, std::span<const std::string> lines, const glm::ivec2& size_px) {
    const glm::vec2 size(size_px);
    const float letter_px = std::max(size.y / lines_per_picture_height, min_text_px);
    canvas.begin(
        glm::mat3(1.0F), {std::max(0.14F * letter_px, 1.2F), 0.12F * letter_px + 1.0F, colour, text_halo_colour});
    glm::vec2 at(letter_px, 2.0F * letter_px);
    const std::size_t max_letters = characters_per_line(size.x - 2.0F * letter_px, letter_px);
    for (const std::string_view line : lines) {
        std::string_view rest = line;
        std::string text = split_at_width(rest, max_letters);
        while (!text.empty() && at.y <= size.y) {
            canvas.text({at, letter_px}, text);
            at.y += line_spacing * letter_px;
            text = split_at_width(rest, max_letters - indent.size());
            text = text.empty() ? text : std::string(indent) + text;
        }
    }
    return canvas.finish();
}

} // namespace octant::visuals::overlay
