#include "visuals/overlay/picture_text.h"

#include "visuals/overlay/stroke_letters.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace octant::visuals::overlay {

namespace {

constexpr float letters_a_picture = 60.0F; ///< heights of a capital, one above the other
constexpr float min_letter_px = 7.0F;
constexpr float lines_apart = 1.8F; ///< heights of a capital
constexpr std::uint32_t shade = 0xb0000000U;
constexpr std::uint32_t colour = 0xffb4f0ffU;

constexpr std::string_view indent = "  "; ///< of what goes on from the line above

char capital(char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

/// How many letters stand beside each other in a width; more than the indent.
std::size_t letters_across(float width_px, float letter_px) {
    const float step_px = letter_px / letter_height;
    std::size_t count = indent.size() + 1;
    while (static_cast<float>(text_width(count + 1)) * step_px <= width_px) {
        ++count;
    }
    return count;
}

/// Takes from the front of a text, and returns, what fits into so many letters: whole words where a
/// space is among them.
std::string take_fitting(std::string_view& text, std::size_t most) {
    std::size_t count = text.size();
    if (count > most) {
        const std::size_t space = text.rfind(' ', most);
        count = space == std::string_view::npos || space == 0 ? most : space;
    }
    std::string taken(text.substr(0, count));
    std::ranges::transform(taken, taken.begin(), capital);
    text.remove_prefix(std::min(text.find_first_not_of(' ', count), text.size()));
    return taken;
}

} // namespace

scene::OverlayDraw
PictureText::draw(std::span<const std::string> lines, const glm::ivec2& size_px) {
    const glm::vec2 size(size_px);
    const float letter_px = std::max(size.y / letters_a_picture, min_letter_px);
    canvas_.begin(
        glm::mat3(1.0F),
        {std::max(0.14F * letter_px, 1.2F), 0.12F * letter_px + 1.0F, colour, shade});
    glm::vec2 at(letter_px, 2.0F * letter_px);
    const std::size_t most = letters_across(size.x - 2.0F * letter_px, letter_px);
    for (const std::string_view line : lines) {
        std::string_view rest = line;
        std::string text = take_fitting(rest, most);
        while (!text.empty() && at.y <= size.y) {
            canvas_.text({at, letter_px}, text);
            at.y += lines_apart * letter_px;
            text = take_fitting(rest, most - indent.size());
            text = text.empty() ? text : std::string(indent) + text;
        }
    }
    return canvas_.finish();
}

} // namespace octant::visuals::overlay
