#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/run_file.h"

#include <span>

namespace octant::ui::report {

/// How a flight kept up with the clock, without its warm-up frames: latency and missed deadlines.
/// No rows where it did not follow the clock.
Rows clock_rows(std::span<const FrameRecord> records);

/// What came from outside: packets, losses, jitter, of all frames. No rows where nothing came.
Rows link_rows(std::span<const FrameRecord> records);

} // namespace octant::ui::report
