#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/base/results_text.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/terrain_options.h"
#include "ui/terrain/ground_ply.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/terrain/mesh_maker.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>

namespace octant::ui::commands {

namespace {

struct MeshOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::string out;
    bool ascii = false;
    bool json = false;
    bool quiet = false;
};

void write_mesh(MeshOptions options) {
    const visuals::scene::Camera camera = ui::terrain::camera_of(options.view);
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    const visuals::terrain::GroundMesh mesh =
        ui::terrain::mesh_from_options(*maker, ui::terrain::mesh_view(camera, options.view), options.mesh);
    write_file(options.out, ui::terrain::ply_of(mesh, camera.eye_m, options.ascii));
    if (options.json) {
        base::JsonValue results;
        results["file"] = options.out;
        results["triangles"] = mesh.counters.triangles;
        results["vertices"] = mesh.vertices.size();
        results["error_px"] = mesh.error_px;
        results["resolution_c"] = mesh.resolution;
        base::print_value(results, true);
        return;
    }
    base::print_note(options.quiet,
        fmt::format("{}: {} triangles, {} vertices, {}", options.out, mesh.counters.triangles, mesh.vertices.size(),
            mesh.resolution > 0.0 ? fmt::format("C = {:.4g}", mesh.resolution)
                                  : fmt::format("error {:.4g} px", mesh.error_px)));
}

std::vector<Option> options_of(MeshOptions& options) {
    std::vector<Option> table;
    add_terrain_options(table, options.view);
    add_view_options(table, options.view);
    add_mesh_options(table, options.mesh);
    add_detail_options(table, options.mesh);
    table.insert(table.end(), {required(text_option("--out", "FILE.ply", "the file to write", options.out)),
                                  flag("--ascii", "as text; else binary, little endian", options.ascii),
                                  flag("--json", "print what was written as JSON", options.json),
                                  flag("--quiet", "no notes", options.quiet)});
    return table;
}

} // namespace

Command terrain_mesh_command() {
    auto options = std::make_shared<MeshOptions>();
    return {.name = "mesh",
        .summary = "Writes the mesh that is made for one eye point, in world coordinates, as PLY",
        .options = options_of(*options),
        .footer = "Example:\n  octant terrain mesh canyon --eye 0,0,900 --look 3000,2000,300 "
                  "--triangles 20000 --out mesh.ply",
        .run = [options] { write_mesh(*options); }};
}

} // namespace octant::ui::commands
