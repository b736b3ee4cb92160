#include "ui/studies/simplification/study_simplification.h"

#include "models/meshfile/mesh_file.h"
#include "models/procedural/procedural_models.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "sim/base/stopwatch.h"
#include "sim/base/thread_pool.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/report/child_program.h"
#include "ui/studies/study.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::studies::simplification {

namespace {

namespace fs = std::filesystem;
namespace measure = models::measure;
namespace simplify = models::simplify;
using models::TriangleMesh;
using simplify::PaperMeasure;

// The meshes.

StudyMesh study_mesh(std::string name, TriangleMesh original) {
    StudyMesh mesh;
    mesh.name = std::move(name);
    mesh.diagonal_m = models::diagonal_m(original);
    TriangleMesh shape;
    shape.vertices_m = original.vertices_m;
    shape.colours = original.colours;
    shape.triangles = original.triangles;
    mesh.original = shape;
    mesh.clean = models::repair::repaired(std::move(shape)).mesh;
    return mesh;
}

/// Every triangle cut in four at the middles of its sides.
TriangleMesh cut_in_four(const TriangleMesh& coarse) {
    TriangleMesh fine;
    fine.vertices_m = coarse.vertices_m;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices_m.size()));
        if (is_new) { fine.vertices_m.push_back(0.5 * (coarse.vertices_m[a] + coarse.vertices_m[b])); }
        return found->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

TriangleMesh fine_aircraft(const char* name) {
    constexpr std::size_t wanted = 40'000;
    TriangleMesh mesh = models::repair::repaired(models::meshfile::read_mesh(base::aircraft_file(name))).mesh;
    while (mesh.triangles.size() < wanted) { mesh = cut_in_four(mesh); }
    return mesh;
}

StudyMesh study_mesh_from(const fs::path& file) {
    StudyMesh mesh = study_mesh(file.stem().string(), models::meshfile::read_mesh(file));
    if (mesh.clean.triangles.empty()) { throw_error_in(file, "expected a mesh with triangles, got none"); }
    return mesh;
}

/// The coloured globe, a torus of 32,768 triangles, and what has sharp edges: a machined part, and the F-15 with every
/// triangle cut in four until there are 40,000.
std::vector<StudyMesh> built_in_meshes() {
    std::vector<StudyMesh> meshes;
    meshes.push_back(study_mesh("globe", models::procedural::globe()));
    meshes.push_back(study_mesh("torus", models::polygons::mesh_from_polygons(models::procedural::torus(256, 64))));
    meshes.push_back(study_mesh("machined part", models::procedural::machined_part()));
    meshes.push_back(study_mesh("F-15, fine", fine_aircraft("f15")));
    return meshes;
}

} // namespace

StudyMesh bunny_from(const std::filesystem::path& file) {
    StudyMesh mesh = study_mesh_from(file);
    constexpr std::size_t vertices = 35947;
    constexpr std::size_t faces = 69451;
    if (mesh.original.vertices_m.size() != vertices || mesh.original.triangles.size() != faces) {
        throw_error_in(file, fmt::format("expected the Stanford bunny of {} vertices and {} faces, got {} and {}",
                                 vertices, faces, mesh.original.vertices_m.size(), mesh.original.triangles.size()));
    }
    mesh.name = "bunny";
    return mesh;
}

