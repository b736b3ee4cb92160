#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace octant::ui::window {

namespace {

constexpr std::array<std::string_view, 10> aircraft_settings{"axes", "shadows", "aircraft-error-px", "show-model",
    "shading", "shading-rule", "smooth-share", "device-ratio", "shading-near", "shading-far"};

/// Lists the levels of detail in which a model can be drawn.
void show_representations(const visuals::planning::AircraftModel& model) {
    if (model.progressive) {
        ImGui::TextDisabled("  refined in each frame: %zu triangles at most", model.progressive->face_count());
    }
    for (const visuals::planning::MeshLevel& level : model.levels) {
        ImGui::TextDisabled("  level of %d triangles, wrong by %.3g m", level.range.polygons, level.error_m);
    }
}

/// Makes one line for each model that flies.
void show_models(const visuals::planning::Scene& scene) {
    for (std::size_t model = 0; model < scene.models.size(); ++model) {
        const auto flying = std::ranges::count(scene.aircraft, model);
        if (flying == 0) { continue; }
        const visuals::planning::AircraftModel& each = *scene.models[model];
        ImGui::BulletText("%ld x %s: %zu polygons", static_cast<long>(flying), each.polygons.name.c_str(),
            each.polygons.polygons.size());
        const auto whole = each.polygons.parents.empty()
                               ? each.polygons.polygons.size()
                               : std::size_t{1} + *std::ranges::max_element(each.polygons.parents);
        if (whole < each.polygons.polygons.size()) {
            ImGui::SameLine();
            ImGui::TextDisabled("(%zu in its file)", whole);
            show_tooltip_on_hover("some were split where no painting order exists otherwise");
        }
        show_representations(each);
    }
}

} // namespace

void aircraft_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Aircraft", state.columns, state.open.aircraft);
    if (!panel.is_seen()) { return; }
    show_models(session.world().scene);
    if (!state.history.empty()) {
        const report::FrameRecord& last = state.history.last();
        ImGui::Text("drawn: %d polygons,", last.aircraft_polygons);
        ImGui::Text("  %d smooth, %d shadow pieces", last.smooth_polygons, last.shadow_triangles);
        if (const auto& adapted = session.shading()) {
            ImGui::Text("  adapted: %d smooth%s", adapted->smooth, adapted->has_no_gain ? ", flat is no faster" : "");
        }
        ImGui::Text("first aircraft: level %d", last.aircraft_level);
        ImGui::Text(
            "refined: %d splits, %d merges, %.2f ms", last.refine_splits, last.refine_collapses, last.refine_ms);
    }
    ImGui::BeginDisabled(state.recording.has_value());
    count_slider(state.next_settings.path.aircraft);
    ImGui::EndDisabled();
    edit_settings(state.next_settings, aircraft_settings);
}

} // namespace octant::ui::window
