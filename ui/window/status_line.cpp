#include "ui/window/panel_parts.h"
#include "ui/window/panels.h"
#include "ui/window/status_marks.h"

#include <cstddef>
#include <optional>

namespace octant::ui::window {

namespace {

std::optional<HandStatus> hand_status(const flight::Simulation& simulation) {
    if (!simulation.by_hand()) {
        return std::nullopt;
    }
    const auto end = simulation.end_of_flight();
    return HandStatus{
        simulation.pilot().warnings(),
        end.has_value(),
        end.has_value() && *end == flight::Simulation::End::OffTheMap};
}

const ImVec4 warning_colour{1.0F, 0.35F, 0.25F, 1.0F};
const ImVec4 mark_colour{1.0F, 0.95F, 0.7F, 1.0F};

} // namespace

void status_line(const ViewState& state, flight::Session& session, double now_s) {
    const auto marks = status_marks(state, hand_status(session.simulation()));
    const bool speaks = now_s < state.message.until_s && !state.message.text.empty();
    if (marks.empty() && !speaks) {
        return;
    }
    constexpr float from_top = 6.0F;
    constexpr float ground_alpha = 0.45F;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(
        {display.x * 0.5F, from_top * gui_scale()}, ImGuiCond_Always, {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(ground_alpha);
    ImGui::Begin(
        "##status",
        nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
            ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
            ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (i > 0) {
            ImGui::SameLine(0.0F, ImGui::GetFontSize());
        }
        ImGui::TextColored(
            marks[i].warns ? warning_colour : mark_colour, "%s", marks[i].text.c_str());
    }
    if (speaks) {
        ImGui::TextUnformatted(state.message.text.c_str());
    }
    ImGui::End();
}

void all_panels(ViewState& state, flight::Session& session, double now_s) {
    if (state.order_numbers) {
        write_order_numbers(session);
    }
    status_line(state, session, now_s);
    if (!state.open.shown) {
        return;
    }
    flight_panel(state, session);
    timing_panel(state);
    terrain_panel(state, session);
    draw_order_panel(state, session);
    aircraft_panel(state, session);
    scene_panel(state, session);
    settings_panel(state);
    help_panel(state);
    first_steps_panel(state);
}

} // namespace octant::ui::window
