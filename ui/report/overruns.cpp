#include "ui/report/overruns.h"

#include <algorithm>

namespace octant::ui::report {

namespace {

std::array<double, 5> stages_of(const FrameRecord& record) {
    const double timed_ms = record.sim_ms + record.plan_ms + record.draw_ms + record.read_ms;
    return {
        record.sim_ms,
        record.plan_ms,
        record.draw_ms,
        record.read_ms,
        std::max(0.0, record.frame_ms - timed_ms)};
}

std::size_t index_of_greatest(const std::array<double, 5>& values) {
    return static_cast<std::size_t>(
        std::max_element(values.begin(), values.end()) - values.begin());
}

std::array<double, 5> stage_medians(std::span<const FrameRecord> records) {
    std::array<std::vector<double>, 5> columns;
    for (const FrameRecord& record : records) {
        const auto stage_ms = stages_of(record);
        for (std::size_t i = 0; i < columns.size() && !record.warm_up; ++i) {
            columns[i].push_back(stage_ms[i]);
        }
    }
    std::array<double, 5> medians{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::sort(columns[i].begin(), columns[i].end());
        medians[i] = nearest_rank(columns[i], 500);
    }
    return medians;
}

} // namespace

std::vector<Overrun> overruns_of(std::span<const FrameRecord> records, double limit_ms) {
    const auto medians = stage_medians(records);
    std::vector<Overrun> overruns;
    for (const FrameRecord& record : records) {
        if (record.warm_up || record.frame_ms <= limit_ms) {
            continue;
        }
        Overrun overrun;
        overrun.record = record;
        overrun.stage_ms = stages_of(record);
        overrun.longest_stage = index_of_greatest(overrun.stage_ms);
        std::array<double, 5> growth = overrun.stage_ms;
        for (std::size_t i = 0; i < growth.size(); ++i) {
            growth[i] -= medians[i];
        }
        overrun.grown_stage = index_of_greatest(growth);
        overrun.growth_ms = growth[overrun.grown_stage];
        overruns.push_back(overrun);
    }
    return overruns;
}

} // namespace octant::ui::report
