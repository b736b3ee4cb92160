#include "ui/window/frame_history.h"

#include "ui/report/statistics.h"

namespace octant::ui::window {

void FrameHistory::add(const report::FrameRecord& record) {
    constexpr std::size_t renewed_every = 30;
    if (records_.size() == max_frames) { records_.erase(records_.begin()); }
    records_.push_back(record);
    if (added_++ % renewed_every == 0) { statistics_ = report::statistics_of(records_); }
}

} // namespace octant::ui::window
