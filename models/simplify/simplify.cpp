// The product's simplification: edge collapses (collapse_run.cpp), as many as a wanted error allows
// (error_search.cpp), and then a polish (polish.cpp), after which corner normals are taken over
// (attributes.cpp).
//
// It goes further than Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, from
// which the distance to triangles in both directions comes: the reference is the original surface
// instead of the previous mesh, new vertices are placed by quadrics instead of at ends or
// midpoints, the link condition keeps a manifold, and a wanted error is certified by measuring, not
// estimated. The paper's own mode is paper_simplify.cpp.
#include "models/simplify/simplify.h"

#include "models/measure/triangle_bvh.h"
#include "models/simplify/attributes.h"
#include "models/simplify/collapse_rounds.h"
#include "models/simplify/collapse_run.h"
#include "models/simplify/collapsing_surface.h"
#include "models/simplify/edge_splits.h"
#include "models/simplify/error_search.h"
#include "models/simplify/passes.h"
#include "models/simplify/point_lists.h"
#include "models/simplify/polish.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace octant::models::simplify {

namespace {

/// At least so many points stand for an original surface: where it is coloured, its borders need
/// them all.
std::size_t least_points(std::size_t triangles, bool coloured) {
    constexpr std::size_t enough = 24'000;
    return coloured ? enough : std::clamp(24 * triangles, std::size_t{8'000}, enough);
}

/// How many times the wanted error collapses go by their own estimate: the polish may bring the
/// error back.
constexpr double beyond_goal = 2.0;

/// The rounds of the polish before and after the collapses of a revision, whose surface is polished
/// already.
constexpr int revision_rounds = 4;
/// How the largest distance is lowered by looking closely, where triangles are few and large.
constexpr PeakOptions close_peaks{.least_looks = 110'000, .samples = 40'000};
/// And how Quality::Fast lowers it.
constexpr PeakOptions quick_peaks{.least_looks = 60'000, .looks_a_face = 3, .samples = 8'000};

/// Whether each triangle that is left of a large mesh stands for many.
bool stands_for_many(const TargetMesh& target, std::size_t faces_left) {
    constexpr std::size_t large = 100'000;
    constexpr std::size_t many = 30;
    return target.face_count() > std::max(large, many * faces_left);
}

/// How thoroughly to polish.
PolishOptions polish_options(
    const WorkingSurface& surface,
    const TargetMesh& target,
    double diagonal_m,
    const SimplifyOptions& options) {
    constexpr std::size_t many = 9;    // Triangles of the target for each one of the surface.
    constexpr std::size_t few = 3'000; // Triangles of a surface that is soon polished.
    // Of a target whose results are revised, and so polished again (best_of_passes).
    constexpr std::size_t soon_revised = 30'000;
    PolishOptions polish;
    polish.threads = options.threads;
    polish.slivers_too = options.fits_slivers;
    // Borders of colours and materials would not be looked at.
    if (!surface.coloured() && surface.materials.empty()) {
        polish.peaks = close_peaks;
    }
    polish.avoided2 = std::pow(options.avoided_m / diagonal_m, 2.0);
    if (options.quality == Quality::Fast) {
        polish.rounds = stands_for_many(target, surface.mesh.face_count()) ? 2 : 1;
        polish.fields = 2;
        polish.extremes = options.lowers_peaks;
        polish.peaks = quick_peaks;
    } else if (target.face_count() > many * surface.mesh.face_count()) {
        polish.fields = 4;
    }
    if (options.quality == Quality::Surface && surface.mesh.face_count() <= few) {
        const bool is_revised = !surface.coloured() && target.face_count() <= soon_revised;
        polish.rounds = is_revised ? 8 : 12;
    }
    return polish;
}

/// Polishes the surface and converts it to file units, with names and materials of `names`.
TriangleMesh polished_in(
    WorkingSurface& surface,
    TrackedPoints& points,
    const TriangleMesh& names,
    const TargetMesh& target,
    const WorkingUnits& units,
    const SimplifyOptions& options) {
    const measure::TriangleBvh bvh(target.places, target.triangles);
    polish(
        surface, points, {target, bvh}, polish_options(surface, target, units.diagonal_m, options));
    return surface.to_mesh(names, units);
}

/// The mesh with corner normals taken from the original.
TriangleMesh with_normals(TriangleMesh mesh, const TriangleMesh& original) {
    if (!original.corner_normals.empty()) {
        take_normals(mesh, original, measure::TriangleBvh(original));
    }
    return mesh;
}

/// The mesh after so many collapses of a sequence, as it is handed out.
TriangleMesh
finished(const CollapseSequence& sequence, std::size_t collapses, const SimplifyOptions& options) {
    TriangleMesh mesh = mesh_after(sequence, collapses);
    return collapses > 0 ? polished(std::move(mesh), sequence.original, options)
                         : with_normals(std::move(mesh), sequence.original);
}

/// How many points track the original. Where there are colours there must be enough to show their
/// borders; where a triangle stands for many, some dozens for each are enough.
std::size_t
wanted_points(const TargetMesh& target, std::size_t faces_left, const SimplifyOptions& options) {
    constexpr std::size_t points_a_face = 32;
    if (!target.coloured() && stands_for_many(target, faces_left)) {
        return std::min(target.places.size(), points_a_face * faces_left);
    }
    return options.quality == Quality::Surface || target.coloured()
               ? least_points(target.face_count(), target.coloured())
               : target.places.size() + 1;
}

CollapseSequence
sequence_to(const Goal& goal, TriangleMesh original, const SimplifyOptions& options) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    WorkingSurface surface(original, units);
    if (options.lock_border) {
        surface.lock_border(original, units);
    }
    std::optional<TrackedPoints> points;
    if (options.quality == Quality::Surface) {
        points.emplace(
            TargetMesh(original, units),
            least_points(original.triangles.size(), !original.colours.empty()));
    }
    CollapsingSurface collapsing(surface, units, points ? EdgeWeights{} : cost_weights);
    const Chooser chooser = points ? Chooser::Distances : Chooser::Quadrics;
    CollapseRun run(collapsing, chooser, points ? &*points : nullptr, nullptr, options);
    run.run(goal, options.show_progress);
    return {std::move(original), std::move(collapsing.collapses())};
}

/// Simplifies to a wanted error: one sequence of collapses beyond it, and then a search along the
/// sequence.
Simplified simplified_to_error(TriangleMesh original, const SimplifyOptions& options) {
    Goal goal = options.goal;
    if (options.quality == Quality::Surface) {
        goal.error_m = *goal.error_m * beyond_goal;
    }
    Simplified result;
    result.sequence = sequence_to(goal, std::move(original), options);
    KeptError kept = most_collapses_within(result.sequence, options, [&](std::size_t collapses) {
        return finished(result.sequence, collapses, options);
    });
    result.sequence.collapses.resize(kept.collapses);
    result.mesh = std::move(kept.mesh);
    return result;
}

/// Collapses in rounds for as long as their errors are far below those at the goal; not at all on
/// meshes of moderate size.
void begin_in_rounds(
    CollapsingSurface& collapsing, Chooser chooser, const SimplifyOptions& options) {
    constexpr std::size_t far = 8; // times the triangles of the goal
    constexpr std::size_t moderate = 50'000;
    RoundOptions rounds;
    rounds.faces = std::max(moderate, far * wanted_faces(options.goal));
    if (collapsing.first_faces() < 2 * rounds.faces) {
        return;
    }
    rounds.strictness = first_strictness(collapsing.surface(), chooser, options);
    rounds.low_may_turn = options.low_may_turn;
    rounds.threads = options.threads;
    // No more than vertices: at a boundary a collapse takes one triangle instead of two.
    collapsing.collapses().reserve(collapsing.first_vertices());
    collapse_in_rounds(collapsing, rounds);
}

/// The tracked points of a surface that is about to collapse on.
TrackedPoints points_of(
    const CollapsingSurface& collapsing,
    const TriangleMesh& original,
    const SimplifyOptions& options) {
    const TargetMesh target(original, collapsing.units());
    const std::size_t wanted = wanted_points(target, wanted_faces(options.goal), options);
    if (collapsing.collapses().empty()) {
        return {target, wanted};
    }
    TrackedPoints points = points_carried(collapsing, target, wanted);
    for (int time = 0; time < 2; ++time) {
        list_nearer(collapsing.surface(), points, options.threads);
    }
    measure_lists(collapsing.surface(), points);
    return points;
}

/// The weights of edges that suit what chooses the collapses.
EdgeWeights weights_for(Chooser chooser) {
    if (measures_distances(chooser)) {
        return {};
    }
    return chooser == Chooser::Planes ? alike_weights : cost_weights;
}

/// Simplifies to a goal of vertices or faces in one pass (OnePass).
Simplified
simplified_to_count(TriangleMesh original, const SimplifyOptions& options, Chooser chosen_by) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    WorkingSurface surface(original, units);
    if (options.lock_border) {
        surface.lock_border(original, units);
    }
    const bool measures = measures_distances(chosen_by);
    CollapsingSurface collapsing(surface, units, weights_for(chosen_by));
    begin_in_rounds(collapsing, chosen_by, options);
    std::optional<TrackedPoints> points;
    if (measures) {
        points.emplace(points_of(collapsing, original, options));
    }
    std::optional<measure::TriangleBvh> tree;
    if (measures && std::isfinite(options.avoided_m)) {
        tree.emplace(surface.places, original.triangles);
    }
    CollapseRun(
        collapsing, chosen_by, points ? &*points : nullptr, tree ? &*tree : nullptr, options)
        .run(options.goal, options.show_progress);
    Simplified result;
    result.chosen_by = chosen_by;
    result.sequence.original = std::move(original);
    const TargetMesh target(result.sequence.original, units);
    if (!points) {
        points.emplace(points_carried(
            collapsing, target, wanted_points(target, surface.mesh.face_count(), options)));
    }
    result.sequence.collapses = std::move(collapsing.collapses());
    if (result.sequence.collapses.empty()) {
        result.mesh = finished(result.sequence, 0, options);
        return result;
    }
    result.mesh = with_normals(
        polished_in(surface, *points, result.sequence.original, target, units, options),
        result.sequence.original);
    return result;
}

/// One revision (Revise): edges are split where the result is farthest off, and the cheapest ones
/// collapse instead.
TriangleMesh resplit(
    const TriangleMesh& mesh,
    const TriangleMesh& original,
    const SimplifyOptions& options,
    const Revision& revision) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const TargetMesh target(original, units);
    const measure::TriangleBvh bvh(target.places, target.triangles);
    const std::size_t wanted = wanted_points(target, mesh.triangles.size(), options);
    TriangleMesh split;
    {
        const WorkingSurface surface(mesh, units);
        TrackedPoints points = points_on(surface, target, wanted);
        split = with_split_edges(
            mesh, split_needs(surface, points, {target, bvh}, revision.split_by), revision.splits);
    }
    WorkingSurface surface(split, units);
    surface.holds_borders = true; // They would move a little each time.
    TrackedPoints points = points_on(surface, target, wanted);
    PolishOptions how = polish_options(surface, target, units.diagonal_m, options);
    how.rounds = revision_rounds;
    how.extremes = false;
    polish(surface, points, {target, bvh}, how);
    list_nearer(surface, points, options.threads);
    measure_lists(surface, points);
    const bool measures = measures_distances(revision.chooser);
    CollapsingSurface collapsing(surface, units, weights_for(revision.chooser));
    CollapseRun(collapsing, revision.chooser, measures ? &points : nullptr, &bvh, options)
        .run(options.goal, {});
    if (!measures) {
        surface.compact();
        points = points_on(surface, target, wanted);
    }
    how.extremes = true;
    polish(surface, points, {target, bvh}, how);
    return with_normals(surface.to_mesh(original, units), original);
}

} // namespace

Simplified simplified(TriangleMesh original, const SimplifyOptions& options) {
    if (options.goal.error_m) {
        return simplified_to_error(std::move(original), options);
    }
    // Revisions divide edges of borders.
    return options.lock_border
               ? simplified_to_count(std::move(original), options, Chooser::Distances)
               : best_of_passes(std::move(original), options, {simplified_to_count, resplit});
}

CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options) {
    assert(options.quality == Quality::Fast && !options.goal.error_m);
    SimplifyOptions facing = options;
    facing.low_may_turn = false;
    return sequence_to(facing.goal, std::move(original), facing);
}

TriangleMesh
polished(TriangleMesh mesh, const TriangleMesh& original, const SimplifyOptions& options) {
    if (mesh.triangles.empty() || original.triangles.empty()) {
        return mesh;
    }
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const TargetMesh target(original, units);
    WorkingSurface surface(mesh, units);
    if (options.lock_border) {
        surface.lock_border(mesh, units);
    }
    TrackedPoints points =
        points_on(surface, target, wanted_points(target, surface.mesh.face_count(), options));
    return with_normals(polished_in(surface, points, mesh, target, units, options), original);
}

} // namespace octant::models::simplify
