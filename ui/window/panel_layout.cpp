#include "ui/window/panel_layout.h"

#include "sim/base/text_file.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace octant::ui::window {

namespace {

constexpr std::string_view first_line = "# octant panels: title = x y width height";
constexpr double farthest = 32000.0;
constexpr double smallest_px = 16.0;

/// The numbers of "x y width height".
std::optional<PanelRect> rect_from(std::string_view text) {
    const std::vector<std::string_view> words = split_words(text);
    std::array<double, 4> numbers{};
    if (words.size() != numbers.size()) { return std::nullopt; }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = finite_number(words[i]);
        if (!number || std::abs(*number) > farthest || (i >= 2 && *number < smallest_px)) { return std::nullopt; }
        numbers[i] = std::round(*number);
    }
    return PanelRect{{static_cast<float>(numbers[0]), static_cast<float>(numbers[1])},
        {static_cast<float>(numbers[2]), static_cast<float>(numbers[3])}};
}

} // namespace

std::string text_of_layout(const PanelLayout& layout) {
    std::string text = fmt::format("{}\n", first_line);
    for (const auto& [title, rect] : layout) {
        text +=
            fmt::format("{} = {:.0f} {:.0f} {:.0f} {:.0f}\n", title, rect.at.x, rect.at.y, rect.size.x, rect.size.y);
    }
    return text;
}

PanelLayout layout_from(std::string_view text) {
    PanelLayout layout;
    const std::vector<std::string_view> lines = split_lines(text);
    if (lines.empty() || lines.front() != first_line) { return layout; }
    for (const std::string_view line : lines) {
        const std::vector<std::string_view> sides = split_fields(line, '=');
        const auto rect = sides.size() == 2 ? rect_from(sides.back()) : std::nullopt;
        if (rect) { layout[std::string(sides.front())] = *rect; }
    }
    return layout;
}

} // namespace octant::ui::window
