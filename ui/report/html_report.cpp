#include "ui/report/html_report.h"

#include "sim/base/output_file.h"
#include "ui/report/comparison.h"
#include "ui/report/flight_accumulator.h"
#include "ui/report/html_text.h"
#include "ui/report/plots.h"
#include "ui/report/slow_pictures.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

using Indices = std::vector<std::size_t>; ///< of recordings

/// Colours of curves in one plot.
constexpr std::array run_colours{
    "#3b82f6", "#f59e0b", "#10b981", "#ef4444", "#8b5cf6", "#14b8a6", "#ec4899", "#84cc16", "#6366f1", "#a16207"};

/// Keys of the figures that stand at the top of the page.
constexpr std::array shown_statistics{"frames", "p50_ms", "p99_ms", "max_ms", "low_1pct_fps", "overruns_16ms"};

/// The figure of that key, which must exist.
const Statistic& statistic_named(std::string_view key) {
    return *std::ranges::find(all_statistics(), key, &Statistic::key);
}

/// A cell of a class of the style sheet.
Cell styled(Cell cell, std::string css_class) {
    cell.css_class = std::move(css_class);
    return cell;
}

std::string title_of(const LoadedRecording& recording) {
    return recording.run.title.empty() ? recording.name : recording.run.title;
}

/// What tells a recording from the others: its folder's name, or its whole path where names repeat.
std::string label_of(Recordings recordings, const LoadedRecording& recording) {
    return std::ranges::count(recordings, recording.name, &LoadedRecording::name) == 1 ? recording.name
                                                                                       : recording.display_name;
}

/// A file's name without its folder, which is too long for a table; any other text as it is.
std::string short_value(const std::string& value) {
    if (value == unset_value) { return "not set"; }
    return value.find('/') == std::string::npos ? value : fs::path(value).filename().string();
}

Indices all_of(Recordings recordings) {
    Indices all(recordings.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

/// Names of settings in which some of these recordings differ, in their order. `among`: at least one.
std::vector<std::string> differing_settings(Recordings recordings, const Indices& among) {
    std::vector<std::string> names;
    for (const auto& row : recordings[among.front()].run.settings) {
        const bool differs = std::ranges::any_of(
            among, [&](std::size_t i) { return value_of(recordings[i].run.settings, row.first) != row.second; });
        if (differs) { names.push_back(row.first); }
    }
    return names;
}

/// End of the axis of frame times of all these recordings, milliseconds.
double shared_ceiling_ms(Recordings recordings, const Indices& runs) {
    double ceiling_ms = 0.0;
    for (const std::size_t i : runs) { ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recordings[i].statistics)); }
    return ceiling_ms;
}

// The top of the page: what came of each flight.

/// What is wrong with a recording: in a word for a table, in sentences for its own page.
struct Fault {
    std::string word;
    std::string explanation;
};

std::vector<Fault> faults_of(const LoadedRecording& recording) {
    std::vector<Fault> faults;
    if (recording.ended_early) {
        faults.push_back({"ended early", "The flight was cut short: the figures are those of the frames recorded until "
                                         "then, and there are no hashes. "});
    }
    if (!recording.run.stopped.empty()) { faults.push_back({"stopped", "Ended by " + recording.run.stopped + ". "}); }
    if (!recording.disagreement.empty()) {
        faults.push_back({"rows and summary disagree",
            "Rows are missing or the summary is not theirs; the figures are those of the rows: " +
                recording.disagreement + ". "});
    }
    if (!recording.run.noise.empty()) {
        faults.push_back({"noisy", ""});
        for (const std::string& reason : recording.run.noise) { faults.back().explanation += reason + " "; }
    }
    if (recording.statistics.frames == 0) { faults.push_back({"no frames", ""}); }
    return faults;
}

std::string tile(std::string_view name, const std::string& value, std::string_view unit) {
    return fmt::format(
        "<div><dt>{}</dt><dd>{} <small>{}</small></dd></div>\n", escaped(name), escaped(value), escaped(unit));
}

