#include "ui/report/html_report.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/report/comparison.h"
#include "ui/report/figures.h"
#include "ui/report/flight_accumulator.h"
#include "ui/report/html_text.h"
#include "ui/report/plots.h"
#include "ui/report/slow_pictures.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
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

/// What tells each recording from the others: its folder's name, or its whole path where names repeat.
std::vector<std::string> labels_of(Recordings recordings) {
    std::map<std::string_view, int> counts;
    for (const LoadedRecording& recording : recordings) { ++counts[recording.name]; }
    std::vector<std::string> labels;
    for (const LoadedRecording& recording : recordings) {
        labels.push_back(counts[recording.name] == 1 ? recording.name : recording.display_name);
    }
    return labels;
}

/// A setting's values as a table shows them: without folders where that leaves different values different.
std::vector<std::string> shown_values(Recordings recordings, std::string_view setting) {
    std::vector<std::string> whole;
    std::vector<std::string> brief;
    for (const LoadedRecording& recording : recordings) {
        const std::string value = value_of(recording.run.settings, setting);
        whole.push_back(value == unset_value ? "not set" : value);
        brief.push_back(value.find('/') == std::string::npos ? whole.back() : fs::path(value).filename().string());
    }
    const auto different = [](const std::vector<std::string>& values) {
        return std::set<std::string_view>(values.begin(), values.end()).size();
    };
    return different(brief) == different(whole) ? brief : whole;
}

/// Names of settings in which some of these recordings differ, in their order, without those that nothing depends on.
std::vector<std::string> differing_settings(Recordings recordings, SettingRoles roles) {
    std::vector<std::string> names;
    for (const auto& [name, value] : recordings.front().run.settings) {
        const bool is_ignored = roles != nullptr && role_of(name, roles) == SettingRole::Ignored;
        const bool differs = std::ranges::any_of(
            recordings, [&name = name, &value = value](const LoadedRecording& each) { // clang 14 captures no binding
                return value_of(each.run.settings, name) != value;
            });
        if (differs && !is_ignored) { names.push_back(name); }
    }
    return names;
}

