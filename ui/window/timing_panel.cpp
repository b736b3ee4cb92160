#include "ui/report/statistics.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/panels.h"
#include "ui/window/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <span>

namespace octant::ui::window {

namespace {

using report::FrameRecord;

constexpr ImU32 line_colour = IM_COL32(120, 200, 255, 255);
constexpr ImU32 level_colour = IM_COL32(200, 200, 120, 160);
constexpr ImU32 overrun_colour = IM_COL32(255, 90, 70, 255);
constexpr std::size_t recent_frames = 60;

std::span<const FrameRecord> recent_records(std::span<const FrameRecord> records) {
    return records.last(std::min(records.size(), recent_frames));
}

template <class Value>
double mean_of(std::span<const FrameRecord> records, Value value) {
    double sum = 0.0;
    int count = 0;
    for (const FrameRecord& record : records) {
        if (std::isfinite(value(record))) {
            sum += value(record);
            ++count;
        }
    }
    return count == 0 ? 0.0 : sum / count;
}

/// Returns how many pictures were begun in a second of wall time.
double frame_rate_hz(std::span<const FrameRecord> records) {
    const double passed_s = records.back().wall_s - records.front().wall_s;
    return passed_s > 0.0 ? static_cast<double>(records.size() - 1) / passed_s : 0.0;
}

void frame_time_plot(const ViewState& state) {
    constexpr double min_top_ms = 20.0;
    const auto records = state.history.records();
    const auto frame_ms = [](const FrameRecord& record) { return record.frame_ms; };
    const double top_ms = std::max(min_top_ms, state.history.statistics().p99_ms * 1.2);
    const FramePlot plot(ImGui::GetFontSize() * 6.0F, 0.0, top_ms);
    plot.level(1000.0 / 60.0, "16.7 ms", level_colour);
    plot.line(records, frame_ms, line_colour);
    plot.marks(
        records, [](const FrameRecord& record) { return record.overrun != 0; }, overrun_colour);
    if (const std::size_t at = plot.pointed_at(records); at != FramePlot::none) {
        const FrameRecord& record = records[at];
        show_tooltip(fmt::format("frame {}: {:.2f} ms = sim {:.2f} + plan {:.2f} + draw {:.2f} + read {:.2f}",
            record.frame, record.frame_ms, record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms));
    }
}

void show_stages(std::span<const FrameRecord> records) {
    const std::array parts{
        BarPart{"sim", mean_of(records, [](const FrameRecord& r) { return r.sim_ms; }), IM_COL32(240, 180, 80, 255)},
        BarPart{"plan", mean_of(records, [](const FrameRecord& r) { return r.plan_ms; }), IM_COL32(120, 210, 120, 255)},
        BarPart{"draw", mean_of(records, [](const FrameRecord& r) { return r.draw_ms; }), IM_COL32(110, 170, 255, 255)},
        BarPart{
            "show", mean_of(records, [](const FrameRecord& r) { return r.read_ms; }), IM_COL32(210, 130, 230, 255)}};
    ImGui::BeginGroup();
    stacked_bar(parts, 1000.0 / 60.0, "ms");
    ImGui::EndGroup();
    show_tooltip_on_hover("mean of the last 60 frames; the bar's width is 16.7 ms. sim: simulation steps, camera; "
                          "plan: what is drawn, in which order; draw: commands to the renderer; show: picture "
                          "finished and shown, with the wait for the display.");
}

void show_percentiles(const report::Statistics& statistics) {
    constexpr std::array<std::string_view, 5> shown{"p50_ms", "p90_ms", "p99_ms", "max_ms", "low_1pct_fps"};
    constexpr std::array<const char*, 5> names{"p50", "p90", "p99", "max", "1 % low"};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const auto statistic = std::ranges::find(report::all_statistics(), shown[i], &report::Statistic::key);
        const bool is_rate = shown[i].ends_with("fps");
        ImGui::BeginGroup();
        ImGui::TextDisabled("%s", names[i]);
        ImGui::Text(is_rate ? "%.1f/s" : "%.2f", statistic->value(statistics));
        ImGui::EndGroup();
        show_tooltip_on_hover(fmt::format("{}: {}", statistic->name, statistic->definition));
        if (i + 1 < shown.size()) { ImGui::SameLine(0.0F, ImGui::GetFontSize() * 1.2F); }
    }
}

void show_clock(std::span<const FrameRecord> records) {
    const auto last = recent_records(records);
    ImGui::Text("%.1f frames/s, stress %.2f", frame_rate_hz(last), records.back().stress);
    show_tooltip_on_hover("stress: frame time over the frame's share of time; filtered where the terrain adapts");
    const auto missed = std::ranges::count_if(records, [](const FrameRecord& record) { return record.missed != 0; });
    const auto overruns = std::ranges::count_if(records, [](const FrameRecord& record) { return record.overrun != 0; });
    ImGui::Text("latency %.1f ms, missed %ld, overruns %ld",
        mean_of(last, [](const FrameRecord& record) { return record.latency_ms; }), static_cast<long>(missed),
        static_cast<long>(overruns));
    show_tooltip_on_hover("latency: from the input that a picture shows to the picture finished, mean of the "
                          "last 60 frames. missed: pictures later than the next one was due; overruns: frames "
                          "above 16.67 ms; both of the last 300 frames.");
}

} // namespace

void timing_panel(ViewState& state) {
    const Panel panel("Frame times", state.columns, state.open.timing);
    if (!panel.is_seen()) { return; }
    if (state.history.empty()) {
        ImGui::TextUnformatted("no frames yet");
        return;
    }
    frame_time_plot(state);
    show_percentiles(state.history.statistics());
    show_stages(recent_records(state.history.records()));
    show_clock(state.history.records());
    ImGui::Checkbox("wait for the display (vsync)", &state.vsync);
}

} // namespace octant::ui::window
