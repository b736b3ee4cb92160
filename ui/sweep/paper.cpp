#include "ui/sweep/paper.h"

#include "flightpaths/toml_fields.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/version.h"
#include "ui/report/change_statistics.h"
#include "ui/report/figures.h"
#include "ui/report/frame_csv.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"
#include "ui/report/zip_file.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_check.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace octant::ui::sweep {

namespace {

namespace fs = std::filesystem;
using report::Plot;
using report::PlotSeries;

/// What a cell's row says. Times are medians over its repeats.
struct CellFigures {
    int repeats = 0;
    int frames = 0;
    double p50_ms = 0.0;
    std::optional<double> low_ms = {};
    std::optional<double> high_ms = {};
    std::optional<double> p95_ms = {};
    std::optional<double> p99_ms = {};
    std::optional<double> p999_ms = {};
    double mean_ms = 0.0;
    std::optional<double> low_1pct_fps = {};
};

constexpr std::array cell_columns{report::column<&CellFigures::repeats>("repeats", "repeats"),
    report::column<&CellFigures::frames>("frames", "frames"),
    report::column<&CellFigures::p50_ms>("p50_ms", "median, ms", 3),
    report::column<&CellFigures::low_ms>("low_ms", "95 % from, ms", 3),
    report::column<&CellFigures::high_ms>("high_ms", "95 % to, ms", 3),
    report::column<&CellFigures::p95_ms>("p95_ms", "P95, ms", 3),
    report::column<&CellFigures::p99_ms>("p99_ms", "P99, ms", 3),
    report::column<&CellFigures::p999_ms>("p999_ms", "P99.9, ms", 3),
    report::column<&CellFigures::mean_ms>("mean_ms", "mean, ms", 3),
    report::column<&CellFigures::low_1pct_fps>("low_1pct_fps", "1 % low, frames/s", 2)};

/// Counted frames that a flight needs for a percentile: one frame above it.
constexpr int frames_for_p95 = 20;
constexpr int frames_for_p99 = 100;
constexpr int frames_for_p999 = 1000;

/// Frame times of a cell over simulated time: median of its repeats, lowest and highest of them.
struct CellCurve {
    std::vector<double> time_s;
    std::vector<double> median_ms;
    std::vector<double> low_ms;
    std::vector<double> high_ms;
};

/// Runs that differ only in their repeat.
struct SweepCell {
    std::string path;
    std::string aircraft;
    std::vector<std::pair<std::string, std::string>> variant; ///< what else is varied
    std::vector<std::size_t> runs;                            ///< those that are done, by their index in the sweep
    CellFigures figures = {};
    CellCurve curve = {};
    std::vector<report::PlotMark> legs = {};

    std::string flight() const { return path + " " + aircraft; }

    /// "triangles 2000, order paper"; empty where nothing else is varied.
    std::string variant_name() const {
        std::string name;
        for (const auto& [key, value] : variant) {
            name += fmt::format("{}{} {}", name.empty() ? "" : ", ", key, value);
        }
        return name;
    }
};

/// A file's name without folder and ending; another text as it is.
std::string short_name(const std::string& text) {
    return fs::path(text).has_parent_path() ? fs::path(text).stem().string() : text;
}

std::string aircraft_name(const settings::RunSettings& settings) {
    std::string name;
    for (const std::string& each : settings.path.aircraft) {
        settings::AircraftEntry flown = settings::parse_aircraft_entry(each);
        flown.shape = short_name(flown.shape);
        if (flown.path) { flown.path = short_name(*flown.path); }
        name += (name.empty() ? "" : "+") + settings::text_of(flown);
    }
    return name;
}

/// The cells of a sweep in the order of their flights (path and aircraft), then in that of the sweep.
std::vector<SweepCell> cells_of(const Sweep& sweep, std::span<const RunResult> results) {
    std::vector<SweepCell> cells;
    std::map<std::string, std::size_t> known;
    std::map<std::string, std::size_t> flights;
    std::map<std::string, int> numbers; ///< of cells by what is shown of them
    for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
        const SweepRun& run = sweep.runs[i];
        std::string key = settings::settings_json(run.settings)
                              .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        for (const auto& varied : run.varied) { key += "\n" + varied.second; }
        const auto [found, is_new] = known.emplace(std::move(key), cells.size());
        if (is_new) {
            cells.push_back({short_name(run.settings.path.name), aircraft_name(run.settings), {}, {}});
            std::ranges::copy_if(run.varied, std::back_inserter(cells.back().variant),
                [](const auto& varied) { return varied.first != "path" && varied.first != "aircraft"; });
            // Files of one name in different folders.
            const int number = ++numbers[cells.back().flight() + "\n" + cells.back().variant_name()];
            if (number > 1) { cells.back().path += fmt::format(" ({})", number); }
            flights.emplace(cells.back().flight(), flights.size());
        }
        if (results[i].done()) { cells[found->second].runs.push_back(i); }
    }
    std::ranges::stable_sort(cells, {}, [&](const SweepCell& cell) { return flights.at(cell.flight()); });
    return cells;
}

