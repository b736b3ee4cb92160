#include "ui/commands/simplify_run.h"

#include "models/measure/mesh_distance.h"
#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_join.h"
#include "models/polygons/obj_reader.h"
#include "models/repair/repair.h"
#include "models/simplify/attribute_seams.h"
#include "models/simplify/paper_simplify.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "ui/base/progress.h"
#include "ui/commands/shared_border.h"
#include "ui/commands/simplify_chart.h"
#include "ui/sweep/engine.h"
#include "ui/world/mesh_loader.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace octant::ui::commands {

namespace simplify = models::simplify;
namespace repair = models::repair;
namespace meshfile = models::meshfile;

namespace {

using base::JsonValue;

simplify::SimplifyOptions options_of(const SimplifyArguments& command, double diagonal_m) {
    simplify::SimplifyOptions options;
    options.effort = command.method == "fast" ? simplify::fast_effort : simplify::surface_effort;
    if (command.effort >= 0) { options.effort = command.effort; }
    if (command.steps >= 0) { options.steps = static_cast<std::size_t>(command.steps); }
    if (command.max_seconds > 0.0) {
        using Clock = std::chrono::steady_clock;
        options.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(command.max_seconds));
    }
    if (command.vertices > 0) { options.goal.vertices = static_cast<std::size_t>(command.vertices); }
    if (command.faces > 0) { options.goal.faces = static_cast<std::size_t>(command.faces); }
    if (!command.error.empty()) { options.goal.error_m = error_m_from(command.error, diagonal_m); }
    // On a coloured scan the distance is then no larger than without colours by other programs.
    constexpr double default_colour_weight = 0.015;
    options.colour_weight = command.colour_weight >= 0.0 ? command.colour_weight : default_colour_weight;
    options.keep_shells = command.keep_shells || command.lock_border;
    options.keep_topology = command.keep_topology || command.lock_border;
    options.lock_border = command.lock_border;
    options.threads = command.threads;
    return options;
}

/// The effort in words.
std::string method_of(const SimplifyArguments& command) {
    const int effort = options_of(command, 1.0).effort;
    return effort == simplify::surface_effort ? "surface"
           : effort == simplify::fast_effort  ? "fast"
                                              : fmt::format("effort {}", effort);
}

/// Throws Error where squares of distances within the mesh are no normal numbers.
void check_size(const std::string& name, const models::TriangleMesh& mesh) {
    constexpr double min_diagonal_m = 1e-100;
    const double diagonal_m = models::diagonal_m(mesh);
    if (!(diagonal_m >= min_diagonal_m)) {
        throw_error_in(name, fmt::format("expected a bounding box with a diagonal of {:.0e} or more, got {:.3g}",
                                 min_diagonal_m, diagonal_m));
    }
}

/// Whether a mesh is larger than caches.
bool is_large(const models::TriangleMesh& mesh) {
    constexpr std::size_t large = 100'000;
    return mesh.triangles.size() > large;
}

/// A mesh as an oriented manifold, and where its attributes break. `name` stands in errors.
simplify::AttributeSeams repaired_mesh(
    const SimplifyArguments& command, const std::string& name, models::TriangleMesh mesh, JsonValue& results) {
    results["faces_in_file"] = mesh.triangles.size();
    if (is_large(mesh)) {
        models::sort_spatially(mesh); // Takes less time than later steps save by better use of caches.
    }
    if (!mesh.triangles.empty()) {
        // Before the repair, which would remove all triangles of a smaller mesh, because their areas round to zero.
        check_size(name, mesh);
    }
    repair::RepairedMesh repaired =
        repair::repaired(std::move(mesh), command.keep_seams_apart ? repair::Seams::Apart : repair::Seams::Welded);
    const std::vector<std::string> repairs = repair::describe_counts(repaired.counts);
    for (const std::string& line : repairs) { base::print_note(command.quiet, "repaired: " + line); }
    for (const std::string& note : repaired.mesh.notes) { base::print_note(command.quiet, "note: " + note); }
    if (command.json) {
        results["repairs"] = repairs; // else they are said
    }
    if (repaired.mesh.triangles.empty()) {
        throw_error_in(name, "expected at least one triangle with an area, got none");
    }
    check_size(name, repaired.mesh);
    return {std::move(repaired.mesh), std::move(repaired.corner_colours)};
}

