#include "sim/base/error.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "ui/report/table_text.h"
#include "ui/terrain/error_tables.h"
#include "ui/terrain/eye_points.h"
#include "ui/terrain/loaded_ground.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

struct ErrorOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::optional<double> target_error_px;
    std::string eye_points;
    std::string map;
    bool compare = false;
    bool json = false;
    bool quiet = false;
};

void show_error(ErrorOptions options) {
    if (options.compare && !options.target_error_px) {
        throw Error("--compare: expected --solve PIXELS beside it, got none");
    }
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    ui::terrain::ErrorMeasurement run{options.view, options.mesh, {}, options.target_error_px, options.quiet};
    if (options.eye_points.empty()) {
        run.cameras.push_back(ui::terrain::camera_of(options.view));
    } else {
        const std::string map =
            options.map.empty() ? std::filesystem::path(options.view.terrain).stem().string() : options.map;
        const visuals::terrain::GroundSamples samples = ground.samples();
        for (const ui::terrain::EyePoint& point : ui::terrain::read_eye_points(options.eye_points, map)) {
            run.cameras.push_back(ui::terrain::camera_at(point, samples, options.view.fov_deg));
        }
    }
    std::vector<report::HtmlTable> tables = {ui::terrain::error_table(ground, run)};
    if (options.compare) { tables.push_back(ui::terrain::comparison_table(ground, run)); }
    std::string text;
    for (const report::HtmlTable& table : tables) { text += (text.empty() ? "" : "\n") + report::markdown_of(table); }
    std::fputs((options.json ? report::json_of(tables) : text).c_str(), stdout);
}

std::vector<Option> options_of(ErrorOptions& options) {
    std::vector<Option> table;
    add_terrain_options(table, options.view);
    add_view_options(table, options.view);
    add_mesh_options(table, options.mesh);
    add_detail_options(table, options.mesh);
    table.insert(table.end(),
        {value_option({"solve", "PIXELS", "find the coarsest mesh whose 99.9th percentile is this", 0.001, 1e4},
             options.target_error_px),
            text_option("--eye-points", "FILE", "many views: a table map,x_m,y_m,agl_m,heading_deg,pitch_deg",
                options.eye_points),
            text_option("--map", "NAME", "which rows of the table [the terrain file's stem]", options.map),
            flag("--compare", "with --solve: beside it Roettger's rule, with full and with partial fans",
                options.compare),
            flag("--json", "as JSON", options.json), flag("--quiet", "no progress", options.quiet)});
    return table;
}

} // namespace

Command terrain_error_command() {
    auto options = std::make_shared<ErrorOptions>();
    return {.name = "error",
        .summary = "Measures how far meshes miss the full-resolution ground on the screen",
        .options = options_of(*options),
        .footer = "Example:\n  octant terrain error canyon --eye 0,0,900 --look 3000,2000,300 "
                  "--triangles 20000\n  octant terrain error map.tif --eye-points points.csv "
                  "--solve 1 --compare",
        .run = [options] { show_error(*options); }};
}

} // namespace octant::ui::commands