/// Counted frames of a run.
struct CountedFrames {
    std::vector<double> time_s;
    std::vector<double> frame_ms;
};

CountedFrames counted_frames_of(const fs::path& recording) {
    CountedFrames times;
    report::FrameReader rows(recording / "frames.csv");
    while (const auto row = rows.next()) {
        if (!row->is_counted()) { continue; }
        times.time_s.push_back(row->sim_time_s);
        times.frame_ms.push_back(row->frame_ms);
    }
    return times;
}

/// Of frames that all repeats have. Where they are more than a figure can show, neighbours share a point: the median of
/// their medians, the lowest and the highest of all.
CellCurve curve_of(std::span<const CountedFrames> repeats) {
    constexpr std::size_t max_points = 300;
    std::size_t frames = repeats.front().time_s.size();
    for (const CountedFrames& repeat : repeats) { frames = std::min(frames, repeat.time_s.size()); }
    const std::size_t per_point = (frames + max_points - 1) / max_points;
    CellCurve curve;
    for (std::size_t begin = 0; begin < frames; begin += per_point) {
        std::vector<double> medians;
        double low_ms = std::numeric_limits<double>::infinity();
        double high_ms = 0.0;
        for (std::size_t i = begin; i < std::min(frames, begin + per_point); ++i) {
            std::vector<double> here;
            for (const CountedFrames& repeat : repeats) { here.push_back(repeat.frame_ms[i]); }
            const auto [lowest, highest] = std::ranges::minmax(here);
            low_ms = std::min(low_ms, lowest);
            high_ms = std::max(high_ms, highest);
            medians.push_back(report::median_of(std::move(here)));
        }
        curve.time_s.push_back(repeats.front().time_s[begin]);
        curve.median_ms.push_back(report::median_of(std::move(medians)));
        curve.low_ms.push_back(low_ms);
        curve.high_ms.push_back(high_ms);
    }
    return curve;
}

CellFigures figures_of(std::span<const CountedFrames> repeats) {
    std::vector<report::Statistics> all;
    for (const CountedFrames& repeat : repeats) { all.push_back(report::statistics_of_times(repeat.frame_ms)); }
    const auto values = [&](double report::Statistics::*figure) {
        std::vector<double> list;
        for (const report::Statistics& each : all) { list.push_back(each.*figure); }
        return list;
    };
    CellFigures figures;
    figures.repeats = static_cast<int>(repeats.size());
    figures.frames = std::ranges::min(all, {}, &report::Statistics::frames).frames;
    const auto median_from = [&](int frames, double report::Statistics::*figure) {
        return figures.frames >= frames ? std::optional(report::median_of(values(figure))) : std::nullopt;
    };
    figures.p50_ms = report::median_of(values(&report::Statistics::p50_ms));
    if (const auto interval = median_interval(values(&report::Statistics::p50_ms))) {
        figures.low_ms = interval->first;
        figures.high_ms = interval->second;
    }
    figures.p95_ms = median_from(frames_for_p95, &report::Statistics::p95_ms);
    figures.p99_ms = median_from(frames_for_p99, &report::Statistics::p99_ms);
    figures.p999_ms = median_from(frames_for_p999, &report::Statistics::p999_ms);
    figures.mean_ms = report::median_of(values(&report::Statistics::mean_ms));
    figures.low_1pct_fps = median_from(frames_for_p99, &report::Statistics::low_1pct_fps);
    return figures;
}

