#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/classic_split_rules.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/refine_criterion.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace refine = visuals::refine;

namespace {

using base::JsonValue;

struct RefineOptions : base::OutputOptions, settings::EyeView {
    world::RefineMeshOptions input;
    int base = 0;
    int vertices = 0; ///< 0: all
    std::string save;
    std::vector<refine::Sphere> regions;
    double error_px = 0.0; ///< 0: no view
    std::string rule = "selective";
    bool no_repair = false;
    std::string out;
    std::string nodes;
    std::string partition;
    std::string colour_by = "none";
};

constexpr std::size_t region_words = 5; ///< sphere X Y Z RADIUS

/// Regions from the words of all --region, `region_words` each. Throws Error.
std::vector<refine::Sphere> regions_from(const Words& words) {
    std::vector<refine::Sphere> regions;
    for (std::size_t first = 0; first + region_words <= words.size(); first += region_words) {
        if (words[first] != "sphere") {
            throw Error(fmt::format("--region: expected sphere X Y Z RADIUS, got '{}'", printable(words[first])));
        }
        std::array<double, region_words - 1> numbers{};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::string& word = words[first + 1 + i];
            const auto number = finite_number(word);
            if (!number) { throw Error(fmt::format("--region: expected a finite number, got '{}'", printable(word))); }
            numbers[i] = *number;
        }
        const auto& [x, y, z, radius] = numbers;
        if (radius < 0.0) { throw Error(fmt::format("--region: expected a radius of at least 0, got {}", radius)); }
        regions.push_back({{x, y, z}, radius});
    }
    return regions;
}

refine::RefineView view_of(const RefineOptions& options) {
    const glm::dvec3& eye_m = *options.eye_m;
    const glm::dvec3& look_m = *options.look_m;
    const double away_m = glm::distance(eye_m, look_m);
    if (!(away_m > 0.0)) { throw Error("--look: expected another point than --eye"); }
    const glm::dvec3 ahead = (look_m - eye_m) / away_m;
    const glm::dvec3 up = std::abs(ahead.z) > 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return refine::picture_view(eye_m, look_m, up, rad_from_deg(options.fov_deg), options.size_px.x, options.size_px.y);
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
        for (const std::uint32_t original : active.originals[vertex]) { text += fmt::format(" {}", original); }
        text += "\n";
    }
    return text;
}

visuals::refine::ColourBy colour_by(const RefineOptions& options) {
    return options.colour_by == "region"  ? visuals::refine::ColourBy::Region
           : options.colour_by == "level" ? visuals::refine::ColourBy::Level
                                          : visuals::refine::ColourBy::Nothing;
}

void write_results(const refine::SelectiveRefiner& refiner, const RefineOptions& options, bool has_material_colours) {
    if (!options.partition.empty()) {
        const bool by_level = options.colour_by == "level";
        models::meshfile::write_mesh(
            options.partition, visuals::refine::partition_mesh(refiner,
                                   by_level ? visuals::refine::ColourBy::Level : visuals::refine::ColourBy::Region));
        base::print_note(options.quiet, "partition: " + options.partition);
    }
    if (options.out.empty() && options.nodes.empty()) { return; }
    refine::ActiveMesh active = refine::active_mesh(refiner);
    if (has_material_colours) { active.mesh.colours.clear(); }
    if (!options.out.empty()) {
        models::meshfile::write_mesh(options.out, visuals::refine::coloured_mesh(active, colour_by(options)));
        base::print_note(options.quiet, "active mesh: " + options.out);
    }
    if (!options.nodes.empty()) {
        write_file(options.nodes, nodes_text(active));
        base::print_note(options.quiet, "active nodes: " + options.nodes);
    }
}

/// Splits what is asked for; adds to the figures.
void refine_all(refine::SelectiveRefiner& refiner, const RefineOptions& options,
    const std::optional<refine::RefineView>& view, JsonValue& results) {
    const Stopwatch watch;
    refine::refine_regions(refiner, options.regions);
    if (view) { refine::refine_for_view(refiner, *view, options.error_px); }
    const refine::RefinerCounts& counts = refiner.counts();
    results["requested_splits"] = counts.splits - counts.forced_by_rule;
    results["forced_by_rule"] = counts.forced_by_rule;
    results["turned_faces_before_repair"] = refiner.flipped_faces();
    refiner.repair();
    results["forced_by_repair"] = counts.forced_by_repair;
    results["turned_faces"] = refiner.flipped_faces();
    results["vertices"] = refiner.active_count();
    results["faces"] = refiner.face_count();
    results["refine_ms"] = watch.ms();
}

void check_mesh_name(const char* option, const std::string& file) {
    if (!file.empty() && !models::meshfile::is_mesh_file(file)) {
        throw Error(
            fmt::format("{}: expected a mesh file such as mesh.obj or mesh.ply, got '{}'", option, printable(file)));
    }
}

