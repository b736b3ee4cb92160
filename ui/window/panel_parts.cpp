#include "ui/window/panel_parts.h"

#include "ui/window/aircraft_list.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::window {

Panel::Panel(const char* title, const PanelPlace& place, bool& open) {
    if (!open) {
        return;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float scale = gui_scale();
    const auto along = [scale](float corner, float inset, float extent) {
        return corner * extent + (1.0F - 2.0F * corner) * inset * scale;
    };
    ImGui::SetNextWindowPos(
        {along(place.corner.x, place.inset.x, display.x),
         along(place.corner.y, place.inset.y, display.y)},
        ImGuiCond_FirstUseEver,
        place.corner);
    ImGui::SetNextWindowSize({place.size.x * scale, place.size.y * scale}, ImGuiCond_FirstUseEver);
    begun_ = true;
    seen_ = ImGui::Begin(title, &open);
}

Panel::~Panel() {
    if (begun_) {
        ImGui::End();
    }
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

void explain(std::string_view text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        show_tooltip(std::string(text));
    }
}

std::string_view key_of(ViewCommand command) {
    const auto keys = view_keys();
    const auto found = std::ranges::find(keys, command, &ViewKey::command);
    return found == keys.end() ? std::string_view() : found->name;
}

std::string with_key(std::string_view text, ViewCommand command) {
    return fmt::format("{} ({})", text, key_of(command));
}

std::optional<std::string>
typed_text(const char* label, const std::string& text, std::string_view hint) {
    std::array<char, 4096> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    const bool entered = ImGui::InputTextWithHint(
        label,
        std::string(hint).c_str(),
        buffer.data(),
        buffer.size(),
        ImGuiInputTextFlags_EnterReturnsTrue);
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
    int& wanted = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("wanted count"), count);
    ImGui::SliderInt(
        "aircraft", &wanted, 1, std::max(most, count), "%d", ImGuiSliderFlags_AlwaysClamp);
    explain("the leader and wingmen of the same kind beside it");
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        aircraft = with_count(std::move(aircraft), wanted);
    } else if (!ImGui::IsItemActive()) {
        wanted = count;
    }
}

} // namespace octant::ui::window
