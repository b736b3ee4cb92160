#include "ui/studies/draw_order/study_draw_order.h"

#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/report/table_text.h"
#include "ui/studies/draw_order/order_tables.h"
#include "ui/studies/draw_order/surface_race.h"

#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace {

namespace scene = visuals::scene;

/// Frames a second of each aircraft alone, as printed.
struct PaperRow {
    const char* aircraft;
    double back_face_fps;
    double depth_buffer_fps;
    double octant_fps; ///< 100 frames in 3.3 and 3.5 s
};

// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time
// Animation", 1989: table 1; octant order: section IV and table 5.
constexpr std::array paper_rows = {
    PaperRow{"f15", 30.0, 5.0, 100.0 / 3.3}, PaperRow{"500md", 29.0, 4.0, 100.0 / 3.5}};

/// An aircraft on an orbit around it, without sky and ground.
Race race_alone(const char* aircraft, bool quiet) {
    constexpr int frames = 200;
    settings::RunSettings settings;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = "none";
    settings.view.kind = scene::View::Orbit;
    settings.air.sky = false;
    settings.time.rate_hz = 5.0;
    return race(settings, frames, quiet);
}

report::HtmlTable speed_table(bool quiet) {
    report::HtmlTable table;
    table.title = "Table 1: frames a second, the aircraft alone";
    table.header = {
        "aircraft",
        "paper: back faces only",
        "paper: z-buffer",
        "paper: octant order",
        "ours: back faces only",
        "ours: depth buffer",
        "ours: octant order",
        "octant / back faces",
        "octant / depth buffer"};
    for (const PaperRow& row : paper_rows) {
        const Race raced = race_alone(row.aircraft, quiet);
        const auto fps = [&](std::size_t mode) {
            return fmt::format("{:.0f}", 1000.0 / raced.gl_times[mode].median_ms);
        };
        table.rows.push_back(
            {row.aircraft,
             fmt::format("{:.0f}", row.back_face_fps),
             fmt::format("{:.0f}", row.depth_buffer_fps),
             fmt::format("{:.0f}", row.octant_fps),
             fps(1),
             fps(2),
             fps(0),
             fmt::format("{:.2f}", raced.against(1)),
             fmt::format("{:.2f}", raced.against(2))});
    }
    table.note = "Ours: an orbit at 1280x720, medians of whole frames; the three ways draw every "
                 "frame in turn. More aircraft and ground: octant study hidden-surface.";
    return table;
}

} // namespace

void study_draw_order(const DrawOrderStudyOptions& options) {
    make_folder(options.out);
    std::vector<OrderedByEachMethod> models;
    for (const char* name : {"f15", "500md", "concave"}) {
        base::print_note(options.quiet, fmt::format("ordering {} by octants, cells and tree", name));
        models.push_back(order_by_each_method(name));
    }
    std::vector<std::string> files;
    std::vector<report::HtmlTable> tables;
    const auto add = [&](const char* file, report::HtmlTable table) {
        base::print_note(options.quiet, fmt::format("{}: {}", file, table.title));
        files.emplace_back(file);
        tables.push_back(std::move(table));
    };
    add("table-1", speed_table(options.quiet));
    add("table-4", paper_order_table());
    add("methods", method_table(models));
    add("wrong-pixels", wrong_pixel_table(models));
    add("bsp", bsp_table(models));
    std::string markdown;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        write_file(options.out / (files[i] + ".csv"), report::csv_of(tables[i]));
        markdown += (i == 0 ? "" : "\n") + report::markdown_of(tables[i]);
    }
    write_file(options.out / "draw-order.md", markdown);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::print_note(
        options.quiet,
        fmt::format("tables: {0}/draw-order.md and one .csv each", options.out.string()));
}

} // namespace octant::ui::studies::draw_order