/// Title, machine, faults and the most important figures of one flight.
std::string overview(const LoadedRecording& recording) {
    const MachineInfo& machine = recording.run.machine_info;
    const bool is_own = recording.capture_format.empty();
    std::string html = fmt::format("<p class=\"lead\">{}<br>{}</p>\n",
        escaped(title_of(recording) + ", " + (is_own ? machine.start_time_utc : recording.capture_format)),
        escaped(is_own ? fmt::format("{}, {} cores", machine.cpu, machine.cores) : machine.cpu));
    const auto badge = [&](std::string_view text, bool bad) {
        html += fmt::format("<span class=\"badge{}\">{}</span>\n", bad ? " bad" : "", text);
    };
    const std::vector<Fault> faults = faults_of(recording);
    std::string explanations;
    if (is_own && !recording.ended_early) { badge("ended", false); }
    if (is_own && recording.run.noise.empty()) { badge("quiet machine", false); }
    for (const Fault& fault : faults) {
        badge(fault.word, true);
        explanations += fault.explanation;
    }
    html += (explanations.empty() ? "" : note_html(explanations)) + "<dl class=\"tiles\">\n";
    const Statistics& statistics = recording.statistics;
    for (const char* key : shown_statistics) {
        const Statistic& statistic = statistic_named(key);
        const std::size_t unit = statistic.name.find(", ");
        html += tile(statistic.name.substr(0, unit), statistic_text(statistic, statistics),
            unit == std::string_view::npos ? "frames" : statistic.name.substr(unit + 2));
    }
    const double fps = statistics.mean_ms > 0.0 ? 1000.0 / statistics.mean_ms : 0.0;
    html += tile("Rate", fmt::format("{:.1f}", fps), "frames/s");
    if (const TargetRange targets = recording.flight.triangle_targets(); targets.varies()) {
        html += tile("Triangle target", fmt::format("{:.0f}", targets.mean),
            fmt::format("mean of {} to {}", targets.min_triangles, targets.max_triangles));
    }
    return card_html(html + "</dl>\n");
}

/// The way from the page to a recording's own page; empty where there is none that stays.
std::string link_to(const LoadedRecording& recording, const fs::path& page_folder) {
    std::error_code ignored;
    const fs::path page = recording.folder.path / "report.html";
    if (page_folder.empty() || recording.folder.unpacked || !fs::is_regular_file(page, ignored)) { return {}; }
    return url_text(fs::absolute(page)
                        .lexically_normal()
                        .lexically_relative(fs::absolute(page_folder).lexically_normal())
                        .generic_string());
}

/// How sweeps flew them, where sweeps did: " 24 flown by a sweep one at a time."
std::string machine_sharing_text(Recordings recordings) {
    std::map<std::string, int> counts;
    for (const LoadedRecording& recording : recordings) {
        const std::string machine_sharing = value_of(recording.run.facts, machine_sharing_fact);
        counts[machine_sharing] += machine_sharing.empty() ? 0 : 1;
    }
    std::string text;
    for (const auto& [machine_sharing, count] : counts) {
        text += count == 0 ? "" : fmt::format(" {} flown by a sweep {}.", count, machine_sharing);
    }
    return text;
}

