#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/plot.h"
#include "ui/window/setting_widgets.h"
#include "visuals/scene/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::window {

namespace {

using report::FrameRecord;

constexpr std::array<std::string_view, 14> controls{"show-mesh", "mesh", "detail", "triangles", "error-px", "adapt",
    "geomorphs", "mesh-ahead", "earth-curvature", "fans", "resolution-c", "roughness-c", "control-a", "control-r"};

void count_plot(std::span<const FrameRecord> records) {
    int most = 1;
    for (const FrameRecord& record : records) { most = std::max(most, record.terrain_triangles); }
    const int target = records.back().triangle_target;
    const FramePlot plot(ImGui::GetFontSize() * 4.0F, 0.0, 1.15 * most);
    plot.level(target, "target", IM_COL32(200, 200, 120, 160));
    plot.line(
        records, [](const FrameRecord& record) { return static_cast<double>(record.terrain_triangles); },
        IM_COL32(120, 210, 120, 255));
}

void change_plot(std::span<const FrameRecord> records) {
    int most = 1;
    for (const FrameRecord& record : records) { most = std::max(most, std::abs(record.triangle_change)); }
    const std::string name = fmt::format("change, +-{}", most);
    const FramePlot plot(ImGui::GetFontSize() * 3.0F, -1.1 * most, 1.1 * most);
    plot.level(0.0, name.c_str(), IM_COL32(200, 200, 200, 160));
    plot.line(
        records, [](const FrameRecord& record) { return static_cast<double>(record.triangle_change); },
        IM_COL32(255, 170, 90, 255));
}

void show_counts(const FrameRecord& last) {
    const bool limited = last.triangle_target < visuals::scene::unlimited_triangles;
    ImGui::Text("%d triangles, target %s", last.terrain_triangles,
        limited ? fmt::format("{}", last.triangle_target).c_str() : "none");
    ImGui::Text("change %+d, shadows %d", last.triangle_change, last.shadow_triangles);
    if (last.error_px > 0.0) {
        ImGui::Text("error %.3g px", last.error_px);
        show_tooltip_on_hover("screen-space error that the mesh was made for");
    } else {
        ImGui::Text("C %.4g, %d fans", last.resolution_c, last.terrain_fans);
        show_tooltip_on_hover("C: resolution of the paper's quadtree; fans: leaves of it that were drawn");
    }
}

} // namespace

void terrain_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Terrain", state.columns, state.open.terrain);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("%s", session.world().ground_name.c_str());
    if (!state.history.empty()) {
        show_counts(state.history.last());
        count_plot(state.history.records());
        change_plot(state.history.records());
    }
    ImGui::Separator();
    edit_settings(state.next_settings, controls);
}

} // namespace octant::ui::window
