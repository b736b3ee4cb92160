#pragma once

#include "ui/flight/session.h"
#include "ui/window/view_state.h"

namespace octant::ui::window {

// Each makes the widgets of one panel between ImGui::NewFrame and ImGui::Render, where it is open.
// They read the session, and change ViewState alone: settings in `wanted`, all else in `requests`.

void flight_panel(ViewState& state, flight::Session& session);
void timing_panel(ViewState& state);
void terrain_panel(ViewState& state, const flight::Session& session);
void draw_order_panel(ViewState& state, const flight::Session& session);
void aircraft_panel(ViewState& state, const flight::Session& session);
void scene_panel(ViewState& state, const flight::Session& session);
void settings_panel(ViewState& state);
void help_panel(ViewState& state);
void first_steps_panel(ViewState& state);

/// The message line, and what is always to be seen: recording, paused, by hand.
void status_line(const ViewState& state, flight::Session& session, double now_s);

/// Painting order of the first aircraft's polygons, written on those that face the eye.
void write_order_numbers(const flight::Session& session);

/// All that are open.
void all_panels(ViewState& state, flight::Session& session, double now_s);

} // namespace octant::ui::window