/// Several flights, a row each: settings in which they differ, figures, hashes and faults.
std::string runs_table(Recordings recordings, const fs::path& page_folder) {
    constexpr std::size_t max_settings = 6;
    constexpr int max_decimals = 2;
    std::vector<std::string> names = differing_settings(recordings, all_of(recordings));
    const std::size_t left_out = names.size() - std::min(names.size(), max_settings);
    names.resize(names.size() - left_out);
    ResultTable table;
    for (const LoadedRecording& recording : recordings) {
        std::vector<Cell> row = {{"flight", label_of(recordings, recording)}};
        row.back().link = link_to(recording, page_folder);
        for (const std::string& name : names) {
            row.emplace_back(name, short_value(value_of(recording.run.settings, name)));
        }
        for (const char* key : shown_statistics) {
            const Statistic& statistic = statistic_named(key);
            row.push_back({std::string(statistic.name), "{:.{}f}", statistic.value(recording.statistics),
                std::min(statistic.decimals, max_decimals)});
        }
        row.push_back(styled({"states", recording.run.state_hash.substr(0, 8)}, "code"));
        row.push_back(styled({"pictures", recording.run.picture_hash.substr(0, 8)}, "code"));
        std::string condition;
        for (const Fault& fault : faults_of(recording)) { condition += (condition.empty() ? "" : ", ") + fault.word; }
        row.push_back(condition.empty()
                          ? Cell("condition", recording.capture_format.empty() ? "good" : recording.capture_format)
                          : styled({"condition", condition}, "worse"));
        table.add(std::move(row));
    }
    table.note = "A click on a column's head sorts by it. States and pictures are the first eight digits of their "
                 "hashes." +
                 machine_sharing_text(recordings);
    if (left_out > 0) {
        table.note += fmt::format(" {} more settings differ; they are in the flights' own pages.", left_out);
    }
    return card_html(html_of(table, "sortable runs"));
}

// Flights of the same path on the same kind of machine, compared.

/// "order-method exact, samples 4", by the settings in which variants differ.
std::string variant_label(const LoadedRecording& recording, const std::vector<std::string>& names) {
    std::string label;
    for (const std::string& name : names) {
        label += fmt::format(
            "{}{} {}", label.empty() ? "" : ", ", name, short_value(value_of(recording.run.settings, name)));
    }
    return label.empty() ? "all the same" : label;
}

std::vector<double> values_of(Recordings recordings, const Indices& runs, const Statistic& statistic) {
    std::vector<double> values;
    for (const std::size_t i : runs) {
        if (recordings[i].statistics.frames > 0) { values.push_back(statistic.value(recordings[i].statistics)); }
    }
    return values;
}

/// Whether other programs, or flights on the same cores, took part in the runs' frame times.
bool is_noisy(Recordings recordings, const Indices& runs) {
    return std::ranges::any_of(runs, [&](std::size_t i) { return !recordings[i].run.noise.empty(); });
}

/// The change of a figure from the first variant: green or red where it is significant and both were quiet.
Cell change_cell(std::string column, std::span<const double> before, std::span<const double> now, bool is_quiet) {
    if (before.empty() || now.empty()) { return {std::move(column), ""}; }
    const RelativeChange change = relative_change(before, now);
    std::string text = fmt::format("{:+.1f} %", 100.0 * change.share);
    if (change.has_interval) {
        text += fmt::format(" ({:+.1f} to {:+.1f} %)", 100.0 * change.low, 100.0 * change.high);
    }
    const bool is_decided = change.is_significant() && is_quiet;
    return styled({std::move(column), text}, !is_decided ? "" : (change.share < 0.0 ? "better" : "worse"));
}

/// A row for each variant of a flight: medians of its runs, and the change from the first variant.
std::string comparison_table(Recordings recordings, const std::vector<Indices>& variants) {
    Indices all;
    for (const Indices& variant : variants) { all.insert(all.end(), variant.begin(), variant.end()); }
    const std::vector<std::string> names = differing_settings(recordings, all);
    const Indices& first = variants.front();
    ResultTable table;
    bool noisy = false;
    for (const Indices& variant : variants) {
        const bool is_first = &variant == &first;
        const bool is_loud = is_noisy(recordings, first) || is_noisy(recordings, variant);
        noisy = noisy || (is_loud && !is_first);
        std::vector<Cell> row = {
            {"variant", variant_label(recordings[variant.front()], names)}, {"runs", variant.size()}};
        for (const char* key : {"p50_ms", "p99_ms"}) {
            const Statistic& statistic = statistic_named(key);
            const std::vector<double> before = values_of(recordings, first, statistic);
            const std::vector<double> now = values_of(recordings, variant, statistic);
            row.emplace_back(std::string(statistic.name), now.empty() ? "none" : fmt::format("{:.3f}", median_of(now)));
            row.push_back(is_first ? styled({"change", "compared with this one"}, "soft")
                                   : change_cell("change", before, now, !is_loud));
        }
        table.add(std::move(row));
    }
    table.note = "Medians over the runs of a variant. In brackets the 95 % interval of the change by the bootstrap "
                 "over runs, where both variants have three runs or more; green or red only where zero lies outside.";
    if (noisy) {
        table.note += " No change from or to noisy runs is called better or worse: other programs, or flights on the "
                      "same cores, took part in their times.";
    }
    return html_of(table);
}

