#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/session.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/studies/draw_order/study_draw_order.h"
#include "ui/studies/draw_order/surface_race.h"

#include <array>
#include <fmt/format.h>
#include <numeric>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

constexpr int frames_left_out = 10; ///< first frames that the figures leave out

/// The ways of table 6, in its order.
constexpr std::array table_modes = {gl_octant, gl_depth_buffer, gl_back_faces};

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
    TimedFlight times;

    /// Of all frames, by the mean of those that count.
    double seconds(std::size_t mode) const {
        const std::vector<double> ms = times.values(mode, &report::FrameRecord::frame_ms);
        return std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size()) * frames / 1000.0;
    }

    double frames_per_second(std::size_t mode) const { return frames / seconds(mode); }
};

settings::RunSettings settings_of(const PrintedTime& row, const StudyOptions& options) {
    settings::RunSettings settings;
    settings.view.size_px = options.settings.view.size_px;
    settings.view.samples = options.settings.view.samples;
    settings.drawing.context = options.settings.drawing.context;
    settings.drawing.renderer = settings::RendererKind::Gl;
    settings.surface.hidden_surface = scene::HiddenSurface::Octant;
    settings.path.aircraft = {row.aircraft};
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

/// Flies a row and records it by octant order. A stop signal ends the recording in order, and the row is measured in
/// part or not at all.
MeasuredRow measure(const PrintedTime& row, const StudyOptions& options, bool quiet) {
    if (base::StopSignals::received()) { return {}; }
    const settings::RunSettings settings = settings_of(row, options);
    const Sessions sessions = timed_sessions(settings);
    flight::Session& octant = *sessions[gl_octant];
    flight::RecordOptions record;
    record.folder = options.out / fmt::format("{}-{}", row.aircraft, row.path);
    flight::FlightRecorder recorder(record, settings, octant);
    const models::polygons::PolygonModel& model = octant.world().scene.models.front()->polygons;
    MeasuredRow measured{model.vertices_m.size(), model.polygons.size(), octant.frames(), {}};
    int frames = 0;
    measured.times = draw_in_turn(sessions, {.frames = measured.frames,
                                                .left_out = frames_left_out,
                                                .name = fmt::format("{} {}", row.aircraft, row.path),
                                                .quiet = quiet,
                                                .after_frame = [&](int, const std::vector<Records>& so_far) {
                                                    // After all ways have drawn, so that none of them draws while the
                                                    // frame is recorded.
                                                    recorder.add(so_far[gl_octant].back(), octant);
                                                    ++frames;
                                                    return !base::StopSignals::received();
                                                }});
    if (frames < measured.frames) {
        recorder.finish(
            octant, fmt::format("{} after {} of {} frames", base::StopSignals::name(), frames, measured.frames));
    } else {
        recorder.finish(octant);
    }
    return measured;
}

constexpr std::size_t table_5_rows = 2;

report::ResultTable table_5(const std::vector<MeasuredRow>& measured) {
    report::ResultTable table{"Table 5: the aircraft alone, 100 frames, by OpenGL"};
    for (std::size_t i = 0; i < table_5_rows; ++i) {
        const PrintedTime& row = printed_times[i];
        const MeasuredRow& m = measured[i];
        table.add({{"aircraft", row.aircraft}, {"vertices", m.vertices}, {"polygons", m.polygons},
            {"paper, s", "{:.1f}", row.octant_s}, {"ours, s", "{:.2f}", m.seconds(gl_octant)},
            {"paper frames/s, octant order", "{:.0f}", row.frames / row.octant_s},
            {"ours frames/s, octant order", "{:.0f}", m.frames_per_second(gl_octant)},
            {"paper frames/s, depth buffer", "{:.0f}", row.depth_buffer_fps},
            {"ours frames/s, depth buffer", "{:.0f}", m.frames_per_second(gl_depth_buffer)},
            {"paper frames/s, back faces only", "{:.0f}", row.back_face_fps},
            {"ours frames/s, back faces only", "{:.0f}", m.frames_per_second(gl_back_faces)}});
    }
    table.note = "An orbit without background. The paper's machine was an IRIS workstation with 12 geometry engines.";
    return table;
}

report::ResultTable table_6(const std::vector<MeasuredRow>& measured, const StudyOptions& options) {
    report::ResultTable table{
        "Table 6: four paths over a background of 60 polygons, one frame a path sample, by OpenGL"};
    for (std::size_t i = table_5_rows; i < printed_times.size(); ++i) {
        const PrintedTime& row = printed_times[i];
        const MeasuredRow& m = measured[i];
        std::vector<report::Cell> cells = {{"aircraft", row.aircraft}, {"path", row.path}, {"frames", m.frames},
            {"paper, s", "{:.1f}", row.octant_s}, {"paper, frames/s", "{:.1f}", row.frames / row.octant_s}};
        for (const std::size_t mode : table_modes) {
            cells.push_back({fmt::format("ours, s, {}", timed_modes[mode].name), "{:.2f}", m.seconds(mode)});
            cells.push_back({fmt::format("frames/s, {}", timed_modes[mode].name), "{:.0f}", m.frames_per_second(mode)});
        }
        cells.push_back({"median: depth buffer / octant", "{:.2f}", over_octant(m.times, gl_depth_buffer)});
        cells.push_back({"median: back faces / octant", "{:.2f}", over_octant(m.times, gl_back_faces)});
        table.add(std::move(cells));
    }
    table.note =
        fmt::format("Ours at {}x{}, mean frame times after a warm-up of 10 frames, times the frames; the three "
                    "methods draw every frame in turn, so that they see the same machine.",
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
    report::Plot plot{
        "Median frame time by flight: 1-2 aircraft alone, 3-6 F-15, 7-10 500MD", "row of the table", "ms", {}, {}, 0.0};
    for (std::size_t k = 0; k < table_modes.size(); ++k) {
        report::PlotSeries series{timed_modes[table_modes[k]].name, colours[k], report::PlotSeries::Style::Points};
        for (std::size_t i = 0; i < measured.size(); ++i) {
            series.x.push_back(static_cast<double>(i + 1));
            series.y.push_back(measured[i].times.median(table_modes[k]));
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

void write_results(const std::vector<MeasuredRow>& measured, const StudyOptions& options) {
    std::vector<NamedFlight> flights;
    std::vector<report::LoadedRecording> recordings;
    for (std::size_t i = 0; i < printed_times.size(); ++i) {
        const PrintedTime& row = printed_times[i];
        flights.push_back({{{"aircraft", row.aircraft}, {"path", row.path}}, measured[i].times});
        recordings.push_back(report::load_recording(options.out / fmt::format("{}-{}", row.aircraft, row.path)));
    }
    Study study(options);
    study.add("table-5", table_5(measured));
    study.add("table-6", table_6(measured, options));
    study.add("raster", raster_table(flights));
    const report::Plot plot = plot_of(measured);
    study.add({&plot, 1}, "Three ways by OpenGL.");
    write_file(options.out / "report.html", report::html_report(recordings, {.first_tables = study.tables()}));
    base::print_note(options.quiet, fmt::format("report: {}/report.html", options.out.string()));
    study.finish("flights");
}

} // namespace

void study_flights(const StudyOptions& options) {
    make_folder(options.out);
    const base::StopSignals stop_signals;
    const std::vector<MeasuredRow> measured = run_cases(
        printed_times, options, [&](const PrintedTime& row, bool quiet) { return measure(row, options, quiet); });
    if (base::StopSignals::received()) { throw base::StoppedBySignal(); }
    write_results(measured, options);
}

} // namespace octant::ui::studies::draw_order