simplify::AttributeSeams read_repaired(const SimplifyArguments& command, JsonValue& results) {
    return repaired_mesh(command, command.in, world::load_mesh(command.in), results);
}

/// Bounds of distances below this share of the diagonal need not be tight. On large meshes the millionth part, as
/// surfaces that all but coincide take long to tell apart.
double negligible_share(const models::TriangleMesh& original) { return is_large(original) ? 1e-6 : 1e-9; }

/// Adds the distance of a mesh from its original.
void add_distance(JsonValue& results, const models::TriangleMesh& original, const models::TriangleMesh& mesh,
    int threads, std::shared_ptr<const models::measure::TriangleBvh> original_tree) {
    constexpr std::size_t samples = 100'000; // The root mean square is right to some 0.2 %.
    const double diagonal_m = models::diagonal_m(original);
    const models::measure::MeshDistance distance = models::measure::distance(original, mesh,
        {.negligible_m = negligible_share(original) * diagonal_m,
            .samples = samples,
            .threads = threads,
            .maximum_only = true,
            .tree_of_a = std::move(original_tree)});
    results["error"] = distance.max_hausdorff_m();
    results["error_of_diagonal"] = distance.max_hausdorff_m() / diagonal_m;
    results["rms"] = distance.rms_m();
    results["rms_of_diagonal"] = distance.rms_m() / diagonal_m;
    if (!original.colours.empty() && !mesh.colours.empty()) { results["colour_rms"] = distance.colour_rms(); }
}

/// Writes a mesh, says what the format leaves out, and adds the distance of the mesh that the file holds, read back,
/// from the original. `original_tree` is one over its triangles, or null.
void write_and_measure(const SimplifyArguments& command, const std::filesystem::path& file,
    const models::TriangleMesh& mesh, const models::TriangleMesh& original, JsonValue& results,
    std::shared_ptr<const models::measure::TriangleBvh> original_tree = nullptr) {
    for (const std::string& note : meshfile::write_warnings(file, mesh)) {
        base::print_note(command.quiet, "note: " + note);
    }
    meshfile::write_mesh(file, mesh);
    if (!mesh.triangles.empty()) {
        add_distance(results, original, meshfile::read_mesh(file), command.threads, std::move(original_tree));
    }
}

/// Leaves the most that the coordinates of one of the files lose by rounding out of the wanted error. Throws Error
/// where nothing is left; a note where it is more than a tenth.
void without_rounding(const SimplifyArguments& command, const std::vector<std::string>& outs,
    const models::BoundingBox& bounds, std::optional<double>& error_m) {
    const auto rounding_of_m = [&](const std::string& out) { return meshfile::rounding_m(out, bounds); };
    const std::string& out = *std::ranges::max_element(outs, {}, rounding_of_m);
    const double rounding_m = rounding_of_m(out);
    if (!error_m || rounding_m == 0.0) { return; }
    if (rounding_m >= *error_m) {
        throw_error_in(
            out, fmt::format("expected a format that keeps --error {:.4g}, got one whose coordinates in single "
                             "precision may be off by {:.4g} (.obj and .ply keep double precision)",
                     *error_m, rounding_m));
    }
    if (rounding_m > 0.1 * *error_m) {
        base::print_note(command.quiet,
            fmt::format("note: {}: coordinates in single precision may be off by {:.4g}, which is left out "
                        "of --error {:.4g}",
                out, rounding_m, *error_m));
    }
    *error_m -= rounding_m;
}

/// A kind of attributes with its bound (0: none) and the figure that keeps it.
struct AttributeBound {
    std::string_view name;
    std::string_view option;
    std::string_view result_name;
    double wanted;
};

std::array<AttributeBound, 3> bounds_of(const SimplifyArguments& command) {
    return {{{"texture coordinates", "--uv-error", "uv_error", command.uv_error},
        {"normals", "--attribute-error normal", "normal_error", command.normal_error},
        {"colours", "--attribute-error colour", "colour_error", command.colour_error}}};
}

