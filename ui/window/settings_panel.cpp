#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"

#include <array>
#include <cstddef>
#include <string>

namespace octant::ui::window {

namespace {

void save_and_load(ViewState& state) {
    std::array<char, 1024> name{};
    state.settings_file.copy(name.data(), name.size() - 1);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 8.0F);
    if (ImGui::InputText("##settings file", name.data(), name.size())) { state.settings_file = name.data(); }
    show_tooltip_on_hover("a settings file, or the run.json of a recording");
    ImGui::BeginDisabled(state.settings_file.empty());
    ImGui::SameLine();
    if (ImGui::Button("Save")) { state.requests.save_settings = state.settings_file; }
    ImGui::SameLine();
    if (ImGui::Button("Load")) { state.requests.load_settings = state.settings_file; }
    ImGui::EndDisabled();
}

} // namespace

void settings_panel(ViewState& state) {
    const Panel panel("Settings", state.columns, state.open.settings);
    if (!panel.is_seen()) { return; }
    save_and_load(state);
    for (const auto& [group, headline] : settings::enum_names<settings::SettingGroup>) {
        if (ImGui::CollapsingHeader(headline.data())) {
            ImGui::PushID(headline.data());
            edit_group(state.next_settings, group);
            ImGui::PopID();
        }
    }
}

} // namespace octant::ui::window
