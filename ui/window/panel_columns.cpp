#include "ui/window/panel_columns.h"

#include "sim/base/text_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
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

namespace {

enum class Column { Left, MiddleColumn, Right };

struct KnownPanel {
    std::string_view title;
    bool OpenPanels::*open;
    Column column;
};

/// From top to bottom.
constexpr std::array known_panels{KnownPanel{"Flight", &OpenPanels::flight, Column::Left},
    KnownPanel{"Frame times", &OpenPanels::timing, Column::Left}, KnownPanel{"Scene", &OpenPanels::scene, Column::Left},
    KnownPanel{"Terrain", &OpenPanels::terrain, Column::Right},
    KnownPanel{"Draw order", &OpenPanels::draw_order, Column::Right},
    KnownPanel{"Aircraft", &OpenPanels::aircraft, Column::Right},
    KnownPanel{"Settings", &OpenPanels::settings, Column::Right},
    KnownPanel{"Leave?", &OpenPanels::leave_question, Column::MiddleColumn},
    KnownPanel{"Keys", &OpenPanels::help, Column::MiddleColumn},
    KnownPanel{"First steps", &OpenPanels::first_steps, Column::MiddleColumn}};

constexpr float edge = 8.0F;
constexpr float gap_px = 6.0F;
constexpr float side_width = 330.0F;
/// A side column takes no more of the window than this.
constexpr float max_of_window = 0.35F;
constexpr float max_middle_width = 620.0F;
constexpr float first_height = 420.0F;
/// Room for a title and a line.
constexpr float min_height = 48.0F;
/// Closer than this is where it was put: places are rounded to whole units.
constexpr float rect_tolerance = 1.0F;

bool is_near(const PanelRect& a, const PanelRect& b) {
    const auto near = [](const glm::vec2& one, const glm::vec2& other) {
        return std::abs(one.x - other.x) <= rect_tolerance && std::abs(one.y - other.y) <= rect_tolerance;
    };
    return near(a.at, b.at) && near(a.size, b.size);
}

/// Brings a chosen place into the window, which may be smaller than when it was chosen.
glm::vec2 clamped(const glm::vec2& at, const PanelArea& area) {
    constexpr float seen = 40.0F;
    const glm::vec2 most = glm::max(area.size - seen * area.scale, glm::vec2(0.0F));
    return glm::clamp(at, glm::min(glm::vec2(seen - side_width, 0.0F) * area.scale, most), most);
}

/// Shares `area` among panels: those that want less than an even share get what they want.
std::vector<float> shrink_to_fit(std::vector<float> wanted_heights, float area) {
    std::vector<std::size_t> by_size(wanted_heights.size());
    std::iota(by_size.begin(), by_size.end(), std::size_t{0});
    std::ranges::sort(by_size, {}, [&](std::size_t i) { return wanted_heights[i]; });
    float left = area;
    for (std::size_t rank = 0; rank < by_size.size(); ++rank) {
        float& height = wanted_heights[by_size[rank]];
        const float share = left / static_cast<float>(by_size.size() - rank);
        height = std::floor(std::max(min_height, std::min(height, share)));
        left -= height;
    }
    return wanted_heights;
}

/// A column of the window: its left edge, width, top and bottom.
struct ColumnRect {
    float left = 0.0F;
    float width = 0.0F;
    float top = 0.0F;
    float bottom = 0.0F;
};

ColumnRect column_rect(Column column, const PanelArea& area, bool left_open, bool right_open) {
    const float border = edge * area.scale;
    const float side = std::floor(std::min(side_width * area.scale, max_of_window * area.size.x));
    ColumnRect strip{border, side, border, area.size.y - border};
    if (column == Column::Right) {
        strip.left = area.size.x - border - side;
        strip.bottom -= area.inset.y;
    } else if (column == Column::MiddleColumn) {
        const float from = border + (left_open ? side + gap_px * area.scale : 0.0F);
        const float right = right_open ? side + gap_px * area.scale : 0.0F;
        const float to = area.size.x - border - std::max(right, area.inset.x);
        strip.width = std::floor(std::min(to - from, max_middle_width * area.scale));
        strip.left = std::floor(std::clamp(0.5F * (area.size.x - strip.width), from, std::max(from, to - strip.width)));
        strip.top += area.status_height;
    }
    return strip;
}

} // namespace

