#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/machine_info.h"

#include <span>
#include <string>

namespace octant::ui::report {

/// The frames after the warm-up as a MangoHud log (its plain CSV, without the "v1" lines), so that
/// MangoHud's tools and ours count the same frames. `elapsed` (ns) is the end of the frame; what
/// MangoHud measures and we do not is 0.
std::string mangohud_csv(
    std::span<const FrameRecord> records, const MachineInfo& machine, const std::string& renderer);

/// All frames as Chrome trace JSON for Perfetto and chrome://tracing, times in microseconds: each
/// frame an "X" event with its stages sim, plan, draw, read inside it, one after the other;
/// counters for triangles and resolution; an instant event at each overrun.
std::string trace_json(std::span<const FrameRecord> records);

} // namespace octant::ui::report