namespace {

/// The bunny where it is given, the built-in meshes, and those of the options.
std::vector<StudyMesh> meshes_of(const SimplificationStudyOptions& options) {
    std::vector<StudyMesh> meshes;
    if (options.bunny) { meshes.push_back(bunny_from(*options.bunny)); }
    std::ranges::move(built_in_meshes(), std::back_inserter(meshes));
    for (const std::filesystem::path& file : options.meshes) { meshes.push_back(study_mesh_from(file)); }
    return meshes;
}

// The paper's simplifier.

/// Counted vertices that the paper stops at.
constexpr std::size_t paper_globe_vertices = 5000;

/// w of the globe's distances in (position, w rgb), metres on a globe of 1 m radius: nearest to the paper's table 2
/// within 0.01.
constexpr double globe_colour_weight_m = 0.12;

/// The paper's goal, or as far as the bunny goes.
std::size_t paper_goal(const StudyMesh& mesh) {
    constexpr double bunny_share = 2000.0 / 35947.0;
    if (mesh.name == "bunny") { return paper_bunny_vertices; }
    if (mesh.name == "globe") { return paper_globe_vertices; }
    return static_cast<std::size_t>(bunny_share * static_cast<double>(mesh.original.vertices_m.size()));
}

std::vector<ColourReading> colour_readings(const StudyMesh& mesh) {
    if (mesh.original.colours.empty()) { return {ColourReading::None}; }
    return {ColourReading::None, ColourReading::Distance, ColourReading::DistanceAndLength};
}

measure::MeshDistance distance_to(const TriangleMesh& original, const TriangleMesh& result) {
    measure::DistanceOptions options;
    options.tightness = 1.02;
    options.samples = 100'000;
    options.threads = core_count();
    return measure::distance(original, result, options);
}

} // namespace

std::vector<PaperRun> paper_runs(
    const StudyMesh& mesh, std::size_t vertices, ColourReading colour, base::Progress& progress) {
    std::vector<PaperRun> runs;
    for (const PaperMeasure by : {PaperMeasure::Plane, PaperMeasure::Triangle, PaperMeasure::Bidirectional}) {
        simplify::PaperOptions options;
        options.measure = by;
        options.goal.vertices = vertices;
        options.colour_weight = colour == ColourReading::None ? 0.0 : globe_colour_weight_m;
        options.colour_in_edge_length = colour == ColourReading::DistanceAndLength;
        PaperRun& run = runs.emplace_back();
        run.mesh = mesh.name;
        run.colour = colour;
        run.measure = by;
        run.diagonal_m = mesh.diagonal_m;
        const Stopwatch watch;
        run.result = simplify::paper_simplified(mesh.original, options);
        run.time_ms = watch.ms();
        run.distance = distance_to(mesh.original, run.result.mesh);
        run.defects = measure::defects(run.result.mesh);
        progress.tick(mesh.name);
    }
    return runs;
}

