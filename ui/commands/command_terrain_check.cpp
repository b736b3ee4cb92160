#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/read_option.h"
#include "ui/commands/terrain_options.h"
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
    const ui::terrain::TerrainFaults faults = ui::terrain::check_terrain(*maker, asked);
    if (options.json) {
        base::Figures figures;
        figures["views"] = faults.views;
        figures["drawn"] = faults.drawn;
        figures["triangles"] = faults.triangles;
        figures["cracked_views"] = faults.cracked_views;
        figures["open_edges"] = faults.edges.open_edges;
        figures["corners_on_edges"] = faults.edges.corners_on_edges;
        figures["crowded_edges"] = faults.edges.crowded_edges;
        figures["turned_triangles"] = faults.edges.turned_triangles;
        figures["doubled_vertices"] = faults.edges.doubled_vertices;
        figures["key_pixels"] = faults.key_pixels;
        base::print_figures(figures, true);
    } else {
        std::fputs(
            fmt::format(
                "{} views, {} triangles, {} drawn: {} views with faults\n{}\n{} pixels of key "
                "colour inside the ground\n",
                faults.views,
                faults.triangles,
                faults.drawn,
                faults.cracked_views,
                faults.edges.text(),
                faults.key_pixels)
                .c_str(),
            stdout);
    }
    if (faults.cracked_views > 0) {
        throw CheckSaidNo();
    }
}

std::vector<Option> options_of(CheckOptions& options) {
    ui::terrain::TerrainCheck& asked = options.check;
    std::vector<Option> table;
    add_terrain_options(table, options.view);
    add_mesh_options(table, options.mesh);
    table.insert(
        table.end(),
        {read_option({"views", "N", "random views", 1, 1e8}, asked.views),
         read_option({"seed", "S", "another seed, other views", 0, 1e9}, asked.seed),
         read_option({"every", "N", "only every Nth view of them is made", 1, 1e6}, asked.every),
         read_option(
             {"draw-every",
              "N",
              "every Nth view made is drawn over a key colour; 0 = none",
              0,
              1e6},
             asked.draw_every),
         curved_option(options.view.curved),
         flag("--json", "as JSON", options.json),
         flag("--quiet", "no progress", asked.quiet)});
    return table;
}

} // namespace

Command terrain_check_command() {
    auto options = std::make_shared<CheckOptions>();
    return {
        .name = "check",
        .summary =
            "Looks for cracks and holes in the meshes of random views, by edge and by picture",
        .options = options_of(*options),
        .footer = "Exit code 1 when there is a crack or a hole.\n"
                  "Example:\n  octant terrain check canyon --views 10000 --seed 1",
        .run = [options] { check(*options); }};
}

} // namespace octant::ui::commands
