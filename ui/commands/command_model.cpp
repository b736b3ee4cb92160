#include "models/measure/mesh_defects.h"
#include "models/meshfile/level_chain.h"
#include "models/repair/repair.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/results_text.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/commands/model_picture.h"
#include "ui/world/aircraft_axes.h"
#include "ui/world/mesh_loader.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::commands {

namespace {

struct ModelInfoOptions {
    std::string file;
    std::string axes = "auto";
    std::string picture;
    bool json = false;
    bool quiet = false;
};

models::TriangleMesh read_any_mesh(const std::string& file) {
    return models::meshfile::is_chain_file(file)
               ? std::move(models::meshfile::read_chain(file).levels.front().mesh)
               : world::load_mesh(file, {.pictures = true});
}

void turn_into_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) {
        vertex_m = axes.body_from_file(vertex_m);
    }
}

/// Which unit of length an aircraft of this length was probably modelled in.
std::string scale_in_words(double length) {
    constexpr double min_m = 2.0;
    constexpr double max_m = 90.0;
    if (length >= min_m && length <= max_m) {
        return "metres";
    }
    constexpr double m_per_cm = 0.01;
    constexpr double m_per_mm = 0.001;
    if (length * m_per_cm >= min_m && length * m_per_cm <= max_m) {
        return "metres as read; centimetres by the length of an aircraft";
    }
    if (length * m_per_mm >= min_m && length * m_per_mm <= max_m) {
        return "metres as read; millimetres by the length of an aircraft";
    }
    return "metres as read; no aircraft is so long";
}

void add_materials(base::JsonValue& results, const models::TriangleMesh& mesh) {
    std::vector<std::pair<std::string, std::size_t>> lines; // how often each comes
    for (const models::Material& material : mesh.materials) {
        const glm::vec3& colour = material.colour;
        std::string line = fmt::format(
            "{} ({:.2f} {:.2f} {:.2f})", printable(material.name), colour.x, colour.y, colour.z);
        const auto known =
            std::ranges::find(lines, line, &std::pair<std::string, std::size_t>::first);
        if (known == lines.end()) {
            lines.emplace_back(std::move(line), 1);
        } else {
            ++known->second;
        }
    }
    results["materials"] = base::JsonValue::list({});
    for (const auto& [line, count] : lines) {
        results["materials"].push_back(
            count == 1 ? line : fmt::format("{}, {} times", line, count));
    }
    results["vertex_colours"] = !mesh.colours.empty();
}

void add_surface(base::JsonValue& results, const models::TriangleMesh& mesh) {
    const std::size_t read = mesh.triangles.size();
    const models::repair::RepairedMesh repaired = models::repair::repaired(mesh);
    const models::measure::MeshDefects found = models::measure::defects(repaired.mesh);
    results["faces"] = read;
    results["vertices"] = mesh.vertices_m.size();
    results["shells"] = found.shells;
    results["closed"] = found.boundary_edges == 0;
    results["defects"] = models::repair::describe_counts(repaired.counts);
}

void show_model_info(const ModelInfoOptions& options) {
    world::check_axes(options.axes);
    if (!options.picture.empty()) {
        check_can_write(options.picture);
    }
    models::TriangleMesh mesh = read_any_mesh(options.file);
    const world::AircraftAxes axes = world::aircraft_axes(options.axes, options.file, mesh);
    turn_into_body(mesh, axes.axes);
    const models::BoundingBox bounds = models::bounds_of(mesh);
    const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
    base::JsonValue results;
    results["file"] = options.file;
    results["length_m"] = extent_m.x;
    results["span_m"] = extent_m.y;
    results["height_m"] = extent_m.z;
    results["scale"] = scale_in_words(extent_m.x);
    results["axes"] = axes.axes.text();
    results["axes_are"] = world::axes_text(axes);
    add_surface(results, mesh);
    add_materials(results, mesh);
    for (const std::string& note : mesh.notes) {
        base::print_note(options.quiet, "note: " + note);
    }
    if (!options.picture.empty()) {
        constexpr int pane_px = 400;
        constexpr int height_px = 320;
        report::write_png(options.picture, three_views(mesh, pane_px, height_px).view());
        results["picture"] = options.picture;
    }
    base::print_value(results, options.json);
}

Command model_info_command() {
    auto options = std::make_shared<ModelInfoOptions>();
    return {
        .name = "info",
        .summary = "Size, axes, surface and materials of a mesh, and a picture of three views",
        .options =
            {required(text_option(
                 "file",
                 "FILE",
                 "a mesh (.obj, .ply, .stl, .gltf, .glb, .ac, .wrl, .chain) or a built-in name",
                 options->file)),
             text_option(
                 "--picture",
                 "OUT.png",
                 "draw it from its left, from above and from ahead; the nose points left",
                 options->picture),
             text_option(
                 "--axes", "X,Y,Z|auto", "where x, y and z of the file point", options->axes),
             flag("--json", "as JSON", options->json),
             flag("--quiet", "no notes", options->quiet)},
        .footer = "Keys: file, length_m, span_m, height_m, scale, axes, axes_are, faces and "
                  "vertices as read,\n  shells, closed and defects as repaired, materials "
                  "(red green blue) and how often, vertex_colours, picture.\n"
                  "Example:\n  octant model info f15 --picture f15.png",
        .run = [options] { show_model_info(*options); }};
}

} // namespace

Command model_command() {
    return {
        .name = "model",
        .summary = "Looks at aircraft and meshes before they fly",
        .footer = "Example:\n  octant model info f15 --picture f15.png",
        .commands = {model_info_command()}};
}

} // namespace octant::ui::commands