namespace {

// All methods, ours and those of other libraries.

struct TimedMesh {
    TriangleMesh mesh;
    double time_ms = 0.0;
};

/// A way to simplify a mesh to a number of faces.
struct Method {
    std::string name;
    std::function<TimedMesh(const TriangleMesh& mesh, std::size_t faces)> simplify;
    bool is_peer = false; ///< Of another library; it is given positions only.
};

/// A way of ours, timed by the wall clock.
template <class Simplify>
Method own_method(const char* name, const Simplify& simplify) {
    return {name, [simplify](const TriangleMesh& mesh, std::size_t faces) {
                const Stopwatch watch;
                TriangleMesh result = simplify(mesh, faces);
                return TimedMesh{std::move(result), watch.ms()};
            }};
}

template <int effort>
TriangleMesh simplified_by_us(const TriangleMesh& mesh, std::size_t faces) {
    simplify::SimplifyOptions options;
    options.effort = effort;
    options.goal.faces = faces;
    return simplify::simplified(mesh, options).mesh;
}

TriangleMesh simplified_as_paper(const TriangleMesh& mesh, std::size_t faces) {
    simplify::PaperOptions options;
    options.goal.faces = faces;
    return simplify::paper_simplified(mesh, options).mesh;
}

double time_in(const fs::path& program, const std::string& output) {
    const auto json = nlohmann::json::parse(output, nullptr, false);
    if (!json.is_object() || !json.contains("time_ms") || !json["time_ms"].is_number()) {
        throw_error_in(program, fmt::format("expected a line of JSON with time_ms, got '{}'", printable(output)));
    }
    return json["time_ms"].get<double>();
}

/// Simplifies by another library, which the program octant-peers calls; the time is the median of three, without
/// reading and writing. Nothing when the program was built without it. Throws Error when it cannot be run or fails.
std::optional<TimedMesh> simplified_by_peer(
    const fs::path& program, const std::string& method, const TriangleMesh& mesh, std::size_t faces) {
    const base::TemporaryFolder folder;
    const fs::path input = folder.path() / "input.obj";
    const fs::path output = folder.path() / "output.obj";
    TriangleMesh shape;
    shape.vertices_m = mesh.vertices_m;
    shape.triangles = mesh.triangles;
    models::meshfile::write_mesh(input, shape);
    auto child = report::ChildProgram::start({fs::absolute(program).string(), method, input.string(),
        fmt::format("{}", faces), output.string(), "--repeat", "3"});
    if (!child) { throw_error_in(program, "expected the program octant-peers, got nothing that can be run"); }
    const report::ProgramResult ending = child->finish();
    if (!ending.succeeded) {
        if (ending.output.starts_with("not built with")) { return std::nullopt; }
        throw_error_in(program, fmt::format("{} failed: {}", method, printable(ending.last_error_line)));
    }
    return TimedMesh{models::meshfile::read_mesh(output), time_in(program, ending.output)};
}

constexpr const char* lindstrom_turk = "CGAL Lindstrom-Turk";

/// Names that the program octant-peers knows, and names in tables.
constexpr std::array peer_methods = {std::pair{"meshoptimizer", "meshoptimizer"},
    std::pair{"cgal-lindstrom-turk", lindstrom_turk}, std::pair{"cgal-garland-heckbert", "CGAL Garland-Heckbert"},
    std::pair{"openmesh-quadric", "OpenMesh quadric"}};

/// Our methods, then those of other libraries with which octant-peers was built, tried on a small mesh. That program is
/// the one of the options or the one in the folder of this program, if it exists.
std::vector<Method> methods_of(const SimplificationStudyOptions& options) {
    std::vector<Method> methods = {own_method("Octant, surface", simplified_by_us<simplify::surface_effort>),
        own_method("Octant, fast", simplified_by_us<simplify::fast_effort>),
        own_method("2005, both directions", simplified_as_paper)};
    std::error_code failed;
    const fs::path neighbour = fs::read_symlink("/proc/self/exe", failed).parent_path() / "octant-peers";
    if (!options.peers && !fs::is_regular_file(neighbour, failed)) { return methods; }
    const fs::path program = options.peers.value_or(neighbour);
    const TriangleMesh torus = models::polygons::mesh_from_polygons(models::procedural::torus());
    for (const auto& [name, shown] : peer_methods) {
        if (!simplified_by_peer(program, name, torus, 100)) { continue; }
        const auto by_peer = [program, name = name](const TriangleMesh& mesh, std::size_t faces) {
            return simplified_by_peer(program, name, mesh, faces).value();
        };
        methods.push_back({shown, by_peer, true});
    }
    return methods;
}

/// One result of any method, lengths as fractions of the original's diagonal.
struct QualityRun {
    std::string mesh;
    std::string method;
    std::size_t target_faces = 0;
    std::size_t faces = 0;
    double hausdorff = 1.0; ///< certified upper bound
    double rms = 1.0;
    std::optional<double> colour_rms = {};
    double time_ms = 0.0;
    bool is_peer = false;
};

QualityRun quality_run(const StudyMesh& mesh, const std::string& name, std::size_t faces, const Method& method) {
    const TimedMesh result = method.simplify(mesh.clean, faces);
    QualityRun run{.mesh = name,
        .method = method.name,
        .target_faces = faces,
        .faces = result.mesh.triangles.size(),
        .time_ms = result.time_ms,
        .is_peer = method.is_peer};
    if (!result.mesh.triangles.empty()) {
        const measure::MeshDistance found = distance_to(mesh.clean, result.mesh);
        run.hausdorff = found.max_hausdorff_m() / mesh.diagonal_m;
        run.rms = found.rms_m() / mesh.diagonal_m;
        if (!mesh.clean.colours.empty() && !result.mesh.colours.empty()) { run.colour_rms = found.colour_rms(); }
    }
    return run;
}

// The tables of the simplification paper with ours beside.
//
// Source: Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, tables 1 and 2, figures 5 and 6.

/// What the paper prints of one model.
struct Printed {
    const char* mesh;
    std::size_t feet_inside;
    std::size_t feet_outside;
    std::array<double, 3> errors;     ///< by PaperMeasure
    std::array<std::size_t, 3> faces; ///< of the result, the same
};

constexpr std::array printed = {Printed{"bunny", 281616, 2501472, {4.34e-5, 3.65e-5, 3.65e-5}, {1725, 1725, 1725}},
    Printed{"globe", 234588, 2479236, {2.56e-5, 2.03e-5, 1.98e-5}, {9944, 9907, 9907}}};

const Printed* printed_of(const PaperRun& run) {
    const auto* found = std::ranges::find(printed, run.mesh, &Printed::mesh);
    return found == printed.end() ? nullptr : found;
}

constexpr std::array measure_names = {"previous", "one direction", "both directions"}; // by PaperMeasure
constexpr std::array colour_names = {"no", "distances", "distances, edge lengths"};    // by ColourReading

const char* name_of(PaperMeasure measure) { return measure_names[static_cast<std::size_t>(measure)]; }

const char* name_of(ColourReading colour) { return colour_names[static_cast<std::size_t>(colour)]; }

/// "12 of 34 = 35.29 %".
std::string share_text(std::size_t part, std::size_t all) {
    return fmt::format("{} of {} = {:.2f} %", part, all,
        100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1)));
}

