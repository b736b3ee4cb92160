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
#include "models/simplify/collapse_run.h"
#include "models/simplify/error_search.h"
#include "models/simplify/passes.h"
#include "models/simplify/polish.h"

#include <cassert>
#include <numeric>
#include <optional>
#include <utility>

namespace octant::models::simplify {

namespace {

/// At least this many points stand for the original surface.
constexpr std::size_t least_points = 24'000;
/// How many times the wanted error collapses go by their own estimate: the polish may bring the
/// error back.
constexpr double beyond_goal = 2.0;

/// How thoroughly to polish.
PolishOptions polish_options(
    const WorkingSurface& surface, const WorkingSurface& target, const SimplifyOptions& options) {
    constexpr std::size_t many = 9;    // Triangles of the target for each one of the surface.
    constexpr std::size_t few = 3'000; // Triangles of a surface that is soon polished.
    PolishOptions polish;
    polish.threads = options.threads;
    if (options.quality == Quality::Fast) {
        polish.rounds = 1;
        polish.fields = 2;
        polish.extremes = false;
    } else if (target.mesh.face_count() > many * surface.mesh.face_count()) {
        polish.fields = 4;
    }
    if (options.quality == Quality::Surface && surface.mesh.face_count() <= few) {
        polish.rounds = 12;
    }
    return polish;
}

/// A tree over a surface none of whose triangles has gone, numbered as they are.
measure::TriangleBvh tree_of(const WorkingSurface& surface) {
    std::vector<Triangle> triangles;
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        triangles.push_back(surface.mesh.corners(face));
    }
    return {surface.places, triangles};
}

/// Polishes the surface and converts it to file units, with names and materials of `names`.
TriangleMesh polished_in(
    WorkingSurface& surface,
    TrackedPoints& points,
    const TriangleMesh& names,
    const WorkingSurface& target,
    const WorkingUnits& units,
    const SimplifyOptions& options) {
    const measure::TriangleBvh bvh = tree_of(target);
    polish(surface, points, {target, bvh}, polish_options(surface, target, options));
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
/// borders.
std::size_t wanted_points(const WorkingSurface& target, Quality quality) {
    return quality == Quality::Surface || target.coloured() ? least_points : 0;
}

/// Points of the target in the lists of their nearest triangles of a surface none of whose
/// triangles has gone.
TrackedPoints points_on(
    const WorkingSurface& surface, const WorkingSurface& target, const SimplifyOptions& options) {
    TrackedPoints points(target, wanted_points(target, options.quality));
    const measure::TriangleBvh bvh = tree_of(surface);
    std::vector<std::uint32_t> nearest(points.size());
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        const auto& place = points.place(point);
        nearest[point] = bvh.nearest({place[0], place[1], place[2]}).triangle;
    }
    points.assign_all(nearest, surface.mesh.face_slots());
    return points;
}

/// Points of the target in the lists of triangles near them, found by following the collapses of
/// the vertices: near enough for the polish to start from.
TrackedPoints points_carried(
    const WorkingSurface& surface,
    const WorkingSurface& target,
    const std::vector<Collapse>& collapses,
    Quality quality) {
    const std::size_t vertices = target.mesh.vertex_slots();
    // for each number of the sequence its vertex slot
    std::vector<std::uint32_t> slots(vertices + collapses.size());
    std::iota(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(vertices), 0U);
    for (std::size_t i = 0; i < collapses.size(); ++i) {
        slots[vertices + i] = slots[collapses[i].first];
    }
    // Backwards: each merged vertex gets the slot of what it became.
    for (std::size_t i = collapses.size(); i-- > 0;) {
        slots[collapses[i].first] = slots[vertices + i];
        slots[collapses[i].second] = slots[vertices + i];
    }
    TrackedPoints points(target, wanted_points(target, quality));
    std::vector<std::uint32_t> nearest(points.size());
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        const std::uint32_t corner = target.mesh.origin(3 * points.face(point));
        nearest[point] = surface.mesh.face_at(slots[corner]);
    }
    points.assign_all(nearest, surface.mesh.face_slots());
    return points;
}

/// Collapses edges of the surface until the goal is met.
std::vector<Collapse> contracted(
    WorkingSurface& surface,
    std::optional<TrackedPoints>& points,
    const WorkingUnits& units,
    const Goal& goal,
    Chooser chooser,
    const SimplifyOptions& options) {
    CollapseRun run(surface, units, chooser, points ? &*points : nullptr, options);
    run.run(goal, options.show_progress);
    return std::move(run.collapses());
}

CollapseSequence
sequence_to(const Goal& goal, TriangleMesh original, const SimplifyOptions& options) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    WorkingSurface surface(original, units);
    std::optional<TrackedPoints> points;
    if (options.quality == Quality::Surface) {
        points.emplace(surface, least_points);
    }
    const Chooser chooser = points ? Chooser::Distances : Chooser::Quadrics;
    CollapseSequence sequence;
    sequence.collapses = contracted(surface, points, units, goal, chooser, options);
    sequence.original = std::move(original);
    return sequence;
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

/// Simplifies to a goal of vertices or faces in one pass (OnePass).
Simplified
simplified_to_count(TriangleMesh original, const SimplifyOptions& options, Chooser chosen_by) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const WorkingSurface target(original, units);
    WorkingSurface surface = target;
    std::optional<TrackedPoints> points;
    if (measures_distances(chosen_by)) {
        points.emplace(target, least_points);
    }
    Simplified result;
    result.chosen_by = chosen_by;
    CollapseSequence& sequence = result.sequence;
    sequence.collapses = contracted(surface, points, units, options.goal, chosen_by, options);
    sequence.original = std::move(original);
    if (sequence.collapses.empty()) {
        result.mesh = finished(sequence, 0, options);
        return result;
    }
    if (!points) {
        points.emplace(points_carried(surface, target, sequence.collapses, options.quality));
    }
    result.mesh = with_normals(
        polished_in(surface, *points, sequence.original, target, units, options),
        sequence.original);
    return result;
}

} // namespace

Simplified simplified(TriangleMesh original, const SimplifyOptions& options) {
    if (options.goal.error_m) {
        return simplified_to_error(std::move(original), options);
    }
    return best_of_passes(std::move(original), options, simplified_to_count);
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
    const WorkingSurface target(original, units);
    WorkingSurface surface(mesh, units);
    TrackedPoints points = points_on(surface, target, options);
    return with_normals(polished_in(surface, points, mesh, target, units, options), original);
}

} // namespace octant::models::simplify
