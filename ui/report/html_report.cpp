#include "ui/report/html_report.h"

#include "sim/base/file_status.h"
#include "ui/report/contact_sheet.h"
#include "ui/report/flight_plots.h"
#include "ui/report/html_style.h"
#include "ui/report/slow_frames.h"
#include "ui/report/page_plot.h"
#include "ui/report/page_script.h"
#include "ui/report/comparison_page.h"
#include "ui/report/slow_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

std::string title_of(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

std::string heading(const std::string& text) {
    return "<h2>" + escaped(text) + "</h2>\n";
}

std::string card(const std::string& inside) {
    return "<div class=\"card\">\n" + inside + "</div>\n";
}

std::string tile(const char* name, const std::string& value, const std::string& unit) {
    return fmt::format(
        "<div><dt>{}</dt><dd>{} <small>{}</small></dd></div>\n",
        escaped(name),
        escaped(value),
        escaped(unit));
}

std::string badges(const LoadedRecording& recording) {
    const auto badge = [](const char* text, bool bad) {
        return fmt::format("<span class=\"badge{}\">{}</span>\n", bad ? " bad" : "", text);
    };
    std::string html =
        badge(recording.ended_early ? "ended early" : "ended", recording.ended_early);
    if (!recording.disagreement.empty()) {
        html += badge("rows and summary disagree", true);
    }
    if (!recording.run.stopped.empty()) {
        html += badge("stopped", true);
    }
    const bool noisy = !recording.run.noise.empty();
    html += badge(noisy ? "noisy" : "quiet machine", noisy);
    if (recording.statistics.frames == 0) {
        html += badge("no frames", true);
    }
    std::string notes;
    for (const std::string& reason : recording.run.noise) {
        notes += reason + " ";
    }
    if (recording.ended_early) {
        notes += "The flight was cut short: the figures are those of the frames recorded until "
                 "then, and there are no hashes.";
    }
    if (!recording.disagreement.empty()) {
        notes +=
            "Rows are missing or the summary is not theirs; the figures are those of the rows: " +
            recording.disagreement + ". ";
    }
    if (!recording.run.stopped.empty()) {
        notes += "Ended by " + recording.run.stopped + ". ";
    }
    return notes.empty() ? html : html + "<p class=\"note\">" + escaped(notes) + "</p>\n";
}

std::string overview(const LoadedRecording& recording) {
    const Statistics& figures_ms = recording.statistics;
    const double fps = figures_ms.mean_ms > 0.0 ? 1000.0 / figures_ms.mean_ms : 0.0;
    const MachineInfo& machine = recording.run.machine_info;
    std::string html = fmt::format(
        "<p class=\"lead\">{}<br>{}, {} cores</p>\n",
        escaped(title_of(recording) + ", " + machine.start_time_utc),
        escaped(machine.cpu),
        machine.cores);
    html += badges(recording);
    html += "<dl class=\"tiles\">\n";
    html += tile("Frames", fmt::format("{}", figures_ms.frames), "counted");
    html += tile("Mean", fmt::format("{:.2f}", figures_ms.mean_ms), "ms");
    html += tile("Rate", fmt::format("{:.1f}", fps), "frames/s");
    html += tile("P50", fmt::format("{:.2f}", figures_ms.p50_ms), "ms");
    html += tile("P99", fmt::format("{:.2f}", figures_ms.p99_ms), "ms");
    html += tile("Longest", fmt::format("{:.2f}", figures_ms.max_ms), "ms");
    html += tile("1 % low", fmt::format("{:.1f}", figures_ms.low_1pct_fps), "frames/s");
    html += tile("Above 16.67 ms", fmt::format("{}", figures_ms.overruns_16ms), "frames");
    if (const TargetRange targets = recording.flight.triangle_targets(); targets.varies()) {
        html += tile(
            "Triangle target",
            fmt::format("{:.0f}", targets.mean),
            fmt::format("mean of {} to {}", targets.min_triangles, targets.max_triangles));
    }
    return html + "</dl>\n";
}

std::string statistics_table(const LoadedRecording& recording) {
    std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th>Figure</th>"
                       "<th class=\"number\">Value</th><th>Definition</th></tr></thead>\n<tbody>\n";
    for (const Statistic& statistic : all_statistics()) {
        html += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{}</td><td "
            "class=\"definition\">{}</td></tr>\n",
            escaped(statistic.name),
            statistic_text(statistic, recording.statistics),
            escaped(statistic.definition));
    }
    return card(
        html +
        "</tbody></table></div>\n<p class=\"note\">frame_ms runs from the start of the frame's "
        "simulation step to its pixels complete and read; writing pictures and video is outside "
        "it. n is the number of frames counted. Stress (frames.csv) is the share of a frame's "
        "time, the simulated time from it to the next, that frame_ms is; where the ground adapts "
        "it is that share through a first-order filter.</p>\n");
}

