#include "ui/report/html_report.h"

#include "ui/report/clock_rows.h"
#include "ui/report/contact_sheet.h"
#include "ui/report/flight_plots.h"
#include "ui/report/html_style.h"
#include "ui/report/overruns.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace octant::ui::report {

namespace {

using Recordings = std::span<const LoadedRecording>;

std::string title_of(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

std::string value_in(const Rows& rows, const std::string& name) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.first == name; });
    return found == rows.end() ? std::string() : found->second;
}

/// What tells a recording from the others: its folder's name, or its whole path where names repeat.
std::string label_of(Recordings recordings, const LoadedRecording& recording) {
    const auto same = [&](const auto& each) { return each.name == recording.name; };
    const bool unique = std::count_if(recordings.begin(), recordings.end(), same) == 1;
    return unique ? recording.name : recording.folder.string();
}

std::string heading(const std::string& text) {
    return "<h2>" + escaped(text) + "</h2>\n";
}

std::string card(const std::string& inside) {
    return "<div class=\"card\">\n" + inside + "</div>\n";
}

/// One card a recording, side by side. `inside` makes a card's content.
template <class Inside>
std::string side_by_side(Recordings recordings, Inside inside) {
    std::string html = "<div class=\"flights\">\n";
    for (const LoadedRecording& recording : recordings) {
        const std::string label = escaped(label_of(recordings, recording));
        const std::string name = recordings.size() > 1 ? "<h3>" + label + "</h3>\n" : "";
        html += card(name + inside(recording));
    }
    return html + "</div>\n";
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
        notes += "The summary is not that of the rows, whose figures these are: " +
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
    if (const TargetRange targets = triangle_targets_of(recording.records); targets.moved()) {
        html += tile(
            "Triangle target",
            fmt::format("{:.0f}", targets.mean),
            fmt::format("mean of {} to {}", targets.least, targets.greatest));
    }
    return html + "</dl>\n";
}

std::string table_head(Recordings recordings, const char* first, const char* last) {
    std::string html = fmt::format("<div class=\"scroll\"><table>\n<thead><tr><th>{}</th>", first);
    for (const LoadedRecording& recording : recordings) {
        const std::string name = recordings.size() > 1 ? label_of(recordings, recording) : "";
        html +=
            fmt::format("<th class=\"{}\">{}</th>", *last != '\0' ? "number" : "", escaped(name));
    }
    return html + (*last != '\0' ? fmt::format("<th>{}</th>", last) : "") +
           "</tr></thead>\n<tbody>\n";
}

/// The figures of all recordings; with several, each after the first says how it compares with it.
std::string figures_table(Recordings recordings) {
    std::string html = table_head(recordings, "Figure", "Definition");
    for (const Figure& figure : figures()) {
        html += fmt::format("<tr><td>{}</td>", escaped(figure.name));
        const double first = figure.value(recordings.front().statistics);
        for (const LoadedRecording& recording : recordings) {
            const double value = figure.value(recording.statistics);
            html += fmt::format("<td class=\"number\">{:.{}f}", value, figure.decimals);
            if (&recording != &recordings.front() && first > 0.0 && figure.decimals > 0) {
                const bool better = figure.less_is_better == (value < first);
                html += fmt::format(
                    " <small class=\"{}\">({:+.1f} %)</small>",
                    value == first ? "" : (better ? "better" : "worse"),
                    100.0 * (value / first - 1.0));
            }
            html += "</td>";
        }
        html += fmt::format("<td class=\"definition\">{}</td></tr>\n", escaped(figure.definition));
    }
    html += "</tbody></table></div>\n<p class=\"note\">frame_ms runs from the start of the frame's "
            "simulation step to its pixels complete and read; writing pictures and video is "
            "outside it. n is the number of frames counted. Stress (frames.csv) is the share of a "
            "frame's time, the simulated time from it to the next, that frame_ms is; where the "
            "ground adapts it is that share through a first-order filter.";
    html += recordings.size() > 1 ? " In brackets: against the first recording.</p>\n" : "</p>\n";
    return card(html);
}

