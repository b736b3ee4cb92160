#include "ui/report/several_page.h"

#include "ui/report/comparison.h"
#include "ui/report/contact_sheet.h"
#include "ui/report/flight_plots.h"
#include "ui/report/html_text.h"
#include "ui/report/page_plot.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;
using Recordings = std::span<const LoadedRecording>;
using Indices = std::vector<std::size_t>;

constexpr std::array colours{
    "#3b82f6",
    "#f59e0b",
    "#10b981",
    "#ef4444",
    "#8b5cf6",
    "#14b8a6",
    "#ec4899",
    "#84cc16",
    "#6366f1",
    "#a16207"};

std::string value_of(const Rows& rows, std::string_view name) {
    const auto found =
        std::ranges::find_if(rows, [&](const auto& row) { return row.first == name; });
    return found == rows.end() ? std::string() : found->second;
}

/// Names of settings in which some of these recordings differ, in their order.
std::vector<std::string> differing_settings(Recordings recordings, const Indices& among) {
    std::vector<std::string> names;
    const Rows& first = recordings[among.front()].run.settings;
    for (const auto& [name, value] : first) {
        const bool differs = std::ranges::any_of(among, [&](std::size_t i) {
            return value_of(recordings[i].run.settings, name) != value;
        });
        if (differs) {
            names.push_back(name);
        }
    }
    return names;
}

Indices all_of(Recordings recordings) {
    Indices all(recordings.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = i;
    }
    return all;
}

/// A file's name without its folder, as table cells have room for.
std::string short_value(const std::string& value) {
    const bool is_path = value.find('/') != std::string::npos;
    return is_path ? fs::path(value).filename().string() : value;
}

std::string
link_of(Recordings recordings, const LoadedRecording& recording, const fs::path& page_folder) {
    const std::string label = escaped(label_of(recordings, recording));
    std::error_code ignored;
    const fs::path page = recording.folder / "report.html";
    if (page_folder.empty() || !fs::is_regular_file(page, ignored)) {
        return label;
    }
    const fs::path way = fs::absolute(page).lexically_normal().lexically_relative(
        fs::absolute(page_folder).lexically_normal());
    return fmt::format("<a href=\"{}\">{}</a>", link_text(way.generic_string()), label);
}

std::string condition_of(const LoadedRecording& recording) {
    std::string text;
    const auto add = [&](bool holds, const char* word) {
        text += holds ? (text.empty() ? "" : ", ") + std::string(word) : "";
    };
    add(recording.ended_early, "ended early");
    add(!recording.run.stopped.empty(), "stopped");
    add(!recording.disagreement.empty(), "rows and summary disagree");
    add(!recording.run.noise.empty(), "noisy");
    add(recording.statistics.frames == 0, "no frames");
    return text;
}

std::string number_cell(double value, int decimals) {
    return fmt::format("<td class=\"number\">{:.{}f}</td>", value, decimals);
}

/// Keys of figures and what they are called where there is little room.
constexpr std::array<std::pair<const char*, const char*>, 6> shown_figures{
    {{"frames", "frames"},
     {"p50_ms", "P50, ms"},
     {"p99_ms", "P99, ms"},
     {"max_ms", "longest, ms"},
     {"low_1pct_fps", "1 % low, 1/s"},
     {"overruns_16ms", "above 16.67 ms"}}};

const Figure& figure_named(std::string_view key) {
    return *std::ranges::find(figures(), key, &Figure::key);
}

