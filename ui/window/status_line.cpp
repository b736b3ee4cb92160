#include "sim/base/utf8.h"
#include "ui/flight/inset_view.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/status_marks.h"

#include <glm/common.hpp>

#include <optional>
#include <string>
#include <vector>

namespace octant::ui::window {

namespace {

std::optional<ManualFlightStatus> manual_flight_status(const flight::Simulation& simulation) {
    if (!simulation.by_hand()) { return std::nullopt; }
    const auto end = simulation.end_of_flight();
    return ManualFlightStatus{simulation.pilot().warnings(), end.has_value(),
        end.has_value() && *end == flight::Simulation::End::OffTheMap, simulation.is_levelling()};
}

const ImVec4 mark_colour{1.0F, 0.95F, 0.7F, 1.0F};

/// Makes a text that is broken where it is wider than `most`.
void show_wrapped(const std::string& text, float most) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + most);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

/// Makes the marks in a line, or in lines no wider than `most`.
void show_marks(const std::vector<StatusMark>& marks, float most) {
    const float gap = ImGui::GetFontSize();
    float used = 0.0F;
    for (const StatusMark& mark : marks) {
        const std::string text = one_line(mark.text);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (used > 0.0F && used + gap + width <= most) {
            ImGui::SameLine(0.0F, gap);
            used += gap + width;
        } else {
            used = width;
        }
        ImGui::PushStyleColor(ImGuiCol_Text, mark.warns ? warning_colour : mark_colour);
        show_wrapped(text, most);
        ImGui::PopStyleColor();
    }
}

/// What the panels have to lie in.
PanelArea panel_area_of(const ViewState& state, float status_height) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    PanelArea area{{size.x, size.y}, gui_scale(), status_height, glm::vec2(0.0F)};
    if (state.next_settings.view.inset) {
        const glm::ivec2& picture_px = state.next_settings.view.size_px;
        const auto inset = flight::inset_rectangle(picture_px);
        const glm::vec2 share =
            glm::vec2(picture_px - glm::ivec2(inset.x, inset.y)) / glm::max(glm::vec2(picture_px), glm::vec2(1.0F));
        constexpr float frame = 4.0F;
        area.inset = share * area.size + frame;
    }
    return area;
}

} // namespace

float status_line(const ViewState& state, flight::Session& session, double now_s) {
    const auto marks = status_marks(state, manual_flight_status(session.simulation()));
    const bool speaks = now_s < state.message.until_s && !state.message.text.empty();
    if (marks.empty() && !speaks) { return 0.0F; }
    constexpr float from_top = 6.0F;
    const float top = from_top * gui_scale();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const auto [left, width] = state.columns.middle().value_or(MiddleColumn{0.0F, display.x});
    // Where others fly, the picture's own words are above.
    const bool below = session.simulation().is_live();
    const float at = below ? display.y - top : top;
    const float share = below ? 1.0F : 0.0F;
    ImGui::SetNextWindowPos({left + 0.5F * width, at}, ImGuiCond_Always, {0.5F, share});
    ImGui::SetNextWindowBgAlpha(background_alpha);
    ImGui::Begin("##status", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
            ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    const float most = width - 2.0F * ImGui::GetStyle().WindowPadding.x;
    show_marks(marks, most);
    if (speaks) { show_wrapped(one_line(state.message.text), most); }
    const float height = ImGui::GetWindowSize().y;
    ImGui::End();
    return below ? 0.0F : top + height;
}

void all_panels(ViewState& state, flight::Session& session, double now_s) {
    if (state.order_numbers) { write_order_numbers(session); }
    const float status_height = status_line(state, session, now_s);
    state.columns.lay_out(state.open, panel_area_of(state, status_height));
    leave_question(state);
    if (!state.open.shown) { return; }
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
