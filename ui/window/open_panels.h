#pragma once

namespace octant::ui::window {

/// Which panels are open.
struct OpenPanels {
    /// While this is false, no panel is shown.
    bool shown = true;
    bool flight = true;
    bool timing = false;
    bool terrain = false;
    bool draw_order = false;
    bool aircraft = false;
    bool scene = false;
    bool settings = false;
    bool help = false;
    /// A panel of three lines on how to begin.
    bool first_steps = false;
    /// Whether to leave although a recording is being made. Shown even where no panel is.
    bool leave_question = false;
};

} // namespace octant::ui::window