PanelColumns::PanelPlacement& PanelColumns::placement_of(std::string_view title) {
    const auto found = placements_.find(title);
    if (found != placements_.end()) { return found->second; }
    PanelPlacement place;
    place.rect = {glm::vec2(edge), {side_width, first_height}};
    place.wanted_height = first_height;
    return placements_.emplace(std::string(title), place).first->second;
}

void PanelColumns::lay_out(const OpenPanels& open, const PanelArea& area) {
    std::array<std::vector<PanelPlacement*>, 3> columns;
    for (const KnownPanel& panel : known_panels) {
        PanelPlacement& place = placement_of(panel.title);
        const bool asks = panel.open == &OpenPanels::leave_question;
        if (!(open.*panel.open) || !(open.shown || asks)) {
            place.is_new = true;
        } else if (place.user_placed) {
            const glm::vec2 at = clamped(place.rect.at, area);
            place.is_new = place.is_new || at != place.rect.at;
            place.rect.at = at;
        } else {
            columns[static_cast<std::size_t>(panel.column)].push_back(&place);
        }
    }
    for (const Column column : {Column::Left, Column::MiddleColumn, Column::Right}) {
        const auto& placements = columns[static_cast<std::size_t>(column)];
        const ColumnRect strip = column_rect(column, area, !columns.front().empty(), !columns.back().empty());
        if (column == Column::MiddleColumn) { middle_ = {strip.left, strip.width}; }
        std::vector<float> heights;
        for (const PanelPlacement* const place : placements) { heights.push_back(place->wanted_height); }
        const float between = gap_px * area.scale;
        const float gaps = between * static_cast<float>(std::max<std::size_t>(placements.size(), 1) - 1);
        heights = shrink_to_fit(std::move(heights), strip.bottom - strip.top - gaps);
        // What the middle shows stands at its bottom, below the aircraft.
        float y = strip.top;
        const float all = std::accumulate(heights.begin(), heights.end(), gaps);
        if (column == Column::MiddleColumn) { y = std::max(y, strip.bottom - all); }
        for (std::size_t i = 0; i < placements.size(); ++i) {
            const PanelRect rect{{strip.left, std::floor(y)}, {strip.width, heights[i]}};
            placements[i]->is_new = placements[i]->is_new || !is_near(rect, placements[i]->rect);
            placements[i]->rect = rect;
            y += heights[i] + between;
        }
    }
}

std::optional<PanelRect> PanelColumns::take_new_rect(std::string_view title) {
    PanelPlacement& place = placement_of(title);
    return place.is_new ? std::optional(place.rect) : std::nullopt;
}

void PanelColumns::report_rect(std::string_view title, const PanelRect& rect) {
    PanelPlacement& place = placement_of(title);
    if (!place.is_new && !is_near(rect, place.rect)) { place.user_placed = true; }
    if (place.user_placed) { place.rect = rect; }
    place.is_new = false;
}

void PanelColumns::report_height(std::string_view title, float height) {
    placement_of(title).wanted_height = std::ceil(height);
}

void PanelColumns::reset_layout() {
    for (auto& [title, place] : placements_) {
        place.is_new = place.is_new || place.user_placed;
        place.user_placed = false;
    }
}

std::map<std::string, PanelRect, std::less<>> PanelColumns::user_placed() const {
    std::map<std::string, PanelRect, std::less<>> placements;
    for (const auto& [title, place] : placements_) {
        if (place.user_placed) { placements.emplace(title, place.rect); }
    }
    return placements;
}

void PanelColumns::restore_user_placed(const std::map<std::string, PanelRect, std::less<>>& placements) {
    for (const KnownPanel& panel : known_panels) {
        const auto found = placements.find(panel.title);
        if (found != placements.end()) {
            PanelPlacement& place = placement_of(panel.title);
            place.rect = found->second;
            place.user_placed = true;
            place.is_new = true;
        }
    }
}

} // namespace octant::ui::window
