#pragma once

#include "ui/report/frame_record.h"

#include <cstddef>
#include <vector>

namespace octant::ui::report {

/// The stages of a flight's frames in the memory of a plot: where there are more frames than columns, neighbours share
/// one, which shows the longest of them.
class StageColumns {
public:
    static constexpr std::size_t max_columns = 400; ///< each wide enough to be seen

    struct Column {
        double x_s = 0.0; ///< simulated time of its first frame
        double frame_ms = 0.0;
        double sim_ms = 0.0;
        double plan_ms = 0.0;
        double draw_ms = 0.0;
        double read_ms = 0.0;
    };

    void add(const FrameRecord& record);

    const std::vector<Column>& columns() const { return columns_; }

    /// Simulated time of the last frame.
    double end_s() const { return end_s_; }

    bool is_thinned() const { return frames_per_column_ > 1; }

private:
    std::vector<Column> columns_;
    std::size_t frames_per_column_ = 1;
    std::size_t in_last_bucket_ = 0;
    double end_s_ = 0.0;
};

} // namespace octant::ui::report
