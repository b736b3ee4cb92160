#include "ui/report/slow_frames.h"

#include <algorithm>
#include <cmath>

namespace octant::ui::report {

namespace {

/// With the decimals of frames.csv, so that there are not many different ones.
std::array<double, 5> stages_of(const FrameRecord& record) {
    constexpr double decimals = 1e4;
    const double timed_ms = record.sim_ms + record.plan_ms + record.draw_ms + record.read_ms;
    return {record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms,
        std::round(std::max(0.0, record.frame_ms - timed_ms) * decimals) / decimals};
}

std::size_t index_of_greatest(const std::array<double, 5>& values) {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

} // namespace

void SlowFrameList::add(const FrameRecord& record) {
    if (record.warm_up) { return; }
    const std::array<double, 5> stage_ms = stages_of(record);
    for (std::size_t i = 0; i < stages_.size(); ++i) { stages_[i].add(stage_ms[i]); }
    if (record.frame_ms > overrun_16_ms) { ++above_16_ms_[index_of_greatest(stage_ms)]; }
    const auto place =
        std::ranges::find_if(slowest_, [&](const FrameRecord& kept) { return kept.frame_ms < record.frame_ms; });
    if (place == slowest_.end() && slowest_.size() == max_kept) { return; }
    slowest_.insert(place, record);
    slowest_.resize(std::min(slowest_.size(), max_kept));
}

std::vector<SlowFrame> SlowFrameList::slowest() const {
    std::array<double, 5> medians_ms{};
    std::ranges::transform(
        stages_, medians_ms.begin(), [](const FrameTimeHistogram& stage) { return stage.statistics().p50_ms; });
    std::vector<SlowFrame> overruns;
    for (const FrameRecord& record : slowest_) {
        SlowFrame overrun;
        overrun.record = record;
        overrun.stage_ms = stages_of(record);
        overrun.longest_stage = index_of_greatest(overrun.stage_ms);
        std::array<double, 5> growth = overrun.stage_ms;
        for (std::size_t i = 0; i < growth.size(); ++i) { growth[i] -= medians_ms[i]; }
        overrun.slowed_stage = index_of_greatest(growth);
        overrun.slowdown_ms = growth[overrun.slowed_stage];
        overruns.push_back(overrun);
    }
    return overruns;
}

} // namespace octant::ui::report
