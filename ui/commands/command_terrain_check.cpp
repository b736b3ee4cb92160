#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/commands/command_terrain_measure.h"
#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/terrain/terrain_check.h"
#include "ui/world/loaded_ground.h"
#include "visuals/terrain/ground_query.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace octant::ui::commands {

namespace {

struct CheckOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    ui::terrain::TerrainCheck check;
    bool json = false;
};

void check(const CheckOptions& options) {
    const world::LoadedGround ground =
        world::load_ground(options.view.terrain, options.view.spacing_m);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    ui::terrain::TerrainCheck asked = options.check;
    asked.by_error = options.mesh.mesh == visuals::scene::GroundMetric::ScreenError;
    const ui::terrain::TerrainFaults faults = ui::terrain::check_terrain(*maker, asked);
    if (options.json) {
        nlohmann::ordered_json figures;
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

} // namespace

void add_terrain_check(CLI::App& terrain) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = terrain.add_subcommand(
        "check",
        "Looks for cracks and holes in the meshes of random views, by edge and by picture");
    ui::terrain::add_terrain_argument(*command, options->view);
    ui::terrain::add_mesh_options(*command, options->mesh, false);
    add_number_option(*command, {"views", "N", "random views", 1, 1e8}, options->check.views);
    add_number_option(
        *command, {"seed", "S", "another seed, other views", 0, 1e9}, options->check.seed);
    add_number_option(
        *command,
        {"every", "N", "only every Nth view of them is made", 1, 1e6},
        options->check.every);
    add_number_option(
        *command,
        {"draw-every", "N", "every Nth view made is drawn over a key colour; 0 = none", 0, 1e6},
        options->check.draw_every);
    command->add_flag_callback(
        "--curved",
        [options] { options->check.earth_radius_m = visuals::terrain::earth_radius_m; },
        "lower the ground by d^2 / 2R as it is in flight (screen-error meshes)");
    command->add_flag("--json", options->json, "as JSON");
    command->add_flag("--quiet", options->check.quiet, "no progress");
    command->footer("Exit code 1 when there is a crack or a hole.\n"
                    "Example:\n  octant terrain check canyon --views 10000 --seed 1");
    command->callback([options] { check(*options); });
}

} // namespace octant::ui::commands