/// What is said of frames in which programs were stopped; empty where there are none.
std::string pauses_text(Recordings recordings) {
    int frames = 0;
    for (const LoadedRecording& recording : recordings) { frames += recording.flight.paused_frames(); }
    return frames == 0
               ? std::string()
               : fmt::format(" Frames in which the program was stopped, as in the turns of octant compare, count "
                             "in no figure and no curve: {} (column paused of frames.csv).",
                     frames);
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

/// Rows of a table, above which they are made while the reader scrolls.
constexpr std::size_t max_html_rows = 100;

/// Several flights, a row each: settings in which they differ, figures, hashes and faults.
std::string runs_table(
    Recordings recordings, const std::vector<std::string>& labels, const ReportPageOptions& options) {
    constexpr std::size_t max_settings = 6;
    constexpr int max_decimals = 2;
    std::vector<std::string> names = differing_settings(recordings, options.roles);
    const std::size_t left_out = names.size() - std::min(names.size(), max_settings);
    names.resize(names.size() - left_out);
    std::vector<std::vector<std::string>> values;
    for (const std::string& name : names) { values.push_back(shown_values(recordings, name)); }
    ResultTable table;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        const LoadedRecording& recording = recordings[i];
        std::vector<Cell> row = {{"flight", labels[i]}};
        row.back().link = link_to(recording, options.folder);
        for (std::size_t n = 0; n < names.size(); ++n) { row.emplace_back(names[n], values[n][i]); }
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
    table.note = "The button in a column's head sorts by it. States and pictures are the first eight digits of their "
                 "hashes." +
                 machine_sharing_text(recordings) + pauses_text(recordings);
    if (left_out > 0) {
        table.note += fmt::format(" {} more settings differ; they are in the flights' own pages.", left_out);
    }
    return heading_html("All flights") + card_html(html_of(table, {"sortable runs", max_html_rows}));
}

// The comparison as the page shows it.

/// What is said of a change: slower, faster, no change found, or that it cannot be told.
enum class Outcome { Slower, Faster, NoChange, Unknown };

/// A variant of a flight against the baseline of that flight.
struct ComparisonRow {
    std::size_t flight = 0;  ///< in Comparison::flights
    std::size_t variant = 0; ///< of the flight; the first is the baseline
    const FlightChange* change = nullptr;
    Outcome outcome = Outcome::Unknown;
};

struct Comparison {
    std::vector<ComparedFlight> flights; ///< those of which there are two recordings or more
    std::vector<ComparisonRow> rows;
};

Outcome outcome_of(const FlightChange& change, double limit, double resolution) {
    if (change.is_changed()) { return change.frames.share() < 0.0 ? Outcome::Faster : Outcome::Slower; }
    return verdict_of(std::span(&change, 1), limit, resolution) == Verdict::CannotTell ? Outcome::Unknown
                                                                                       : Outcome::NoChange;
}

Comparison comparison_of(const ReportPageOptions& options) {
    Comparison comparison;
    for (const ComparedFlight& flight : options.flights) {
        if (flight.variants.size() == 1 && flight.variants.front().runs.size() == 1) { continue; }
        for (std::size_t v = 1; v < flight.variants.size(); ++v) {
            const FlightChange& change = options.changes[comparison.rows.size()];
            comparison.rows.push_back(
                {comparison.flights.size(), v, &change, outcome_of(change, options.limit, options.resolution)});
        }
        comparison.flights.push_back(flight);
    }
    return comparison;
}

// The answer, the matrix and the changes one by one.

/// A change with its mark and colour.
Cell change_cell(std::string column, const ComparisonRow& row, bool with_interval) {
    constexpr std::array classes{"slower", "faster", "no-change", "unknown"};
    const FrameChange& frames = row.change->frames;
    const bool has_frames = frames.old_runs > 0 && frames.new_runs > 0;
    std::string text = has_frames ? fmt::format("{:+.1f} %", 100.0 * frames.share()) : "no frames";
    if (with_interval && frames.change) {
        text += fmt::format(" ({:+.1f} to {:+.1f} %)", 100.0 * frames.low_share(), 100.0 * frames.high_share());
    }
    return styled({std::move(column), text}, classes[static_cast<std::size_t>(row.outcome)]);
}

/// The answer in a sentence, and how many changes are of which kind.
std::string answer_html(const Comparison& comparison, const ReportPageOptions& options) {
    constexpr std::array marks{"\u25B2", "\u25BC", "=", "?"};
    std::string answer = answer_text(options.changes, options.limit, options.resolution);
    std::string more;
    if (comparison.flights.empty()) {
        answer = "Nothing is compared: no two recordings are of the same flight on the same kind of machine";
    } else if (comparison.rows.empty()) {
        answer = "Nothing is compared: recordings of the same flight are repeats of one variant";
    } else if (comparison.rows.size() == 1) {
        const ComparisonRow& row = comparison.rows.front();
        answer = fmt::format("{} {}", marks[static_cast<std::size_t>(row.outcome)], answer);
        more = fmt::format("{}, compared with {}.", row.change->new_variant, row.change->old_variant);
    } else {
        std::array<std::size_t, marks.size()> counts{};
        for (const ComparisonRow& row : comparison.rows) { ++counts[static_cast<std::size_t>(row.outcome)]; }
        more = fmt::format("{} {} slower, {} {} faster, {} {} without a change, {} {} that cannot be told.", marks[0],
            counts[0], marks[1], counts[1], marks[2], counts[2], marks[3], counts[3]);
    }
    return "<p class=\"answer\">" + escaped(answer) + ".</p>\n" +
           (more.empty() ? "" : "<p>" + escaped(more) + "</p>\n");
}

/// Variants in rows and flights in columns, or the other way round where there are many flights.
struct Matrix {
    std::vector<std::string> rows;
    std::vector<std::string> columns;
    std::map<std::pair<std::size_t, std::size_t>, Cell> cells; ///< by row and column
    bool rows_are_flights = false;
};

Matrix matrix_of(const Comparison& comparison) {
    constexpr std::size_t max_flight_columns = 24;
    std::vector<std::string> flights;
    std::vector<std::string> variants;
    std::map<std::string_view, std::size_t> places; // of variants
    for (const ComparedFlight& flight : comparison.flights) {
        for (const Variant& variant : flight.variants) {
            if (flight.variants.size() > 1 && places.try_emplace(variant.name, variants.size()).second) {
                variants.push_back(variant.name);
            }
        }
    }
    std::map<std::pair<std::size_t, std::size_t>, Cell> cells; // by variant and flight
    for (const ComparisonRow& row : comparison.rows) {
        const ComparedFlight& flight = comparison.flights[row.flight];
        if (row.variant == 1) {
            flights.push_back(flight.name);
            cells.emplace(std::pair(places.at(flight.variants.front().name), flights.size() - 1),
                styled({"", "{:.3f} ms", row.change->frames.old_ms}, "soft"));
        }
        cells.emplace(
            std::pair(places.at(flight.variants[row.variant].name), flights.size() - 1), change_cell("", row, false));
    }
    Matrix matrix{
        variants, flights, std::move(cells), flights.size() > max_flight_columns && flights.size() > variants.size()};
    if (matrix.rows_are_flights) {
        std::swap(matrix.rows, matrix.columns);
        std::map<std::pair<std::size_t, std::size_t>, Cell> turned;
        for (auto& [at, cell] : matrix.cells) { turned.emplace(std::pair(at.second, at.first), std::move(cell)); }
        matrix.cells = std::move(turned);
    }
    return matrix;
}

/// The matrix in tables of at most 12 columns, so that it is not wider than a page.
std::string matrix_html(const Comparison& comparison, double excluded_slowdown) {
    constexpr std::size_t max_columns = 12;
    const Matrix matrix = matrix_of(comparison);
    std::string html;
    for (std::size_t begin = 0; begin < matrix.columns.size(); begin += max_columns) {
        const std::size_t end = std::min(begin + max_columns, matrix.columns.size());
        ResultTable table;
        for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
            std::vector<Cell> row = {{matrix.rows_are_flights ? "flight" : "variant", matrix.rows[r]}};
            for (std::size_t c = begin; c < end; ++c) {
                const auto found = matrix.cells.find({r, c});
                row.push_back(found == matrix.cells.end() ? Cell("", "") : found->second);
                row.back().column = matrix.columns[c];
            }
            table.add(std::move(row));
        }
        html += html_of(table, {"sortable matrix"});
    }
    return html + note_html(fmt::format(
                      "Change of the frame time from the baseline, whose own is shown in ms. \u25B2 slower, \u25BC "
                      "faster: certain at 5 % with all comparisons of this page counted. = no change found, and a "
                      "slowdown above {:.2g} % excluded. ? cannot tell: the interval is wider, or a side has fewer "
                      "than three runs.",
                      100.0 * excluded_slowdown));
}

