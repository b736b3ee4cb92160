#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"

#include <array>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::window {

namespace {

constexpr std::array<std::string_view, 2> order_settings{"hidden-surface", "order-method"};

void show_last_frame(const report::FrameRecord& last, const visuals::draworder::DrawOrder& order) {
    if (order.has_one_cell_per_eye()) {
        show_value("cell", fmt::format("{} of 0 to {}", last.draw_cell, order.cell_count() - 1));
        show_tooltip_on_hover("in which the eye is, of the first aircraft's");
    } else {
        show_value("parts", fmt::format("{}", order.cell_count()));
        show_tooltip_on_hover("of the first aircraft, in an order that is found anew for each eye");
    }
    show_value("lists", fmt::format("{}", order.list_count()));
    show_tooltip_on_hover("different painting orders that the cells share");
    show_value("polygons", fmt::format("{}", last.aircraft_polygons));
    show_tooltip_on_hover("of all aircraft, in the lists drawn");
    show_value("cuts", fmt::format("{}", last.cuts));
    show_tooltip_on_hover("ground triangles and aircraft polygons painted again, cut by planes");
    show_value("unordered", fmt::format("{}", last.unordered));
    show_tooltip_on_hover("overlaps for which no painting order was found");
}

void show_pixel_check(ViewState& state) {
    if (ImGui::Button("Count wrong pixels")) { state.requests.count_wrong_pixels = true; }
    show_tooltip_on_hover("draws this picture once more with a depth buffer and compares them");
    if (!state.wrong_pixels) { return; }
    const WrongPixels& found = *state.wrong_pixels;
    const bool clean = found.wrong == 0;
    ImGui::SameLine();
    ImGui::TextColored(clean ? ImVec4(0.5F, 0.9F, 0.5F, 1.0F) : warning_colour, "%ld wrong", found.wrong);
    ImGui::Text("%ld of %ld pixels differ", found.differing, found.pixels);
    show_tooltip_on_hover("with those along edges, where two right pictures may differ");
}

} // namespace

void draw_order_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Draw order", state.columns, state.open.draw_order);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("A cell is a part of the space around an aircraft: from every eye in it, the same order of "
                       "polygons, painted one over the other, hides what is hidden.");
    const auto& scene = session.world().scene;
    if (!state.history.empty()) { show_last_frame(state.history.last(), scene.model_of(0).order); }
    edit_settings(state.next_settings, order_settings);
    ImGui::Checkbox("painting order on the polygons", &state.order_numbers);
    show_pixel_check(state);
}

} // namespace octant::ui::window
