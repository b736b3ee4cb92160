#include "ui/window/panel_parts.h"
#include "ui/window/panels.h"
#include "ui/window/view_keys.h"

#include <string_view>

namespace octant::ui::window {

namespace {

void line_of(std::string_view name, std::string_view meaning) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(meaning.data(), meaning.data() + meaning.size());
}

} // namespace

void help_panel(ViewState& state) {
    const Panel panel("Keys", {{0.5F, 0.0F}, {0.0F, 50.0F}, {600.0F, 650.0F}}, state.open.help);
    if (!panel.is_seen() || !ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        return;
    }
    for (const ViewKey& key : view_keys()) {
        line_of(key.name, key.meaning);
    }
    for (const HeldKey& key : held_keys()) {
        line_of(key.name, key.meaning);
    }
    ImGui::EndTable();
}

void first_steps_panel(ViewState& state) {
    const Panel panel(
        "First steps", {{0.5F, 0.5F}, {0.0F, 0.0F}, {450.0F, 125.0F}}, state.open.first_steps);
    if (!panel.is_seen()) {
        return;
    }
    ImGui::BulletText("Space plays and pauses; 1 to 5 change the view.");
    ImGui::BulletText("Drag to look around, turn the wheel to come nearer.");
    ImGui::BulletText("H flies by hand; F1 lists all keys; Tab hides the panels.");
    if (ImGui::Button("Begin")) {
        state.open.first_steps = false;
    }
}

} // namespace octant::ui::window
