#include "ui/studies/draw_order/study_flights.h"

#include "sim/base/output_file.h"
#include "sim/base/thread_pool.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/session.h"
#include "ui/report/html_report.h"
#include "ui/report/html_text.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/plots.h"
#include "ui/report/statistics.h"
#include "ui/studies/draw_order/surface_race.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

constexpr int frames_left_out = 10; ///< first frames that the figures leave out
constexpr std::array compared_methods = {
    scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer, scene::HiddenSurface::BackFace};
constexpr std::array method_names = {"octant order", "depth buffer", "back faces only"};

/// Seconds that the paper printed; 0 where it printed frames a second or nothing.
struct PrintedTime {
    const char* aircraft;
    const char* path; ///< "alone" = table 5
    int frames;
    double octant_s;
    double depth_buffer_fps;
    double back_face_fps;
};

// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989:
// section IV (frames a second by back-face removal and z-buffer), tables 5 and 6.
constexpr std::array printed_times = {PrintedTime{"f15", "alone", 100, 3.3, 5.0, 30.0},
    PrintedTime{"500md", "alone", 100, 3.5, 4.0, 29.0}, PrintedTime{"f15", "straight", 800, 27.5, 0, 0},
    PrintedTime{"f15", "jinking", 700, 24.0, 0, 0}, PrintedTime{"f15", "pop-up", 730, 25.0, 0, 0},
    PrintedTime{"f15", "turn", 580, 19.5, 0, 0}, PrintedTime{"500md", "straight", 800, 29.0, 0, 0},
    PrintedTime{"500md", "jinking", 700, 25.5, 0, 0}, PrintedTime{"500md", "pop-up", 730, 27.0, 0, 0},
    PrintedTime{"500md", "turn", 580, 20.5, 0, 0}};

struct MeasuredRow {
    std::size_t vertices = 0; ///< of the aircraft
    std::size_t polygons = 0;
    int frames = 0;
    std::array<double, compared_methods.size()> seconds{};
    std::array<double, compared_methods.size()> median_ms{};
    RasterTimes raster;
};

settings::RunSettings settings_of(
    const PrintedTime& row, const FlightStudyOptions& options, scene::HiddenSurface method) {
    settings::RunSettings settings;
    settings.view.size_px = options.settings.view.size_px;
    settings.view.samples = options.settings.view.samples;
    settings.drawing.context = options.settings.drawing.context;
    settings.drawing.renderer = settings::RendererKind::Gl; // whose depth buffer is a tuned one
    settings.path.aircraft = {row.aircraft};
    settings.surface.hidden_surface = method;
    settings.time.warm_up = 0;
    settings.time.frame_per_sample = true;
    if (std::string(row.path) == "alone") {
        settings.path.name = "straight";
        settings.path.terrain = "none";
        settings.view.kind = scene::View::Orbit;
        settings.air.sky = false;
        settings.time.frames = row.frames;
        settings.time.frame_per_sample = false;
        settings.time.rate_hz = 2.5; // 40 s of the orbit, which pass through all octants
    } else {
        settings.path.name = row.path;
        settings.path.terrain = "background60";
    }
    return settings;
}

