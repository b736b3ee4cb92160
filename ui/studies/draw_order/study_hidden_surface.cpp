#include "ui/studies/draw_order/study_hidden_surface.h"

#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/flight/id_comparison.h"
#include "ui/report/table_text.h"
#include "ui/studies/draw_order/ray_comparison.h"
#include "ui/studies/draw_order/surface_race.h"
#include "ui/studies/draw_order/view_comparisons.h"
#include "ui/world/world.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

constexpr std::array views = {
    StudiedView{scene::View::Chase, "chase"},
    StudiedView{scene::View::Tower, "tower"},
    StudiedView{scene::View::Tower, "behind ridges", true},
    StudiedView{scene::View::Orbit, "orbit"}};
constexpr StudiedView cockpit{scene::View::Cockpit, "cockpit"};

ComparisonFlights aircraft_shown_by(const HiddenSurfaceStudyOptions& study) {
    return {
        study.settings,
        study.aircraft.empty() ? std::vector<std::string>{"f15", "500md"}
                               : std::vector<std::string>{study.aircraft},
        study.every,
        study.jobs,
        study.quiet};
}

std::vector<Race> run_races(const HiddenSurfaceStudyOptions& study) {
    std::vector<Race> races;
    for (const glm::ivec2 size_px : {glm::ivec2(640, 480), glm::ivec2(1280, 720)}) {
        for (const std::string& terrain :
             {std::string("background60"), study.settings.path.terrain}) {
            for (const std::size_t aircraft : {1U, 16U, 100U, 1000U}) {
                settings::RunSettings settings = study.settings;
                settings.path.name = "straight";
                settings.path.terrain = terrain;
                settings.path.aircraft.assign(aircraft, "f15");
                settings.view.size_px = size_px;
                races.push_back(race(settings, study.race_frames, study.quiet));
            }
        }
    }
    return races;
}

report::HtmlTable race_table(const std::vector<Race>& races) {
    report::HtmlTable table;
    table.title =
        "Frames a second by OpenGL: octant order, removal of back faces only, depth buffer";
    table.header = {
        "scene",
        "aircraft",
        "size",
        "octant, frames/s",
        "back faces, frames/s",
        "depth buffer, frames/s",
        "octant / back faces",
        "octant / depth buffer",
        "p99 ms octant",
        "p99 ms back faces",
        "p99 ms depth buffer",
        "draw calls octant",
        "draw calls back faces",
        "draw calls depth buffer"};
    for (const Race& r : races) {
        std::vector<std::string> cells = {
            short_name(r.scene),
            fmt::format("{}", r.aircraft),
            fmt::format("{}x{}", r.width_px, r.height_px)};
        for (const RaceTimes& mode : r.gl_times) {
            cells.push_back(fmt::format("{:.0f}", 1000.0 / mode.median_ms));
        }
        cells.push_back(fmt::format("{:.2f}", r.against(1)));
        cells.push_back(fmt::format("{:.2f}", r.against(2)));
        for (const RaceTimes& mode : r.gl_times) {
            cells.push_back(fmt::format("{:.2f}", mode.p99_ms));
        }
        for (const RaceTimes& mode : r.gl_times) {
            cells.push_back(fmt::format("{}", mode.draw_calls));
        }
        table.rows.push_back(std::move(cells));
    }
    table.note = "Whole frames from simulation to pixels read, medians; the three ways draw every "
                 "frame in turn. Same culling, vertex format and shaders.";
    return table;
}

report::HtmlTable raster_times(const std::vector<Race>& races) {
    std::vector<std::vector<std::string>> names;
    std::vector<RasterTimes> times;
    for (const Race& r : races) {
        names.push_back(
            {short_name(r.scene),
             fmt::format("{}", r.aircraft),
             fmt::format("{}x{}", r.width_px, r.height_px)});
        times.push_back(r.raster);
    }
    return raster_table({"scene", "aircraft", "size"}, names, times);
}

std::vector<std::string>
cells_of(std::vector<std::string> name, const flight::IdComparison& result) {
    name.push_back(fmt::format("{}", result.frames));
    name.push_back(fmt::format("{}", result.frames_with_cuts));
    name.push_back(fmt::format("{}", result.cuts));
    name.push_back(fmt::format("{}", result.unordered));
    name.push_back(fmt::format("{}", result.pixels));
    name.push_back(fmt::format("{}", result.differing));
    name.push_back(fmt::format("{}", result.unmatched));
    name.push_back(fmt::format("{}", result.wrong));
    return name;
}

