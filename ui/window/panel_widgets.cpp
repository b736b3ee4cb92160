#include "ui/window/panel_widgets.h"

#include "ui/window/aircraft_list.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::window {

Panel::Panel(const char* title, PanelColumns& columns, bool& open) : title_(title), columns_(columns) {
    if (!open) { return; }
    if (const auto rect = columns.take_new_rect(title)) {
        ImGui::SetNextWindowPos({rect->at.x, rect->at.y});
        ImGui::SetNextWindowSize({rect->size.x, rect->size.y});
    }
    begun_ = true;
    seen_ = ImGui::Begin(title, &open, ImGuiWindowFlags_NoCollapse);
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    columns.report_rect(title, {{at.x, at.y}, {size.x, size.y}});
    ImGui::PushTextWrapPos();
}

Panel::~Panel() {
    if (seen_) {
        const ImGuiStyle& style = ImGui::GetStyle();
        columns_.report_height(title_, ImGui::GetCursorPosY() - style.ItemSpacing.y + style.WindowPadding.y);
    }
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

void count_slider(std::vector<std::string>& aircraft) {
    constexpr int most = 100;
    const int count = static_cast<int>(aircraft.size());
    int& wanted_count = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("wanted count"), count);
    ImGui::SetNextItemWidth(value_width());
    ImGui::SliderInt("aircraft", &wanted_count, 1, std::max(most, count), "%d", ImGuiSliderFlags_AlwaysClamp);
    show_tooltip_on_hover("the leader and wingmen of the same kind beside it");
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        aircraft = with_aircraft_count(std::move(aircraft), wanted_count);
    } else if (!ImGui::IsItemActive()) {
        wanted_count = count;
    }
}

} // namespace octant::ui::window
