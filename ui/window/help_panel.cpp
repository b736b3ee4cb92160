#include "sim/base/utf8.h"
#include "ui/window/key_names.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/view_keys.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace octant::ui::window {

namespace {

constexpr float key_share = 0.3F;

void line_of(std::string_view name, std::string_view meaning) {
    ImGui::TableNextRow();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(meaning.data(), meaning.data() + meaning.size());
    ImGui::PopTextWrapPos();
}

void bullet(const char* text) {
    ImGui::Bullet();
    ImGui::TextWrapped("%s", text);
}

/// What a person's own keys come from, or how to have some.
void show_file_of_keys(ViewState& state) {
    if (state.keys_file.empty()) { return; }
    const std::string file = one_line(state.keys_file.string());
    if (!state.keys_file_exists) {
        if (next_button("Write keys")) { state.requests.write_keys = true; }
        show_tooltip_on_hover("into " + file + ", to be changed there; they count from the next start on");
        return;
    }
    ImGui::TextWrapped("keys of %s", file.c_str());
    for (const std::string& fault : state.key_errors) { ImGui::TextWrapped("%s", one_line(fault).c_str()); }
}

} // namespace

void help_panel(ViewState& state) {
    const Panel panel("Keys", state.columns, state.open.help);
    if (!panel.is_seen()) { return; }
    if (ImGui::Button("Put panels back")) { state.columns.reset_layout(); }
    show_tooltip_on_hover("into their columns, each as high as what it shows");
    show_file_of_keys(state);
    if (!ImGui::BeginTable("keys", 2)) { return; }
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthStretch, key_share);
    ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthStretch, 1.0F - key_share);
    const KeyMap& keys = state.keys;
    for (const ViewKey& key : view_keys()) { line_of(keys.name_of(key.command), key.meaning); }
    std::string names;
    for (const HeldKey& key : held_keys()) {
        names += (names.empty() ? "" : ", ") + keys.name_of(key.chosen_action);
        if (!key.meaning.empty()) {
            line_of(names, key.meaning);
            names.clear();
        }
    }
    line_of(name_of_button(keys.look_button) + " drag", "turn the look, or around the aircraft");
    line_of("wheel", "zoom");
    line_of(
        name_of_button(keys.stick_button) + " button", "by hand: the pointer is the stick, from the window's middle");
    for (std::size_t i = 0; i < keys.pad_commands.size(); ++i) {
        if (const auto& what = keys.pad_commands[i]) {
            line_of("gamepad " + name_of_pad_button(static_cast<int>(i)),
                std::ranges::find(view_keys(), *what, &ViewKey::command)->meaning);
        }
    }
    line_of("gamepad", "by hand: left stick; triggers throttle; bumpers or right stick rudder");
    line_of("joystick", "by hand: stick, twist, lever");
    ImGui::EndTable();
}

void first_steps_panel(ViewState& state) {
    const Panel panel("First steps", state.columns, state.open.first_steps);
    if (!panel.is_seen()) { return; }
    bullet("Space plays and pauses; 1 to 5 change the view.");
    bullet("Drag to look around, turn the wheel to come nearer.");
    bullet("H flies by hand; F1 lists all keys; Tab hides the panels.");
    if (ImGui::Button("Begin")) { state.open.first_steps = false; }
}

void leave_question(ViewState& state) {
    const Panel panel("Leave?", state.columns, state.open.leave_question);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("A recording is being made. Leaving ends it; what was flown is kept.");
    if (ImGui::Button("Stop it and leave")) { state.requests.leave_recording = true; }
    if (next_button("Go on")) { state.open.leave_question = false; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::Leave));
}

} // namespace octant::ui::window