/// Flies a row and records it. A stop signal ends the recording in order, and the row is measured in part or not at
/// all.
MeasuredRow measure(const PrintedTime& row, const FlightStudyOptions& options) {
    if (base::StopSignals::received()) { return {}; }
    std::array<std::unique_ptr<flight::Session>, compared_methods.size()> sessions;
    for (std::size_t m = 0; m < compared_methods.size(); ++m) {
        sessions[m] = std::make_unique<flight::Session>(settings_of(row, options, compared_methods[m]));
    }
    std::vector<std::unique_ptr<flight::Session>> raster_sessions;
    for (const RasterMode& mode : raster_modes) {
        raster_sessions.push_back(raster_session(settings_of(row, options, scene::HiddenSurface::Octant), mode));
    }
    flight::Session& octant = *sessions.front();
    flight::RecordOptions record;
    record.folder = options.out / fmt::format("{}-{}", row.aircraft, row.path);
    flight::FlightRecorder recorder(record, settings_of(row, options, compared_methods.front()), octant);
    MeasuredRow measured;
    const models::polygons::PolygonModel& model = octant.world().scene.models.front()->polygons;
    measured.vertices = model.vertices_m.size();
    measured.polygons = model.polygons.size();
    measured.frames = octant.frames();
    std::array<std::vector<double>, compared_methods.size()> frame_ms;
    base::Progress progress(fmt::format("{} {}", row.aircraft, row.path), measured.frames, options.quiet);
    int frame = 0;
    for (; frame < measured.frames && !(base::StopSignals::received() && frame > 0); ++frame) {
        report::FrameRecord octant_record;
        for (std::size_t turn = 0; turn < compared_methods.size(); ++turn) {
            const std::size_t m = (turn + static_cast<std::size_t>(frame)) % compared_methods.size();
            const report::FrameRecord drawn = sessions[m]->draw(frame);
            frame_ms[m].push_back(drawn.frame_ms);
            if (m == 0) { octant_record = drawn; }
        }
        for (std::size_t turn = 0; turn < raster_modes.size(); ++turn) {
            const std::size_t mode = (turn + static_cast<std::size_t>(frame)) % raster_modes.size();
            const report::FrameRecord drawn = raster_sessions[mode]->draw(frame);
            if (frame >= frames_left_out) { measured.raster.add(mode, drawn); }
        }
        // After all of them, so that no method draws next to the work of recording.
        recorder.add(octant_record, octant);
        progress.show(frame + 1);
    }
    progress.finish();
    if (frame < measured.frames) {
        recorder.finish(
            octant, fmt::format("{} after {} of {} frames", base::StopSignals::name(), frame, measured.frames));
        return measured;
    }
    recorder.finish(octant);
    for (std::size_t m = 0; m < compared_methods.size(); ++m) {
        frame_ms[m].erase(frame_ms[m].begin(), frame_ms[m].begin() + frames_left_out);
        const double mean_ms =
            std::accumulate(frame_ms[m].begin(), frame_ms[m].end(), 0.0) / static_cast<double>(frame_ms[m].size());
        measured.seconds[m] = mean_ms * measured.frames / 1000.0;
        measured.median_ms[m] = report::statistics_of_times(frame_ms[m]).p50_ms;
    }
    return measured;
}

constexpr std::size_t table_5_rows = 2;

std::string seconds_text(double seconds) { return fmt::format("{:.2f}", seconds); }

std::string fps_text(int frames, double seconds) { return fmt::format("{:.0f}", frames / seconds); }

report::HtmlTable table_5(const std::vector<MeasuredRow>& measured) {
    report::HtmlTable table;
    table.title = "Table 5: the aircraft alone, 100 frames, by OpenGL";
    table.header = {"aircraft", "vertices", "polygons", "paper, s", "ours, s"};
    for (const char* method : method_names) {
        table.header.push_back(fmt::format("paper frames/s, {}", method));
        table.header.push_back(fmt::format("ours frames/s, {}", method));
    }
    for (std::size_t i = 0; i < table_5_rows; ++i) {
        const PrintedTime& row = printed_times[i];
        const MeasuredRow& m = measured[i];
        table.add_row("{}\t{}\t{}\t{:.1f}\t{}\t{:.0f}\t{}\t{:.0f}\t{}\t{:.0f}\t{}", row.aircraft, m.vertices,
            m.polygons, row.octant_s, seconds_text(m.seconds[0]), row.frames / row.octant_s,
            fps_text(m.frames, m.seconds[0]), row.depth_buffer_fps, fps_text(m.frames, m.seconds[1]), row.back_face_fps,
            fps_text(m.frames, m.seconds[2]));
    }
    table.note = "An orbit without background. The paper's machine was an IRIS workstation with 12 "
                 "geometry engines.";
    return table;
}

