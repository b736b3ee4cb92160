#include "models/measure/sampled_distance.h"
#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "sim/base/error.h"
#include "sim/base/worker_team.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/commands.h"
#include "ui/commands/read_option.h"
#include "ui/world/mesh_input.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <variant>

namespace octant::ui::commands {

namespace measure = models::measure;

namespace {

using base::Figures;

struct MeshErrorOptions {
    std::string a;
    std::string b;
    double tightness = 1.01;
    int samples = 400'000;
    int threads = core_count();
    bool json = false;
    bool quiet = false;
};

/// What was found; lengths in the units of the files.
struct Findings {
    measure::MeshDistance distance;
    measure::MeshDefects defects; ///< of B
    double flipped_area_share = 0.0;
    double diagonal_m = 0.0; ///< of A
    bool coloured = false;   ///< both are
    double measure_ms = 0.0; ///< without reading
};

models::TriangleMesh read_surface(const std::string& path) {
    models::TriangleMesh mesh = world::read_mesh_input(path);
    if (mesh.triangles.empty()) {
        error_in(path, "expected a mesh with triangles, got none");
    }
    return mesh;
}

Findings found_between(
    const models::TriangleMesh& a, const models::TriangleMesh& b, const MeshErrorOptions& options) {
    const base::Stopwatch watch;
    measure::DistanceOptions wanted;
    wanted.tightness = options.tightness;
    wanted.samples = static_cast<std::size_t>(options.samples);
    wanted.threads = options.threads;
    base::Progress progress("measuring", 4, options.quiet, "steps");
    wanted.progress = [&progress](int done, int) { progress.show(done); };
    Findings found;
    found.distance = measure::distance(a, b, wanted);
    progress.finish();
    found.defects = measure::defects(b);
    measure::FlippedAreaOptions flipped;
    flipped.reach_m = found.distance.rms_m();
    flipped.threads = options.threads;
    found.flipped_area_share = measure::flipped_area_share(b, a, flipped);
    found.diagonal_m = models::diagonal_m(a);
    found.coloured = !a.colours.empty() && !b.colours.empty();
    found.measure_ms = watch.ms();
    return found;
}

/// One way, or both: lengths as fractions of the diagonal, then in units.
Figures way_figures(const measure::OneWayDistance& way, const Findings& found) {
    const auto fraction = [&](double length_m) {
        return found.diagonal_m > 0.0 ? Figures(length_m / found.diagonal_m) : Figures();
    };
    Figures figures;
    figures["hausdorff_least"] = fraction(way.min_hausdorff_m);
    figures["hausdorff_most"] = fraction(way.max_hausdorff_m);
    figures["rms"] = fraction(way.rms_m);
    figures["mean"] = fraction(way.mean_m);
    figures["hausdorff_least_units"] = way.min_hausdorff_m;
    figures["hausdorff_most_units"] = way.max_hausdorff_m;
    figures["rms_units"] = way.rms_m;
    figures["mean_units"] = way.mean_m;
    if (found.coloured) {
        figures["colour_rms"] = way.colour_rms;
    }
    return figures;
}

measure::OneWayDistance both_ways(const measure::MeshDistance& distance) {
    return {
        distance.min_hausdorff_m(),
        distance.max_hausdorff_m(),
        distance.rms_m(),
        distance.mean_m(),
        distance.colour_rms()};
}

Figures defect_figures(const measure::MeshDefects& defects) {
    Figures figures;
    figures["boundary_edges"] = defects.boundary_edges;
    figures["boundary_loops"] = defects.boundary_loops;
    figures["non_manifold_edges"] = defects.non_manifold_edges;
    figures["non_manifold_vertices"] = defects.non_manifold_vertices;
    figures["turned_edges"] = defects.turned_edges;
    figures["duplicate_faces"] = defects.duplicate_faces;
    figures["degenerate_faces"] = defects.degenerate_faces;
    figures["unreferenced_vertices"] = defects.unreferenced_vertices;
    figures["shells"] = defects.shells;
    figures["euler_characteristic"] = defects.euler_characteristic;
    figures["genus"] = defects.genus;
    return figures;
}

void print_row(
    const std::string& name,
    const measure::MeshDistance& distance,
    double measure::OneWayDistance::*figure,
    double unit) {
    const auto both = both_ways(distance);
    std::fputs(
        fmt::format(
            "{:<28} {:>12.5g} {:>12.5g} {:>12.5g}\n",
            name,
            distance.there.*figure / unit,
            distance.back.*figure / unit,
            both.*figure / unit)
            .c_str(),
        stdout);
}

void print_text(const Findings& found) {
    using Way = measure::OneWayDistance;
    std::fputs(
        fmt::format("{:<28} {:>12} {:>12} {:>12}\n", "", "A to B", "B to A", "larger").c_str(),
        stdout);

    struct Kind {
        const char* name;
        double unit;
    };

    for (const Kind& kind : {Kind{"of A's diagonal", found.diagonal_m}, Kind{"units", 1.0}}) {
        if (!(kind.unit > 0.0)) {
            continue;
        }
        const auto row = [&](const std::string& name, double Way::*figure) {
            print_row(fmt::format("{}, {}", name, kind.name), found.distance, figure, kind.unit);
        };
        row("largest >=", &Way::min_hausdorff_m);
        row("largest <=", &Way::max_hausdorff_m);
        row("rms", &Way::rms_m);
        row("mean", &Way::mean_m);
    }
    if (found.coloured) {
        print_row("colour rms, of 0..1", found.distance, &Way::colour_rms, 1.0);
    }
    const Figures defects = defect_figures(found.defects);
    for (const auto& [name, figure] : std::get<Figures::Named>(defects.value())) {
        std::fputs(
            fmt::format("B: {:<25} {:>12}\n", name, base::figure_text(figure)).c_str(), stdout);
    }
    std::fputs(
        fmt::format(
            "B: {:<25} {:>12.3g}\n{:<28} {:>12.5g}\n{:<28} {:>12.4g}\n",
            "flipped_area_share",
            found.flipped_area_share,
            "A's diagonal, units",
            found.diagonal_m,
            "time, ms",
            found.measure_ms)
            .c_str(),
        stdout);
}

void mesh_error(const MeshErrorOptions& options) {
    const base::Stopwatch watch;
    const models::TriangleMesh a = read_surface(options.a);
    const models::TriangleMesh b = read_surface(options.b);
    const double read_ms = watch.ms();
    const Findings found = found_between(a, b, options);
    Figures figures;
    figures["a"] = options.a;
    figures["b"] = options.b;
    figures["a_triangles"] = a.triangles.size();
    figures["b_triangles"] = b.triangles.size();
    figures["diagonal_units"] = found.diagonal_m;
    figures["both"] = way_figures(both_ways(found.distance), found);
    figures["a_to_b"] = way_figures(found.distance.there, found);
    figures["b_to_a"] = way_figures(found.distance.back, found);
    figures["defects_of_b"] = defect_figures(found.defects);
    figures["flipped_area_share"] = found.flipped_area_share;
    figures["samples"] = options.samples;
    figures["threads"] = options.threads;
    figures["read_ms"] = read_ms;
    figures["measure_ms"] = found.measure_ms;
    if (options.json) {
        base::print_figures(figures, true);
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
    return {
        required(text_option(
            "A",
            "MESH",
            "the original: " + world::built_in_meshes() +
                " or a file (.obj, .ply, .stl, .gltf, .glb, .ac, .wrl)",
            options.a)),
        required(text_option("B", "MESH", "what was made of it", options.b)),
        read_option(
            {"tightness", "RATIO", "most / least of the largest distance", 1.000001, 100},
            options.tightness),
        read_option({"samples", "N", "points each way, for rms and mean", 1, 1e9}, options.samples),
        read_option({"threads", "N", "that measure [all processors]", 1, 256}, options.threads),
        flag("--json", "results as JSON", options.json),
        flag("--quiet", "no progress", options.quiet)};
}

} // namespace

Command mesh_error_command() {
    auto options = std::make_shared<MeshErrorOptions>();
    return {
        .name = "mesh-error",
        .summary = "Measures how far two triangle meshes are apart, and what is wrong with B",
        .options = options_of(*options),
        .footer = footer,
        .run = [options] { mesh_error(*options); }};
}

} // namespace octant::ui::commands