/// "frames 210-260; plan stage +0.80 ms; other pictures", "by medians; other states; other pictures".
std::string remarks_on(const FlightChange& change) {
    std::vector<std::string> parts;
    if (const auto& frames = change.frames.frames_changed) {
        parts.push_back(fmt::format("frames {}-{}", frames->first_frame, frames->last_frame));
    }
    if (const auto& stage = change.frames.stage_changed) {
        parts.push_back(fmt::format("{} stage {:+.2g} ms", stage_names[stage->stage], stage->change_ms));
    }
    if (change.frames.pairing == Pairing::Figures) { parts.emplace_back("by medians"); }
    if (!change.same_states) { parts.emplace_back("other states"); }
    if (!change.same_pictures) { parts.emplace_back("other pictures"); }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// How the changes were found, in each of the ways that the rows have.
std::string pairing_text(const Comparison& comparison) {
    constexpr std::array texts{" Frames that something else held up, whose new / old time is more than 2.5 standard "
                               "deviations off, are left out.",
        " Flights that did not alternate have a wider interval, with room for drift of the machine.",
        " By medians: the frames are not the same, so the medians of the flights' frame times are compared, and the "
        "two times in ms are theirs."};
    std::string text;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const bool is_used = std::ranges::any_of(comparison.rows,
            [&](const ComparisonRow& row) { return row.change->frames.pairing == static_cast<Pairing>(i); });
        text += is_used ? texts[i] : "";
    }
    return text;
}

