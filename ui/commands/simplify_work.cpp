#include "ui/commands/simplify_work.h"

#include "models/measure/mesh_distance.h"
#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/written_places.h"
#include "models/polygons/obj_reader.h"
#include "models/repair/repair.h"
#include "models/simplify/colour_seams.h"
#include "models/simplify/paper_simplify.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/chain_maker.h"
#include "ui/commands/simplify_as_printed.h"
#include "ui/world/mesh_input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <thread>

namespace octant::ui::commands {

namespace simplify = models::simplify;
namespace repair = models::repair;
namespace meshfile = models::meshfile;

namespace {

using base::Figures;

simplify::SimplifyOptions options_of(const SimplifyCommand& command, double diagonal_m) {
    simplify::SimplifyOptions options;
    options.effort =
        command.method == "fast" ? simplify::fast_effort : simplify::surface_effort;
    if (command.effort >= 0) {
        options.effort = command.effort;
    }
    if (command.steps >= 0) {
        options.steps = static_cast<std::size_t>(command.steps);
    }
    if (command.max_seconds > 0.0) {
        options.max_seconds = command.max_seconds;
    }
    if (command.vertices > 0) {
        options.goal.vertices = static_cast<std::size_t>(command.vertices);
    }
    if (command.faces > 0) {
        options.goal.faces = static_cast<std::size_t>(command.faces);
    }
    if (!command.error.empty()) {
        options.goal.error_m = error_m_from(command.error, diagonal_m);
    }
    options.colour_weight = command.colour_weight;
    options.keep_shells = command.keep_shells;
    options.threads = command.threads;
    return options;
}

/// The mesh as an oriented manifold, and where its colours break.
simplify::ColourSeams read_repaired(const SimplifyCommand& command, Figures& figures) {
    models::TriangleMesh mesh = world::read_mesh_input(command.in);
    figures["faces_in_file"] = mesh.triangles.size();
    repair::RepairedMesh repaired = repair::repaired(
        std::move(mesh), command.keep_seams_apart ? repair::Seams::Apart : repair::Seams::Welded);
    const std::vector<std::string> repairs = repair::in_words(repaired.counts);
    for (const std::string& line : repairs) {
        base::say(command.quiet, "repaired: " + line);
    }
    for (const std::string& note : repaired.mesh.notes) {
        base::say(command.quiet, "note: " + note);
    }
    if (command.json) {
        figures["repairs"] = repairs; // else they are said
    }
    if (repaired.mesh.triangles.empty()) {
        error_in(command.in, "expected at least one triangle with an area, got none");
    }
    return {std::move(repaired.mesh), std::move(repaired.corner_colours)};
}

/// Bounds of distances below this share of the diagonal need not be tight. On large meshes the
/// millionth part, as surfaces that all but coincide take long to tell apart.
double negligible_share(const models::TriangleMesh& original) {
    constexpr std::size_t large = 100'000;
    return original.triangles.size() > large ? 1e-6 : 1e-9;
}

/// Rounds the places of a mesh as its file does.
void round_as_written(models::TriangleMesh& mesh, const std::string& file) {
    if (!meshfile::writes_places_in_float(file)) {
        return;
    }
    for (glm::dvec3& place_m : mesh.vertices_m) {
        place_m = glm::dvec3(glm::vec3(place_m));
    }
}

/// Adds the distance of the mesh as it was written to `file`.
void add_distance(
    Figures& figures,
    const models::TriangleMesh& original,
    models::TriangleMesh& mesh,
    const std::string& file,
    int threads) {
    constexpr std::size_t samples = 100'000; // The root mean square is right to some 0.2 %.
    round_as_written(mesh, file);
    const double diagonal_m = models::diagonal_m(original);
    const models::measure::MeshDistance distance = models::measure::distance(
        original,
        mesh,
        {.negligible_m = negligible_share(original) * diagonal_m,
         .samples = samples,
         .threads = threads,
         .larger_alone = true});
    figures["error"] = distance.most_hausdorff_m();
    figures["error_of_diagonal"] = distance.most_hausdorff_m() / diagonal_m;
    figures["rms"] = distance.rms_m();
    figures["rms_of_diagonal"] = distance.rms_m() / diagonal_m;
    if (!original.colours.empty()) {
        figures["colour_rms"] = distance.colour_rms();
    }
}

/// A level of a chain, in a line or as figures.
Figures level_figures(const meshfile::ChainLevel& level, double diagonal_m, bool json) {
    const std::size_t faces = level.mesh.triangles.size();
    const double of_diagonal = level.error_m / diagonal_m;
    if (!json) {
        return fmt::format(
            "level of {} faces: error {:.4g}, {:.3g} of the diagonal",
            faces,
            level.error_m,
            of_diagonal);
    }
    return {{"faces", faces}, {"error", level.error_m}, {"error_of_diagonal", of_diagonal}};
}

/// As they stand in the file, which has the mesh's axes.
models::polygons::PolygonModel polygons_in_file_axes(const std::filesystem::path& file) {
    const models::polygons::FileAxes axes;
    models::polygons::PolygonModel polygons = models::polygons::read_obj(file, axes);
    for (glm::dvec3& vertex_m : polygons.vertices_m) {
        vertex_m = axes.file_from_body(vertex_m);
    }
    return polygons;
}

} // namespace

double error_m_from(const std::string& text, double diagonal_m) {
    const bool share = text.ends_with('%');
    const std::string number = share ? text.substr(0, text.size() - 1) : text;
    const double value = finite_number(number).value_or(0.0);
    if (!(value > 0.0)) {
        throw Error(fmt::format(
            "--error: expected a number above 0 in file units, or with % of the diagonal, got '{}'",
            printable(text)));
    }
    return share ? value / 100.0 * diagonal_m : value;
}

std::optional<simplify::PaperMeasure> paper_measure(const std::string& method) {
    using simplify::PaperMeasure;
    constexpr std::array<std::pair<std::string_view, PaperMeasure>, 3> measures{
        {{"plane", PaperMeasure::Plane},
         {"triangle", PaperMeasure::Triangle},
         {"bidirectional", PaperMeasure::Bidirectional}}};
    const auto found = std::ranges::find(
        measures, std::string_view(method), &std::pair<std::string_view, PaperMeasure>::first);
    return found == measures.end() ? std::nullopt : std::optional(found->second);
}

void simplify_as_printed(
    const SimplifyCommand& command, simplify::PaperMeasure measure, Figures& figures) {
    const models::TriangleMesh original = world::read_mesh_input(command.in);
    const double diagonal_m = models::diagonal_m(original);
    simplify::PaperOptions options;
    options.measure = measure;
    options.goal = options_of(command, diagonal_m).goal;
    options.colour_weight = original.colours.empty() ? 0.0 : command.colour_weight * diagonal_m;
    base::Progress progress("contracting edges", 100, command.quiet, "percent");
    options.show_progress = [&](double share) { progress.show(static_cast<int>(100.0 * share)); };
    figures["faces_before"] = original.triangles.size();
    figures["vertices_before"] = original.vertices_m.size();
    const base::Stopwatch watch;
    simplify::PaperResult result = simplify::paper_simplified(original, options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_mesh(command.out, result.mesh);
    figures["faces"] = result.mesh.triangles.size();
    figures["vertices"] = result.mesh.vertices_m.size();
    figures["method"] = command.method;
    add_paper_figures(figures, options, result);
    if (!result.mesh.triangles.empty()) {
        add_distance(figures, original, result.mesh, command.out, command.threads);
    }
    figures["time_s"] = time_s;
}

bool simplify_mesh(const SimplifyCommand& command, Figures& figures) {
    const simplify::ColourSeams seams = read_repaired(command, figures);
    const models::TriangleMesh& original = seams.marked();
    simplify::SimplifyOptions options = options_of(command, models::diagonal_m(original));
    figures["faces_before"] = original.triangles.size();
    figures["vertices_before"] = original.vertices_m.size();
    base::Progress progress("simplifying", 100, command.quiet, "percent");
    options.show_progress = [&](double share) { progress.show(static_cast<int>(100.0 * share)); };
    const base::Stopwatch watch;
    simplify::Simplified result = simplify::simplified(original, options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_mesh(command.out, seams.broken(result.mesh));
    result.sequence = {}; // It is as large as the mesh, and so is what measuring needs.
    figures["faces"] = result.mesh.triangles.size();
    figures["vertices"] = result.mesh.vertices_m.size();
    figures["method"] = command.method;
    figures["steps"] = result.steps;
    figures["shells_gone"] = result.shells_gone;
    const double measured_from_s = base::process_cpu_s();
    if (!result.mesh.triangles.empty()) {
        add_distance(figures, original, result.mesh, command.out, command.threads);
    }
    figures["time_s"] = time_s;
    if (command.json) {
        figures["cpu_s"] = {
            {"collapse", result.collapse_cpu_s},
            {"optimizer", result.optimize_cpu_s},
            {"certificate", base::process_cpu_s() - measured_from_s}};
    }
    if (command.max_seconds > 0.0) {
        base::say(
            command.quiet,
            fmt::format("note: --steps {} instead of --max-seconds repeats this", result.steps));
    }
    const bool short_of_faces =
        options.goal.faces && result.mesh.triangles.size() > *options.goal.faces;
    const bool short_of_vertices =
        options.goal.vertices && result.mesh.vertices_m.size() > *options.goal.vertices;
    if (short_of_faces || short_of_vertices) {
        base::say(
            command.quiet,
            "note: no edge can collapse any more without changing the kind of surface");
        return false;
    }
    return true;
}

void simplify_into_chain(const SimplifyCommand& command, Figures& figures) {
    const simplify::ColourSeams seams = read_repaired(command, figures);
    ChainOptions options;
    options.simplify = options_of(command, models::diagonal_m(seams.marked()));
    if (command.faces > 0) {
        options.coarsest_faces = static_cast<std::size_t>(command.faces);
    }
    if (!command.polygons.empty()) {
        options.polygons = polygons_in_file_axes(command.polygons);
    }
    base::Progress progress("making levels", 100, command.quiet, "percent");
    options.show_level = [&](std::size_t done, std::size_t of) {
        progress.show(static_cast<int>(100 * done / std::max<std::size_t>(of, 1)));
    };
    const base::Stopwatch watch;
    const meshfile::LevelChain chain = level_chain(seams, options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_chain(command.out, chain);
    const double diagonal_m = models::diagonal_m(chain.levels.front().mesh);
    for (const meshfile::ChainLevel& level : chain.levels) {
        figures["levels"].push_back(level_figures(level, diagonal_m, command.json));
    }
    figures["polygons"] = chain.polygons ? chain.polygons->polygons.size() : 0;
    if (chain.polygons) {
        figures["polygons_error"] = chain.polygons_error_m;
    }
    figures["time_s"] = time_s;
}

} // namespace octant::ui::commands
