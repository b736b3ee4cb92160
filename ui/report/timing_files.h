#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/machine_info.h"

#include <string>

namespace octant::ui::report {

/// A MangoHud log (its plain CSV, without the "v1" lines) of the frames after the warm-up, so that
/// MangoHud's tools and ours count the same frames: its head, then a line a frame, nothing for one
/// of the warm-up. `elapsed` (ns) is the end of the frame; what MangoHud measures and we do not is
/// 0.
std::string mangohud_head(const MachineInfo& machine, const std::string& renderer);
std::string mangohud_line(const FrameRecord& record);

/// A trace for Perfetto and chrome://tracing, a list of events that both also read where its end is
/// missing (Trace Event Format, "JSON Array Format"), times in microseconds: each frame an "X"
/// event with its stages sim, plan, draw, read inside it, one after the other; counters for
/// triangles and resolution; an instant event at each overrun.
std::string trace_head();
std::string trace_events(const FrameRecord& record);
std::string trace_end();

} // namespace octant::ui::report