/// A number among named figures; 0 where there is none.
double number_in_results(const JsonValue& results, std::string_view name) {
    for (const auto& [key, value] : std::get<JsonValue::JsonMembers>(results.value())) {
        if (key == name) {
            const auto* number = std::get_if<double>(&value.value());
            const auto* count = std::get_if<std::uint64_t>(&value.value());
            return number != nullptr ? *number : count != nullptr ? static_cast<double>(*count) : 0.0;
        }
    }
    return 0.0;
}

/// The given options that can put a number of faces out of reach.
std::string kept_feature_options(const SimplifyArguments& command) {
    std::string held;
    const auto add = [&](std::string_view option, bool is_given) {
        held += is_given ? fmt::format("{}{}", held.empty() ? "" : ", ", option) : "";
    };
    add("--keep-shells", command.keep_shells);
    add("--keep-topology", command.keep_topology);
    add("--keep-seams-apart", command.keep_seams_apart);
    add("--lock-border", command.lock_border);
    for (const AttributeBound& bound : bounds_of(command)) { add(bound.option, bound.wanted > 0.0); }
    return held;
}

/// Whether the figures of a written mesh keep the wanted error and the bounds of attributes, and its faces and vertices
/// are few enough; else says why not.
bool reaches_goals(
    const SimplifyArguments& command, const simplify::Goal& goal, double wanted_error_m, const JsonValue& results) {
    const auto result_value = [&](std::string_view name) { return number_in_results(results, name); };
    bool is_kept = true;
    const auto refuse = [&](const std::string& why) {
        base::print_note(command.quiet, "note: " + why);
        is_kept = false;
    };
    if (goal.error_m && result_value("error") > wanted_error_m) {
        refuse(fmt::format("the error of the file as read back, {:.4g}, is above --error {:.4g}", result_value("error"),
            wanted_error_m));
    }
    for (const AttributeBound& bound : bounds_of(command)) {
        if (bound.wanted > 0.0 && result_value(bound.result_name) > bound.wanted) {
            refuse(fmt::format("{} are off by {:.4g}, more than {} {:.4g}", bound.name, result_value(bound.result_name),
                bound.option, bound.wanted));
        }
    }
    if ((goal.faces && result_value("faces") > static_cast<double>(*goal.faces)) ||
        (goal.vertices && result_value("vertices") > static_cast<double>(*goal.vertices))) {
        const std::string held = kept_feature_options(command);
        refuse(fmt::format("no edge can collapse any more without folding the surface{}: {:.0f} triangles are left",
            held.empty() ? "" : " or losing what is held by " + held, result_value("faces")));
    }
    return is_kept;
}

/// The bounds of attributes that the mesh has; none where no such bound is given.
std::optional<simplify::AttributeBounds> attribute_bounds(
    const SimplifyArguments& command, const simplify::AttributeSeams& seams) {
    simplify::AttributeBounds bounds;
    bool is_bounded = false;
    for (const auto& [bound, wanted, has_attribute] :
        {std::tuple(&bounds.texture, command.uv_error, seams.has_texture_coordinates()),
            std::tuple(&bounds.normal_deg, command.normal_error, seams.has_normals()),
            std::tuple(&bounds.colour, command.colour_error, seams.has_colours())}) {
        if (wanted > 0.0 && has_attribute) {
            *bound = wanted;
            is_bounded = true;
        }
    }
    return is_bounded ? std::optional(bounds) : std::nullopt;
}

/// Searches for a simplified mesh whose attributes keep their bounds: each try simplifies the mesh and divides
/// triangles of the result until the bounds are kept.
class BoundedSearch {
public:
    /// All must outlive this.
    BoundedSearch(const simplify::AttributeSeams& seams, const simplify::AttributeBounds& bounds,
        const simplify::SimplifyOptions& options)
        : seams_(seams), bounds_(bounds), options_(options), goal_(simplify::target_faces(options.goal)) {
        options_.effort_limits_each = true;
    }

