#include "sim/base/output_file.h"
#include "ui/command_terrain_measure.h"
#include "ui/figures_text.h"
#include "ui/ground_ply.h"
#include "ui/loaded_ground.h"
#include "ui/mesh_maker.h"
#include "ui/progress.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace octant::ui {

namespace {

struct MeshOptions {
    GroundViewOptions view;
    GroundMeshOptions mesh;
    std::string out;
    bool ascii = false;
    bool json = false;
    bool quiet = false;
};

void write_mesh(const MeshOptions& options) {
    const visuals::scene::Camera camera = camera_of(options.view);
    const LoadedGround ground = load_ground(options.view.terrain, options.view.spacing_m);
    const auto maker = make_mesh_maker(ground, options.mesh);
    const visuals::terrain::GroundMesh mesh =
        mesh_as_asked(*maker, mesh_view(camera, options.view), options.mesh);
    write_file(options.out, ply_of(mesh, camera.eye_m, options.ascii));
    if (options.json) {
        nlohmann::ordered_json figures;
        figures["file"] = options.out;
        figures["triangles"] = mesh.counters.triangles;
        figures["vertices"] = mesh.vertices.size();
        figures["error_px"] = mesh.error_px;
        figures["resolution_c"] = mesh.resolution;
        print_figures(figures, true);
        return;
    }
    say(options.quiet,
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
    add_terrain_argument(*mesh, options->view);
    add_view_options(*mesh, options->view);
    add_mesh_options(*mesh, options->mesh, true);
    mesh->add_option("--out", options->out, "the file to write")->type_name("FILE.ply")->required();
    mesh->add_flag("--ascii", options->ascii, "as text; else binary, little endian");
    mesh->add_flag("--json", options->json, "print what was written as JSON");
    mesh->add_flag("--quiet", options->quiet, "no notes");
    mesh->footer("Example:\n  octant terrain mesh canyon --eye 0,0,900 --look 3000,2000,300 "
                 "--triangles 20000 --out mesh.ply");
    mesh->callback([options] { write_mesh(*options); });
}

} // namespace octant::ui
