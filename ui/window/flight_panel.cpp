#include "sim/base/units.h"
#include "sim/fixed_step.h"
#include "ui/settings/path_fields.h"
#include "ui/window/aircraft_list.h"
#include "ui/window/look_control.h"
#include "ui/window/panel_parts.h"
#include "ui/window/panels.h"
#include "ui/window/setting_style.h"
#include "ui/window/setting_widgets.h"

#include <glm/geometric.hpp>

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
        "aircraft", "NAME|FILE", "the first aircraft and all of its kind: f15, 500md or a file"};
    ImGui::BeginDisabled(state.recording.has_value());
    ImGui::BeginGroup();
    edit_settings(state.wanted, path);
    std::string leader = state.wanted.path.aircraft.front();
    ImGui::PushID("leader");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * value_share);
    if (choose_name(leader_info, leader, settings::built_in_aircraft)) {
        state.wanted.path.aircraft = with_leader(state.wanted.path.aircraft, leader);
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("aircraft");
    ImGui::PopID();
    edit_settings(state.wanted, terrain);
    ImGui::EndGroup();
    ImGui::EndDisabled();
    if (state.recording) {
        explain("a recording keeps its path, aircraft and ground");
    }
}

void play_buttons(ViewState& state) {
    Playback& playback = state.playback;
    // One name for both, so that a click that changes it is a click on one button.
    if (ImGui::Button(playback.playing ? "Pause###play" : "Play###play")) {
        playback.playing = !playback.playing;
    }
    explain(key_of(ViewCommand::PlayOrPause));
    ImGui::SameLine();
    if (ImGui::Button("One frame")) {
        state.requests.step_frame = true;
    }
    explain(key_of(ViewCommand::StepFrame));
    ImGui::SameLine();
    if (ImGui::Button("To beginning")) {
        state.requests.go_to_s = playback.begin_s;
    }
    explain(key_of(ViewCommand::ToBeginning));
    ImGui::SameLine();
    ImGui::Checkbox("loop", &playback.loops);
    explain(with_key("begin again at the path's end", ViewCommand::Loop));
}

void time_sliders(ViewState& state, bool by_hand) {
    Playback& playback = state.playback;
    double time_s = playback.time_s;
    ImGui::BeginDisabled(by_hand || state.recording.has_value());
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * wide_share);
    if (ImGui::SliderScalar(
            "time",
            ImGuiDataType_Double,
            &time_s,
            &playback.begin_s,
            &playback.end_s,
            "%.2f s",
            ImGuiSliderFlags_AlwaysClamp)) {
        state.requests.go_to_s = time_s;
    }
    ImGui::EndDisabled();
    if (state.recording) {
        explain("a recording goes on in time: stop it first");
    } else if (by_hand) {
        explain("by hand time only goes on: give it back to the path first");
    } else {
        explain("where on the path it is; drag to go there");
    }
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * wide_share);
    ImGui::SliderScalar(
        "speed",
        ImGuiDataType_Double,
        &playback.speed,
        &Playback::slowest,
        &Playback::fastest,
        "x%.2f",
        ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    explain(fmt::format(
        "simulated seconds a second; keys {} and {}",
        key_of(ViewCommand::Slower),
        key_of(ViewCommand::Faster)));
}

void choose_view(ViewState& state, const flight::Session& session) {
    struct Choice {
        scene::View view;
        ViewCommand command;
    };

    constexpr std::array<Choice, 5> choices{
        Choice{scene::View::Cockpit, ViewCommand::Cockpit},
        Choice{scene::View::Chase, ViewCommand::Chase},
        Choice{scene::View::Tower, ViewCommand::Tower},
        Choice{scene::View::Orbit, ViewCommand::Orbit},
        Choice{scene::View::Free, ViewCommand::Free}};
    for (const Choice& choice : choices) {
        if (choice.view != choices.front().view) {
            ImGui::SameLine(0.0F, 4.0F * gui_scale());
        }
        const std::string label =
            fmt::format("{} {}", key_of(choice.command), settings::text_of(choice.view));
        const bool is_it = state.wanted.view.kind == choice.view;
        if (ImGui::RadioButton(label.c_str(), is_it) && !is_it) {
            state.wanted = with_view(state.wanted, choice.view, session.camera());
        }
    }
    constexpr std::array<std::string_view, 1> inset{"inset"};
    edit_settings(state.wanted, inset);
}

void show_hand_flight(const flight::Simulation& simulation) {
    const sim::HandFlight& pilot = simulation.pilot();
    const sim::AircraftState& at = pilot.state();
    const auto throttle = static_cast<float>(simulation.controls().throttle);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * value_share);
    ImGui::ProgressBar(
        throttle,
        {ImGui::CalcItemWidth(), 0.0F},
        fmt::format("{:.0f} %", 100.0F * throttle).c_str());
    ImGui::SameLine();
    ImGui::TextUnformatted("throttle");
    ImGui::Text(
        "%.0f kt  %.0f ft  %.1f g",
        kt_from_mps(glm::length(at.velocity_mps)),
        ft_from_m(at.position_m.z),
        at.load_factor);
    const ImVec4 warning{1.0F, 0.35F, 0.25F, 1.0F};
    if (simulation.end_of_flight()) {
        ImGui::SameLine();
        ImGui::TextColored(
            warning,
            simulation.end_of_flight() == flight::Simulation::End::OffTheMap ? "left the map"
                                                                             : "met the ground");
    } else if (pilot.warnings().stalled) {
        ImGui::SameLine();
        ImGui::TextColored(warning, "STALL");
    } else if (pilot.warnings().at_a_limit) {
        ImGui::SameLine();
        ImGui::TextColored(warning, "limit");
    }
}

void hand_buttons(ViewState& state, const flight::Simulation& simulation) {
    const bool by_hand = simulation.by_hand();
    if (ImGui::Button(by_hand ? "Back to the path###hand" : "Fly by hand###hand")) {
        state.requests.toggle_hand = true;
    }
    explain(key_of(ViewCommand::ByHand));
    if (!by_hand) {
        return;
    }
    ImGui::SameLine();
    if (ImGui::Button("Level off")) {
        state.requests.level_off = true;
    }
    explain(key_of(ViewCommand::LevelOff));
    show_hand_flight(simulation);
}

void recording_buttons(ViewState& state, const flight::Simulation& simulation) {
    if (ImGui::Button(state.recording ? "Stop recording###record" : "Record###record")) {
        state.requests.toggle_recording = true;
    }
    explain(key_of(ViewCommand::Record));
    ImGui::SameLine();
    if (ImGui::Button("Screenshot")) {
        state.requests.screenshot = true;
    }
    explain(key_of(ViewCommand::Screenshot));
    if (state.recording) {
        ImGui::TextColored(
            {1.0F, 0.35F, 0.25F, 1.0F},
            "%.1f s in %s",
            static_cast<double>(simulation.log().size()) * sim::step_s,
            state.recording->c_str());
    }
}

} // namespace

void flight_panel(ViewState& state, flight::Session& session) {
    const Panel panel(
        "Flight", {{0.0F, 1.0F}, {10.0F, 10.0F}, {430.0F, 330.0F}}, state.open.flight);
    if (!panel.is_seen()) {
        return;
    }
    choose_flight(state);
    ImGui::Separator();
    play_buttons(state);
    time_sliders(state, session.simulation().by_hand());
    ImGui::Separator();
    choose_view(state, session);
    ImGui::Separator();
    hand_buttons(state, session.simulation());
    recording_buttons(state, session.simulation());
}

} // namespace octant::ui::window