    /// The best try. Where none keeps the bounds: for a number of triangles the first one, else the mesh itself.
    simplify::Simplified find() {
        constexpr int max_tries = 5;
        for (int tries = 0; tries < max_tries && attempt(); ++tries) {}
        if (goal_ == 0 && rank_ < Rank::KeepsBounds) { best_ = {.mesh = seams_.marked(), .sequence = {}}; }
        best_.collapse_cpu_s = sums_.collapse_cpu_s;
        best_.optimize_cpu_s = sums_.optimize_cpu_s;
        best_.steps = sums_.steps;
        return std::move(best_);
    }

    /// The fewest triangles of a try that kept the bounds; 0 = none did.
    std::size_t min_keeping() const { return min_keeping_; }

private:
    enum class Rank : std::uint8_t { None, Undivided, Divided, KeepsBounds };

    /// Makes a try with the present goal, and sets the next one. Returns false where no further try can help.
    bool attempt() {
        simplify::Simplified result = simplify::simplified(seams_.marked(), options_);
        sums_.collapse_cpu_s += result.collapse_cpu_s;
        sums_.optimize_cpu_s += result.optimize_cpu_s;
        sums_.steps += result.steps;
        if (options_.steps) { *options_.steps -= std::min(*options_.steps, result.steps); }
        const std::size_t before = result.mesh.triangles.size();
        const std::size_t max_faces = seams_.marked().triangles.size();
        models::TriangleMesh divided = seams_.divided(result.mesh, bounds_, max_faces);
        const std::size_t after = divided.triangles.size();
        const bool keeps = is_kept(seams_.errors(divided, simplify::LookAt::AllTriangles));
        if (keeps) { min_keeping_ = min_keeping_ == 0 ? after : std::min(min_keeping_, after); }
        Rank rank = keeps ? Rank::KeepsBounds : Rank::Divided;
        if (goal_ != 0 && after > goal_) {
            rank = Rank::Undivided;
        } else {
            result.mesh = std::move(divided);
        }
        const bool is_fewer = result.mesh.triangles.size() < best_.mesh.triangles.size();
        const bool is_better = rank > rank_ || (rank == rank_ && rank > Rank::Undivided && is_fewer == (goal_ == 0));
        if (is_better) {
            rank_ = rank;
            best_ = std::move(result);
        }
        return goal_ == 0 ? set_error(is_better, before, after) : set_faces(rank, before, after);
    }

    bool is_kept(const simplify::AttributeErrors& errors) const {
        return errors.texture.max <= bounds_.texture && errors.normal_deg.max <= bounds_.normal_deg &&
               errors.colour.max <= bounds_.colour;
    }

    /// Sets a smaller error to try next, where that may take fewer triangles than dividing did.
    bool set_error(bool is_better, std::size_t before, std::size_t after) {
        constexpr double finer = 0.3;
        const bool is_enough = rank_ == Rank::KeepsBounds && (!is_better || 2 * after <= 3 * before);
        *options_.goal.error_m *= finer;
        return !is_enough && before < seams_.marked().triangles.size();
    }

    /// Sets the number of triangles to try next, so that as many as are wanted are left after they were divided.
    bool set_faces(Rank rank, std::size_t before, std::size_t after) {
        constexpr double enough = 0.98; // of the goal
        const auto goal = static_cast<double>(goal_);
        const auto faces = static_cast<double>(after);
        // Where steps may run out, a later try may have none and be worse.
        const bool is_enough =
            rank > Rank::Undivided && (enough * goal <= faces || options_.steps || options_.deadline);
        options_.goal.vertices.reset();
        options_.goal.faces =
            static_cast<std::size_t>(std::max(4.0, static_cast<double>(before) * std::min(goal / faces, 2.0)));
        return !is_enough && before >= 8;
    }

    const simplify::AttributeSeams& seams_;
    const simplify::AttributeBounds& bounds_;
    simplify::SimplifyOptions options_; ///< Of the next try.
    std::size_t goal_;                  ///< The wanted triangles; 0 = an error is wanted.
    Rank rank_ = Rank::None;            ///< Of the best try so far.
    simplify::Simplified best_;
    simplify::Simplified sums_; ///< Times and steps of all tries.
    std::size_t min_keeping_ = 0;
};