std::vector<report::Cell> error_row(const PaperRun& run, const PaperRun& previous) {
    const Printed* paper = printed_of(run);
    const auto index = static_cast<std::size_t>(run.measure);
    const auto& sums = run.result.sums;
    const auto& before = previous.result.sums;
    const bool is_printed = paper != nullptr;
    return {{"mesh", run.mesh}, {"colour in", name_of(run.colour)}, {"measure", name_of(run.measure)},
        {"paper: error", is_printed ? fmt::format("{:.2e}", paper->errors[index]) : ""},
        {"paper: of previous", is_printed ? fmt::format("{:.2f}", paper->errors[index] / paper->errors[0]) : ""},
        {"one-way sum, m2", "{:.4e}", sums.triangle_m2},
        {"of previous", "{:.3f}", sums.triangle_m2 / before.triangle_m2},
        {"two-way sum, m2", "{:.4e}", sums.bidirectional_m2},
        {"of previous", "{:.3f}", sums.bidirectional_m2 / before.bidirectional_m2},
        {"paper: faces", is_printed ? fmt::format("{}", paper->faces[index]) : ""},
        {"faces", run.result.mesh.triangles.size()}, {"vertices used", run.result.mesh.vertices_m.size()},
        {"duplicate faces", run.defects.duplicate_faces}, {"edges of 3+ faces", run.defects.non_manifold_edges},
        {"Hausdorff, 1e-3", "{:.3f}", 1e3 * run.distance.max_hausdorff_m() / run.diagonal_m},
        {"RMS, 1e-4", "{:.3f}", 1e4 * run.distance.rms_m() / run.diagonal_m}, {"ms", "{:.0f}", run.time_ms}};
}

/// Whether a result has the faces asked for, and not many more.
bool is_at_goal(const QualityRun& run) {
    return static_cast<double>(run.faces) <= 1.02 * static_cast<double>(run.target_faces);
}

