#include "ui/report/clock_rows.h"

#include "ui/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace octant::ui::report {

Rows clock_rows(std::span<const FrameRecord> records) {
    std::vector<double> latency_ms;
    int missed = 0;
    for (const FrameRecord& record : records) {
        if (!record.warm_up && std::isfinite(record.latency_ms)) {
            latency_ms.push_back(record.latency_ms);
            missed += record.missed;
        }
    }
    if (latency_ms.empty()) {
        return {};
    }
    std::sort(latency_ms.begin(), latency_ms.end());
    return {
        {"latency, median and 99th percentile",
         fmt::format(
             "{:.2f} ms, {:.2f} ms", nearest_rank(latency_ms, 500), nearest_rank(latency_ms, 990))},
        {"deadlines missed", fmt::format("{} of {}", missed, latency_ms.size())}};
}

Rows link_rows(std::span<const FrameRecord> records) {
    long packets = 0;
    long lost = 0;
    long late = 0;
    long wrong = 0;
    long stale = 0;
    double jitter_ms = 0.0;
    for (const FrameRecord& record : records) {
        packets += record.packets;
        lost += record.packets_lost;
        late += record.packets_late;
        wrong += record.packets_wrong;
        stale += record.stale;
        jitter_ms += record.jitter_ms;
    }
    if (packets + wrong == 0) {
        return {};
    }
    return {
        {"packets taken, lost, late, wrong",
         fmt::format("{}, {}, {}, {}", packets, lost, late, wrong)},
        {"frames with an aircraft that stood for want of packets",
         fmt::format("{} of {}", stale, records.size())},
        {"jitter of packets, mean",
         fmt::format("{:.1f} ms", jitter_ms / static_cast<double>(records.size()))}};
}

} // namespace octant::ui::report
