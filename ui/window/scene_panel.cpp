#include "sim/sun_position.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"
#include "ui/world/sun_at_time.h"

#include <array>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::window {

namespace {

constexpr std::array<std::string_view, 12> scene_settings{"time", "sun-azimuth", "sun-elevation", "visibility",
    "haze-height", "sky", "background", "relief-shadows", "water-level", "palette", "ground-shading", "drape"};

constexpr sim::SolarTime noon_in_spring{2000, 3, 20, 12 * 60};
constexpr ImGuiSliderFlags slider_without_input = ImGuiSliderFlags_NoInput;
constexpr int last_minute = 24 * 60 - 1;

std::string clock_text(const sim::SolarTime& time) {
    return fmt::format("{:02}:{:02}", time.minute / 60, time.minute % 60);
}

std::string date_text(const sim::SolarTime& time) {
    return fmt::format("{:04}-{:02}-{:02}", time.year, time.month, time.day);
}

/// Makes sliders for time and day, which set the position of the sun. They show none where the sun was put in its place
/// by hand.
void time_of_day(settings::RunSettings& settings, double latitude_deg) {
    const auto now =
        settings.air.time ? sim::solar_time_from_text(*settings.air.time) : std::optional<sim::SolarTime>();
    sim::SolarTime time = now.value_or(noon_in_spring);
    int day = sim::day_of_year(time);
    const std::string clock = now ? clock_text(time) : "by hand";
    const std::string date = now ? date_text(time) : "by hand";
    ImGui::SetNextItemWidth(value_width());
    bool changed = ImGui::SliderInt("time of day", &time.minute, 0, last_minute, clock.c_str(), slider_without_input);
    show_tooltip_on_hover(
        fmt::format("the sun's own time at latitude {:.1f}; sets its azimuth and elevation. At night it stays "
                    "on the horizon.",
            latitude_deg));
    ImGui::SetNextItemWidth(value_width());
    changed = ImGui::SliderInt("day of year", &day, 1, 365, date.c_str(), slider_without_input) || changed;
    show_tooltip_on_hover("March 20: spring equinox, June 21: midsummer of the northern half");
    if (changed) {
        time = sim::on_day(time, day);
        settings.air.time = fmt::format("{}T{}", date_text(time), clock_text(time));
    }
}

} // namespace

void scene_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Scene", state.columns, state.open.scene);
    if (!panel.is_seen()) { return; }
    time_of_day(state.next_settings, world::latitude_of(session.world().ground_place));
    ImGui::Separator();
    edit_settings(state.next_settings, scene_settings);
    ImGui::Separator();
    ImGui::BeginDisabled(state.recording.has_value());
    count_slider(state.next_settings.path.aircraft);
    ImGui::EndDisabled();
}

} // namespace octant::ui::window
