#pragma once

#include "sim/base/thread_pool.h"
#include "ui/base/output_options.h"
#include "ui/flight/session.h"
#include "ui/report/plots.h"
#include "ui/report/png_file.h"
#include "ui/report/statistics.h"
#include "ui/report/table.h"
#include "ui/settings/settings.h"
#include "visuals/raster/renderer.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies {

/// Options of studies that fly.
struct StudyOptions : base::StudyOutput {
    settings::RunSettings settings = settings::measurement_settings();
    int jobs = 1; ///< cases at once; above 1 their frame times depend on each other
};

/// What a study writes into its folder: each table as CSV, each picture as PNG, the tables with their pictures as one
/// Markdown page, and all of it with plots as one HTML page, which any browser shows.
class Study {
public:
    /// Makes the folder. Throws Error.
    explicit Study(base::StudyOutput output);

    /// Adds a table and writes it as FILE.csv; `file` has no ending. Throws Error.
    void add(const std::string& file, report::ResultTable table);

    /// Adds plots with one text below them.
    void add(std::span<const report::Plot> plots, const std::string& caption);

    /// Adds a picture with a text below it and writes it as FILE. Throws Error.
    void add(const std::string& file, const report::PixelView& picture, const std::string& caption);

    const std::vector<report::ResultTable>& tables() const { return tables_; }

    /// Writes PAGE.md and PAGE.html, prints the tables as Markdown or JSON, and says where everything is. The
    /// `introduction`, Markdown, comes before the tables. Throws Error.
    void finish(const std::string& page, const std::string& introduction = "") const;

private:
    base::StudyOutput output_;
    std::vector<report::ResultTable> tables_;
    std::string plots_html_;
    std::string pictures_html_;
    std::string pictures_markdown_;
};

/// Calls `run(case, quiet)` for each case, `options.jobs` at once, and returns the results in the order of the cases.
/// Cases that run at once are quiet, because their progress lines would overwrite one another.
template <class Cases, class Run>
auto run_cases(const Cases& cases, const StudyOptions& options, const Run& run) {
    std::vector<decltype(run(*cases.begin(), true))> results(cases.size());
    parallel_for(cases.size(), options.jobs,
        [&](std::size_t i, std::size_t /*worker*/) { results[i] = run(cases[i], options.quiet || options.jobs > 1); });
    return results;
}

/// A way to draw a flight.
struct DrawingMode {
    const char* name;
    settings::RendererKind renderer;
    visuals::scene::HiddenSurface hidden_surface = visuals::scene::HiddenSurface::Octant;
    int samples = 1; ///< a pixel; 0: as the settings say
    visuals::raster::Renderer::PaintDirection paint_direction = visuals::raster::Renderer::PaintDirection::NearToFar;
};

/// The run, drawn in that way. Throws Error.
std::unique_ptr<flight::Session> session_of(settings::RunSettings settings, const DrawingMode& mode);

using Sessions = std::vector<std::unique_ptr<flight::Session>>;
using Records = std::vector<report::FrameRecord>; ///< of one session, by frame

/// Median by nearest rank; 0 of no values.
double median_of(std::vector<double> values);

/// One value of all records but the first `left_out`.
template <class Value>
std::vector<double> values_of(const Records& records, Value report::FrameRecord::*value, int left_out) {
    std::vector<double> values;
    for (auto i = static_cast<std::size_t>(left_out); i < records.size(); ++i) {
        values.push_back(static_cast<double>(records[i].*value));
    }
    return values;
}

/// A flight drawn in several ways.
struct TimedFlight {
    std::vector<Records> records; ///< by way
    int left_out = 0;             ///< frames at the beginning that do not count

    /// Of the frames that count.
    template <class Value = double>
    std::vector<double> values(std::size_t way, Value report::FrameRecord::*value) const {
        return values_of(records[way], value, left_out);
    }

    template <class Value = double>
    double median(std::size_t way, Value report::FrameRecord::*value = &report::FrameRecord::frame_ms) const {
        return median_of(values(way, value));
    }
};

struct DrawInTurnOptions {
    int frames = 0;
    int left_out = 0;
    std::string name = {}; ///< of the progress line
    bool quiet = true;     ///< no progress line
    /// Called with all records so far after each frame of all; returns false to stop. Empty: goes on.
    std::function<bool(int frame, const std::vector<Records>& so_far)> after_frame = {};
};

/// Draws the first frames of all sessions. The sessions draw each frame in turn, and another one begins each time, so
/// that load from other programs affects all of them.
TimedFlight draw_in_turn(const Sessions& sessions, const DrawInTurnOptions& options);

} // namespace octant::ui::studies
