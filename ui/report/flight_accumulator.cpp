#include "ui/report/flight_accumulator.h"

#include <algorithm>

namespace octant::ui::report {

void FlightAccumulator::add(const FrameRecord& record) {
    const double at_s = record.sim_time_s;
    begin_s_ = frames_ == 0 ? at_s : begin_s_;
    end_s_ = at_s;
    ++frames_;
    times_.add(record);
    link.add(record);
    if (record.warm_up) {
        warm_up_ms.add(at_s, record.frame_ms);
        return;
    }
    frame_ms.add(at_s, record.frame_ms);
    triangles.add(at_s, record.terrain_triangles);
    triangle_change.add(at_s, record.triangle_change);
    triangle_target.add(at_s, record.triangle_target);
    stress.add(at_s, record.stress);
    stages.add(record);
    slow.add(record);
    clock.add(record);
    const int target = record.triangle_target;
    targets_.min_triangles = reported_counts_ == 0 ? target : std::min(targets_.min_triangles, target);
    targets_.max_triangles = std::max(targets_.max_triangles, target);
    targets_.mean += target;
    ++reported_counts_;
}

TargetRange FlightAccumulator::triangle_targets() const {
    TargetRange range = targets_;
    range.mean = reported_counts_ > 0 ? targets_.mean / static_cast<double>(reported_counts_) : 0.0;
    return range;
}

} // namespace octant::ui::report
