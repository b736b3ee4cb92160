#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/frame_times.h"
#include "ui/report/statistics.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// The stages of a frame; `other` is what frame_ms holds beside the four that are timed.
inline constexpr std::array<std::string_view, 5> stage_names{"sim", "plan", "draw", "read", "other"};

/// A slow frame and why.
struct SlowFrame {
    FrameRecord record;
    std::array<double, 5> stage_ms{}; ///< as stage_names
    std::size_t longest_stage = 0;    ///< took most of the frame
    std::size_t slowed_stage = 0;     ///< took most above its own median of the flight
    double slowdown_ms = 0.0;         ///< by that much
};

/// The slowest frames of a flight, those of its warm-up left out, in constant memory.
class SlowFrameList {
public:
    static constexpr std::size_t max_kept = 12;

    void add(const FrameRecord& record);

    /// At most max_kept, the slowest first.
    std::vector<SlowFrame> slowest() const;

    /// Frames above overrun_16_ms by the stage that took most of each.
    const std::array<int, 5>& above_16_ms() const { return above_16_ms_; }

private:
    std::vector<FrameRecord> slowest_;
    std::array<FrameTimeHistogram, 5> stages_;
    std::array<int, 5> above_16_ms_{};
};

} // namespace octant::ui::report