void refine_mesh(RefineOptions options) {
    options.input.quiet = options.quiet;
    options.input.base = static_cast<std::size_t>(options.base);
    if (options.vertices > 0) { options.input.max_vertices = static_cast<std::size_t>(options.vertices); }
    if ((options.error_px > 0.0) != options.eye_m.has_value() ||
        options.eye_m.has_value() != options.look_m.has_value()) {
        throw Error(fmt::format("--error-px, --eye, --look: expected all three or none, got{}{}{}",
            options.error_px > 0.0 ? " --error-px" : "", options.eye_m ? " --eye" : "",
            options.look_m ? " --look" : ""));
    }
    std::optional<refine::RefineView> view;
    if (options.error_px > 0.0) { view = view_of(options); }
    check_mesh_name("--out", options.out);
    check_mesh_name("--colours partition", options.partition);
    if (!options.save.empty() && !refine::is_progressive_file(options.save)) {
        throw Error(fmt::format("--save: expected a file name that ends in .pm, got '{}'", printable(options.save)));
    }
    for (const std::string& file : {options.save, options.out, options.partition, options.nodes}) {
        if (!file.empty()) { check_can_write(file); }
    }
    const Stopwatch watch;
    const world::RefineMesh input = world::load_refine_mesh(options.input);
    const auto& mesh = input.mesh;
    JsonValue results;
    results["model"] = mesh->parts().name;
    results["original_vertices"] = mesh->leaf_count();
    results["original_faces"] = mesh->face_count();
    results["base_vertices"] = mesh->roots().size();
    results["hierarchy_bytes_a_vertex"] = static_cast<double>(mesh->bytes()) / static_cast<double>(mesh->leaf_count());
    results["load_ms"] = watch.ms();
    if (!options.save.empty()) {
        refine::write_progressive(options.save, *mesh);
        base::print_note(options.quiet, "progressive mesh: " + options.save);
    }
    results["rule"] = options.rule;
    refine::SelectiveRefiner refiner(mesh,
        {.required_split = refine::required_split_of(rule_of(options.rule), *mesh), .repair = !options.no_repair});
    refine_all(refiner, options, view, results);
    write_results(refiner, options, input.has_material_colours);
    base::print_value(results, options.json);
}

std::vector<Option> model_options(RefineOptions& options) {
    std::vector<Option> table{required(text_option("in", "MESH|FILE.pm",
                                  "a mesh: " + world::built_in_mesh_names() +
                                      " or a file (.obj, .ply, .stl, .gltf, .glb, .ac, .wrl); or a progressive mesh",
                                  options.input.file)),
        value_option(
            {"base", "N", "meshes: number of vertices of the base mesh [as few as possible]", 0, 1e9}, options.base),
        value_option(
            {"vertices", "N", ".pm files: read only the coarser model of N vertices [all]", 0, 1e9}, options.vertices),
        {.name = "--region",
            .form = "sphere X Y Z RADIUS",
            .meaning = "refine this sphere to full resolution, in file axes; repeatable",
            .arity = Arity::OneOrMore,
            .read = [&options](const Words& words) { options.regions = regions_from(words); },
            .words_per_use = static_cast<int>(region_words)},
        value_option({"error-px", "PIXELS", "refine until the error seen from --eye is at most this [off]", 0.0, 1e6},
            options.error_px)};
    add_eye_options(table, "in file axes", options);
    return table;
}

void add_method_options(std::vector<Option>& table, RefineOptions& options) {
    table.insert(
        table.end(), {choice_option("--rule", "RULE",
                          "condition for a vertex split: two cut vertices active (selective), neighbouring faces "
                          "active (hoppe, 1997) or all neighbouring vertices active (xia, 1996)",
                          {"selective", "hoppe", "xia"}, options.rule),
                         flag("--no-repair", "do not repair flipped faces", options.no_repair),
                         text_option("--save", "FILE.pm", "output file of the progressive mesh", options.save),
                         text_option("--out", "FILE", "output file of the active mesh", options.out),
                         text_option("--nodes", "FILE", "output file of the list of active nodes", options.nodes)});
    add_family(table, {.name = "--colours", .form = "KEY=VALUE,...", .meaning = "pictures of the active vertices:"},
        {{"by", choice_option("--colour-by", "WHAT",
                    "vertex colours of --out: region (one colour per active vertex) or level (by the number of "
                    "original vertices that it stands for)",
                    {"none", "region", "level"}, options.colour_by)},
            {"partition", text_option("--out-partition", "FILE",
                              "output file of the original mesh, coloured by active vertex", options.partition)}});
    table = with_output_options(options, std::move(table));
}

} // namespace

Command refine_command() {
    auto options = std::make_shared<RefineOptions>();
    options->fov_deg = 50.0;
    Command command = {.name = "refine",
        .summary = "Makes progressive meshes and refines them where it is asked for",
        .options = model_options(*options),
        .footer = "Without --region and --error-px the active mesh is the base mesh.\n"
                  "Keys of --json: model, original_vertices, original_faces, base_vertices,\n"
                  "  hierarchy_bytes_a_vertex, load_ms, rule, requested_splits, forced_by_rule,\n"
                  "  turned_faces_before_repair, forced_by_repair, turned_faces, vertices, faces, "
                  "refine_ms.\n"
                  "Examples:\n"
                  "  octant refine bunny.ply --base 100 --save bunny.pm\n"
                  "  octant refine bunny.pm --region sphere -0.05 0.1 0 0.02 --out ear.ply --nodes "
                  "ear.txt\n"
                  "  octant refine bunny.pm --error-px 1 --eye 0,0.1,0.4 --look 0,0.1,0 --out seen.obj",
        .run = [options] { refine_mesh(*options); }};
    add_method_options(command.options, *options);
    return command;
}

} // namespace octant::ui::commands
