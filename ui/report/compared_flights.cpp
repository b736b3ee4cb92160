#include "ui/report/compared_flights.h"

#include "ui/report/comparison.h"
#include "ui/report/flight_plots.h"
#include "ui/report/comparison_text.h"
#include "ui/report/html_text.h"
#include "ui/report/page_plot.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

using Indices = std::vector<std::size_t>;

/// "order-method tree, samples 4", by the settings in which variants differ.
std::string variant_label(const LoadedRecording& recording, const std::vector<std::string>& names) {
    std::string label;
    for (const std::string& name : names) {
        label += fmt::format(
            "{}{} {}",
            label.empty() ? "" : ", ",
            name,
            short_value(value_of(recording.run.settings, name)));
    }
    return label.empty() ? "all the same" : label;
}

std::vector<double>
values_of(Recordings recordings, const Indices& runs, double (*value)(const Statistics&)) {
    std::vector<double> values;
    for (const std::size_t i : runs) {
        if (recordings[i].statistics.frames > 0) {
            values.push_back(value(recordings[i].statistics));
        }
    }
    return values;
}

/// Whether other programs had a part in the runs' frame times, or other flights on shared cores.
bool is_noisy(Recordings recordings, const Indices& runs) {
    return std::ranges::any_of(
        runs, [&](std::size_t i) { return !recordings[i].run.noise.empty(); });
}

/// How a variant is set against the first one: where both were quiet, a sure change is better or
/// worse; where one was noisy, it may be the machine's.
enum class Reference { Itself, Quiet, Noisy };

/// Median of a variant's runs, and how it compares with the first variant's.
std::string
compared_cells(const std::vector<double>& before, const std::vector<double>& now, Reference reference) {
    if (now.empty() || before.empty()) {
        return "<td class=\"number\">none</td><td></td>";
    }
    std::string html = number_cell(median_of(now), 3);
    if (reference == Reference::Itself) {
        return html + "<td class=\"soft\">compared with this one</td>";
    }
    const RelativeChange change = relative_change(before, now);
    const bool is_decided = change.is_significant() && reference == Reference::Quiet;
    const char* const mark = !is_decided ? "" : (change.share < 0.0 ? "better" : "worse");
    std::string text = fmt::format("{:+.1f} %", 100.0 * change.share);
    if (change.has_interval) {
        text += fmt::format(" ({:+.1f} to {:+.1f} %)", 100.0 * change.low, 100.0 * change.high);
    }
    return html + fmt::format("<td class=\"{}\">{}</td>", mark, text);
}

std::string comparison_table(Recordings recordings, const std::vector<Indices>& variants) {
    Indices all;
    for (const Indices& variant : variants) {
        all.insert(all.end(), variant.begin(), variant.end());
    }
    const std::vector<std::string> names = differing_settings(recordings, all);
    std::string html =
        "<div class=\"scroll\"><table>\n<thead><tr><th>variant</th><th class=\"number\">runs</th>"
        "<th class=\"number\">P50, ms</th><th>change</th><th class=\"number\">P99, ms</th>"
        "<th>change</th></tr></thead>\n<tbody>\n";
    bool noisy = false;
    for (const Indices& variant : variants) {
        const bool is_first = &variant == &variants.front();
        const bool is_loud =
            is_noisy(recordings, variants.front()) || is_noisy(recordings, variant);
        const Reference reference =
            is_first ? Reference::Itself : (is_loud ? Reference::Noisy : Reference::Quiet);
        noisy = noisy || reference == Reference::Noisy;
        html += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{}</td>",
            escaped(variant_label(recordings[variant.front()], names)),
            variant.size());
        for (const char* key : {"p50_ms", "p99_ms"}) {
            const auto value = statistic_named(key).value;
            html += compared_cells(
                values_of(recordings, variants.front(), value),
                values_of(recordings, variant, value),
                reference);
        }
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n<p class=\"note\">Medians over the runs of a variant. In "
            "brackets the 95 % interval of the change by the bootstrap over runs, where both "
            "variants have three runs or more; green or red only where it leaves zero out.";
    if (noisy) {
        html += " Beside noisy runs nothing is called better or worse: other programs, or flights "
                "on the same cores, had a part in their times.";
    }
    return html + "</p>\n";
}

std::string title_of_group(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

/// The frame times of a flight's runs over its simulated time, in one plot: as many of each variant
/// as there is room for.
std::string
overlaid_plot(Recordings recordings, const std::vector<Indices>& variants, double ceiling_ms) {
    constexpr std::size_t max_curves = 12;
    Plot plot{"Frame time of each run", "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
    const std::size_t max_of_each = std::max<std::size_t>(1, max_curves / variants.size());
    std::size_t runs = 0;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        runs += variants[v].size();
        const std::size_t max_here = std::min(max_of_each, max_curves - plot.series.size());
        for (std::size_t k = 0; k < std::min(variants[v].size(), max_here); ++k) {
            const LoadedRecording& recording = recordings[variants[v][k]];
            PlotSeries curve = recording.flight.frame_ms.series(400);
            curve.name = label_of(recordings, recording);
            curve.colour = run_colours[v % run_colours.size()];
            plot.series.push_back(std::move(curve));
        }
    }
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    plot.marks = recordings[variants.front().front()].run.legs;
    const std::string html = page_plot(plot, PlotWidth::FullWidth);
    if (plot.series.size() == runs) {
        return html;
    }
    return html + fmt::format("<p class=\"note\">{} of {} runs.</p>\n", plot.series.size(), runs);
}

} // namespace

std::string compared_flights_html(Recordings recordings) {
    constexpr std::size_t max_groups = 24;
    std::string html;
    std::size_t shown = 0;
    std::size_t compared = 0;
    for (const Indices& group : comparable_groups(recordings)) {
        if (group.size() < 2) {
            continue;
        }
        ++compared;
        if (shown == max_groups) {
            continue;
        }
        ++shown;
        const std::vector<Indices> variants = variants_of(recordings, group);
        html += "<div class=\"card\">\n<h3>" + escaped(title_of_group(recordings[group.front()])) +
                "</h3>\n";
        if (variants.size() > 1) {
            html += comparison_table(recordings, variants);
        }
        html += overlaid_plot(recordings, variants, shared_ceiling_ms(recordings, group)) + "</div>\n";
    }
    if (html.empty()) {
        return "<p class=\"note\">No two of these recordings are of the same flight on the same "
               "kind of machine, so none are compared.</p>\n";
    }
    if (shown < compared) {
        html += fmt::format(
            "<p class=\"note\">The first {} of {} flights that were flown more than once.</p>\n",
            shown,
            compared);
    }
    return "<h2>The same flight, compared</h2>\n" + html;
}

} // namespace octant::ui::report