report::HtmlTable table_6(const std::vector<MeasuredRow>& measured, const FlightStudyOptions& options) {
    report::HtmlTable table;
    table.title = "Table 6: four paths over a background of 60 polygons, one frame a path sample, by OpenGL";
    table.header = {"aircraft", "path", "frames", "paper, s", "paper, frames/s"};
    for (const char* method : method_names) {
        table.header.push_back(fmt::format("ours, s, {}", method));
        table.header.push_back(fmt::format("frames/s, {}", method));
    }
    table.header.emplace_back("median: depth buffer / octant");
    table.header.emplace_back("median: back faces / octant");
    for (std::size_t i = table_5_rows; i < printed_times.size(); ++i) {
        const PrintedTime& row = printed_times[i];
        const MeasuredRow& m = measured[i];
        std::vector<std::string> cells = report::cells(
            "{}\t{}\t{}\t{:.1f}\t{:.1f}", row.aircraft, row.path, m.frames, row.octant_s, row.frames / row.octant_s);
        for (const double seconds : m.seconds) {
            cells.push_back(seconds_text(seconds));
            cells.push_back(fps_text(m.frames, seconds));
        }
        report::append_cells(cells, "{:.2f}\t{:.2f}", m.median_ms[1] / m.median_ms[0], m.median_ms[2] / m.median_ms[0]);
        table.rows.push_back(cells);
    }
    table.note =
        fmt::format("Ours at {}x{}, mean frame times after a warm-up of 10 frames, times the frames; the three "
                    "methods draw every frame in turn, so that "
                    "they see the same machine.",
            options.settings.view.size_px.x, options.settings.view.size_px.y);
    if (options.jobs > 1) {
        table.note += fmt::format(" {} flights at once shared the cores: compare no times between rows, nor with those "
                                  "of flights alone.",
            options.jobs);
    }
    return table;
}

report::Plot plot_of(const std::vector<MeasuredRow>& measured) {
    constexpr std::array colours = {"#1f77b4", "#d62728", "#7f7f7f"};
    report::Plot plot;
    plot.title = "Median frame time by flight: 1-2 aircraft alone, 3-6 F-15, 7-10 500MD";
    plot.x_label = "row of the table";
    plot.y_label = "ms";
    plot.y_min = 0.0;
    for (std::size_t m = 0; m < compared_methods.size(); ++m) {
        report::PlotSeries series;
        series.name = method_names[m];
        series.colour = colours[m];
        for (std::size_t i = 0; i < measured.size(); ++i) {
            series.x.push_back(static_cast<double>(i + 1));
            series.y.push_back(measured[i].median_ms[m]);
        }
        plot.series.push_back(series);
    }
    return plot;
}

report::HtmlTable raster_times(const std::vector<MeasuredRow>& measured) {
    std::vector<std::vector<std::string>> names;
    std::vector<RasterTimes> times;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        names.push_back({printed_times[i].aircraft, printed_times[i].path});
        times.push_back(measured[i].raster);
    }
    return raster_table({"aircraft", "path"}, names, times);
}

void write_results(const std::vector<MeasuredRow>& measured, const FlightStudyOptions& options) {
    report::StudyTables tables(options);
    tables.add("table-5", table_5(measured));
    tables.add("table-6", table_6(measured, options));
    tables.add("raster", raster_times(measured));
    tables.finish("flights", tables.markdown());
    if (const auto svg = report::plot_svg(plot_of(measured))) {
        write_file(options.out / "flights.svg", *svg);
    } else {
        base::print_note(options.quiet, "flights.svg not made: gnuplot is not installed");
    }
    std::vector<report::LoadedRecording> recordings;
    for (const PrintedTime& row : printed_times) {
        recordings.push_back(report::load_recording(options.out / fmt::format("{}-{}", row.aircraft, row.path)));
    }
    write_file(options.out / "report.html", report::html_report(recordings, tables.tables()));
    base::print_note(
        options.quiet, fmt::format("tables: {0}/flights.md, {0}/table-5.csv, {0}/table-6.csv, {0}/raster.csv; report: "
                                   "{0}/report.html",
                           options.out.string()));
}

} // namespace

void study_flights(const FlightStudyOptions& options) {
    make_folder(options.out);
    FlightStudyOptions of_row = options;
    of_row.quiet = options.quiet || options.jobs > 1; // progress of one at a time only
    std::vector<MeasuredRow> measured(printed_times.size());
    const base::StopSignals stop_signals;
    parallel_for(printed_times.size(), options.jobs,
        [&](std::size_t row, std::size_t /*worker*/) { measured[row] = measure(printed_times[row], of_row); });
    if (base::StopSignals::received()) { throw base::StoppedBySignal(); }
    write_results(measured, options);
}

} // namespace octant::ui::studies::draw_order