/// A simplified mesh whose attributes keep their bounds, where that can be reached.
simplify::Simplified simplified_with_bounds(
    const SimplifyArguments& command, const simplify::AttributeSeams& seams, const simplify::SimplifyOptions& options) {
    const std::optional<simplify::AttributeBounds> bounds = attribute_bounds(command, seams);
    if (!bounds) { return simplify::simplified(seams.marked(), options); }
    BoundedSearch search(seams, *bounds, options);
    simplify::Simplified found = search.find();
    const std::size_t goal = simplify::target_faces(options.goal);
    if (goal != 0 && search.min_keeping() > goal) {
        base::print_note(
            command.quiet, fmt::format("note: the fewest triangles found that keep the bounds of attributes: {}",
                               search.min_keeping()));
    } else if (goal == 0 && found.mesh.triangles.size() == seams.marked().triangles.size()) {
        base::print_note(command.quiet, "note: no fewer triangles were found that keep the bounds of attributes");
    }
    return found;
}

/// Says how a result of --max-seconds is repeated.
void print_steps(const SimplifyArguments& command, const simplify::Simplified& result) {
    if (command.max_seconds > 0.0) {
        base::print_note(
            command.quiet, fmt::format("note: --steps {} instead of --max-seconds repeats this", result.steps));
    }
}

/// Adds how far attributes are off. The RMS of colours comes with the distance.
void add_attribute_errors(const SimplifyArguments& command, JsonValue& results, const simplify::AttributeSeams& seams,
    const models::TriangleMesh& made) {
    const simplify::AttributeErrors errors = seams.errors(
        made, attribute_bounds(command, seams) ? simplify::LookAt::AllTriangles : simplify::LookAt::SomeTriangles);
    if (seams.has_texture_coordinates()) {
        results["uv_error"] = errors.texture.max;
        results["uv_rms"] = errors.texture.rms;
    }
    if (seams.has_normals()) {
        results["normal_error"] = errors.normal_deg.max;
        results["normal_rms"] = errors.normal_deg.rms;
    }
    if (seams.has_colours()) { results["colour_error"] = errors.colour.max; }
}

/// Adds levels to the figures, as lines or for programs, and writes the page of --chart.
void add_levels(
    const SimplifyArguments& command, const std::vector<ChartLevel>& levels, double diagonal_m, JsonValue& results) {
    if (!command.chart.empty()) {
        write_file(command.chart, chart_page(command.in, levels, diagonal_m));
        results["chart"] = command.chart;
    }
    for (const ChartLevel& level : levels) {
        const double of_diagonal = level.error_m / diagonal_m;
        results["levels"].push_back(
            command.json
                ? JsonValue({{"faces", level.faces}, {"error", level.error_m}, {"error_of_diagonal", of_diagonal}})
                : JsonValue(fmt::format("level of {} faces: error {:.4g}, {:.3g} of the diagonal", level.faces,
                      level.error_m, of_diagonal)));
    }
}

/// As they stand in the file, which has the mesh's axes.
models::polygons::PolygonModel polygons_in_file_axes(const std::filesystem::path& file) {
    const models::polygons::FileAxes axes;
    models::polygons::PolygonModel polygons = models::polygons::read_obj(file, axes);
    for (glm::dvec3& vertex_m : polygons.vertices_m) { vertex_m = axes.file_from_body(vertex_m); }
    return polygons;
}

} // namespace

bool has_attribute_bound(const SimplifyArguments& command) {
    return command.uv_error > 0.0 || command.normal_error > 0.0 || command.colour_error > 0.0;
}

double error_m_from(const std::string& text, double diagonal_m) {
    const bool share = text.ends_with('%');
    const std::string number = share ? text.substr(0, text.size() - 1) : text;
    const double value = finite_number(number).value_or(0.0);
    if (!(value > 0.0)) {
        throw Error(fmt::format(
            "--error: expected a number above 0 in file units, or with % of the diagonal, got '{}'", printable(text)));
    }
    return share ? value / 100.0 * diagonal_m : value;
}

