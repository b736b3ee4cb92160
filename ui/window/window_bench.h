#pragma once

#include "ui/window/viewer.h"

namespace octant::ui::window {

/// Median and tail of one way to show a flight.
struct WindowTimes {
    double median_ms = 0.0;
    double p99_ms = 0.0;
};

/// The same flight without a window, in a window whose panels are hidden, and with panels open.
struct WindowBench {
    WindowTimes without;
    WindowTimes hidden;
    WindowTimes open;
};

/// Takes turns between the three, frame by frame, and times each whole turn: simulation to picture
/// read or shown, with everything that the window does in between. Opens a window. Throws Error.
WindowBench bench_window(const ViewOptions& options, int frames, bool quiet);

} // namespace octant::ui::window