/// The frame times of a flight's runs over simulated time in one plot, at most 12 curves.
std::string overlaid_plot(Recordings recordings, const std::vector<Indices>& variants, double ceiling_ms) {
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
    return plot.series.size() == runs ? html
                                      : html + note_html(fmt::format("{} of {} runs.", plot.series.size(), runs));
}

/// Recordings of the same flight on the same kind of machine: a table of their variants where settings differ, and
/// their frame times in one plot. Says so where no two belong together.
std::string compared_flights(Recordings recordings) {
    constexpr std::size_t max_groups = 24;
    std::vector<Indices> groups = comparable_groups(recordings);
    std::erase_if(groups, [](const Indices& group) { return group.size() < 2; });
    if (groups.empty()) {
        return note_html("No two of these recordings are of the same flight on the same kind of machine, so none are "
                         "compared.");
    }
    std::string html = heading_html("The same flight, compared");
    for (const Indices& group : std::span(groups).first(std::min(groups.size(), max_groups))) {
        const std::vector<Indices> variants = variants_of(recordings, group);
        html += card_html("<h3>" + escaped(title_of(recordings[group.front()])) + "</h3>\n" +
                          (variants.size() > 1 ? comparison_table(recordings, variants) : "") +
                          overlaid_plot(recordings, variants, shared_ceiling_ms(recordings, group)));
    }
    if (groups.size() > max_groups) {
        html += note_html(
            fmt::format("The first {} of {} flights that were flown more than once.", max_groups, groups.size()));
    }
    return html;
}

// Plots and pictures.

/// All plots of one flight, over simulated time with the legs of its path.
std::string plots_of_one(const LoadedRecording& recording) {
    const double ceiling_ms = plot_ceiling_ms(recording.statistics);
    std::string html = heading_html("Plots") + "<div class=\"plots\">\n";
    PlotWidth width = PlotWidth::FullWidth;
    for (Plot& plot : flight_plots(recording.flight, ceiling_ms)) {
        if (plot.x_label.starts_with("simulated time")) { plot.marks = recording.run.legs; }
        html += card_html(page_plot(plot, std::exchange(width, PlotWidth::HalfWidth)));
    }
    std::string text = "Values under the pointer; drag to zoom, double click for all of it.";
    if (recording.statistics.max_ms > ceiling_ms) {
        text += " Where a frame took longer than the plot is high, its curve leaves it at the top.";
    }
    return html + "</div>\n" + note_html(text);
}

