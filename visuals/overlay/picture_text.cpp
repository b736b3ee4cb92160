#include "visuals/overlay/picture_text.h"

#include "visuals/overlay/stroke_letters.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cstddef>

namespace octant::visuals::overlay {

namespace {

constexpr float letters_a_picture = 60.0F; ///< heights of a capital, one above the other
constexpr float least_letter_px = 7.0F;
constexpr float lines_apart = 1.8F; ///< heights of a capital
constexpr std::uint32_t shade = 0xb0000000U;
constexpr std::uint32_t colour = 0xffb4f0ffU;

char capital(char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

/// What fits beside the margin of a picture.
std::string fitting(const std::string& line, float letter_px, float width_px) {
    const float step_px = letter_px / letter_height;
    std::size_t count = line.size();
    while (count > 0 && static_cast<float>(text_width(count)) * step_px > width_px) {
        --count;
    }
    std::string text = line.substr(0, count);
    std::transform(text.begin(), text.end(), text.begin(), capital);
    return text;
}

} // namespace

scene::OverlayDraw
PictureText::draw(std::span<const std::string> lines, const glm::ivec2& size_px) {
    const glm::vec2 size(size_px);
    const float letter_px = std::max(size.y / letters_a_picture, least_letter_px);
    canvas_.begin(
        glm::mat3(1.0F),
        {std::max(0.14F * letter_px, 1.2F), 0.12F * letter_px + 1.0F, colour, shade});
    glm::vec2 at(letter_px, 2.0F * letter_px);
    for (const std::string& line : lines) {
        if (at.y > size.y) {
            break;
        }
        canvas_.text({at, letter_px}, fitting(line, letter_px, size.x - 2.0F * letter_px));
        at.y += lines_apart * letter_px;
    }
    return canvas_.finish();
}

} // namespace octant::visuals::overlay
