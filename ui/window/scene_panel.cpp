#include "ui/window/panel_parts.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"
#include "ui/window/sun_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::window {

namespace {

constexpr std::array<std::string_view, 9> scene_settings{
    "sun-azimuth",
    "sun-elevation",
    "visibility",
    "sky",
    "background",
    "water-level",
    "palette",
    "ground-shading",
    "drape"};

constexpr float noon = 12.0F;
constexpr int spring_equinox = 80;
constexpr double latitude_without_place_deg = 45.0;

/// Returns the hour in the form "13:05".
std::string clock_text(float hour) {
    const long minutes = std::lround(hour * 60.0F);
    return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

/// Makes sliders for time and day, which set the position of the sun. ImGui keeps time and day with
/// the panel, because settings hold only the position.
void time_of_day(settings::RunSettings& settings, double latitude_deg) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    float& hour = *storage.GetFloatRef(ImGui::GetID("hour"), noon);
    int& day = *storage.GetIntRef(ImGui::GetID("day of year"), spring_equinox);
    ImGui::SetNextItemWidth(value_width());
    bool changed = ImGui::SliderFloat("time of day", &hour, 0.0F, 24.0F, clock_text(hour).c_str());
    explain(fmt::format(
        "the sun's own time at latitude {:.1f}; sets its azimuth and elevation. At night it stays "
        "on the horizon.",
        latitude_deg));
    ImGui::SetNextItemWidth(value_width());
    changed = ImGui::SliderInt("day of year", &day, 1, 365) || changed;
    explain("80: spring equinox, 172: midsummer, 355: midwinter of the northern half");
    if (changed) {
        const SunPosition sun =
            sun_position(latitude_deg, static_cast<double>(day), static_cast<double>(hour));
        settings.air.sun_azimuth_deg = sun.azimuth_deg;
        settings.air.sun_elevation_deg = std::clamp(sun.elevation_deg, 0.0, 90.0);
    }
}

} // namespace

void scene_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Scene", state.columns, state.open.scene);
    if (!panel.is_seen()) {
        return;
    }
    const auto& place = session.world().ground_place;
    time_of_day(state.wanted, place ? place->latitude_deg : latitude_without_place_deg);
    ImGui::Separator();
    edit_settings(state.wanted, scene_settings);
    ImGui::Separator();
    ImGui::BeginDisabled(state.recording.has_value());
    count_slider(state.wanted.path.aircraft);
    ImGui::EndDisabled();
}

} // namespace octant::ui::window