std::string runs_table(Recordings recordings, const fs::path& page_folder) {
    constexpr std::size_t most_settings = 6;
    std::vector<std::string> names = differing_settings(recordings, all_of(recordings));
    const std::size_t left_out = names.size() - std::min(names.size(), most_settings);
    names.resize(names.size() - left_out);
    std::string html = "<div class=\"scroll\"><table class=\"sortable runs\">\n<thead><tr>"
                       "<th>flight</th>";
    for (const std::string& name : names) {
        html += "<th>" + escaped(name) + "</th>";
    }
    for (const auto& [key, name] : shown_figures) {
        html += fmt::format("<th class=\"number\">{}</th>", name);
    }
    html += "<th>states</th><th>pictures</th><th>condition</th></tr></thead>\n<tbody>\n";
    for (const LoadedRecording& recording : recordings) {
        html += "<tr><td>" + link_of(recordings, recording, page_folder) + "</td>";
        for (const std::string& name : names) {
            html += "<td>" + escaped(short_value(value_of(recording.run.settings, name))) + "</td>";
        }
        for (const auto& [key, name] : shown_figures) {
            const Figure& figure = figure_named(key);
            html += number_cell(figure.value(recording.statistics), std::min(figure.decimals, 2));
        }
        const std::string condition = condition_of(recording);
        html += fmt::format(
            "<td><code>{}</code></td><td><code>{}</code></td><td class=\"{}\">{}</td></tr>\n",
            escaped(recording.run.state_hash.substr(0, 8)),
            escaped(recording.run.picture_hash.substr(0, 8)),
            condition.empty() ? "" : "worse",
            condition.empty() ? "good" : condition);
    }
    html += "</tbody></table></div>\n<p class=\"note\">A click on a column's head sorts by it. "
            "States and pictures are the first eight digits of their hashes.";
    if (left_out > 0) {
        html +=
            fmt::format(" {} more settings differ; they are in the flights' own pages.", left_out);
    }
    return "<div class=\"card\">\n" + html + "</p></div>\n";
}

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

/// Median of a variant's runs, and how it compares with the first variant's.
std::string
compared_cells(const std::vector<double>& before, const std::vector<double>& now, bool is_first) {
    if (now.empty() || before.empty()) {
        return "<td class=\"number\">none</td><td></td>";
    }
    std::string html = number_cell(median_of(now), 3);
    if (is_first) {
        return html + "<td class=\"soft\">compared with this one</td>";
    }
    const Change change = change_between(before, now);
    const char* const mark = !change.is_sure() ? "" : (change.share < 0.0 ? "better" : "worse");
    std::string text = fmt::format("{:+.1f} %", 100.0 * change.share);
    if (change.has_interval) {
        text += fmt::format(" ({:+.1f} to {:+.1f} %)", 100.0 * change.least, 100.0 * change.most);
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
    for (const Indices& variant : variants) {
        html += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{}</td>",
            escaped(variant_label(recordings[variant.front()], names)),
            variant.size());
        for (const char* key : {"p50_ms", "p99_ms"}) {
            const auto value = figure_named(key).value;
            html += compared_cells(
                values_of(recordings, variants.front(), value),
                values_of(recordings, variant, value),
                &variant == &variants.front());
        }
        html += "</tr>\n";
    }
    html += "</tbody></table></div>\n<p class=\"note\">Medians over the runs of a variant. In "
            "brackets the 95 % interval of the change by the bootstrap over runs, where both "
            "variants have three runs or more; green or red only where it leaves zero out.</p>\n";
    return html;
}

std::string title_of_group(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

/// The frame times of a flight's runs over its simulated time, in one plot.
std::string
overlaid(Recordings recordings, const std::vector<Indices>& variants, double ceiling_ms) {
    constexpr std::size_t most_curves = 12;
    Plot plot{"Frame time of each run", "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
    for (std::size_t v = 0; v < variants.size(); ++v) {
        for (const std::size_t i : variants[v]) {
            if (plot.series.size() < most_curves) {
                PlotSeries curve = frame_time_curve(recordings[i].records, 400);
                curve.name = label_of(recordings, recordings[i]);
                curve.colour = colours[v % colours.size()];
                plot.series.push_back(std::move(curve));
            }
        }
    }
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    plot.marks = recordings[variants.front().front()].run.legs;
    return page_plot(plot, PlotPlace::Wide);
}

double ceiling_of(Recordings recordings, const Indices& runs) {
    double ceiling_ms = 0.0;
    for (const std::size_t i : runs) {
        ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recordings[i].records));
    }
    return ceiling_ms;
}

