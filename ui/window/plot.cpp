#include "ui/window/plot.h"

#include "ui/window/frame_history.h"
#include "ui/window/panel_widgets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace octant::ui::window {

FramePlot::FramePlot(float height_px, double least, double most)
    : from_(ImGui::GetCursorScreenPos()), least_(least), most_(std::max(most, least + 1e-9)) {
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.0F), height_px};
    to_ = {from_.x + size.x, from_.y + size.y};
    ImGui::GetWindowDrawList()->AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg));
    ImGui::Dummy(size);
}

float FramePlot::x_of(std::size_t frames_ago) const {
    return to_.x - (to_.x - from_.x) * static_cast<float>(frames_ago) / static_cast<float>(FrameHistory::max_frames);
}

float FramePlot::y_of(double value) const {
    const double finite = std::isfinite(value) ? value : least_;
    const double share = std::clamp((finite - least_) / (most_ - least_), 0.0, 1.0);
    return to_.y - (to_.y - from_.y) * static_cast<float>(share);
}

void FramePlot::mark(std::size_t frames_ago, ImU32 colour) const {
    constexpr float length_px = 5.0F;
    const float x = x_of(frames_ago);
    ImGui::GetWindowDrawList()->AddRectFilled({x - 1.0F, from_.y}, {x + 1.0F, from_.y + length_px}, colour);
}

void FramePlot::level(double value, const char* name, ImU32 colour) const {
    if (value < least_ || value > most_) { return; }
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

} // namespace octant::ui::window