/// The least value of the libraries on the same mesh at the same goal, of those that reach it.
template <typename Value>
std::optional<double> best_peer_value(
    std::span<const QualityRun> runs, const QualityRun& reference, const Value& value) {
    std::optional<double> best;
    for (const QualityRun& run : runs) {
        if (run.is_peer && is_at_goal(run) && run.mesh == reference.mesh &&
            run.target_faces == reference.target_faces) {
            best = std::min(best.value_or(std::numeric_limits<double>::infinity()), value(run));
        }
    }
    return best;
}

std::optional<double> time_of_lindstrom_turk(std::span<const QualityRun> runs, const QualityRun& reference) {
    const auto found = std::ranges::find_if(runs, [&](const QualityRun& run) {
        return run.method == lindstrom_turk && run.mesh == reference.mesh && run.target_faces == reference.target_faces;
    });
    return found != runs.end() ? std::optional(found->time_ms) : std::nullopt;
}

std::string ratio_text(double value, const std::optional<double>& to) {
    return to && *to > 0.0 ? fmt::format("{:.2f}", value / *to) : "";
}

/// Of two distances as fractions of the diagonal: below 1e-8 they are rounding.
std::string distance_ratio_text(double value, const std::optional<double>& to) {
    constexpr double exact = 1e-8;
    if (!to || *to >= exact) { return ratio_text(value, to); }
    return value < exact ? "both exact" : "library exact";
}

std::vector<std::string> names_in_order(std::span<const QualityRun> runs, std::string QualityRun::*name) {
    std::vector<std::string> names;
    for (const QualityRun& run : runs) {
        if (std::find(names.begin(), names.end(), run.*name) == names.end()) { names.push_back(run.*name); }
    }
    return names;
}

report::PlotSeries series_of(std::span<const QualityRun> runs, const std::string& mesh, const std::string& method) {
    report::PlotSeries series;
    series.name = method;
    for (const QualityRun& run : runs) {
        if (run.mesh == mesh && run.method == method && run.rms > 0.0) {
            series.x.push_back(static_cast<double>(run.faces));
            series.y.push_back(run.rms);
        }
    }
    return series;
}

/// How the paper was read, above its tables: Markdown.
std::string paper_reading_text() {
    return fmt::format("# Simplification by distances to triangles (Y. Kim, B. U. Lee, 2005)\n\n"
                       "How the paper is read, where it leaves a choice:\n\n"
                       "- The shortest edge goes first, in space; equal lengths by the numbers of the vertices. "
                       "It becomes one of its ends or the middle, whichever costs least. No test keeps a "
                       "manifold.\n"
                       "- A cost is a sum of squared distances: of the new vertex to the faces of both ends, each "
                       "once (one direction); of both old ends to the same faces as moved, those that collapse "
                       "too; both directions: the larger sum. Previous: quadrics of planes.\n"
                       "- A foot is inside for 0 < a, b, c < 1: corners and borders are outside, and so is all of "
                       "a collapsed triangle. The share hangs on these points.\n"
                       "- Vertices that no triangle uses are counted: the bunny has 1113, and only so do 2000 "
                       "points have 1725 faces.\n"
                       "- The globe is made: 192 meridians, 192 rings, two poles, 1 m radius, land from Natural "
                       "Earth. Colour counts in distances as three more directions, w rgb with w = {:g} m, and "
                       "in the length of edges too where the table says so.\n"
                       "- The paper's error is the sum over all contractions, each against the mesh before. Its "
                       "unit is not said, and its values were not found again; what can be compared is each "
                       "measure against the previous one.\n\n",
        globe_colour_weight_m);
}