/// The median of a variant's P99; "none" where no run has frames.
std::string p99_text(Recordings recordings, const Variant& variant) {
    std::vector<double> values;
    for (const std::size_t i : variant.runs) {
        if (recordings[i].statistics.frames > 0) { values.push_back(recordings[i].statistics.p99_ms); }
    }
    return values.empty() ? "none" : fmt::format("{:.3f}", median_of(values));
}

/// All changes, a row each.
std::string changes_table(Recordings recordings, const Comparison& comparison) {
    const std::string& baseline = comparison.rows.front().change->old_variant;
    const bool is_one_baseline =
        std::ranges::all_of(comparison.rows, [&](const auto& row) { return row.change->old_variant == baseline; });
    ResultTable table;
    for (const ComparisonRow& row : comparison.rows) {
        const ComparedFlight& flight = comparison.flights[row.flight];
        const FrameChange& frames = row.change->frames;
        std::vector<Cell> cells;
        if (comparison.flights.size() > 1) { cells.emplace_back("flight", flight.name); }
        cells.emplace_back("variant", row.change->new_variant);
        cells.push_back(change_cell("change", row, true));
        cells.emplace_back("where", remarks_on(*row.change));
        if (!is_one_baseline) { cells.emplace_back("baseline", row.change->old_variant); }
        cells.push_back({"runs", "{}+{}", frames.old_runs, frames.new_runs});
        cells.push_back({"baseline, ms", "{:.3f}", frames.old_ms});
        cells.push_back({"ms", "{:.3f}", frames.new_ms});
        cells.emplace_back("P99 of baseline, ms", p99_text(recordings, flight.variants.front()));
        cells.emplace_back("P99, ms", p99_text(recordings, flight.variants[row.variant]));
        table.add(std::move(cells));
    }
    table.note = "Medians over the runs of a variant of their mean frame times, the change frame by frame with its "
                 "95 % interval in brackets, and medians of P99." +
                 pauses_text(recordings);
    if (is_one_baseline) { table.note = fmt::format("The baseline is {}. ", baseline) + table.note; }
    table.note += pairing_text(comparison);
    return heading_html("Changes") + card_html(html_of(table, {"sortable", max_html_rows}));
}

// Plots and pictures.

/// The frame times of a flight's runs over simulated time, at most 12 shared curves.
Plot overlaid_plot(Recordings recordings, const ComparedFlight& flight) {
    constexpr std::size_t max_curves = 12;
    Plot plot{flight.name, "simulated time, s", "ms", {}, {}, 0.0, 0.0};
    const bool is_one = flight.variants.size() == 1; // then a colour for each run
    const std::size_t max_of_each = std::max<std::size_t>(1, max_curves / flight.variants.size());
    std::size_t runs = 0;
    double ceiling_ms = 0.0;
    for (std::size_t v = 0; v < flight.variants.size(); ++v) {
        const Indices& variant = flight.variants[v].runs;
        runs += variant.size();
        for (const std::size_t i : variant) {
            ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recordings[i].statistics));
        }
        const std::size_t max_here = std::min(max_of_each, max_curves - plot.series.size());
        for (const std::size_t i : std::span(variant).first(std::min(variant.size(), max_here))) {
            const std::size_t colour = is_one ? plot.series.size() : v;
            plot.series.push_back({.name = is_one ? "" : flight.variants[v].name,
                .colour = run_colours[colour % run_colours.size()],
                .shared_curve = i});
        }
    }
    if (plot.series.size() < runs) { plot.title += fmt::format(" ({} of {} runs)", plot.series.size(), runs); }
    plot.y_max = ceiling_ms;
    plot.levels = {{"16.67 ms", overrun_16_ms}};
    plot.marks = recordings[flight.variants.front().runs.front()].run.legs;
    return plot;
}

