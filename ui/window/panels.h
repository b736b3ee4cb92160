#pragma once

#include "ui/flight/session.h"
#include "ui/window/view_state.h"

namespace octant::ui::window {

// Each function makes the widgets of one panel, where it is open, between ImGui::NewFrame and ImGui::Render. Panels
// read the session and change ViewState alone: settings in `wanted`, all else in `requests`.

void flight_panel(ViewState& state, flight::Session& session);
void timing_panel(ViewState& state);
void terrain_panel(ViewState& state, const flight::Session& session);
void draw_order_panel(ViewState& state, const flight::Session& session);
void aircraft_panel(ViewState& state, const flight::Session& session);
void scene_panel(ViewState& state, const flight::Session& session);
void settings_panel(ViewState& state);
void help_panel(ViewState& state);
void first_steps_panel(ViewState& state);
void leave_question(ViewState& state);

/// Makes the line of status marks (recording, paused, by hand) and the line of the last message, between the columns of
/// panels: at the top, or at the bottom where others fly and the picture has words of its own at the top. Returns how
/// much of the window's upper end they take.
float status_line(const ViewState& state, flight::Session& session, double now_s);

/// Writes the painting order of the first aircraft's polygons on those that face the eye.
void write_order_numbers(const flight::Session& session);

/// Makes all panels that are open.
void all_panels(ViewState& state, flight::Session& session, double now_s);

} // namespace octant::ui::window