/// Table 1: how many perpendiculars end outside their triangle.
report::ResultTable feet_table(std::span<const PaperRun> runs) {
    report::ResultTable table{"Table 1: perpendiculars whose foot lies outside the triangle"};
    for (const PaperRun& run : runs) {
        if (run.measure != PaperMeasure::Bidirectional) { continue; }
        const Printed* paper = printed_of(run);
        table.add({{"mesh", run.mesh}, {"colour in", name_of(run.colour)},
            {"paper: outside",
                paper == nullptr ? "" : share_text(paper->feet_outside, paper->feet_inside + paper->feet_outside)},
            {"ours: outside", share_text(run.result.feet_outside, run.result.feet)}});
    }
    table.note = "Of the runs by both directions: three candidates for each edge, three points for "
                 "each face. The paper's numbers of perpendiculars can be divided by nine too.";
    return table;
}

/// Table 2: sums of errors, and what an independent measure says of the results.
report::ResultTable paper_error_table(std::span<const PaperRun> runs) {
    report::ResultTable table{"Table 2: error summed over all contractions"};
    const PaperRun* previous = nullptr;
    for (const PaperRun& run : runs) {
        previous = run.measure == PaperMeasure::Plane ? &run : previous;
        table.add(error_row(run, *previous));
    }
    table.note = "The sums are taken of every run by the same two rulers, whichever measure chose: squared "
                 "distances of new vertices to the triangles they replace, and the larger sum of both ways. "
                 "Hausdorff (certified upper bound, 2 % wide) and RMS are the larger one of both ways "
                 "between result and original, of positions only, as fractions of the diagonal: the paper's "
                 "sums fall while "
                 "these may rise, as each step is compared with the mesh before it only.";
    return table;
}

/// Every method on every mesh: distance to the original and time.
report::ResultTable quality_table(std::span<const QualityRun> runs, bool with_peers) {
    report::ResultTable table{"Distance to the original, and time"};
    for (const QualityRun& run : runs) {
        const auto hausdorff = best_peer_value(runs, run, [](const QualityRun& r) { return r.hausdorff; });
        const auto rms = best_peer_value(runs, run, [](const QualityRun& r) { return r.rms; });
        table.add({{"mesh", run.mesh}, {"method", run.method}, {"wanted faces", run.target_faces}, {"faces", run.faces},
            {"Hausdorff, 1e-3", "{:.3f}", 1e3 * run.hausdorff}, {"RMS, 1e-4", "{:.3f}", 1e4 * run.rms},
            {"colour RMS", run.colour_rms ? fmt::format("{:.4f}", *run.colour_rms) : ""},
            {"Hausdorff / best library", distance_ratio_text(run.hausdorff, hausdorff)},
            {"RMS / best library", distance_ratio_text(run.rms, rms)}, {"time, ms", "{:.1f}", run.time_ms},
            {"time / Lindstrom-Turk", ratio_text(run.time_ms, time_of_lindstrom_turk(runs, run))}});
    }
    table.note = "Both ways between result and repaired original, the larger one, as fractions of the "
                 "diagonal; Hausdorff is a certified upper bound, 2 % wide. One thread, wall time without "
                 "reading and writing; of the libraries the median of three. The libraries are given "
                 "positions only; the best one is that of those that came down to the faces wanted.";
    if (!with_peers) {
        table.note += " No libraries: build the target octant_peers (needs CGAL, meshoptimizer or "
                      "OpenMesh) and name the program octant-peers by --peers.";
    }
    return table;
}

/// RMS distance over faces, a plot a mesh; none for one number of faces.
std::vector<report::Plot> quality_plots(std::span<const QualityRun> runs) {
    constexpr std::array colours = {"#d62728", "#ff7f0e", "#777777", "#2ca02c", "#1f77b4", "#17becf", "#9467bd"};
    const std::vector<std::string> methods = names_in_order(runs, &QualityRun::method);
    std::vector<report::Plot> plots;
    for (const std::string& mesh : names_in_order(runs, &QualityRun::mesh)) {
        report::Plot plot{mesh, "faces", "RMS / diagonal"};
        plot.x_logarithmic = true;
        plot.y_logarithmic = true;
        for (std::size_t i = 0; i < methods.size(); ++i) {
            report::PlotSeries series = series_of(runs, mesh, methods[i]);
            series.colour = colours[i % colours.size()];
            if (series.x.size() > 1) { plot.series.push_back(std::move(series)); }
        }
        if (!plot.series.empty()) { plots.push_back(std::move(plot)); }
    }
    return plots;
}