std::string rows_table(const char* first, const NamedValues& rows) {
    std::string html = fmt::format(
        "<div class=\"scroll\"><table>\n<thead><tr><th>{}</th><th></th></tr></thead>\n<tbody>\n",
        first);
    for (const auto& [name, value] : rows) {
        html += fmt::format(
            "<tr><td>{}</td><td><code>{}</code></td></tr>\n", escaped(name), escaped(value));
    }
    return card(html + "</tbody></table></div>\n");
}

/// Those that are set; what is not set follows from the others.
NamedValues set_settings_rows(const NamedValues& settings) {
    NamedValues rows;
    std::ranges::copy_if(settings, std::back_inserter(rows), [](const auto& row) {
        return row.second != unset_value && !row.second.empty();
    });
    return rows;
}

NamedValues result_rows(const LoadedRecording& recording) {
    NamedValues rows{
        {"state hash", recording.run.state_hash},
        {"picture hash", recording.run.picture_hash},
        {"path offset over the ground (x, y, z), m", recording.run.path_offset}};
    rows.insert(rows.end(), recording.run.facts.begin(), recording.run.facts.end());
    const NamedValues clock = recording.flight.clock.rows();
    rows.insert(rows.end(), clock.begin(), clock.end());
    const NamedValues link = recording.flight.link.rows();
    rows.insert(rows.end(), link.begin(), link.end());
    return rows;
}

std::string plots_html(const LoadedRecording& recording) {
    const double ceiling_ms = plot_ceiling_ms(recording.statistics);
    std::string html = "<div class=\"plots\">\n";
    bool first = true;
    for (Plot& plot : flight_plots(recording.flight, ceiling_ms)) {
        if (plot.x_label.starts_with("simulated time")) {
            plot.marks = recording.run.legs;
        }
        html += card(page_plot(plot, first ? PlotWidth::FullWidth : PlotWidth::HalfWidth));
        first = false;
    }
    html += "</div>\n<p class=\"note\">Values under the pointer; drag to zoom, double click for "
            "all of it.";
    if (recording.statistics.max_ms > ceiling_ms) {
        html += " Where a frame took longer than the plot is high, its curve leaves it at the top.";
    }
    return html + "</p>\n";
}

std::string overrun_summary(const LoadedRecording& recording) {
    const auto& counts = recording.flight.slow.above_16_ms();
    std::string text = fmt::format(
        "{} of {} frames took longer than 16.67 ms.",
        recording.statistics.overruns_16ms,
        recording.statistics.frames);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) {
            text += fmt::format(" In {} of them {} took most.", counts[i], stage_names[i]);
        }
    }
    return text;
}