/// A small plot of each flight, on common axes.
std::string plots_of_several(Recordings recordings) {
    const double ceiling_ms = shared_ceiling_ms(recordings, all_of(recordings));
    const std::size_t pieces = recordings.size() > 40 ? 60 : 150;
    double begin_s = 0.0;
    double end_s = 0.0;
    for (const LoadedRecording& recording : recordings) {
        begin_s = std::min(begin_s, recording.flight.begin_s());
        end_s = std::max(end_s, recording.flight.end_s());
    }
    std::string html;
    for (const LoadedRecording& recording : recordings) {
        Plot plot{label_of(recordings, recording), "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms};
        plot.x_min = begin_s;
        plot.x_max = end_s;
        plot.series.push_back(recording.flight.frame_ms.series(pieces));
        plot.series.back().colour = run_colours.front();
        plot.levels = {{"16.67 ms", overrun_16_ms}};
        html += page_plot(plot, PlotWidth::Small);
    }
    return heading_html("Frame time of each flight, ms over seconds, on common axes") +
           card_html("<div class=\"small-plots\">\n" + html + "</div>\n");
}

/// Pictures of one flight, evenly spaced; of several flights one from the middle of each.
std::string pictures(Recordings recordings) {
    const bool is_one = recordings.size() == 1;
    const std::size_t max_shown = is_one ? 12 : 24;
    const int widest_px = is_one ? 640 : 320;
    std::vector<std::pair<fs::path, std::string>> all; ///< and captions
    for (const LoadedRecording& recording : recordings) {
        const std::vector<fs::path>& own = recording.pictures;
        for (std::size_t i = is_one ? 0 : own.size() / 2; i < own.size(); i += is_one ? 1 : own.size()) {
            const std::string name = own[i].filename().string();
            all.emplace_back(own[i], is_one ? name : label_of(recordings, recording) + ", " + name);
        }
    }
    if (all.empty()) { return {}; }
    std::string html;
    for (const std::size_t index : evenly_spaced(all.size(), max_shown)) {
        html += picture_html(all[index].first, widest_px, all[index].second);
    }
    html = "<div class=\"sheet\">\n" + html + "</div>\n";
    if (all.size() > max_shown) {
        html += note_html(
            fmt::format("{} of {} {}, evenly spaced.", max_shown, all.size(), is_one ? "pictures" : "flights"));
    }
    return heading_html(is_one ? "Pictures" : "A picture from the middle of each flight") + card_html(html);
}

// Figures, slow frames and results of one flight.

std::string statistics_table(const LoadedRecording& recording) {
    ResultTable table;
    for (const Statistic& statistic : all_statistics()) {
        table.add({{"Figure", statistic.name}, {"Value", statistic_text(statistic, recording.statistics)},
            styled({"Definition", statistic.definition}, "definition")});
    }
    if (!recording.capture_format.empty()) {
        table.note = "n is the number of frames counted. Frame times are as the other program measured them.";
        return heading_html("Frame times") + card_html(html_of(table));
    }
    table.note = "frame_ms runs from the start of the frame's simulation step to its pixels complete and read; writing "
                 "pictures and video is outside it. n is the number of frames counted. Stress (frames.csv) is the "
                 "share of a frame's time, the simulated time from it to the next, that frame_ms is; where the ground "
                 "adapts it is that share through a first-order filter.";
    return heading_html("Frame times") + card_html(html_of(table));
}

std::string overrun_summary(const LoadedRecording& recording) {
    const auto& counts = recording.flight.slow.above_16_ms();
    std::string text = fmt::format(
        "{} of {} frames took longer than 16.67 ms.", recording.statistics.overruns_16ms, recording.statistics.frames);
    for (std::size_t i = 0; recording.flight.has_stages() && i < counts.size(); ++i) {
        if (counts[i] > 0) { text += fmt::format(" In {} of them {} took most.", counts[i], stage_names[i]); }
    }
    return "<p>" + text + "</p>\n";
}

ResultTable slowest_table(const LoadedRecording& recording) {
    ResultTable table;
    for (const SlowFrame& frame : recording.slowest) {
        const FrameRecord& record = frame.record;
        std::vector<Cell> row = {
            {"frame", record.frame}, {"at, s", "{:.2f}", record.sim_time_s}, {"ms", "{:.2f}", record.frame_ms}};
        if (recording.flight.has_stages()) {
            row.emplace_back("took most", stage_names[frame.longest_stage]);
            row.push_back({"ms", "{:.2f}", frame.stage_ms[frame.longest_stage]});
            row.push_back(
                {"grew most over its median", "{} by {:.2f} ms", stage_names[frame.slowed_stage], frame.slowdown_ms});
            row.emplace_back("triangles", record.terrain_triangles);
            row.push_back({"change", "{:+}", record.triangle_change});
        }
        if (recording.has_counters) {
            row.emplace_back("page faults", record.counters.page_faults);
            row.emplace_back("switches", record.counters.switches);
            row.push_back({"stolen, ms", "{:.0f}", record.counters.stolen_ms});
        }
        table.add(std::move(row));
    }
    if (recording.has_counters) {
        table.note = "Switches: how often another program was given the processor. Stolen: by the host for other "
                     "machines, in the kernel's steps of 10 ms, of all processors.";
    }
    return table;
}

/// The picture of a slow frame: its own, else the recorded one nearest to it; empty where there is none.
std::string slow_picture_html(const LoadedRecording& recording, const FrameRecord& frame) {
    constexpr int widest_px = 320;
    const std::string caption = fmt::format("frame {}, {:.2f} ms", frame.frame, frame.frame_ms);
    const fs::path own = recording.folder.path / slow_picture_name(frame.frame);
    if (is_file(own)) { return picture_html(own, widest_px, caption); }
    if (recording.pictures.empty()) { return {}; }
    const fs::path& nearest = *std::ranges::min_element(recording.pictures, {}, [&](const fs::path& picture) {
        return std::abs(picture_frame(picture.filename().string()).value_or(0) - frame.frame);
    });
    return picture_html(nearest, widest_px, caption + ": nearest picture, " + nearest.filename().string());
}

std::string slowest_frames(const LoadedRecording& recording) {
    std::string sheet;
    for (std::size_t i = 0; i < std::min(SlowPictures::max_shown, recording.slowest.size()); ++i) {
        sheet += slow_picture_html(recording, recording.slowest[i].record);
    }
    return heading_html(recording.flight.has_stages() ? "The slowest frames and why" : "The slowest frames") +
           card_html(overrun_summary(recording) + html_of(slowest_table(recording)) +
                     (sheet.empty() ? "" : "<div class=\"sheet\">\n" + sheet + "</div>\n"));
}

/// A table of names and values; empty without rows.
std::string values_table(std::string_view title, const NamedValues& rows) {
    if (rows.empty()) { return {}; }
    ResultTable table;
    for (const auto& [name, value] : rows) { table.add({{"", name}, styled({"", value}, "code")}); }
    return heading_html(title) + card_html(html_of(table));
}

NamedValues result_rows(const LoadedRecording& recording) {
    NamedValues rows;
    if (recording.capture_format.empty()) {
        rows = {{"state hash", recording.run.state_hash}, {"picture hash", recording.run.picture_hash},
            {"path offset over the ground (x, y, z), m", recording.run.path_offset}};
    }
    for (const NamedValues& more : {recording.run.facts, recording.flight.clock.rows(), recording.flight.link.rows()}) {
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
}

/// Settings, or entries of program and machine, that are set and the same in all recordings.
NamedValues common_rows(Recordings recordings, NamedValues RunFile::*rows) {
    NamedValues common;
    for (const auto& row : recordings.front().run.*rows) {
        const bool is_same = std::ranges::all_of(
            recordings, [&](const LoadedRecording& each) { return value_of(each.run.*rows, row.first) == row.second; });
        if (is_same && row.second != unset_value && !row.second.empty()) { common.push_back(row); }
    }
    return common;
}

std::string page_title(Recordings recordings) {
    return recordings.size() == 1 ? title_of(recordings.front())
                                  : fmt::format("{} flights compared", recordings.size());
}

} // namespace

std::string html_report(
    Recordings recordings, std::span<const ResultTable> first_tables, const std::filesystem::path& page_folder) {
    const bool is_one = recordings.size() == 1;
    std::string html = page_head(page_title(recordings), "Octant flight report", recordings.size() > 1);
    for (const ResultTable& table : first_tables) { html += card_html(html_of(table)); }
    if (recordings.empty()) { return html + page_end(); }
    const LoadedRecording& first = recordings.front();
    html += is_one ? overview(first) + plots_of_one(first)
                   : runs_table(recordings, page_folder) + compared_flights(recordings) + plots_of_several(recordings);
    html += pictures(recordings);
    if (is_one) {
        html += statistics_table(first) + slowest_frames(first) + values_table("Results", result_rows(first));
    }
    html += values_table(
        is_one ? "Settings" : "Settings that all have in common", common_rows(recordings, &RunFile::settings));
    html += values_table(is_one ? "Program and machine" : "Program and machine that all have in common",
        common_rows(recordings, &RunFile::machine));
    return html + page_end();
}

} // namespace octant::ui::report