std::optional<simplify::PaperMeasure> paper_measure(const std::string& method) {
    using simplify::PaperMeasure;
    constexpr std::array<std::pair<std::string_view, PaperMeasure>, 3> measures{{{"plane", PaperMeasure::Plane},
        {"triangle", PaperMeasure::Triangle}, {"bidirectional", PaperMeasure::Bidirectional}}};
    const auto found =
        std::ranges::find(measures, std::string_view(method), &std::pair<std::string_view, PaperMeasure>::first);
    return found == measures.end() ? std::nullopt : std::optional(found->second);
}

namespace {

/// Of the mesh as it is, nothing repaired.
void simplify_as_printed(const SimplifyArguments& command, simplify::PaperMeasure measure, JsonValue& results) {
    const models::TriangleMesh original = world::load_mesh(command.in);
    check_size(command.in, original);
    const double diagonal_m = models::diagonal_m(original);
    simplify::PaperOptions options;
    options.measure = measure;
    options.goal = options_of(command, diagonal_m).goal;
    constexpr double printed_colour_weight = 0.1;
    const double weight = command.colour_weight >= 0.0 ? command.colour_weight : printed_colour_weight;
    options.colour_weight = original.colours.empty() ? 0.0 : weight * diagonal_m;
    base::Progress progress("contracting edges", 100, command.quiet, "percent");
    options.show_progress = [&](double share) { progress.show(static_cast<int>(100.0 * share)); };
    results["faces_before"] = original.triangles.size();
    results["vertices_before"] = original.vertices_m.size();
    const Stopwatch watch;
    simplify::PaperResult result = simplify::paper_simplified(original, options);
    const double time_s = watch.s();
    progress.finish();
    if (!original.corner_texture_coordinates.empty()) {
        base::print_note(
            command.quiet, fmt::format("note: --method {} leaves texture coordinates out, as printed", command.method));
    }
    results["faces"] = result.mesh.triangles.size();
    results["vertices"] = result.mesh.vertices_m.size();
    results["method"] = command.method;
    add_paper_results(results, options, result);
    write_and_measure(command, command.out, result.mesh, original, results);
    results["time_s"] = time_s;
}

bool simplify_mesh(const SimplifyArguments& command, const simplify::AttributeSeams& seams, JsonValue& results) {
    const models::TriangleMesh& original = seams.marked();
    simplify::SimplifyOptions options = options_of(command, models::diagonal_m(original));
    const double wanted_error_m = options.goal.error_m.value_or(0.0);
    without_rounding(command, {command.out}, models::bounds_of(original), options.goal.error_m);
    results["faces_before"] = original.triangles.size();
    results["vertices_before"] = original.vertices_m.size();
    base::Progress progress("simplifying", 100, command.quiet, "percent");
    options.show_progress = [&](double share) { progress.show(static_cast<int>(100.0 * share)); };
    const Stopwatch watch;
    simplify::Simplified result = simplified_with_bounds(command, seams, options);
    const double time_s = watch.s();
    progress.finish();
    result.sequence = {}; // It is as large as the mesh, and so is what measuring needs.
    results["faces"] = result.mesh.triangles.size();
    results["vertices"] = result.mesh.vertices_m.size();
    results["method"] = method_of(command);
    results["steps"] = result.steps;
    results["shells_gone"] = result.shells_removed;
    results["holes_closed"] = result.holes_closed;
    results["handles_cut"] = result.handles_cut;
    add_attribute_errors(command, results, seams, result.mesh);
    const double measured_from_s = process_cpu_s();
    models::TriangleMesh coloured;
    if (!original.colours.empty()) { coloured = seams.with_colours(original); }
    write_and_measure(command, command.out, seams.with_attributes(std::move(result.mesh)),
        original.colours.empty() ? original : coloured, results, std::move(result.original_tree));
    results["time_s"] = time_s;
    if (command.json) {
        results["cpu_s"] = {{"collapse", result.collapse_cpu_s}, {"optimizer", result.optimize_cpu_s},
            {"certificate", process_cpu_s() - measured_from_s}};
    }
    print_steps(command, result);
    return reaches_goals(command, options.goal, wanted_error_m, results);
}

/// The figures of one of several files, in a line.
std::string summary_line_of(const std::string& out, const JsonValue& of_file) {
    return fmt::format("{}: {:.0f} faces, error {:.4g}, {:.3g} of the diagonal", out,
        number_in_results(of_file, "faces"), number_in_results(of_file, "error"),
        number_in_results(of_file, "error_of_diagonal"));
}

} // namespace

