#include "ui/report/comparison_page.h"

#include "ui/report/compared_flights.h"
#include "ui/report/contact_sheet.h"
#include "ui/report/flight_plots.h"
#include "ui/report/comparison_text.h"
#include "ui/report/html_text.h"
#include "ui/report/page_plot.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <string_view>
#include <vector>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> all_of(Recordings recordings) {
    std::vector<std::size_t> all(recordings.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = i;
    }
    return all;
}

std::string
link_of(Recordings recordings, const LoadedRecording& recording, const fs::path& page_folder) {
    const std::string label = escaped(label_of(recordings, recording));
    std::error_code ignored;
    const fs::path page = recording.folder / "report.html";
    const bool is_unpacked = recording.display_name != recording.folder.string(); // and goes with us
    if (page_folder.empty() || is_unpacked || !fs::is_regular_file(page, ignored)) {
        return label;
    }
    const fs::path way = fs::absolute(page).lexically_normal().lexically_relative(
        fs::absolute(page_folder).lexically_normal());
    return fmt::format("<a href=\"{}\">{}</a>", url_text(way.generic_string()), label);
}

std::string noise_text_of(const LoadedRecording& recording) {
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

/// Keys of figures and what they are called where there is little room.
constexpr std::array<std::pair<const char*, const char*>, 6> shown_statistics{
    {{"frames", "frames"},
     {"p50_ms", "P50, ms"},
     {"p99_ms", "P99, ms"},
     {"max_ms", "longest, ms"},
     {"low_1pct_fps", "1 % low, 1/s"},
     {"overruns_16ms", "above 16.67 ms"}}};

/// How sweeps flew them, where sweeps did: " 24 flown by a sweep one at a time."
std::string batch_context_text(Recordings recordings) {
    std::map<std::string, int> counts;
    for (const LoadedRecording& recording : recordings) {
        const std::string batch_context = value_of(recording.run.facts, batch_context_fact);
        counts[batch_context] += batch_context.empty() ? 0 : 1;
    }
    std::string text;
    for (const auto& [batch_context, count] : counts) {
        text += count == 0 ? "" : fmt::format(" {} flown by a sweep {}.", count, escaped(batch_context));
    }
    return text;
}

std::string runs_table(Recordings recordings, const fs::path& page_folder) {
    constexpr std::size_t max_settings = 6;
    std::vector<std::string> names = differing_settings(recordings, all_of(recordings));
    const std::size_t left_out = names.size() - std::min(names.size(), max_settings);
    names.resize(names.size() - left_out);
    std::string html = "<div class=\"scroll\"><table class=\"sortable runs\">\n<thead><tr>"
                       "<th>flight</th>";
    for (const std::string& name : names) {
        html += "<th>" + escaped(name) + "</th>";
    }
    for (const auto& [key, name] : shown_statistics) {
        html += fmt::format("<th class=\"number\">{}</th>", name);
    }
    html += "<th>states</th><th>pictures</th><th>condition</th></tr></thead>\n<tbody>\n";
    for (const LoadedRecording& recording : recordings) {
        html += "<tr><td>" + link_of(recordings, recording, page_folder) + "</td>";
        for (const std::string& name : names) {
            html += "<td>" + escaped(short_value(value_of(recording.run.settings, name))) + "</td>";
        }
        for (const auto& [key, name] : shown_statistics) {
            const Statistic& statistic = statistic_named(key);
            html += number_cell(statistic.value(recording.statistics), std::min(statistic.decimals, 2));
        }
        const std::string condition = noise_text_of(recording);
        html += fmt::format(
            "<td><code>{}</code></td><td><code>{}</code></td><td class=\"{}\">{}</td></tr>\n",
            escaped(recording.run.state_hash.substr(0, 8)),
            escaped(recording.run.picture_hash.substr(0, 8)),
            condition.empty() ? "" : "worse",
            condition.empty() ? "good" : condition);
    }
    html += "</tbody></table></div>\n<p class=\"note\">A click on a column's head sorts by it. "
            "States and pictures are the first eight digits of their hashes." +
            batch_context_text(recordings);
    if (left_out > 0) {
        html +=
            fmt::format(" {} more settings differ; they are in the flights' own pages.", left_out);
    }
    return "<div class=\"card\">\n" + html + "</p></div>\n";
}

std::string plot_per_recording(Recordings recordings) {
    const double ceiling_ms = shared_ceiling_ms(recordings, all_of(recordings));
    const std::size_t pieces = recordings.size() > 40 ? 60 : 150;
    double begin_s = 0.0;
    double end_s = 0.0;
    for (const LoadedRecording& recording : recordings) {
        begin_s = std::min(begin_s, recording.flight.begin_s());
        end_s = std::max(end_s, recording.flight.end_s());
    }
    std::string html = "<div class=\"small-plots\">\n";
    for (const LoadedRecording& recording : recordings) {
        Plot plot{
            label_of(recordings, recording), "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
        plot.x_min = begin_s;
        plot.x_max = end_s;
        PlotSeries curve = recording.flight.frame_ms.series(pieces);
        curve.colour = run_colours.front();
        plot.series.push_back(std::move(curve));
        plot.levels = {{"16.67 ms", overrun_16_ms}};
        html += page_plot(plot, PlotWidth::Small);
    }
    return "<h2>Frame time of each flight, ms over seconds, on common axes</h2>\n<div "
           "class=\"card\">" +
           html + "</div></div>\n";
}

std::string pictures(Recordings recordings) {
    constexpr std::size_t max_flights = 24;
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
    for (const std::size_t index : evenly_spaced(flights.size(), max_flights)) {
        const LoadedRecording& flight = *flights[index];
        const fs::path& middle = flight.pictures[flight.pictures.size() / 2];
        html += picture_html(
            middle, widest_px, label_of(recordings, flight) + ", " + middle.filename().string());
    }
    html += "</div>\n";
    if (flights.size() > max_flights) {
        html +=
            fmt::format("<p class=\"note\">{} of {} flights.</p>\n", max_flights, flights.size());
    }
    return "<h2>A picture from the middle of each flight</h2>\n<div class=\"card\">" + html +
           "</div>\n";
}

/// Settings, program and machine where all recordings have the same.
std::string common_rows(Recordings recordings) {
    const auto table = [&](const char* title, auto rows_of) {
        std::string html = fmt::format(
            "<div class=\"card\">\n<h3>{}</h3>\n<div class=\"scroll\"><table>\n<tbody>\n", title);
        for (const auto& row : rows_of(recordings.front())) {
            const auto& name = row.first;
            const auto& value = row.second;
            const bool same = std::ranges::all_of(recordings, [&](const LoadedRecording& each) {
                return value_of(rows_of(each), name) == value;
            });
            if (same && value != unset_value && !value.empty()) {
                html += fmt::format(
                    "<tr><td>{}</td><td><code>{}</code></td></tr>\n",
                    escaped(name),
                    escaped(value));
            }
        }
        return html + "</tbody></table></div></div>\n";
    };
    return "<h2>What all have in common</h2>\n" +
           table("Settings", [](const LoadedRecording& each) { return each.run.settings; }) +
           table(
               "Program and machine", [](const LoadedRecording& each) { return each.run.machine; });
}

} // namespace

std::string several_recordings_html(Recordings recordings, const fs::path& page_folder) {
    return runs_table(recordings, page_folder) + compared_flights_html(recordings) +
           plot_per_recording(recordings) + pictures(recordings) + common_rows(recordings);
}

} // namespace octant::ui::report