/// What the table says below its rows.
std::string note_of(std::span<const SweepCell> cells, const Sweep& sweep, std::span<const RunResult> results) {
    std::string note = fmt::format(
        "Times are medians over the repeats of a cell; each repeat's figures are those of its counted frames. "
        "Percentiles and the 1 % low are left out where a flight is too short for them: P95 needs {} counted "
        "frames, P99 and the 1 % low {}, P99.9 {}.",
        frames_for_p95, frames_for_p99, frames_for_p999);
    const auto has_interval = [](const SweepCell& cell) { return cell.figures.low_ms.has_value(); };
    if (std::ranges::any_of(cells, has_interval)) {
        note += " 95 %: the interval of the median frame time over repeats, by Student's t on logarithms for 3 to 5 "
                "repeats, by Wilcoxon's signed ranks for more.";
    }
    if (!std::ranges::all_of(cells, has_interval)) {
        note += " A cell with fewer than 3 repeats has no interval: they do not show how much repeats differ.";
    }
    const auto done = std::ranges::count(results, true, &RunResult::done);
    if (static_cast<std::size_t>(done) < results.size()) {
        note += fmt::format(" Only {} of {} flights are done; the table shows those.", done, results.size());
    }
    const auto noisy =
        std::ranges::count_if(results, [](const RunResult& run) { return run.done() && !run.noise.empty(); });
    if (noisy > 0) {
        note += fmt::format(" The machine was not quiet during {} flights (column noise of sweep.csv).", noisy);
    }
    const std::size_t differences = hash_mismatches(sweep, results).size();
    if (differences > 0) {
        note += fmt::format(" {} repeats did not show the same as the first of their cell.", differences);
    }
    return note;
}

report::ResultTable table_of(const std::string& title, std::span<const SweepCell> cells, const std::string& note) {
    const auto is_shown = [&](const report::Column<CellFigures>& column) {
        return std::ranges::any_of(
            cells, [&](const SweepCell& cell) { return std::isfinite(column.value(cell.figures)); });
    };
    report::ResultTable table{.title = title, .note = note};
    for (const SweepCell& cell : cells) {
        std::vector<report::Cell> row = {{"path", cell.path}, {"aircraft", cell.aircraft}};
        for (const auto& [name, value] : cell.variant) { row.emplace_back(name, value); }
        for (const report::Column<CellFigures>& column : cell_columns) {
            if (is_shown(column)) { row.emplace_back(std::string(column.name), report::text_of(column, cell.figures)); }
        }
        table.add(std::move(row));
    }
    return table;
}

/// Colours that people with each kind of colour blindness tell apart (M. Okabe, K. Ito, "Color universal design",
/// 2008).
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#000000", "#cc79a7", "#e69f00", "#56b4e9"};

/// Curves that one figure shows.
constexpr std::size_t max_curves = 6;

/// The names of all variants in the order of the first cell of each.
std::vector<std::string> variants_in(std::span<const SweepCell> cells) {
    std::vector<std::string> names;
    for (const SweepCell& cell : cells) {
        if (std::ranges::find(names, cell.variant_name()) == names.end()) { names.push_back(cell.variant_name()); }
    }
    return names;
}

std::string colour_of_variant(const std::vector<std::string>& variants, const SweepCell& cell) {
    const auto index = static_cast<std::size_t>(std::ranges::find(variants, cell.variant_name()) - variants.begin());
    return colours[index % colours.size()];
}

