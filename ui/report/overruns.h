#pragma once

#include "ui/report/frame_record.h"
#include "ui/report/statistics.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// The stages of a frame; `other` is what frame_ms holds beside the four that are timed.
inline constexpr std::array<std::string_view, 5> stage_names{
    "sim", "plan", "draw", "read", "other"};

/// A slow frame and why.
struct Overrun {
    FrameRecord record;
    std::array<double, 5> stage_ms{}; ///< as stage_names
    std::size_t longest_stage = 0;    ///< took most of the frame
    std::size_t grown_stage = 0;      ///< took most above its own median of the flight
    double growth_ms = 0.0;           ///< by that much
};

/// The counted frames above a time in flight order.
std::vector<Overrun>
overruns_of(std::span<const FrameRecord> records, double limit_ms = overrun_16_ms);

} // namespace octant::ui::report
