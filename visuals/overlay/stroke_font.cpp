#include "visuals/overlay/stroke_font.h"

#include <array>
#include <string_view>
#include <utility>

namespace octant::visuals::overlay {

namespace {

/// Two digits a point, x then y; a space lifts the pen.
constexpr std::array<std::pair<char, std::string_view>, 50> drawings{{
    {'0', "103041453616050110"},
    {'1', "152620 1030"},
    {'2', "05163645440040"},
    {'3', "051636454433 13334241301001"},
    {'4', "30360242"},
    {'5', "460603334241301001"},
    {'6', "46160501103041423303"},
    {'7', "064610"},
    {'8', "13040516364544331302011030414233"},
    {'9', "00304145361605041343"},
    {'A', "0004264440 0242"},
    {'B', "0006364544330300 3342413000"},
    {'C', "4536160501103041"},
    {'D', "00062644422000"},
    {'E', "46060040 0333"},
    {'F', "460600 0333"},
    {'G', "45361605011030414323"},
    {'H', "0006 4046 0343"},
    {'I', "1030 2026 1636"},
    {'J', "4641301001"},
    {'K', "0006 460340"},
    {'L', "060040"},
    {'M', "0006234640"},
    {'N', "00064046"},
    {'O', "103041453616050110"},
    {'P', "00063645443303"},
    {'Q', "103041453616050110 2240"},
    {'R', "00063645443303 2340"},
    {'S', "453616050413334241301001"},
    {'T', "0646 2620"},
    {'U', "060110304146"},
    {'V', "062046"},
    {'W', "0610233046"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
    {'.', "2021"},
    {',', "2110"},
    {'-', "0343"},
    {'+', "0343 2125"},
    {'/', "0046"},
    {':', "2122 2425"},
    {';', "2110 2425"},
    {'_', "0040"},
    {'=', "0242 0444"},
    {'(', "36242230"},
    {')', "16242210"},
    {'\'', "2625"},
    {'%', "0046 0605 4140"},
    {'^', "1526352415"},
}};

constexpr std::size_t max_points = 16;

struct Glyph {
    std::array<GlyphPoint, max_points> points{};
    std::size_t count = 0;
};

constexpr Glyph letter_from(std::string_view drawing) {
    Glyph letter;
    bool begins_stroke = true;
    for (std::size_t at = 0; at < drawing.size();) {
        if (drawing[at] == ' ') {
            begins_stroke = true;
            ++at;
            continue;
        }
        letter.points.at(letter.count++) = {drawing[at] - '0', drawing[at + 1] - '0', begins_stroke};
        begins_stroke = false;
        at += 2;
    }
    return letter;
}

constexpr std::size_t codes = 128;

constexpr std::array<Glyph, codes> make_font() {
    std::array<Glyph, codes> font{};
    for (const auto& [code, drawing] : drawings) { font.at(static_cast<std::size_t>(code)) = letter_from(drawing); }
    return font;
}

constexpr std::array<Glyph, codes> font = make_font();

} // namespace

std::span<const GlyphPoint> glyph_strokes(char letter) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= codes) { return {}; }
    return std::span(font[code].points).first(font[code].count);
}

} // namespace octant::visuals::overlay
