#include "ui/window/flight_readouts.h"

#include "sim/base/units.h"
#include "ui/window/panel_widgets.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <fmt/format.h>

namespace octant::ui::window {

namespace {

constexpr ImU32 frame_colour = IM_COL32(150, 150, 150, 255);
constexpr ImU32 control_colour = IM_COL32(255, 220, 120, 255);
constexpr float frame_px = 1.0F;

/// Draws a bar in a frame; `share` from 0 to 1 of it is marked, along its longer side.
void mark_in(const ImVec2& from, const ImVec2& to, float share, float mark_px) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect(from, to, frame_colour, 0.0F, 0, frame_px);
    const bool upright = to.y - from.y > to.x - from.x;
    const ImVec2 at =
        upright ? ImVec2(from.x, to.y + share * (from.y - to.y)) : ImVec2(from.x + share * (to.x - from.x), from.y);
    const float half = 0.5F * mark_px;
    if (upright) {
        list.AddRectFilled({from.x, at.y - half}, {to.x, at.y + half}, control_colour);
    } else {
        list.AddRectFilled({at.x - half, from.y}, {at.x + half, to.y}, control_colour);
    }
}

/// The stick from above (pulled is down), the rudder below it and the throttle beside it.
void draw_controls(const sim::PilotControls& controls, float size) {
    const float bar = 0.12F * size;
    const float gap = 0.08F * size;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to(at.x + size, at.y + size);
    const ImVec2 middle(at.x + 0.5F * size, at.y + 0.5F * size);
    list.AddRect(at, to, frame_colour, 0.0F, 0, frame_px);
    list.AddLine({middle.x, at.y}, {middle.x, to.y}, frame_colour, frame_px);
    list.AddLine({at.x, middle.y}, {to.x, middle.y}, frame_colour, frame_px);
    const auto roll = static_cast<float>(controls.roll);
    const auto pitch = static_cast<float>(controls.pitch);
    const auto yaw = static_cast<float>(controls.yaw);
    const float travel = 0.5F * size - 0.5F * bar;
    const ImVec2 stick(middle.x + roll * travel, middle.y + pitch * travel);
    const float half = 0.5F * bar;
    list.AddRectFilled({stick.x - half, stick.y - half}, {stick.x + half, stick.y + half}, control_colour);
    mark_in({at.x, to.y + gap}, {to.x, to.y + gap + bar}, 0.5F + 0.5F * yaw, 0.5F * bar);
    mark_in({to.x + gap, at.y}, {to.x + gap + bar, to.y}, static_cast<float>(controls.throttle), 0.5F * bar);
    ImGui::Dummy({size + gap + bar, size + gap + bar});
}

} // namespace

std::vector<FlightReadout> flight_readouts(
    const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls) {
    const glm::dvec3 in_body = glm::conjugate(state.body_to_world) * state.velocity_mps;
    const double alpha_rad = std::atan2(in_body.z, in_body.x);
    const bool rotor = kind.flight_model == sim::FlightModel::Helicopter;
    constexpr double seconds_a_minute = 60.0;
    return {{rotor ? "collective" : "throttle", fmt::format("{:.0f} %", 100.0 * controls.throttle)},
        {"speed", fmt::format("{:.0f} kt", kt_from_mps(glm::length(state.velocity_mps)))},
        {"height", fmt::format("{:.0f} ft", ft_from_m(state.position_m.z))},
        {"climb", fmt::format("{:+.0f} ft/min", seconds_a_minute * ft_from_m(state.velocity_mps.z))},
        {"AoA", fmt::format("{:.1f} deg", deg_from_rad(alpha_rad))},
        {"load", fmt::format("{:.2f} g", state.load_factor)}};
}

void show_controls(const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls) {
    constexpr float letters = 5.0F;
    constexpr float name_letters = 11.0F;
    ImGui::BeginGroup();
    draw_controls(controls, letters * ImGui::GetFontSize());
    ImGui::EndGroup();
    show_tooltip_on_hover("the stick from above (pulled is down), rudder or pedals below it, throttle or "
                          "collective beside it");
    ImGui::SameLine();
    ImGui::BeginGroup();
    for (const FlightReadout& number : flight_readouts(kind, state, controls)) {
        ImGui::TextDisabled("%s", number.name.c_str());
        ImGui::SameLine(name_letters * ImGui::CalcTextSize("n").x);
        ImGui::TextUnformatted(number.value.c_str());
    }
    ImGui::EndGroup();
}

} // namespace octant::ui::window
