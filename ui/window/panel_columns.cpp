#include "ui/window/panel_columns.h"

#include "sim/base/text_file.h"

#include <glm/common.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
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

enum Column : std::size_t { left_column, middle_column, right_column };

struct KnownPanel {
    std::string_view title;
    bool OpenPanels::*open;
    Column column;
};

constexpr std::array known_panels{KnownPanel{"Flight", &OpenPanels::flight, left_column},
    KnownPanel{"Frame times", &OpenPanels::timing, left_column}, KnownPanel{"Scene", &OpenPanels::scene, left_column},
    KnownPanel{"Terrain", &OpenPanels::terrain, right_column},
    KnownPanel{"Draw order", &OpenPanels::draw_order, right_column},
    KnownPanel{"Aircraft", &OpenPanels::aircraft, right_column},
    KnownPanel{"Settings", &OpenPanels::settings, right_column},
    KnownPanel{"Leave?", &OpenPanels::leave_question, middle_column},
    KnownPanel{"Keys", &OpenPanels::help, middle_column},
    KnownPanel{"First steps", &OpenPanels::first_steps, middle_column}};

constexpr float edge = 8.0F;
constexpr float gap_px = 6.0F;
constexpr float side_width = 330.0F;
/// A side column takes no more of the window than this.
constexpr float max_of_window = 0.35F;
constexpr float max_middle_width = 620.0F;
/// Room for a title and a line.
constexpr float min_height = 48.0F;
/// A window that is closer than this to its place was not moved: ImGui rounds positions to whole units.
constexpr float tolerance = 1.0F;

bool is_near(const glm::vec2& a, const glm::vec2& b) {
    return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance;
}

/// Brings a chosen place into the window, which may be smaller than when it was chosen.
glm::vec2 clamped(const glm::vec2& at, const PanelArea& area) {
    constexpr float seen = 40.0F;
    const glm::vec2 most = glm::max(area.size - seen * area.scale, glm::vec2(0.0F));
    return glm::clamp(at, glm::min(glm::vec2(seen - side_width, 0.0F) * area.scale, most), most);
}

} // namespace

PanelColumns::FreeColumn PanelColumns::column_of(std::size_t column, bool left_open, bool right_open) const {
    const float border = edge * area_.scale;
    const float side = std::floor(std::min(side_width * area_.scale, max_of_window * area_.size.x));
    FreeColumn free{border, side, border, area_.size.y - border, 0};
    if (column == right_column) {
        free.left = area_.size.x - border - side;
        free.bottom -= area_.inset.y;
    } else if (column == middle_column) {
        const float from = border + (left_open ? side + gap_px * area_.scale : 0.0F);
        const float right = right_open ? side + gap_px * area_.scale : 0.0F;
        const float to = area_.size.x - border - std::max(right, area_.inset.x);
        free.width = std::floor(std::min(to - from, max_middle_width * area_.scale));
        free.left = std::floor(std::clamp(0.5F * (area_.size.x - free.width), from, std::max(from, to - free.width)));
        free.top += area_.status_height;
    }
    return free;
}

void PanelColumns::lay_out(const OpenPanels& open, const PanelArea& area) {
    area_ = area;
    std::array<int, 3> panels{};
    for (const KnownPanel& panel : known_panels) {
        const bool is_shown = open.*panel.open && (open.shown || panel.open == &OpenPanels::leave_question);
        const auto place = placements_.find(panel.title);
        if (is_shown && (place == placements_.end() || !place->second.user_placed)) { ++panels[panel.column]; }
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        columns_[i] = column_of(i, panels[left_column] > 0, panels[right_column] > 0);
        columns_[i].panels = panels[i];
    }
    middle_ = {columns_[middle_column].left, columns_[middle_column].width};
}

/// Tells ImGui where the next window is: below those placed before it, or above them in the middle, which is filled
/// from its bottom. ImGui finds its height, at most an even share of what is left.
void PanelColumns::place_in_column(std::size_t column, PanelPlacement& place) {
    const FreeColumn& free = columns_[column];
    const auto panels = static_cast<float>(std::max(free.panels, 1));
    const float gaps = gap_px * area_.scale * (panels - 1.0F);
    const float share = std::max(min_height, std::floor((free.bottom - free.top - gaps) / panels));
    const float height = std::min(place.rect.size.y, share);
    const glm::vec2 at(free.left, std::floor(column == middle_column ? free.bottom - height : free.top));
    if (place.is_new || !is_near(at, place.rect.at)) {
        ImGui::SetNextWindowPos({at.x, at.y});
        place.rect.at = at;
    }
    ImGui::SetNextWindowSizeConstraints({free.width, min_height}, {free.width, share});
    ImGui::SetNextWindowSize({free.width, 0.0F});
}

bool PanelColumns::begin_panel(const char* title, bool& open) {
    const auto known = std::ranges::find(known_panels, title, &KnownPanel::title);
    const std::size_t column = known == known_panels.end() ? middle_column : known->column;
    PanelPlacement& place = placements_[title];
    if (!place.user_placed) {
        place_in_column(column, place);
    } else if (const glm::vec2 at = clamped(place.rect.at, area_); place.is_new || at != place.rect.at) {
        place.rect.at = at;
        ImGui::SetNextWindowPos({at.x, at.y});
        ImGui::SetNextWindowSize({place.rect.size.x, place.rect.size.y});
    }
    const bool seen = ImGui::Begin(title, &open,
        ImGuiWindowFlags_NoCollapse | (place.user_placed ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoResize));
    const PanelRect rect{
        {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y}, {ImGui::GetWindowSize().x, ImGui::GetWindowSize().y}};
    if (!place.user_placed) {
        FreeColumn& free = columns_[column];
        const float used = rect.size.y + gap_px * area_.scale;
        (column == middle_column ? free.bottom : free.top) += column == middle_column ? -used : used;
        --free.panels;
        place.user_placed = !is_near(rect.at, place.rect.at);
    }
    place.rect = rect;
    place.is_new = false;
    return seen;
}

void PanelColumns::reset_layout() {
    for (auto& [title, place] : placements_) {
        place.is_new = place.is_new || place.user_placed;
        place.user_placed = false;
    }
}

PanelLayout PanelColumns::user_placed() const {
    PanelLayout layout;
    for (const auto& [title, place] : placements_) {
        if (place.user_placed) { layout.emplace(title, place.rect); }
    }
    return layout;
}

void PanelColumns::restore_user_placed(const PanelLayout& layout) {
    for (const KnownPanel& panel : known_panels) {
        const auto found = layout.find(panel.title);
        if (found != layout.end()) { placements_[std::string(panel.title)] = {found->second, true, true}; }
    }
}

} // namespace octant::ui::window