report::HtmlTable picture_table(
    const std::vector<NamedResult<flight::IdComparison>>& compared, const HiddenSurfaceStudyOptions& study) {
    report::HtmlTable table;
    table.title = "Polygon numbers: octant order against the depth buffer";
    table.header = {
        "path",
        "aircraft",
        "view",
        "frames",
        "frames with cuts",
        "cuts",
        "unordered",
        "pixels",
        "differing",
        "apart",
        "wrong"};
    flight::IdComparison sum;
    for (const NamedResult<flight::IdComparison>& run : compared) {
        table.rows.push_back(cells_of(run.name, run.result));
        sum.frames += run.result.frames;
        sum.frames_with_cuts += run.result.frames_with_cuts;
        sum.cuts += run.result.cuts;
        sum.unordered += run.result.unordered;
        sum.pixels += run.result.pixels;
        sum.differing += run.result.differing;
        sum.unmatched += run.result.unmatched;
        sum.wrong += run.result.wrong;
    }
    table.rows.push_back(cells_of({"all", "", ""}, sum));
    table.note = fmt::format(
        "Every frame number {} of each flight over {}, {}x{}. Apart: the pixel's polygon does not "
        "occur in the 3 x 3 pixels around it in the picture by depth buffer. Wrong: nor in the "
        "same "
        "place of one three times as large, which shows what the rounding of corners to 1/256 "
        "pixel "
        "lost in the first. Cuts: ground triangles and aircraft polygons painted once more in "
        "front of an aircraft, cut to its outline.",
        study.every,
        short_name(study.settings.path.terrain),
        study.settings.view.size_px.x,
        study.settings.view.size_px.y);
    return table;
}

std::vector<NamedResult<RayComparison>> run_ray_comparisons(const HiddenSurfaceStudyOptions& study) {
    std::vector<StudiedView> all(views.begin(), views.end());
    all.push_back(cockpit);
    return run_comparisons(
        aircraft_shown_by(study),
        all,
        [&](const settings::RunSettings& settings,
            const flight::ComparisonWorlds& worlds,
            int every,
            const auto& on_frame) {
            RayComparison result = compare_with_rays(settings, worlds, every, on_frame);
            for (const RayComparison::OfRenderer& one : result.renderers) {
                if (one.wrong > 0) {
                    base::print_note(
                        study.quiet,
                        fmt::format("{} wrong pixels, the first: {}", one.wrong, one.first_wrong));
                }
            }
            return result;
        });
}

report::HtmlTable
ray_table(const std::vector<NamedResult<RayComparison>>& compared, const HiddenSurfaceStudyOptions& study) {
    report::HtmlTable table;
    table.title = "Polygon numbers: octant order against a ray through each pixel's middle";
    table.header = {
        "path",
        "aircraft",
        "view",
        "pictures",
        "pixels of a renderer",
        "raster: differing",
        "raster: wrong",
        "OpenGL: differing",
        "OpenGL: wrong",
        "first wrong"};
    const auto add_row = [&](std::vector<std::string> cells, const RayComparison& result) {
        cells.push_back(fmt::format("{}", result.frames));
        cells.push_back(fmt::format("{}", result.pixels));
        std::string first_wrong;
        for (const RayComparison::OfRenderer& one : result.renderers) {
            cells.push_back(fmt::format("{}", one.differing));
            cells.push_back(fmt::format("{}", one.wrong));
            first_wrong = first_wrong.empty() ? one.first_wrong : first_wrong;
        }
        cells.push_back(first_wrong);
        table.rows.push_back(std::move(cells));
    };
    RayComparison sum;
    for (const NamedResult<RayComparison>& run : compared) {
        add_row(run.name, run.result);
        sum.add(run.result);
    }
    add_row({"all", "", ""}, sum);
    table.note = fmt::format(
        "Every frame number {} of each flight over {}, {}x{}, one sample a pixel. Rays meet all "
        "triangles in double precision, without order. Wrong: no rounding explains what is shown: "
        "nothing of that number comes within {:.3f} pixel of the pixel's middle, or all of that "
        "neighbourhood lies behind nearer triangles. Rounding is also what it is where the pieces, "
        "painted in their order without it, show what the ray finds, and sides of the piece shown "
        "and of all painted over it there pass within that distance.",
        study.every,
        short_name(study.settings.path.terrain),
        study.settings.view.size_px.x,
        study.settings.view.size_px.y,
        rounding_reach_px);
    return table;
}

} // namespace

bool study_hidden_surface(const HiddenSurfaceStudyOptions& study) {
    world::load_world(study.settings); // says what is wrong with them before there is a folder
    make_folder(study.out);
    std::vector<report::HtmlTable> tables;
    bool right = true;
    if (study.race) {
        const std::vector<Race> races = run_races(study);
        tables.push_back(race_table(races));
        write_file(study.out / "frames-per-second.csv", report::csv_of(tables.back()));
        tables.push_back(raster_times(races));
        write_file(study.out / "raster.csv", report::csv_of(tables.back()));
    }
    if (study.pictures) {
        const auto compared =
            run_comparisons(aircraft_shown_by(study), views, flight::compare_with_depth_buffer);
        for (const auto& run : compared) {
            right = right && run.result.wrong == 0;
        }
        tables.push_back(picture_table(compared, study));
        write_file(study.out / "pictures.csv", report::csv_of(tables.back()));
    }
    if (study.rays) {
        const auto compared = run_ray_comparisons(study);
        for (const auto& run : compared) {
            right = right && run.result.wrong() == 0;
        }
        tables.push_back(ray_table(compared, study));
        write_file(study.out / "rays.csv", report::csv_of(tables.back()));
    }
    std::string markdown;
    for (const report::HtmlTable& table : tables) {
        markdown += (markdown.empty() ? "" : "\n") + report::markdown_of(table);
    }
    write_file(study.out / "hidden-surface.md", markdown);
    std::fputs((study.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::print_note(study.quiet, fmt::format("tables: {}/hidden-surface.md", study.out.string()));
    return right;
}

} // namespace octant::ui::studies::draw_order
