#include "ui/report/stage_columns.h"

namespace octant::ui::report {

namespace {

using Column = StageColumns::Column;

Column column_of(const FrameRecord& record) {
    return {record.sim_time_s, record.frame_ms, record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms};
}

/// The longer of two neighbours, from where the first one begins.
Column joined(const Column& first, const Column& second) {
    Column column = second.frame_ms > first.frame_ms ? second : first;
    column.x_s = first.x_s;
    return column;
}

} // namespace

void StageColumns::add(const FrameRecord& record) {
    end_s_ = record.sim_time_s;
    if (!columns_.empty() && in_last_bucket_ < frames_per_column_) {
        columns_.back() = joined(columns_.back(), column_of(record));
        ++in_last_bucket_;
        return;
    }
    if (columns_.size() == max_columns) {
        for (std::size_t i = 0; 2 * i < max_columns; ++i) {
            columns_[i] = joined(columns_[2 * i], columns_[2 * i + 1]);
        }
        columns_.resize(max_columns / 2);
        frames_per_column_ *= 2;
    }
    columns_.push_back(column_of(record));
    in_last_bucket_ = 1;
}

} // namespace octant::ui::report