/// A plot with its title as a picture; empty where cairo is missing.
std::string picture_of_plot(const Plot& plot) {
    try {
        std::string svg = figure_svg(plot, {.width_mm = 160.0, .height_mm = 60.0});
        svg.erase(0, svg.find("<svg"));
        return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, escaped(plot.title));
    } catch (const Error&) { return {}; }
}

/// The frame times of each compared flight's runs in one plot.
std::string overlaid_plots(Recordings recordings, const Comparison& comparison, std::span<const PlotSeries> curves) {
    if (comparison.flights.empty()) { return {}; }
    std::vector<Plot> plots;
    for (const ComparedFlight& flight : comparison.flights) { plots.push_back(overlaid_plot(recordings, flight)); }
    return heading_html("Frame times of the same flight, a colour for each variant") +
           card_html(page_plot_list(
               plots, curves, plots.size() == 1 ? PlotWidth::FullWidth : PlotWidth::HalfWidth, picture_of_plot));
}

/// All plots of one flight, over simulated time with the legs of its path.
std::string plots_of_one(const LoadedRecording& recording) {
    const double ceiling_ms = plot_ceiling_ms(recording.statistics);
    std::string html = heading_html("Plots") + "<div class=\"plots\">\n";
    PlotWidth width = PlotWidth::FullWidth;
    for (Plot& plot : flight_plots(recording.flight, ceiling_ms)) {
        if (plot.x_label.starts_with("simulated time")) { plot.marks = recording.run.legs; }
        // A picture of the frame times alone: those of all would make the page of a long flight half as large again.
        const PlotPicture picture_of = width == PlotWidth::FullWidth ? picture_of_plot : nullptr;
        html += card_html(page_plot(plot, std::exchange(width, PlotWidth::HalfWidth), picture_of));
    }
    std::string text = "Values under the pointer; drag to zoom, double click for all of it.";
    if (recording.statistics.max_ms > ceiling_ms) {
        text += " Where a frame took longer than the plot is high, its curve leaves it at the top.";
    }
    return html + "</div>\n" + note_html(text);
}

/// The frame times of all recordings, for plots to share: the more there are, the fewer points each has.
std::vector<PlotSeries> frame_time_curves(Recordings recordings, const std::vector<std::string>& labels) {
    std::vector<PlotSeries> curves;
    for (const LoadedRecording& recording : recordings) {
        curves.push_back(recording.flight.frame_ms.series(max_curve_pieces(recordings.size())));
        curves.back().name = labels[curves.size() - 1];
    }
    return curves;
}

/// A small plot of each flight, on common axes.
std::string plots_of_several(Recordings recordings, std::span<const PlotSeries> curves) {
    double begin_s = 0.0;
    double end_s = 0.0;
    double ceiling_ms = 0.0;
    for (const LoadedRecording& recording : recordings) {
        begin_s = std::min(begin_s, recording.flight.begin_s());
        end_s = std::max(end_s, recording.flight.end_s());
        ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recording.statistics));
    }
    std::vector<Plot> plots;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        plots.push_back({"", "simulated time, s", "ms", {}, {}, 0.0, ceiling_ms});
        plots.back().x_min = begin_s;
        plots.back().x_max = end_s;
        plots.back().series = {{.name = "", .colour = run_colours.front(), .shared_curve = i}};
        plots.back().levels = {{"16.67 ms", overrun_16_ms}};
    }
    return heading_html("Frame time of each flight, ms over seconds, on common axes") +
           card_html(page_plot_list(plots, curves, PlotWidth::Small));
}