std::string comparisons(Recordings recordings) {
    constexpr std::size_t most_groups = 24;
    std::string html;
    std::size_t shown = 0;
    std::size_t compared = 0;
    for (const Indices& group : comparable_groups(recordings)) {
        if (group.size() < 2) {
            continue;
        }
        ++compared;
        if (shown == most_groups) {
            continue;
        }
        ++shown;
        const std::vector<Indices> variants = variants_of(recordings, group);
        html += "<div class=\"card\">\n<h3>" + escaped(title_of_group(recordings[group.front()])) +
                "</h3>\n";
        if (variants.size() > 1) {
            html += comparison_table(recordings, variants);
        }
        html += overlaid(recordings, variants, ceiling_of(recordings, group)) + "</div>\n";
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

std::string small_multiples(Recordings recordings) {
    const double ceiling_ms = ceiling_of(recordings, all_of(recordings));
    const std::size_t pieces = recordings.size() > 40 ? 60 : 150;
    double begin_s = 0.0;
    double end_s = 0.0;
    for (const LoadedRecording& recording : recordings) {
        if (!recording.records.empty()) {
            begin_s = std::min(begin_s, recording.records.front().sim_time_s);
            end_s = std::max(end_s, recording.records.back().sim_time_s);
        }
    }
    std::string html = "<div class=\"small-plots\">\n";
    for (const LoadedRecording& recording : recordings) {
        Plot plot{
            label_of(recordings, recording), "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
        plot.x_min = begin_s;
        plot.x_max = end_s;
        PlotSeries curve = frame_time_curve(recording.records, pieces);
        curve.colour = colours.front();
        plot.series.push_back(std::move(curve));
        plot.levels = {{"16.67 ms", overrun_16_ms}};
        html += page_plot(plot, PlotPlace::Small);
    }
    return "<h2>Frame time of each flight, ms over seconds, on common axes</h2>\n<div "
           "class=\"card\">" +
           html + "</div></div>\n";
}

std::string pictures(Recordings recordings) {
    constexpr std::size_t most_flights = 24;
    constexpr int widest_px = 320;
    std::vector<const LoadedRecording*> flights;
    for (const LoadedRecording& recording : recordings) {
        if (!recording.pictures.empty()) {
            flights.push_back(&recording);
        }
    }
    if (flights.empty()) {
        return {};
    }
    std::string html = "<div class=\"sheet\">\n";
    for (const std::size_t index : evenly_spaced(flights.size(), most_flights)) {
        const LoadedRecording& flight = *flights[index];
        const fs::path& middle = flight.pictures[flight.pictures.size() / 2];
        html += picture_html(
            middle, widest_px, label_of(recordings, flight) + ", " + middle.filename().string());
    }
    html += "</div>\n";
    if (flights.size() > most_flights) {
        html +=
            fmt::format("<p class=\"note\">{} of {} flights.</p>\n", most_flights, flights.size());
    }
    return "<h2>A picture from the middle of each flight</h2>\n<div class=\"card\">" + html +
           "</div>\n";
}

/// Settings, program and machine where all recordings have the same.
std::string common_rows(Recordings recordings) {
    const auto table = [&](const char* title, auto rows_of) {
        HtmlTable common{title, {"name", "value"}, {}, ""};
        for (const auto& [name, value] : rows_of(recordings.front())) {
            const bool same = std::ranges::all_of(recordings, [&](const LoadedRecording& each) {
                return value_of(rows_of(each), name) == value;
            });
            if (same) {
                common.rows.push_back({name, value});
            }
        }
        return "<div class=\"card\">" + html_of(common) + "</div>\n";
    };
    return "<h2>What all have in common</h2>\n" +
           table("Settings", [](const LoadedRecording& each) { return each.run.settings; }) +
           table(
               "Program and machine", [](const LoadedRecording& each) { return each.run.machine; });
}

} // namespace

std::string label_of(Recordings recordings, const LoadedRecording& recording) {
    const auto same = [&](const auto& each) { return each.name == recording.name; };
    const bool unique = std::ranges::count_if(recordings, same) == 1;
    return unique ? recording.name : recording.folder.string();
}

std::string several_html(Recordings recordings, const fs::path& page_folder) {
    return runs_table(recordings, page_folder) + comparisons(recordings) +
           small_multiples(recordings) + pictures(recordings) + common_rows(recordings);
}

} // namespace octant::ui::report