/// Frame times of cells of one flight. Bands leave the figure at 2.5 times its highest curve, so that single long
/// frames do not flatten the curves.
Plot flight_plot(std::span<const SweepCell* const> cells, const std::vector<std::string>& variants) {
    Plot plot{"Frame time of " + cells.front()->flight(), "simulated time, s", "frame time, ms"};
    plot.marks = cells.front()->legs;
    double highest_curve_ms = 0.0;
    double highest_band_ms = 0.0;
    for (const SweepCell* const cell : cells) {
        const CellCurve& curve = cell->curve;
        highest_curve_ms = std::max(highest_curve_ms, std::ranges::max(curve.median_ms));
        highest_band_ms = std::max(highest_band_ms, std::ranges::max(curve.high_ms));
        plot.series.push_back({"", colour_of_variant(variants, *cell), PlotSeries::Style::Area, curve.time_s,
            curve.high_ms, curve.low_ms});
    }
    for (const SweepCell* const cell : cells) {
        plot.series.push_back({cell->variant_name(), colour_of_variant(variants, *cell), PlotSeries::Style::Line,
            cell->curve.time_s, cell->curve.median_ms});
    }
    plot.y_min = 0.0;
    plot.y_max = 1.05 * std::min(highest_band_ms, 2.5 * highest_curve_ms);
    return plot;
}

/// Medians with intervals of all rows of the table, by their numbers.
Plot cells_plot(std::span<const SweepCell> cells, const std::vector<std::string>& variants) {
    constexpr double gap_ms = std::numeric_limits<double>::quiet_NaN();
    constexpr double wide_range = 20.0;
    Plot plot{"Median frame times of all cells", "row of the table", "median frame time, ms"};
    plot.x_min = 0.5;
    plot.x_max = static_cast<double>(cells.size()) + 0.5;
    const bool by_variant = variants.size() <= max_curves;
    std::vector<PlotSeries> points;
    std::string flight;
    double least_ms = std::numeric_limits<double>::infinity();
    double most_ms = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const SweepCell& cell = cells[i];
        const double row = static_cast<double>(i) + 1.0;
        const std::string name = by_variant ? cell.variant_name() : "";
        auto series = std::ranges::find(points, name, &PlotSeries::name);
        if (series == points.end()) {
            const std::string colour = by_variant ? colour_of_variant(variants, cell) : colours[0];
            points.push_back({name, colour, PlotSeries::Style::Points});
            plot.series.push_back({"", colour, PlotSeries::Style::Line}); // the intervals
            series = points.end() - 1;
        }
        const CellFigures& figures = cell.figures;
        const double low_ms = figures.low_ms.value_or(figures.p50_ms);
        const double high_ms = figures.high_ms.value_or(figures.p50_ms);
        series->x.insert(series->x.end(), {row, row});
        series->y.insert(series->y.end(), {figures.p50_ms, gap_ms});
        PlotSeries& intervals = plot.series[static_cast<std::size_t>(series - points.begin())];
        intervals.x.insert(intervals.x.end(), {row, row, row});
        intervals.y.insert(intervals.y.end(), {low_ms, high_ms, gap_ms});
        least_ms = std::min(least_ms, low_ms);
        most_ms = std::max(most_ms, high_ms);
        if (flight != cell.flight()) {
            flight = cell.flight();
            plot.marks.push_back({flight, row - 0.5});
        }
    }
    plot.series.insert(plot.series.end(), points.begin(), points.end());
    plot.y_logarithmic = most_ms > wide_range * least_ms;
    return plot;
}

/// Letters, digits and single dashes, as file names in LaTeX may have.
std::string file_label(std::string_view text) {
    std::string label;
    for (const char c : text.substr(0, 80)) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (is_plain || !label.ends_with('-')) { label += is_plain ? c : '-'; }
    }
    return label;
}

void write_figure(const fs::path& file, const Plot& plot) {
    write_file(file.string() + ".svg", report::figure_svg(plot));
    write_file(file.string() + ".pdf", report::figure_pdf(plot));
}

