#include "sim/base/utf8.h"
#include "sim/fixed_step.h"
#include "ui/base/data_files.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/path_fields.h"
#include "ui/window/aircraft_list.h"
#include "ui/window/camera_control.h"
#include "ui/window/flight_readouts.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/setting_style.h"
#include "ui/window/setting_widgets.h"

#include <array>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::window {

namespace scene = visuals::scene;

namespace {

void choose_flight(ViewState& state) {
    constexpr std::array<std::string_view, 1> path{"path"};
    constexpr std::array<std::string_view, 1> terrain{"terrain"};
    constexpr settings::FieldInfo leader_info{
        "aircraft", "NAME|FILE", "the first aircraft and all of its kind: a built-in one or a file"};
    ImGui::BeginDisabled(state.recording.has_value());
    ImGui::BeginGroup();
    edit_settings(state.next_settings, path);
    std::string leader = settings::aircraft_shape(state.next_settings.path.aircraft.front());
    ImGui::PushID("leader");
    ImGui::SetNextItemWidth(value_width());
    if (choose_name(leader_info, leader, base::built_in_models)) {
        state.next_settings.path.aircraft = with_lead_aircraft(state.next_settings.path.aircraft, leader);
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("aircraft");
    ImGui::PopID();
    edit_settings(state.next_settings, terrain);
    ImGui::EndGroup();
    ImGui::EndDisabled();
    if (state.recording) { show_tooltip_on_hover("a recording keeps its path, aircraft and ground"); }
}

void play_buttons(ViewState& state) {
    Playback& playback = state.playback;
    // One name for both, so that a click that changes it is a click on one button.
    if (ImGui::Button(playback.playing ? "Pause###play" : "Play###play")) { playback.playing = !playback.playing; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::PlayOrPause));
    if (next_button("One frame")) { state.requests.step_frame = true; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::StepFrame));
    if (next_button("To beginning")) { state.requests.go_to_s = playback.begin_s; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::ToBeginning));
    same_line_for(checkbox_width("loop"));
    ImGui::Checkbox("loop", &playback.loops);
    show_tooltip_on_hover(fmt::format("begin again at the path's end ({})", state.keys.name_of(ViewCommand::Loop)));
}

void time_sliders(ViewState& state, bool by_hand) {
    Playback& playback = state.playback;
    double time_s = playback.time_s;
    ImGui::BeginDisabled(by_hand || state.recording.has_value());
    ImGui::SetNextItemWidth(value_width());
    if (ImGui::SliderScalar("time", ImGuiDataType_Double, &time_s, &playback.begin_s, &playback.end_s, "%.2f s",
            ImGuiSliderFlags_AlwaysClamp)) {
        state.requests.go_to_s = time_s;
    }
    ImGui::EndDisabled();
    if (state.recording) {
        show_tooltip_on_hover("a recording goes on in time: stop it first");
    } else if (by_hand) {
        show_tooltip_on_hover("by hand time only goes on: give it back to the path first");
    } else {
        show_tooltip_on_hover("where on the path it is; drag to go there");
    }
    ImGui::SetNextItemWidth(value_width());
    ImGui::SliderScalar("speed", ImGuiDataType_Double, &playback.speed, &Playback::slowest, &Playback::fastest, "x%.2f",
        ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    show_tooltip_on_hover(fmt::format("simulated seconds a second; keys {} and {}",
        state.keys.name_of(ViewCommand::Slower), state.keys.name_of(ViewCommand::Faster)));
}

void choose_view(ViewState& state, const flight::Session& session) {
    struct Choice {
        scene::View view;
        ViewCommand command;
    };

    constexpr std::array<Choice, 5> choices{Choice{scene::View::Cockpit, ViewCommand::Cockpit},
        Choice{scene::View::Chase, ViewCommand::Chase}, Choice{scene::View::Tower, ViewCommand::Tower},
        Choice{scene::View::Orbit, ViewCommand::Orbit}, Choice{scene::View::Free, ViewCommand::Free}};
    for (const Choice& choice : choices) {
        const std::string label =
            fmt::format("{} {}", state.keys.name_of(choice.command), settings::text_of(choice.view));
        if (choice.view != choices.front().view) { same_line_for(checkbox_width(label.c_str())); }
        const bool is_it = state.next_settings.view.kind == choice.view;
        if (ImGui::RadioButton(label.c_str(), is_it) && !is_it) {
            state.next_settings = with_view(state.next_settings, choice.view, session.camera());
        }
    }
    constexpr std::array<std::string_view, 1> inset{"inset"};
    edit_settings(state.next_settings, inset);
}

void show_manual_flight(const ViewState& state, const flight::Simulation& simulation) {
    const sim::PilotedFlight& pilot = simulation.pilot();
    show_controls(base::aircraft_kind_of(settings::aircraft_shape(state.next_settings.path.aircraft.front())),
        pilot.state(), simulation.controls());
    const char* warning = "";
    ImVec4 colour = warning_colour;
    if (simulation.end_of_flight()) {
        warning = simulation.end_of_flight() == flight::Simulation::End::OffTheMap ? "left the map" : "met the ground";
    } else if (simulation.is_levelling()) {
        warning = "levelling off";
        colour = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    } else if (pilot.warnings().stalled) {
        warning = "STALL";
    } else if (pilot.warnings().is_at_limit) {
        warning = "limit";
    }
    // Always a line, so that what lies below does not jump.
    ImGui::TextColored(colour, "%s", warning);
}

void manual_flight_buttons(ViewState& state, const flight::Simulation& simulation) {
    const bool by_hand = simulation.by_hand();
    if (ImGui::Button(by_hand ? "Back to the path###hand" : "Fly by hand###hand")) {
        state.requests.toggle_manual_flight = true;
    }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::ManualFlight));
    if (!by_hand) { return; }
    if (next_button("Level off")) { state.requests.level_off = true; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::LevelOff));
    show_manual_flight(state, simulation);
}

void recording_buttons(ViewState& state, const flight::Simulation& simulation) {
    if (ImGui::Button(state.recording ? "Stop recording###record" : "Record###record")) {
        state.requests.toggle_recording = true;
    }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::Record));
    if (next_button("Screenshot")) { state.requests.screenshot = true; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::Screenshot));
    if (state.recording) {
        ImGui::PushStyleColor(ImGuiCol_Text, warning_colour);
        ImGui::TextWrapped("%.1f s in %s", static_cast<double>(simulation.log().size()) * sim::step_s,
            one_line(state.recording->string()).c_str());
        ImGui::PopStyleColor();
    }
}

} // namespace

void flight_panel(ViewState& state, flight::Session& session) {
    const Panel panel("Flight", state.columns, state.open.flight);
    if (!panel.is_seen()) { return; }
    choose_flight(state);
    ImGui::Separator();
    play_buttons(state);
    time_sliders(state, session.simulation().by_hand());
    ImGui::Separator();
    choose_view(state, session);
    ImGui::Separator();
    manual_flight_buttons(state, session.simulation());
    recording_buttons(state, session.simulation());
}

} // namespace octant::ui::window
