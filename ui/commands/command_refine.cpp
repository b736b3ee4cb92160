#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/units.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/settings/read_option.h"
#include "ui/settings/settings_text.h"
#include "ui/world/refine_input.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/partition_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/refine_region.h"

#include <glm/geometric.hpp>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace octant::ui::commands {

namespace refine = visuals::refine;

namespace {

using Json = nlohmann::ordered_json;
using RegionWords = std::tuple<std::string, double, double, double, double>;

struct RefineOptions {
    world::RefineInput input;
    int base = 0;
    int vertices = 0; ///< 0: all
    std::string save;
    std::vector<RegionWords> regions;
    double error_px = 0.0; ///< 0: no view
    std::optional<glm::dvec3> eye_m;
    std::optional<glm::dvec3> look_m;
    double fov_deg = 50.0;
    glm::ivec2 size_px{1280, 720};
    std::string rule = "selective";
    bool no_repair = false;
    std::string out;
    std::string nodes;
    std::string partition;
    std::string colour_by = "none";
    bool json = false;
};

std::vector<refine::Sphere> spheres_of(const RefineOptions& options) {
    std::vector<refine::Sphere> spheres;
    for (const auto& [kind, x, y, z, radius] : options.regions) {
        if (kind != "sphere") {
            throw Error(
                fmt::format("--region: expected sphere X Y Z RADIUS, got '{}'", printable(kind)));
        }
        const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
        if (!finite || !std::isfinite(radius) || radius < 0.0) {
            throw Error("--region: expected finite numbers and a radius of at least 0");
        }
        spheres.push_back({{x, y, z}, radius});
    }
    return spheres;
}

refine::RefineView view_of(const RefineOptions& options) {
    const glm::dvec3& eye_m = *options.eye_m;
    const glm::dvec3& look_m = *options.look_m;
    const double away_m = glm::distance(eye_m, look_m);
    if (!(away_m > 0.0)) {
        throw Error("--look: expected another point than --eye");
    }
    const glm::dvec3 ahead = (look_m - eye_m) / away_m;
    const glm::dvec3 up =
        std::abs(ahead.z) > 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return refine::picture_view(
        eye_m, look_m, up, rad_from_deg(options.fov_deg), options.size_px.x, options.size_px.y);
}

refine::SplitRule rule_of(const std::string& name) {
    return name == "hoppe" ? refine::SplitRule::Hoppe
           : name == "xia" ? refine::SplitRule::Xia
                           : refine::SplitRule::Selective;
}

/// One line a vertex of the mesh: its node, then the original vertices below it.
std::string nodes_text(const refine::ActiveMesh& active) {
    std::string text = "# octant active nodes 1\n"
                       "# line by line the vertices of the active mesh: number of the node, then "
                       "the original vertices below it; all from 0\n";
    for (std::size_t vertex = 0; vertex < active.nodes.size(); ++vertex) {
        text += fmt::format("{}", active.nodes[vertex]);
        for (const std::uint32_t original : active.originals[vertex]) {
            text += fmt::format(" {}", original);
        }
        text += "\n";
    }
    return text;
}

visuals::refine::ColourBy colour_by(const RefineOptions& options) {
    return options.colour_by == "region"  ? visuals::refine::ColourBy::Region
           : options.colour_by == "level" ? visuals::refine::ColourBy::Level
                                          : visuals::refine::ColourBy::Nothing;
}

void write_results(const refine::SelectiveRefiner& refiner, const RefineOptions& options) {
    if (!options.partition.empty()) {
        const bool by_level = options.colour_by == "level";
        models::meshfile::write_mesh(
            options.partition,
            visuals::refine::partition_mesh(
                refiner,
                by_level ? visuals::refine::ColourBy::Level : visuals::refine::ColourBy::Region));
        base::say(options.input.quiet, "partition: " + options.partition);
    }
    if (options.out.empty() && options.nodes.empty()) {
        return;
    }
    const refine::ActiveMesh active = refine::active_mesh(refiner);
    if (!options.out.empty()) {
        models::meshfile::write_mesh(
            options.out, visuals::refine::coloured_active(active, colour_by(options)));
        base::say(options.input.quiet, "active mesh: " + options.out);
    }
    if (!options.nodes.empty()) {
        write_file(options.nodes, nodes_text(active));
        base::say(options.input.quiet, "active nodes: " + options.nodes);
    }
}

/// Splits what is asked for; adds to the figures.
void refine_all(
    refine::SelectiveRefiner& refiner,
    const RefineOptions& options,
    const std::vector<refine::Sphere>& spheres,
    const std::optional<refine::RefineView>& view,
    Json& figures) {
    const base::Stopwatch watch;
    refine::refine_regions(refiner, spheres);
    if (view) {
        refine::refine_for_view(refiner, *view, options.error_px);
    }
    const refine::RefinerCounts& counts = refiner.counts();
    figures["requested_splits"] = counts.splits - counts.forced_by_rule;
    figures["forced_by_rule"] = counts.forced_by_rule;
    figures["turned_faces_before_repair"] = refiner.turned_faces();
    refiner.repair();
    figures["forced_by_repair"] = counts.forced_by_repair;
    figures["turned_faces"] = refiner.turned_faces();
    figures["vertices"] = refiner.active_count();
    figures["faces"] = refiner.face_count();
    figures["refine_ms"] = watch.ms();
}

void check_mesh_name(const char* option, const std::string& file) {
    if (!file.empty() && !models::meshfile::is_mesh_file(file)) {
        throw Error(fmt::format(
            "{}: expected a mesh file such as mesh.obj or mesh.ply, got '{}'",
            option,
            printable(file)));
    }
}

void refine_mesh(RefineOptions options) {
    options.input.base = static_cast<std::size_t>(options.base);
    if (options.vertices > 0) {
        options.input.most_vertices = static_cast<std::size_t>(options.vertices);
    }
    const std::vector<refine::Sphere> spheres = spheres_of(options);
    if ((options.error_px > 0.0) != options.eye_m.has_value() ||
        options.eye_m.has_value() != options.look_m.has_value()) {
        throw Error(fmt::format(
            "--error-px, --eye, --look: expected all three or none, got{}{}{}",
            options.error_px > 0.0 ? " --error-px" : "",
            options.eye_m ? " --eye" : "",
            options.look_m ? " --look" : ""));
    }
    std::optional<refine::RefineView> view;
    if (options.error_px > 0.0) {
        view = view_of(options);
    }
    check_mesh_name("--out", options.out);
    check_mesh_name("--out-partition", options.partition);
    if (!options.save.empty() && !refine::is_progressive_file(options.save)) {
        throw Error(fmt::format(
            "--save: expected a file name that ends in .pm, got '{}'", printable(options.save)));
    }
    for (const std::string& file : {options.save, options.out, options.partition, options.nodes}) {
        if (!file.empty()) {
            check_can_write(file);
        }
    }
    const base::Stopwatch watch;
    const auto mesh = world::read_refine_input(options.input);
    Json figures;
    figures["model"] = mesh->parts().name;
    figures["original_vertices"] = mesh->leaf_count();
    figures["original_faces"] = mesh->face_count();
    figures["base_vertices"] = mesh->roots().size();
    figures["hierarchy_bytes_a_vertex"] =
        static_cast<double>(mesh->bytes()) / static_cast<double>(mesh->leaf_count());
    figures["load_ms"] = watch.ms();
    if (!options.save.empty()) {
        refine::write_progressive(options.save, *mesh);
        base::say(options.input.quiet, "progressive mesh: " + options.save);
    }
    figures["rule"] = options.rule;
    refine::SelectiveRefiner refiner(
        mesh, {.rule = rule_of(options.rule), .repair = !options.no_repair});
    refine_all(refiner, options, spheres, view, figures);
    write_results(refiner, options);
    base::print_figures(figures, options.json);
}

void add_what(CLI::App& command, RefineOptions& options) {
    command
        .add_option(
            "in",
            options.input.file,
            "a mesh: globe, torus, machined-part, f15, 500md, concave or a file (.obj, .ply, .stl, "
            ".gltf, .glb, "
            ".ac, .wrl); or a progressive mesh")
        ->type_name("MESH|FILE.pm")
        ->required();
    add_number_option(
        command,
        {"base", "N", "meshes: simplify to N vertices and no further [all the way]", 0, 1e9},
        options.base);
    add_number_option(
        command,
        {"vertices", "N", ".pm: read the coarser model of N vertices [all]", 0, 1e9},
        options.vertices);
    command
        .add_option(
            "--region",
            options.regions,
            "every original vertex inside is active (file axes, repeatable)")
        ->type_name("sphere X Y Z RADIUS");
    add_number_option(
        command,
        {"error-px", "PIXELS", "split what shows a larger error from --eye [none]", 0.0, 1e6},
        options.error_px);
    settings::add_read_option(
        command, {"eye", "X,Y,Z", "where the view is from, file axes", -1e9, 1e9}, options.eye_m);
    settings::add_read_option(
        command, {"look", "X,Y,Z", "what it looks at", -1e9, 1e9}, options.look_m);
    add_number_option(
        command, {"fov", "DEGREES", "height of the view", 1.0, 170.0}, options.fov_deg);
    settings::add_read_option(
        command, {"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192}, options.size_px)
        ->default_str(settings::text_of(options.size_px));
}

void add_how(CLI::App& command, RefineOptions& options) {
    command
        .add_option(
            "--rule",
            options.rule,
            "what a split needs: two cut vertices (selective), the faces beside (hoppe, 1997) or "
            "all vertices around (xia, 1996)")
        ->type_name("RULE")
        ->check(CLI::IsMember({"selective", "hoppe", "xia"}))
        ->capture_default_str();
    command.add_flag("--no-repair", options.no_repair, "leave faces that have turned over");
    command.add_option("--save", options.save, "write the progressive mesh")->type_name("FILE.pm");
    command.add_option("--out", options.out, "write the active mesh")->type_name("FILE");
    command
        .add_option(
            "--colour-by",
            options.colour_by,
            "colours of --out: each active vertex its own (region) or by original vertices below "
            "it (level)")
        ->type_name("WHAT")
        ->check(CLI::IsMember({"none", "region", "level"}))
        ->capture_default_str();
    command
        .add_option(
            "--out-partition",
            options.partition,
            "write the original mesh coloured by active vertices")
        ->type_name("FILE");
    command.add_option("--nodes", options.nodes, "write the list of active nodes")
        ->type_name("FILE");
    command.add_flag("--json", options.json, "results as JSON");
    command.add_flag("--quiet", options.input.quiet, "no progress, no notes");
}

} // namespace

void add_refine_command(CLI::App& program) {
    auto options = std::make_shared<RefineOptions>();
    CLI::App* command = program.add_subcommand(
        "refine", "Makes progressive meshes and refines them where it is asked for");
    add_what(*command, *options);
    add_how(*command, *options);
    command->footer(
        "Without --region and --error-px the active mesh is the base mesh.\n"
        "Keys of --json: model, original_vertices, original_faces, base_vertices,\n"
        "  hierarchy_bytes_a_vertex, load_ms, rule, requested_splits, forced_by_rule,\n"
        "  turned_faces_before_repair, forced_by_repair, turned_faces, vertices, faces, "
        "refine_ms.\n"
        "Examples:\n"
        "  octant refine bunny.ply --base 100 --save bunny.pm\n"
        "  octant refine bunny.pm --region sphere -0.05 0.1 0 0.02 --out ear.ply --nodes ear.txt\n"
        "  octant refine bunny.pm --error-px 1 --eye 0,0.1,0.4 --look 0,0.1,0 --out seen.obj");
    command->callback([options] { refine_mesh(*options); });
}

} // namespace octant::ui::commands