/// Writes a figure of each flight, several where it has many variants, and one of all cells. How many.
std::size_t write_figures(const fs::path& folder, std::span<const SweepCell> cells) {
    const std::vector<std::string> variants = variants_in(cells);
    std::set<std::string> names;
    for (std::size_t begin = 0; begin < cells.size();) {
        std::vector<const SweepCell*> flown;
        std::size_t end = begin;
        for (; end < cells.size() && cells[end].flight() == cells[begin].flight() && flown.size() < max_curves; ++end) {
            flown.push_back(&cells[end]);
        }
        const std::string name = "flight-" + file_label(cells[begin].path + "-" + cells[begin].aircraft);
        std::string free_name = name;
        for (int i = 2; !names.insert(free_name).second; ++i) { free_name = fmt::format("{}-{}", name, i); }
        write_figure(folder / free_name, flight_plot(flown, variants));
        begin = end;
    }
    write_figure(folder / "cells", cells_plot(cells, variants));
    return names.size() + 1;
}

// The archive.

/// Brings the files that a sweep names, and the names themselves, into an archive: files in the sweep file's folder or
/// below keep their place, others come into inputs/.
class ArchiveInputs {
public:
    explicit ArchiveInputs(const fs::path& sweep_file)
        : sweep_file_(absolute_path(sweep_file)), root_(sweep_file_.parent_path()) {}

    /// Throws no Error: what is missing is noted.
    void add_runs(const Sweep& sweep);

    /// The settings with the archive's names.
    settings::RunSettings renamed(settings::RunSettings settings) const;

    /// The sweep file with the archive's names.
    std::string renamed_sweep() const;

    std::map<std::string, fs::path> files; ///< by their names in the archive
    report::ResultTable missing;           ///< files that are not in it

private:
    std::string name_in_archive(const fs::path& file, const fs::path& elsewhere) const {
        const fs::path way = file.lexically_relative(root_);
        return !way.empty() && *way.begin() != ".." ? way.string() : elsewhere.string();
    }

    void add_file(const fs::path& file, const fs::path& elsewhere) {
        const std::string name = name_in_archive(file, elsewhere);
        files.emplace(name, file);
        names_[file.string()] = name;
    }

    void add_missing(const fs::path& file);
    void add_ground(const std::string& text, const std::vector<fs::path>& ground);
    bool rename(settings::RunSettings& settings) const;
    std::optional<std::string> renamed_word(const std::string& key, const std::string& word) const;

    struct Replacement {
        toml::source_region region;
        std::string text;
    };

    void find_words(const toml::node& node, const std::string& key, std::vector<Replacement>& found) const;

    fs::path sweep_file_;
    fs::path root_;
    std::map<std::string, std::string> names_; ///< in the archive, by what settings with absolute names have
    std::set<std::string> known_;              ///< texts of runs, and files, that were added
    int grounds_ = 0;                          ///< that are packed
};

void ArchiveInputs::add_missing(const fs::path& file) {
    if (!known_.insert("missing " + file.string()).second) { return; }
    std::error_code code;
    const auto bytes = fs::file_size(file, code);
    missing.add({{"file", file.string()}, {"bytes", code ? std::string() : fmt::format("{}", bytes)},
        {"hash", code ? std::string() : world::hash_of_file(file)}});
}

/// Adds the files of a terrain or a drape unless they are large. `text` as the settings name them. Files keep their
/// places to each other, because some name others.
void ArchiveInputs::add_ground(const std::string& text, const std::vector<fs::path>& ground) {
    constexpr std::uintmax_t largest_bytes = 20'000'000;
    if (ground.empty() || !known_.insert("ground " + text).second) { return; }
    std::uintmax_t bytes = 0;
    bool is_packed = fs::path(text).is_absolute() && !models::heights::is_subdataset_name(text);
    fs::path base = fs::path(text).parent_path(); // the folder in which all of them lie
    for (const fs::path& each : ground) {
        const fs::path file = absolute_path(each);
        known_.insert("ground file " + file.string());
        std::error_code code;
        bytes += fs::file_size(file, code);
        is_packed = is_packed && !code && bytes <= largest_bytes;
        while (is_packed && *file.lexically_relative(base).begin() == "..") { base = base.parent_path(); }
    }
    if (!is_packed) {
        for (const fs::path& file : ground) { add_missing(absolute_path(file)); }
        return;
    }
    const fs::path folder = fs::path("inputs") / fmt::format("ground-{}", ++grounds_);
    const auto name_of = [&](const fs::path& file) {
        return name_in_archive(file, folder / file.lexically_relative(base));
    };
    for (const fs::path& file : ground) { files.emplace(name_of(absolute_path(file)), file); }
    names_[text] = name_of(text);
}