/// The slowest frames with their reasons.
HtmlTable slowest_table(std::span<const SlowFrame> slowest, bool has_counters) {
    HtmlTable table;
    table.header = {
        "frame",
        "at, s",
        "ms",
        "took most",
        "ms",
        "grew most over its median",
        "triangles",
        "change"};
    if (has_counters) {
        table.header.insert(table.header.end(), {"page faults", "switches", "stolen, ms"});
        table.note = "Switches: how often another program was given the processor. Stolen: by the "
                     "host for other machines, in the kernel's steps of 10 ms, of all processors.";
    }
    for (const SlowFrame& frame : slowest) {
        std::vector<std::string> row = {
            fmt::format("{}", frame.record.frame),
            fmt::format("{:.2f}", frame.record.sim_time_s),
            fmt::format("{:.2f}", frame.record.frame_ms),
            std::string(stage_names[frame.longest_stage]),
            fmt::format("{:.2f}", frame.stage_ms[frame.longest_stage]),
            fmt::format("{} by {:.2f} ms", stage_names[frame.slowed_stage], frame.slowdown_ms),
            fmt::format("{}", frame.record.terrain_triangles),
            fmt::format("{:+}", frame.record.triangle_change)};
        if (has_counters) {
            const FrameCounters& counters = frame.record.counters;
            row.insert(
                row.end(),
                {fmt::format("{}", counters.page_faults),
                 fmt::format("{}", counters.switches),
                 fmt::format("{:.0f}", counters.stolen_ms)});
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// The kept picture nearest to a frame.
const std::filesystem::path&
nearest_picture(std::span<const std::filesystem::path> pictures, int frame) {
    return *std::ranges::min_element(pictures, {}, [&](const std::filesystem::path& picture) {
        return std::abs(picture_frame(picture.filename().string()).value_or(0) - frame);
    });
}

/// The picture of a slow frame: its own, else the kept one nearest to it; empty where there is
/// none.
std::string slow_picture_html(const LoadedRecording& recording, const FrameRecord& frame) {
    constexpr int widest_px = 320;
    const std::string caption = fmt::format("frame {}, {:.2f} ms", frame.frame, frame.frame_ms);
    const auto own = recording.folder / slow_picture_name(frame.frame);
    if (is_file(own)) {
        return picture_html(own, widest_px, caption);
    }
    if (recording.pictures.empty()) {
        return {};
    }
    const std::filesystem::path& picture = nearest_picture(recording.pictures, frame.frame);
    const std::string name = picture.filename().string();
    return picture_html(picture, widest_px, caption + ": nearest picture, " + name);
}

std::string slowest_html(const LoadedRecording& recording) {
    const std::vector<SlowFrame>& slowest = recording.slowest;
    std::string sheet;
    for (std::size_t i = 0; i < std::min(SlowPictures::max_shown, slowest.size()); ++i) {
        sheet += slow_picture_html(recording, slowest[i].record);
    }
    return card(
        "<p>" + overrun_summary(recording) + "</p>\n" +
        html_of(slowest_table(slowest, recording.has_counters)) +
        (sheet.empty() ? "" : "<div class=\"sheet\">\n" + sheet + "</div>\n"));
}

std::string one_html(const LoadedRecording& recording) {
    std::string html = card(overview(recording));
    html += heading("Plots") + plots_html(recording);
    const std::string sheet = contact_sheet_html(recording.pictures);
    html += sheet.empty() ? sheet : heading("Pictures") + card(sheet);
    html += heading("Frame times") + statistics_table(recording);
    html += heading("The slowest frames and why") + slowest_html(recording);
    html += heading("Results") + rows_table("Result", result_rows(recording));
    html += heading("Settings") + rows_table("Setting", set_settings_rows(recording.run.settings));
    return html + heading("Program and machine") + rows_table("Entry", recording.run.machine);
}

std::string page_title(Recordings recordings) {
    if (recordings.size() == 1) {
        return title_of(recordings.front());
    }
    return fmt::format("{} flights compared", recordings.size());
}

} // namespace

std::string html_report(
    Recordings recordings,
    std::span<const HtmlTable> first_tables,
    const std::filesystem::path& page_folder) {
    std::string html = page_head(page_title(recordings), recordings.size() > 1 ? "several" : "one");
    html += "<header><p class=\"lead\">Octant flight report</p><h1>" +
            escaped(page_title(recordings)) + "</h1></header>\n";
    for (const HtmlTable& table : first_tables) {
        html += card(html_of(table));
    }
    if (recordings.size() == 1) {
        html += one_html(recordings.front());
    } else if (!recordings.empty()) {
        html += several_recordings_html(recordings, page_folder);
    }
    return html + "</main>\n<div id=\"tip\" hidden></div>\n<script>" + std::string(page_script()) +
           "</script>\n</body>\n</html>\n";
}

} // namespace octant::ui::report