bool simplify_with_shared_borders(const SimplifyArguments& command, JsonValue& results) {
    std::vector<SharedBorderFile> files;
    models::TriangleMesh joined = read_joined(command.files, files);
    const simplify::AttributeSeams seams = repaired_mesh(command, command.files.front(), std::move(joined), results);
    const models::TriangleMesh& marked = seams.marked();
    simplify::SimplifyOptions options = options_of(command, models::diagonal_m(marked));
    const double wanted_error_m = options.goal.error_m.value_or(0.0);
    const std::filesystem::path folder = command.out_dir;
    const auto out_of = [&](const std::string& file) {
        return (folder / std::filesystem::path(file).filename()).string();
    };
    std::vector<std::string> outs;
    std::ranges::transform(command.files, std::back_inserter(outs), out_of);
    without_rounding(command, outs, models::bounds_of(marked), options.goal.error_m);
    const models::TriangleMesh original = seams.with_colours(marked);
    const Stopwatch watch;
    simplify::Simplified result = simplified_with_bounds(command, seams, options);
    if (const std::optional<std::size_t> file =
            vanished_file(files, original.triangle_materials, seams.with_colours(result.mesh).triangle_materials)) {
        base::print_note(command.quiet,
            fmt::format("note: no triangle of {} would be left, so --keep-shells is taken", command.files[*file]));
        options.keep_shells = true;
        result = simplified_with_bounds(command, seams, options);
    }
    const double time_s = watch.s();
    results["faces_before"] = marked.triangles.size();
    results["faces"] = result.mesh.triangles.size();
    results["vertices"] = result.mesh.vertices_m.size();
    results["steps"] = result.steps;
    print_steps(command, result);
    add_attribute_errors(command, results, seams, result.mesh);
    bool is_reached = reaches_goals(command, {options.goal.vertices, options.goal.faces, {}}, 0.0, results);
    if (!align_shared_borders(seams, files, original, result.mesh)) {
        base::print_note(command.quiet, "note: --shared-border: no two files have a vertex in common");
    }
    const models::TriangleMesh made = seams.with_attributes(std::move(result.mesh));
    const UnfinishedFolder unfinished(folder);
    for (std::size_t i = 0; i < command.files.size(); ++i) {
        const models::TriangleMesh part = files[i].part_of(made);
        JsonValue of_file = {{"in", command.files[i]}, {"out", outs[i]}, {"faces", part.triangles.size()},
            {"vertices", part.vertices_m.size()}};
        write_and_measure(command, unfinished.path() / std::filesystem::path(outs[i]).filename(), part,
            files[i].part_of(original), of_file);
        is_reached = reaches_goals(command, {{}, {}, options.goal.error_m}, wanted_error_m, of_file) && is_reached;
        results["files"].push_back(command.json ? std::move(of_file) : JsonValue(summary_line_of(outs[i], of_file)));
    }
    unfinished.move_into_place();
    results["time_s"] = time_s;
    return is_reached;
}