void ArchiveInputs::add_runs(const Sweep& sweep) {
    std::vector<settings::RunSettings> all;
    std::set<std::string> texts;
    for (const SweepRun& run : sweep.runs) {
        settings::RunSettings settings = run.settings;
        std::string key;
        world::rename_inputs(settings, [&](std::string& text) { key += text + "\n"; });
        if (run.repeat > 1 || !known_.insert(key).second) { continue; }
        try {
            settings = world::with_absolute_paths(settings);
            world::rename_inputs(settings, [&](std::string& text) { texts.insert(text); });
            world::input_files(std::span(&settings, 1));
            add_ground(settings.path.terrain, world::ground_files(settings.path.terrain));
            if (settings.air.drape) {
                add_ground(*settings.air.drape, models::heights::referenced_files(*settings.air.drape));
            }
            all.push_back(std::move(settings));
        } catch (const Error& fault) { missing.add({{"file", fault.what()}, {"bytes", ""}, {"hash", ""}}); }
    }
    for (const world::InputFile& input : world::input_files(all)) {
        const fs::path file = absolute_path(input.file);
        const bool lies_below_root = name_in_archive(file, "") != "";
        if (known_.contains("ground file " + file.string())) { continue; }
        if (input.location == world::FileLocation::BuiltIn && !texts.contains(file.string())) { continue; }
        if (input.location == world::FileLocation::External && !lies_below_root) {
            add_missing(file);
        } else {
            add_file(file, input.name);
        }
    }
}

/// Whether a name changed. `settings` with absolute names.
bool ArchiveInputs::rename(settings::RunSettings& settings) const {
    bool is_changed = false;
    world::rename_inputs(settings, [&](std::string& text) {
        const auto found = names_.find(text);
        if (found == names_.end()) { return; }
        // A name without a folder would be read, and shown, otherwise.
        text = fs::path(found->second).has_parent_path() ? found->second : "./" + found->second;
        is_changed = true;
    });
    return is_changed;
}

settings::RunSettings ArchiveInputs::renamed(settings::RunSettings settings) const {
    try {
        settings = world::with_absolute_paths(std::move(settings));
    } catch (const Error&) { return settings; } // one of those that are missing
    rename(settings);
    if (settings::is_order_cache_folder(settings.surface.order_cache)) {
        settings.surface.order_cache = "inputs/orders";
    }
    return settings;
}

/// A word of the sweep file by the archive's name; nothing where it stays.
std::optional<std::string> ArchiveInputs::renamed_word(const std::string& key, const std::string& word) const {
    settings::RunSettings settings;
    const auto text = [&]() -> std::string {
        if (key == "path") { return settings.path.name; }
        if (key == "aircraft") { return settings.path.aircraft.front(); }
        if (key == "terrain") { return settings.path.terrain; }
        return key == "drape" ? settings.air.drape.value_or("") : settings.path.terrain_system.value_or("");
    };
    constexpr std::array<std::string_view, 5> keys{"path", "aircraft", "terrain", "terrain-system", "drape"};
    if (std::ranges::find(keys, key) == keys.end()) { return std::nullopt; }
    try {
        settings::set_by_name(settings, key, {word});
        settings::resolve_paths_from(root_, settings);
        settings = world::with_absolute_paths(settings);
    } catch (const Error&) { return std::nullopt; }
    if (!rename(settings) || fs::path(text()).lexically_normal() == fs::path(word).lexically_normal()) {
        return std::nullopt;
    }
    return text();
}

