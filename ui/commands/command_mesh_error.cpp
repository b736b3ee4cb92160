#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "sim/base/error.h"
#include "sim/base/stopwatch.h"
#include "sim/base/thread_pool.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/world/mesh_loader.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <variant>

namespace octant::ui::commands {

using namespace command_line;

namespace measure = models::measure;

namespace {

using base::JsonValue;

struct MeshErrorOptions : base::OutputOptions {
    std::string a;
    std::string b;
    double tightness = 1.01;
    int samples = 400'000;
    int threads = core_count();
};

/// What was found; lengths in the units of the files.
struct MeshComparison {
    measure::MeshDistance distance;
    measure::MeshDefects defects; ///< of B
    double flipped_area_share = 0.0;
    double diagonal_m = 0.0; ///< of A
    bool coloured = false;   ///< both are
    double measure_ms = 0.0; ///< without reading
};

models::TriangleMesh read_surface(const std::string& path) {
    models::TriangleMesh mesh = world::load_mesh(path);
    if (mesh.triangles.empty()) { throw_error_in(path, "expected a mesh with triangles, got none"); }
    return mesh;
}

MeshComparison measure_meshes(
    const models::TriangleMesh& a, const models::TriangleMesh& b, const MeshErrorOptions& options) {
    const Stopwatch watch;
    measure::DistanceOptions wanted;
    wanted.tightness = options.tightness;
    wanted.samples = static_cast<std::size_t>(options.samples);
    wanted.threads = options.threads;
    base::Progress progress("measuring", 4, options.quiet, "steps");
    wanted.progress = [&progress](int done, int) { progress.show(done); };
    MeshComparison found;
    found.distance = measure::distance(a, b, wanted);
    progress.finish();
    found.defects = measure::defects(b);
    found.flipped_area_share = measure::flipped_area_share(b, a, found.distance.rms_m(), {.threads = options.threads});
    found.diagonal_m = models::diagonal_m(a);
    found.coloured = !a.colours.empty() && !b.colours.empty();
    found.measure_ms = watch.ms();
    return found;
}

/// One way, or both: lengths as fractions of the diagonal, then in units.
JsonValue distance_results(const measure::OneWayDistance& way, const MeshComparison& found) {
    const auto fraction = [&](double length_m) {
        return found.diagonal_m > 0.0 ? JsonValue(length_m / found.diagonal_m) : JsonValue();
    };
    JsonValue results;
    results["hausdorff_least"] = fraction(way.min_hausdorff_m);
    results["hausdorff_most"] = fraction(way.max_hausdorff_m);
    results["rms"] = fraction(way.rms_m);
    results["mean"] = fraction(way.mean_m);
    results["hausdorff_least_units"] = way.min_hausdorff_m;
    results["hausdorff_most_units"] = way.max_hausdorff_m;
    results["rms_units"] = way.rms_m;
    results["mean_units"] = way.mean_m;
    if (found.coloured) { results["colour_rms"] = way.colour_rms; }
    return results;
}

measure::OneWayDistance two_sided_distance(const measure::MeshDistance& distance) {
    return {{distance.min_hausdorff_m(), distance.max_hausdorff_m()},
        {distance.rms_m(), distance.mean_m(), distance.colour_rms()}};
}

JsonValue defect_results(const measure::MeshDefects& defects) {
    JsonValue results;
    results["boundary_edges"] = defects.boundary_edges;
    results["boundary_loops"] = defects.boundary_loops;
    results["non_manifold_edges"] = defects.non_manifold_edges;
    results["non_manifold_vertices"] = defects.non_manifold_vertices;
    results["turned_edges"] = defects.turned_edges;
    results["duplicate_faces"] = defects.duplicate_faces;
    results["degenerate_faces"] = defects.degenerate_faces;
    results["unreferenced_vertices"] = defects.unreferenced_vertices;
    results["shells"] = defects.shells;
    results["euler_characteristic"] = defects.euler_characteristic;
    results["genus"] = defects.genus;
    return results;
}

void print_row(const std::string& name, const measure::MeshDistance& distance,
    double measure::OneWayDistance::*statistic, double unit) {
    const auto both = two_sided_distance(distance);
    std::fputs(fmt::format("{:<28} {:>12.5g} {:>12.5g} {:>12.5g}\n", name, distance.there.*statistic / unit,
                   distance.back.*statistic / unit, both.*statistic / unit)
                   .c_str(),
        stdout);
}

void print_text(const MeshComparison& found) {
    using Way = measure::OneWayDistance;
    std::fputs(fmt::format("{:<28} {:>12} {:>12} {:>12}\n", "", "A to B", "B to A", "larger").c_str(), stdout);

    struct LengthUnit {
        const char* name;
        double unit;
    };

    for (const LengthUnit& kind : {LengthUnit{"of A's diagonal", found.diagonal_m}, LengthUnit{"units", 1.0}}) {
        if (!(kind.unit > 0.0)) { continue; }
        const auto row = [&](const std::string& name, double Way::*statistic) {
            print_row(fmt::format("{}, {}", name, kind.name), found.distance, statistic, kind.unit);
        };
        row("largest >=", &Way::min_hausdorff_m);
        row("largest <=", &Way::max_hausdorff_m);
        row("rms", &Way::rms_m);
        row("mean", &Way::mean_m);
    }
    if (found.coloured) { print_row("colour rms, of 0..1", found.distance, &Way::colour_rms, 1.0); }
    const JsonValue defects = defect_results(found.defects);
    for (const auto& [name, statistic] : std::get<JsonValue::JsonMembers>(defects.value())) {
        std::fputs(fmt::format("B: {:<25} {:>12}\n", name, base::text_of_value(statistic)).c_str(), stdout);
    }
    std::fputs(fmt::format("B: {:<25} {:>12.3g}\n{:<28} {:>12.5g}\n{:<28} {:>12.4g}\n", "flipped_area_share",
                   found.flipped_area_share, "A's diagonal, units", found.diagonal_m, "time, ms", found.measure_ms)
                   .c_str(),
        stdout);
}

void mesh_error(const MeshErrorOptions& options) {
    const Stopwatch watch;
    const models::TriangleMesh a = read_surface(options.a);
    const models::TriangleMesh b = read_surface(options.b);
    const double read_ms = watch.ms();
    const MeshComparison found = measure_meshes(a, b, options);
    JsonValue results;
    results["a"] = options.a;
    results["b"] = options.b;
    results["a_triangles"] = a.triangles.size();
    results["b_triangles"] = b.triangles.size();
    results["diagonal_units"] = found.diagonal_m;
    results["both"] = distance_results(two_sided_distance(found.distance), found);
    results["a_to_b"] = distance_results(found.distance.there, found);
    results["b_to_a"] = distance_results(found.distance.back, found);
    results["defects_of_b"] = defect_results(found.defects);
    results["flipped_area_share"] = found.flipped_area_share;
    results["samples"] = options.samples;
    results["threads"] = options.threads;
    results["read_ms"] = read_ms;
    results["measure_ms"] = found.measure_ms;
    if (options.json) {
        base::print_value(results, true);
    } else {
        print_text(found);
    }
}

constexpr const char* footer =
    "Distances go both ways, and the larger one counts. The largest distance (Hausdorff) is\n"
    "certified to lie between its two figures; rms and mean are over the area, sampled. Fractions\n"
    "are of the diagonal of A's bounding box, units those of the files. Area of B is flipped "
    "where\n"
    "it faces against the nearest part of A.\n"
    "Keys of --json:\n"
    "  a, b, a_triangles, b_triangles, diagonal_units;\n"
    "  both, a_to_b, b_to_a, each with hausdorff_least, hausdorff_most, rms, mean as fractions\n"
    "  (null where A has no size), the same with _units behind the name, and colour_rms (length "
    "in\n"
    "  RGB 0..1) where both files have colours;\n"
    "  defects_of_b with boundary_edges, boundary_loops, non_manifold_edges,\n"
    "  non_manifold_vertices, turned_edges, duplicate_faces, degenerate_faces,\n"
    "  unreferenced_vertices, shells, euler_characteristic, genus (null unless closed);\n"
    "  flipped_area_share, samples, threads, read_ms, measure_ms.\n"
    "Example:\n"
    "  octant mesh-error bunny.ply bunny-1000.ply --json";

std::vector<Option> options_of(MeshErrorOptions& options) {
    return with_output_options(options,
        {required(text_option("A", "MESH",
             "the original: " + world::built_in_mesh_names() + " or a file (.obj, .ply, .stl, .gltf, .glb, .ac, .wrl)",
             options.a)),
            required(text_option("B", "MESH", "mesh to compare with A", options.b)),
            hidden(value_option(
                {"tightness", "RATIO",
                    "largest allowed ratio of the upper to the lower bound of the Hausdorff distance", 1.000001, 100},
                options.tightness)),
            value_option({"samples", "N", "number of sample points in each direction, for rms and mean", 1, 1e9},
                options.samples),
            threads_option(options.threads)});
}

} // namespace

Command mesh_error_command() {
    auto options = std::make_shared<MeshErrorOptions>();
    return {.name = "mesh-error",
        .summary = "Measures the distance between two triangle meshes, and the defects of B",
        .options = options_of(*options),
        .footer = footer,
        .run = [options] { mesh_error(*options); }};
}

} // namespace octant::ui::commands
