#pragma once

#include "ui/window/viewer.h"

namespace octant::ui::window {

/// Median and 99th percentile of the frame times of one way to show a flight.
struct WindowTimes {
    double median_ms = 0.0;
    double p99_ms = 0.0;
};

/// Frame times of one flight without a window, in a window with hidden panels, and with open
/// panels.
struct WindowBench {
    WindowTimes without;
    WindowTimes hidden;
    WindowTimes open;
};

/// Takes turns between the three ways, frame by frame, and times each whole turn, from the
/// simulation to the picture read or shown with everything that the window does in between. Opens a
/// window. Throws Error.
WindowBench bench_window(const ViewOptions& options, int frames, bool quiet);

} // namespace octant::ui::window