void ArchiveInputs::find_words(const toml::node& node, const std::string& key, std::vector<Replacement>& found) const {
    if (const auto* const table = node.as_table()) {
        for (const auto& [name, child] : *table) { find_words(child, std::string(name.str()), found); }
    } else if (const auto* const list = node.as_array()) {
        for (const toml::node& child : *list) { find_words(child, key, found); }
    } else if (const auto word = node.value_exact<std::string>()) {
        if (const auto name = renamed_word(key, *word)) { found.push_back({node.source(), *name}); }
    }
}

/// The byte of a place in a text, whose columns count characters.
std::size_t byte_at(std::string_view text, const toml::source_position& place) {
    std::size_t at = 0;
    for (unsigned line = 1; line < place.line; ++line) { at = text.find('\n', at) + 1; }
    for (unsigned column = 1; column < place.column; ++column) {
        at += std::max<std::size_t>(1, utf8_length(text.substr(at)));
    }
    return at;
}

std::string ArchiveInputs::renamed_sweep() const {
    std::string text = read_text_file(sweep_file_);
    std::vector<Replacement> found;
    const toml::table root = flightpaths::parse_toml(sweep_file_, text);
    for (const char* part : {"settings", "vary"}) {
        if (const toml::node* const node = root.get(part)) { find_words(*node, part, found); }
    }
    const auto place = [](const Replacement& each) {
        return std::pair(each.region.begin.line, each.region.begin.column);
    };
    std::ranges::sort(found, std::ranges::greater(), place);
    for (const Replacement& each : found) {
        std::string quoted = "\"";
        for (const char letter : each.text) {
            if (letter == '"' || letter == '\\') { quoted += '\\'; }
            quoted += letter;
        }
        const std::size_t begin = byte_at(text, each.region.begin);
        text.replace(begin, byte_at(text, each.region.end) - begin, quoted + "\"");
    }
    return text;
}

/// Program and machine of the first run that is done on each machine.
report::ResultTable machines_of(const SweepFolder& folder, std::span<const RunResult> results) {
    report::ResultTable table;
    std::set<std::string> hosts;
    for (const RunResult& result : results) {
        if (!result.done() || !hosts.insert(result.host).second) { continue; }
        for (const auto& [name, value] : report::read_run_file(folder.recording(result.name) / "run.json").machine) {
            table.add({{"machine", result.host}, {"entry", name}, {"value", value}});
        }
    }
    return table;
}

/// README.txt of the archive, at most 15 lines.
std::string readme_of(const Sweep& sweep, const std::string& file, std::span<const RunResult> results, bool is_whole) {
    const auto done = std::ranges::count(results, true, &RunResult::done);
    return fmt::format(
        "{}: {} flights, of which {} are done, flown by Octant {}, commit {}.\n"
        "In this folder the same program flies them again:\n\n"
        "  octant sweep {} --out again --paper\n\n"
        "The columns state_hash and picture_hash of again/sweep.csv must be those of results/sweep.csv.\n"
        "Times depend on the machine; machines.csv describes program and machine of the results.\n"
        "results/  sweep.csv (a line a flight) and the table of the paper as LaTeX, CSV and Markdown\n"
        "jobs/     the settings of each flight, for octant fly --settings jobs/NAME.json\n"
        "inputs/   files that the sweep names and that lay outside its folder\n{}",
        sweep.name, sweep.runs.size(), done, base::program_version(), base::program_commit(), file,
        is_whole
            ? ""
            : "Not in this archive: the files of missing.csv (bytes and Octant's hash). Put them where they were, or "
              "change\ntheir names in the sweep file.\n");
}