namespace {

void simplify_into_chain(const SimplifyArguments& command, const simplify::AttributeSeams& seams, JsonValue& results) {
    ChainOptions options;
    options.simplify = options_of(command, models::diagonal_m(seams.marked()));
    if (command.faces > 0) { options.coarsest_faces = static_cast<std::size_t>(command.faces); }
    if (!command.polygons.empty()) { options.polygons = polygons_in_file_axes(command.polygons); }
    base::Progress progress("making levels", 100, command.quiet, "percent");
    options.show_level = [&](std::size_t done, std::size_t of) {
        progress.show(static_cast<int>(100 * done / std::max<std::size_t>(of, 1)));
    };
    const Stopwatch watch;
    const meshfile::LevelChain chain = level_chain(seams, options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_chain(command.out, chain);
    const double diagonal_m = models::diagonal_m(chain.levels.front().mesh);
    std::vector<ChartLevel> chart;
    for (const meshfile::ChainLevel& level : chain.levels) {
        chart.push_back({.faces = level.mesh.triangles.size(),
            .error_m = level.error_m,
            .made_by = chart.empty() ? "the mesh itself" : fmt::format("level {} of the chain", chart.size())});
    }
    add_levels(command, chart, diagonal_m, results);
    results["polygons"] = chain.polygons ? chain.polygons->polygons.size() : 0;
    if (chain.polygons) { results["polygons_error"] = chain.polygons_error_m; }
    results["time_s"] = time_s;
}

/// The command that makes one level of a chart, with the options that change the result.
std::string level_command(const SimplifyArguments& command, std::size_t faces) {
    std::string text = fmt::format("octant simplify {} OUT --faces {}", sweep::shell_quoted(command.in), faces);
    const auto add = [&](std::string_view option, bool is_given, const auto&... value) {
        if (is_given) {
            text += fmt::format(" {}", option);
            ((text += fmt::format(" {}", value)), ...);
        }
    };
    add("--method", !command.method.empty(), command.method);
    add("--effort", command.effort >= 0, command.effort);
    add("--steps", command.steps >= 0, command.steps);
    if (command.colour_weight >= 0.0) {
        text += fmt::format(" --attribute-error colour-weight={}", command.colour_weight);
    }
    for (const AttributeBound& bound : bounds_of(command)) {
        const char separator = bound.option == "--uv-error" ? ' ' : '=';
        if (bound.wanted > 0.0) { text += fmt::format(" {}{}{}", bound.option, separator, bound.wanted); }
    }
    add("--keep-shells", command.keep_shells);
    add("--keep-topology", command.keep_topology);
    add("--keep-seams-apart", command.keep_seams_apart);
    add("--lock-border", command.lock_border);
    return text;
}

/// Half the triangles each time, each level by the command that the page gives for it.
void write_simplify_chart(const SimplifyArguments& command, const simplify::AttributeSeams& seams, JsonValue& results) {
    const models::TriangleMesh& original = seams.marked();
    const double diagonal_m = models::diagonal_m(original);
    const std::size_t faces_before = original.triangles.size();
    const std::size_t coarsest = std::clamp<std::size_t>(faces_before / 2, 2, 32);
    std::vector<ChartLevel> levels{{.faces = faces_before, .error_m = 0.0, .made_by = "the mesh itself"}};
    SimplifyArguments quiet = command; // Notes are on the mesh that is written.
    quiet.quiet = true;
    base::Progress progress("making levels", 100, command.quiet, "percent");
    for (std::size_t goal = faces_before / 2; goal >= coarsest;
         goal = goal == coarsest ? 0 : std::max(goal / 2, coarsest)) {
        simplify::SimplifyOptions options = options_of(command, diagonal_m);
        options.goal = {.vertices = {}, .faces = goal, .error_m = {}};
        const models::TriangleMesh mesh = simplified_with_bounds(quiet, seams, options).mesh;
        if (mesh.triangles.size() >= levels.back().faces) { break; }
        levels.push_back({.faces = mesh.triangles.size(),
            .error_m = certified_distance_m(original, mesh, command.threads),
            .made_by = level_command(command, goal)});
        progress.show(static_cast<int>(100 - 100 * goal / faces_before));
    }
    progress.finish();
    if (levels.size() < 2) {
        throw_error_in(
            command.in, fmt::format("--chart: expected a mesh that can be simplified, got one of {} triangles that "
                                    "cannot",
                            faces_before));
    }
    add_levels(command, levels, diagonal_m, results);
}

} // namespace

bool simplify_one(const SimplifyArguments& command, JsonValue& results) {
    if (const auto measure = paper_measure(command.method)) {
        simplify_as_printed(command, *measure, results);
        return true;
    }
    const simplify::AttributeSeams seams = read_repaired(command, results);
    if (command.chain) {
        simplify_into_chain(command, seams, results);
        return true;
    }
    if (!command.chart.empty()) { write_simplify_chart(command, seams, results); }
    return command.out.empty() || simplify_mesh(command, seams, results);
}

} // namespace octant::ui::commands
