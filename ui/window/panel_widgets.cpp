#include "ui/window/panel_widgets.h"

#include "ui/window/view_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace octant::ui::window {

FramePlot::FramePlot(float height_px, double min_value, double max_value)
    : from_(ImGui::GetCursorScreenPos()), min_value_(min_value), max_value_(std::max(max_value, min_value + 1e-9)) {
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.0F), height_px};
    to_ = {from_.x + size.x, from_.y + size.y};
    ImGui::GetWindowDrawList()->AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg));
    ImGui::Dummy(size);
}

float FramePlot::x_of(std::size_t frames_ago) const {
    return to_.x - (to_.x - from_.x) * static_cast<float>(frames_ago) / static_cast<float>(FrameHistory::max_frames);
}

float FramePlot::y_of(double value) const {
    const double finite = std::isfinite(value) ? value : min_value_;
    const double share = std::clamp((finite - min_value_) / (max_value_ - min_value_), 0.0, 1.0);
    return to_.y - (to_.y - from_.y) * static_cast<float>(share);
}

void FramePlot::mark(std::size_t frames_ago, ImU32 colour) const {
    constexpr float length_px = 5.0F;
    const float x = x_of(frames_ago);
    ImGui::GetWindowDrawList()->AddRectFilled({x - 1.0F, from_.y}, {x + 1.0F, from_.y + length_px}, colour);
}

void FramePlot::level(double value, const char* name, ImU32 colour) const {
    if (value < min_value_ || value > max_value_) { return; }
    const float y = y_of(value);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({from_.x, y}, {to_.x, y}, colour);
    const float above = y - ImGui::GetFontSize();
    list.AddText({from_.x + 2.0F, above < from_.y ? y : above}, colour, name);
}

std::size_t FramePlot::pointed_at(std::span<const Record> records) const {
    if (!ImGui::IsMouseHoveringRect(from_, to_) || !ImGui::IsWindowHovered()) { return none; }
    const float share = (to_.x - ImGui::GetIO().MousePos.x) / (to_.x - from_.x);
    const auto ago =
        static_cast<std::size_t>(std::max(std::lround(share * static_cast<float>(FrameHistory::max_frames)), 1L));
    return ago > records.size() ? none : records.size() - ago;
}

void stacked_bar(std::span<const BarPart> parts, double whole, const char* unit) {
    double sum = 0.0;
    for (const BarPart& part : parts) { sum += std::max(part.value, 0.0); }
    const double scale = std::max({whole, sum, 1e-9});
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.0F), ImGui::GetFontSize() * 1.2F};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    float x = from.x;
    for (const BarPart& part : parts) {
        const float end = x + size.x * static_cast<float>(std::max(part.value, 0.0) / scale);
        list.AddRectFilled({x, from.y}, {end, from.y + size.y}, part.colour);
        x = end;
    }
    ImGui::Dummy(size);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string text = fmt::format("{} {:.2f} {}", parts[i].name, parts[i].value, unit);
        if (i > 0) { same_line_for(ImGui::CalcTextSize(text.c_str()).x); }
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(parts[i].colour), "%s", text.c_str());
    }
}

Panel::Panel(const char* title, PanelColumns& columns, bool& open) {
    if (!open) { return; }
    begun_ = true;
    seen_ = columns.begin_panel(title, open);
    ImGui::PushTextWrapPos();
}

Panel::~Panel() {
    if (begun_) {
        ImGui::PopTextWrapPos();
        ImGui::End();
    }
}

float value_width() {
    constexpr float widest_name_letters = 19.0F;
    constexpr float min_share = 0.4F;
    const float all = ImGui::GetContentRegionAvail().x;
    const float name = widest_name_letters * ImGui::CalcTextSize("n").x;
    return std::max(min_share * all, all - name);
}

void same_line_for(float width) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= right) { ImGui::SameLine(); }
}

float checkbox_width(const char* label) {
    return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label, nullptr, true).x;
}

bool next_button(const char* label) {
    const float text = ImGui::CalcTextSize(label, nullptr, true).x;
    same_line_for(text + 2.0F * ImGui::GetStyle().FramePadding.x);
    return ImGui::Button(label);
}

float gui_scale() {
    constexpr float usual_px = 13.0F;
    return ImGui::GetFontSize() / usual_px;
}

void show_tooltip(const std::string& text) {
    constexpr float widest_letters = 36.0F;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * widest_letters);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void show_tooltip_on_hover(std::string_view text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) { show_tooltip(std::string(text)); }
}

std::optional<std::string> typed_text(const char* label, const std::string& text, std::string_view hint) {
    std::array<char, 4096> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    const bool entered = ImGui::InputTextWithHint(
        label, std::string(hint).c_str(), buffer.data(), buffer.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    return entered ? std::optional<std::string>(buffer.data()) : std::nullopt;
}

void show_value(const char* name, const std::string& value) {
    ImGui::TextUnformatted(name);
    ImGui::SameLine(ImGui::GetFontSize() * 9.0F);
    ImGui::TextUnformatted(value.c_str());
}

} // namespace octant::ui::window
