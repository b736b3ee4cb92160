#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace octant::ui::settings {

/// A text that a template takes as its argument.
template <std::size_t size>
struct FixedText {
    std::array<char, size> letters{};

    constexpr FixedText(const char (&text)[size]) { std::ranges::copy(text, letters.begin()); }

    constexpr std::string_view view() const { return {letters.data(), size - 1}; }
};

/// Calls `take` with the pieces of "before a, b, c after".
template <FixedText before, const auto& names, FixedText after>
constexpr void for_each_piece(auto take) {
    take(before.view());
    for (std::size_t i = 0; i < names.size(); ++i) {
        take(i > 0 ? std::string_view(", ") : std::string_view());
        take(names[i]);
    }
    take(after.view());
}

template <FixedText before, const auto& names, FixedText after>
inline constexpr auto joined_text_letters = [] {
    constexpr std::size_t size = [] {
        std::size_t sum = 0;
        for_each_piece<before, names, after>([&](std::string_view piece) { sum += piece.size(); });
        return sum;
    }();
    std::array<char, size> letters{};
    auto end = letters.begin();
    for_each_piece<before, names, after>(
        [&](std::string_view piece) { end = std::ranges::copy(piece, end).out; });
    return letters;
}();

/// "before a, b, c after", put together when the program is compiled: help that lists names which
/// stand elsewhere.
template <FixedText before, const auto& names, FixedText after>
inline constexpr std::string_view joined_text{
    joined_text_letters<before, names, after>.data(), joined_text_letters<before, names, after>.size()};

} // namespace octant::ui::settings