void write_archive(const fs::path& zip, const fs::path& sweep_file, const Sweep& sweep, const SweepFolder& folder,
    std::span<const RunResult> results, const ArchiveInputs& inputs) {
    report::ZipWriter writer(zip);
    const std::string file = sweep_file.filename().string();
    const bool is_whole = inputs.missing.rows.empty();
    writer.add("README.txt", readme_of(sweep, file, results, is_whole));
    writer.add(file, inputs.renamed_sweep());
    for (const auto& [name, input] : inputs.files) { writer.add_file(name, input); }
    if (!is_whole) { writer.add("missing.csv", report::csv_of(inputs.missing)); }
    writer.add("machines.csv", report::csv_of(machines_of(folder, results)));
    writer.add_file("results/sweep.csv", folder.path() / "sweep.csv");
    for (const char* table : {"table.tex", "table.csv", "table.md"}) {
        writer.add_file(std::string("results/") + table, folder.path() / "paper" / table);
    }
    for (const SweepRun& run : sweep.runs) {
        writer.add("jobs/" + run.name + ".json", settings::settings_json(inputs.renamed(run.settings)).dump(2) + "\n");
    }
    writer.finish();
}

} // namespace

std::optional<std::pair<double, double>> median_interval(std::span<const double> medians_ms) {
    std::vector<double> logarithms;
    for (const double each_ms : medians_ms) { logarithms.push_back(std::log(each_ms)); }
    const auto centre = report::centre_of(logarithms);
    if (!centre) { return std::nullopt; }
    // The median of the repeats itself lies in it, also where one of them is far off.
    const double median_ms = report::median_of({medians_ms.begin(), medians_ms.end()});
    return std::pair(std::min(std::exp(centre->low), median_ms), std::max(std::exp(centre->high), median_ms));
}

std::vector<std::string> write_paper(
    const fs::path& sweep_file, const Sweep& sweep, const SweepFolder& folder, std::span<const RunResult> results) {
    std::vector<SweepCell> cells = cells_of(sweep, results);
    std::vector<std::string> notes;
    for (SweepCell& cell : cells) {
        std::vector<CountedFrames> repeats;
        for (const std::size_t run : cell.runs) {
            repeats.push_back(counted_frames_of(folder.recording(sweep.runs[run].name)));
        }
        std::erase_if(repeats, [](const CountedFrames& repeat) { return repeat.frame_ms.empty(); });
        if (repeats.empty()) { continue; }
        cell.figures = figures_of(repeats);
        cell.curve = curve_of(repeats);
        cell.legs = report::read_run_file(folder.recording(sweep.runs[cell.runs.front()].name) / "run.json").legs;
    }
    const std::size_t left_out = std::erase_if(cells, [](const SweepCell& cell) { return cell.figures.repeats == 0; });
    if (cells.empty()) { return {"note: --paper writes nothing: no flight is done that has counted frames"}; }
    std::string note = note_of(cells, sweep, results);
    if (left_out > 0) { note += fmt::format(" Cells left out because none of their flights is done: {}.", left_out); }
    const fs::path paper = folder.path() / "paper";
    make_folder(paper);
    const report::ResultTable table = table_of("Frame times of " + sweep.name, cells, note);
    write_file(paper / "table.csv", report::csv_of(table));
    write_file(paper / "table.md", report::markdown_of(std::span(&table, 1)));
    write_file(paper / "table.tex",
        "% \\documentclass{article}\\usepackage{booktabs}\n% \\begin{document}\\input{table}\\end{document}\n" +
            report::latex_of(table));
    const std::size_t figures = write_figures(paper, cells);
    ArchiveInputs inputs(sweep_file);
    inputs.add_runs(sweep);
    const fs::path zip = paper / (sweep.name + ".zip");
    write_archive(zip, sweep_file, sweep, folder, results, inputs);
    notes.push_back(fmt::format("paper: {0}/table.tex, .csv, .md, {1} figures (.svg, .pdf), {2}", paper.string(),
        figures, zip.filename().string()));
    for (const std::vector<report::Cell>& row : inputs.missing.rows) {
        notes.push_back(fmt::format("note: not in {}: {}", zip.filename().string(), row.front().text));
    }
    return notes;
}

} // namespace octant::ui::sweep