/// Pictures of one flight, evenly spaced; of several flights one from the middle of each.
std::string pictures(Recordings recordings, const std::vector<std::string>& labels) {
    const bool is_one = recordings.size() == 1;
    const std::size_t max_shown = is_one ? 12 : 24;
    const int widest_px = is_one ? 640 : 320;
    std::vector<std::pair<fs::path, std::string>> all; ///< and captions
    for (std::size_t r = 0; r < recordings.size(); ++r) {
        const std::vector<fs::path>& own = recordings[r].pictures;
        for (std::size_t i = is_one ? 0 : own.size() / 2; i < own.size(); i += is_one ? 1 : own.size()) {
            const std::string name = own[i].filename().string();
            all.emplace_back(own[i], is_one ? name : labels[r] + ", " + name);
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

/// The pictures to which a table links, those of a row beside each other.
std::string linked_pictures(const ResultTable& table, const fs::path& folder) {
    constexpr int widest_px = 640;
    constexpr std::size_t max_shown = 12;
    std::string html;
    std::size_t shown = 0;
    for (const std::vector<Cell>& row : table.rows) {
        for (const Cell& cell : row) {
            if (!cell.link.ends_with(".png") || shown++ >= max_shown) { continue; }
            html += picture_html(folder / cell.link, widest_px, fmt::format("{}, {}", row.front().text, cell.column));
        }
    }
    return html.empty() ? html : "<div class=\"sheet pairs\">\n" + html + "</div>\n";
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
                 "adapts it is that share through a first-order filter." +
                 pauses_text(std::span(&recording, 1));
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

/// The picture and the facts of a recorded track; empty for a flight that follows none.
std::string recorded_track(const LoadedRecording& recording) {
    const fs::path picture = recording.folder.path / track_picture_name;
    if (!is_file(picture)) { return {}; }
    constexpr int widest_px = 1200;
    std::string html = "<div class=\"sheet\">\n" + picture_html(picture, widest_px, "map and heights") + "</div>\n";
    ResultTable table;
    for (const auto& [name, value] : recording.run.facts) {
        if (name.starts_with("track") || name == "recorded track") {
            table.add({{"", name}, styled({"", value}, "code")});
        }
    }
    if (!table.rows.empty()) { html += html_of(table); }
    return heading_html("Recorded track") + card_html(html);
}

std::string page_of_one(const LoadedRecording& recording, const ReportPageOptions& options) {
    std::string html = page_head(title_of(recording), "Octant flight report");
    for (const ResultTable& table : options.first_tables) { html += card_html(html_of(table)); }
    const Recordings one(&recording, 1);
    return html + overview(recording) + plots_of_one(recording) + recorded_track(recording) +
           pictures(one, labels_of(one)) + statistics_table(recording) + slowest_frames(recording) +
           values_table("Results", result_rows(recording)) +
           values_table("Settings", common_rows(one, &RunFile::settings)) +
           values_table("Program and machine", common_rows(one, &RunFile::machine)) + page_end();
}

std::string page_of_several(Recordings recordings, const ReportPageOptions& options) {
    const std::vector<std::string> labels = labels_of(recordings);
    const Comparison comparison = comparison_of(options);
    const std::vector<PlotSeries> curves = frame_time_curves(recordings, labels);
    const char* const compared = comparison.rows.empty() ? "" : " compared";
    std::string html =
        page_head(fmt::format("{} flights{}", recordings.size(), compared), "Octant flight report", true);
    html += card_html(answer_html(comparison, options) +
                      (comparison.rows.empty() ? "" : matrix_html(comparison, options.limit + options.resolution)));
    for (const ResultTable& table : options.first_tables) {
        html += card_html(html_of(table, {"sortable", max_html_rows}) + linked_pictures(table, options.folder));
    }
    if (!comparison.rows.empty()) { html += changes_table(recordings, comparison); }
    return html + page_curves(curves) + overlaid_plots(recordings, comparison, curves) +
           runs_table(recordings, labels, options) + plots_of_several(recordings, curves) +
           pictures(recordings, labels) +
           values_table("Settings that all have in common", common_rows(recordings, &RunFile::settings)) +
           values_table("Program and machine that all have in common", common_rows(recordings, &RunFile::machine)) +
           page_end();
}

} // namespace

std::string html_report(Recordings recordings, const ReportPageOptions& options) {
    if (recordings.size() == 1) { return page_of_one(recordings.front(), options); }
    if (!recordings.empty()) { return page_of_several(recordings, options); }
    std::string html = page_head("No flights", "Octant flight report");
    for (const ResultTable& table : options.first_tables) { html += card_html(html_of(table)); }
    return html + page_end();
}

} // namespace octant::ui::report
