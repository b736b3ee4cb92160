#include "sim/base/output_file.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/commands/command_terrain_measure.h"
#include "ui/terrain/ground_ply.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/world/loaded_ground.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
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

void write_mesh(const MeshOptions& options) {
    const visuals::scene::Camera camera = ui::terrain::camera_of(options.view);
    const world::LoadedGround ground =
        world::load_ground(options.view.terrain, options.view.spacing_m);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    const visuals::terrain::GroundMesh mesh = ui::terrain::mesh_as_asked(
        *maker, ui::terrain::mesh_view(camera, options.view), options.mesh);
    write_file(options.out, ui::terrain::ply_of(mesh, camera.eye_m, options.ascii));
    if (options.json) {
        nlohmann::ordered_json figures;
        figures["file"] = options.out;
        figures["triangles"] = mesh.counters.triangles;
        figures["vertices"] = mesh.vertices.size();
        figures["error_px"] = mesh.error_px;
        figures["resolution_c"] = mesh.resolution;
        base::print_figures(figures, true);
        return;
    }
    base::say(
        options.quiet,
        fmt::format(
            "{}: {} triangles, {} vertices, {}",
            options.out,
            mesh.counters.triangles,
            mesh.vertices.size(),
            mesh.resolution > 0.0 ? fmt::format("C = {:.4g}", mesh.resolution)
                                  : fmt::format("error {:.4g} px", mesh.error_px)));
}

} // namespace

void add_terrain_mesh(CLI::App& terrain) {
    auto options = std::make_shared<MeshOptions>();
    CLI::App* mesh = terrain.add_subcommand(
        "mesh", "Writes the mesh that is made for one eye point, in world coordinates, as PLY");
    ui::terrain::add_terrain_argument(*mesh, options->view);
    ui::terrain::add_view_options(*mesh, options->view);
    ui::terrain::add_mesh_options(*mesh, options->mesh, true);
    mesh->add_option("--out", options->out, "the file to write")->type_name("FILE.ply")->required();
    mesh->add_flag("--ascii", options->ascii, "as text; else binary, little endian");
    mesh->add_flag("--json", options->json, "print what was written as JSON");
    mesh->add_flag("--quiet", options->quiet, "no notes");
    mesh->footer("Example:\n  octant terrain mesh canyon --eye 0,0,900 --look 3000,2000,300 "
                 "--triangles 20000 --out mesh.ply");
    mesh->callback([options] { write_mesh(*options); });
}

} // namespace octant::ui::commands
