#include "ui/base/progress.h"
#include "ui/base/results_text.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/terrain/terrain_check.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace octant::ui::commands {

namespace {

struct CheckOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    ui::terrain::TerrainCheck check;
    bool json = false;
};

void check(CheckOptions options) {
    const terrain::LoadedGround ground = terrain::load_ground(options.view);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    ui::terrain::TerrainCheck asked = options.check;
    asked.earth_radius_m = options.view.earth_radius_m;
    asked.by_error = options.mesh.mesh == visuals::scene::GroundMetric::ScreenError;
    const ui::terrain::TerrainCheckResult check_result = ui::terrain::check_terrain(*maker, asked);
    if (options.json) {
        base::JsonValue results;
        results["views"] = check_result.views;
        results["drawn"] = check_result.drawn;
        results["triangles"] = check_result.triangles;
        results["cracked_views"] = check_result.cracked_views;
        results["open_edges"] = check_result.edges.open_edges;
        results["corners_on_edges"] = check_result.edges.t_junctions;
        results["crowded_edges"] = check_result.edges.overlapping_edges;
        results["turned_triangles"] = check_result.edges.inverted_triangles;
        results["doubled_vertices"] = check_result.edges.duplicate_vertices;
        results["key_pixels"] = check_result.key_pixels;
        base::print_value(results, true);
    } else {
        std::fputs(fmt::format("{} views, {} triangles, {} drawn: {} views with faults\n{}\n{} pixels of key "
                               "colour inside the ground\n",
                       check_result.views, check_result.triangles, check_result.drawn, check_result.cracked_views,
                       check_result.edges.text(), check_result.key_pixels)
                       .c_str(),
            stdout);
    }
    if (check_result.cracked_views > 0) { throw CheckFailed(); }
}

std::vector<Option> options_of(CheckOptions& options) {
    ui::terrain::TerrainCheck& asked = options.check;
    std::vector<Option> table;
    add_terrain_options(table, options.view);
    add_mesh_options(table, options.mesh);
    table.insert(table.end(),
        {value_option({"views", "N", "random views", 1, 1e8}, asked.views),
            value_option({"seed", "S", "another seed, other views", 0, 1e9}, asked.seed),
            value_option({"every", "N", "only every Nth view of them is made", 1, 1e6}, asked.every),
            value_option({"draw-every", "N", "every Nth view made is drawn over a key colour; 0 = none", 0, 1e6},
                asked.draw_every),
            curved_option(options.view.curved), flag("--json", "as JSON", options.json),
            flag("--quiet", "no progress", asked.quiet)});
    return table;
}

} // namespace

Command terrain_check_command() {
    auto options = std::make_shared<CheckOptions>();
    return {.name = "check",
        .summary = "Looks for cracks and holes in the meshes of random views, by edge and by picture",
        .options = options_of(*options),
        .footer = "Exit code 1 when there is a crack or a hole.\n"
                  "Example:\n  octant terrain check canyon --views 10000 --seed 1",
        .run = [options] { check(*options); }};
}

} // namespace octant::ui::commands