/// The paper's runs of all meshes.
std::vector<PaperRun> all_paper_runs(const std::vector<StudyMesh>& meshes, bool quiet) {
    constexpr int measures = 3;
    int total = 0;
    for (const StudyMesh& mesh : meshes) { total += measures * static_cast<int>(colour_readings(mesh).size()); }
    base::Progress progress("the paper's simplifier", total, quiet, "results");
    std::vector<PaperRun> runs;
    for (const StudyMesh& mesh : meshes) {
        for (const ColourReading colour : colour_readings(mesh)) {
            std::ranges::move(paper_runs(mesh, paper_goal(mesh), colour, progress), std::back_inserter(runs));
        }
    }
    return runs;
}

std::vector<std::size_t> goals_for(const StudyMesh& mesh, const std::vector<std::size_t>& wanted) {
    if (!wanted.empty()) { return wanted; }
    std::vector<std::size_t> goals;
    for (const double share : {0.15, 0.05, 0.025}) {
        goals.push_back(static_cast<std::size_t>(share * static_cast<double>(mesh.clean.triangles.size())));
    }
    return goals;
}

/// Every method on every mesh, for each number of faces. Coloured meshes twice: for their shape alone by every method,
/// with colour by ours.
std::vector<QualityRun> all_quality_runs(
    const std::vector<StudyMesh>& meshes, const SimplificationStudyOptions& options, std::span<const Method> methods) {
    const auto own_methods = static_cast<std::size_t>(std::ranges::count(methods, false, &Method::is_peer));
    std::size_t total = 0;
    for (const StudyMesh& mesh : meshes) {
        total +=
            (methods.size() + (mesh.clean.colours.empty() ? 0 : own_methods)) * goals_for(mesh, options.faces).size();
    }
    base::Progress progress("every method", static_cast<int>(total), options.quiet, "results");
    std::vector<QualityRun> runs;
    const auto add = [&](const StudyMesh& mesh, const std::string& name, std::span<const Method> by) {
        for (const std::size_t faces : goals_for(mesh, options.faces)) {
            for (const Method& method : by) {
                runs.push_back(quality_run(mesh, name, faces, method));
                progress.tick(name);
            }
        }
    };
    for (const StudyMesh& mesh : meshes) {
        StudyMesh shape = mesh;
        shape.clean.colours.clear();
        add(shape, mesh.name, methods);
        if (!mesh.clean.colours.empty()) { add(mesh, mesh.name + ", coloured", methods.first(own_methods)); }
    }
    return runs;
}

} // namespace

void study_simplification(const SimplificationStudyOptions& options) {
    const std::vector<StudyMesh> meshes = meshes_of(options);
    Study study(options);
    const std::vector<Method> methods = options.paper_only ? std::vector<Method>() : methods_of(options);
    const std::vector<PaperRun> paper = all_paper_runs(meshes, options.quiet);
    study.add("table-1", feet_table(paper));
    study.add("table-2", paper_error_table(paper));
    if (!options.paper_only) {
        const std::vector<QualityRun> runs = all_quality_runs(meshes, options, methods);
        study.add("quality", quality_table(runs, !methods.empty() && methods.back().is_peer));
        study.add(quality_plots(runs), "RMS distance to the original over the number of faces.");
    }
    study.finish("simplification",
        paper_reading_text() + (options.bunny ? ""
                                              : "Left out: the bunny, which is not ours to ship; give the Stanford "
                                                "repository's bun_zipper.ply by --bunny.\n\n"));
}

} // namespace octant::ui::studies::simplification