/// Rows of names and values of all recordings, in the order in which the names first come.
/// `rows_of` gives a recording's rows. Rows in which recordings differ are marked.
template <class RowsOf>
std::string rows_table(Recordings recordings, const char* first, RowsOf rows_of) {
    std::vector<std::string> names;
    for (const LoadedRecording& recording : recordings) {
        for (const auto& [name, value] : rows_of(recording)) {
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    std::string html = table_head(recordings, first, "");
    for (const std::string& name : names) {
        const std::string expected = value_in(rows_of(recordings.front()), name);
        std::string cells;
        bool changed = false;
        for (const LoadedRecording& recording : recordings) {
            const std::string value = value_in(rows_of(recording), name);
            changed = changed || value != expected;
            cells += "<td><code>" + escaped(value) + "</code></td>";
        }
        html += fmt::format(
            "<tr{}><td>{}</td>{}</tr>\n",
            changed ? " class=\"changed\"" : "",
            escaped(name),
            cells);
    }
    return card(html + "</tbody></table></div>\n");
}

Rows result_rows(const LoadedRecording& recording) {
    Rows rows{
        {"state hash", recording.run.state_hash},
        {"picture hash", recording.run.picture_hash},
        {"path offset over the ground (x, y, z), m", recording.run.path_offset}};
    rows.insert(rows.end(), recording.run.facts.begin(), recording.run.facts.end());
    const Rows clock = clock_rows(recording.records);
    rows.insert(rows.end(), clock.begin(), clock.end());
    const Rows link = link_rows(recording.records);
    rows.insert(rows.end(), link.begin(), link.end());
    return rows;
}

std::string plot_html(const Plot& plot, bool wide) {
    const auto svg = plot_svg(plot);
    if (!svg) {
        return {};
    }
    return fmt::format(
        "<div class=\"plot{}\"><h3>{}</h3>{}</div>\n",
        wide ? " wide" : "",
        escaped(plot.title),
        inline_svg(*svg));
}

std::string plots_html(const LoadedRecording& recording, double ceiling_ms, bool alone) {
    std::string html = "<div class=\"plots\">\n";
    bool first = true;
    for (Plot& plot : flight_plots(recording.records, ceiling_ms)) {
        plot.width_px = first && alone ? 1120 : 640;
        plot.height_px = first && alone ? 300 : 270;
        html += plot_html(plot, first);
        first = false;
    }
    html += "</div>\n";
    if (recording.statistics.max_ms > ceiling_ms) {
        html += "<p class=\"note\">Where a frame took longer than the plot is high, its curve "
                "leaves it at the top.</p>\n";
    }
    return html;
}

std::string plots_section(Recordings recordings) {
    if (!gnuplot_installed()) {
        return heading("Plots") +
               "<p class=\"note\">There are no plots: gnuplot is not installed.</p>\n";
    }
    double ceiling_ms = 0.0;
    for (const LoadedRecording& recording : recordings) {
        ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recording.records));
    }
    return heading("Plots") + side_by_side(recordings, [&](const LoadedRecording& recording) {
               return plots_html(recording, ceiling_ms, recordings.size() == 1);
           });
}

std::string overrun_summary(std::span<const Overrun> overruns, int frames) {
    std::array<int, stage_names.size()> counts{};
    for (const Overrun& overrun : overruns) {
        ++counts[overrun.longest_stage];
    }
    std::string text =
        fmt::format("{} of {} frames took longer than 16.67 ms.", overruns.size(), frames);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) {
            text += fmt::format(" In {} of them {} took most.", counts[i], stage_names[i]);
        }
    }
    return text;
}

std::string overruns_html(const LoadedRecording& recording) {
    constexpr std::size_t most_rows = 20;
    std::vector<Overrun> overruns = overruns_of(recording.records);
    std::string html = "<p>" + overrun_summary(overruns, recording.statistics.frames) + "</p>\n";
    if (overruns.empty()) {
        return html;
    }
    std::stable_sort(overruns.begin(), overruns.end(), [](const Overrun& a, const Overrun& b) {
        return a.record.frame_ms > b.record.frame_ms;
    });
    HtmlTable table;
    table.header = {"frame", "ms", "took most", "ms", "grew most over its median", "triangles"};
    for (std::size_t i = 0; i < std::min(most_rows, overruns.size()); ++i) {
        const Overrun& overrun = overruns[i];
        table.rows.push_back(
            {fmt::format("{}", overrun.record.frame),
             fmt::format("{:.2f}", overrun.record.frame_ms),
             std::string(stage_names[overrun.longest_stage]),
             fmt::format("{:.2f}", overrun.stage_ms[overrun.longest_stage]),
             fmt::format("{} by {:.2f} ms", stage_names[overrun.grown_stage], overrun.growth_ms),
             fmt::format("{}", overrun.record.terrain_triangles)});
    }
    if (overruns.size() > most_rows) {
        table.note = fmt::format("The {} longest; all of them are in frames.csv.", most_rows);
    }
    return html + html_of(table);
}

std::string pictures_section(Recordings recordings) {
    const bool any = std::any_of(recordings.begin(), recordings.end(), [](const auto& each) {
        return !each.pictures.empty();
    });
    if (!any) {
        return {};
    }
    return heading("Pictures") + side_by_side(recordings, [](const LoadedRecording& recording) {
               const std::string sheet = contact_sheet_html(recording.pictures);
               return sheet.empty() ? std::string("<p class=\"note\">No pictures.</p>\n") : sheet;
           });
}

std::string page_title(Recordings recordings) {
    if (recordings.size() == 1) {
        return title_of(recordings.front());
    }
    return fmt::format("{} flights compared", recordings.size());
}

std::string head(Recordings recordings) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{} - Octant</title>\n<style>{}</style>\n</head>\n<body>\n"
        "<main class=\"{}\" style=\"--flights: {}\">\n",
        escaped(page_title(recordings)),
        page_style(),
        recordings.size() > 1 ? "several" : "one",
        std::max<std::size_t>(recordings.size(), 1));
}

} // namespace

std::string html_report(Recordings recordings, std::span<const HtmlTable> further) {
    std::string html = head(recordings);
    html += "<header><p class=\"lead\">Octant flight report</p><h1>" +
            escaped(page_title(recordings)) + "</h1></header>\n";
    if (!recordings.empty()) {
        html += side_by_side(recordings, overview);
        html += plots_section(recordings);
        html += pictures_section(recordings);
        html += heading("Frame times") + figures_table(recordings);
        html += heading("What was overrun and why") + side_by_side(recordings, overruns_html);
        html += heading("Results") + rows_table(recordings, "Result", result_rows);
        html += heading("Settings") + rows_table(recordings, "Setting", [](const auto& recording) {
                    return recording.run.settings;
                });
        html += heading("Program and machine") +
                rows_table(recordings, "Entry", [](const auto& recording) {
                    return recording.run.machine;
                });
    }
    for (const HtmlTable& table : further) {
        html += card(html_of(table));
    }
    return html + "</main>\n</body>\n</html>\n";
}

} // namespace octant::ui::report
