// The product's simplification: edge collapses (collapse_run.cpp) and then a polish (polish.cpp),
// after which corner normals are taken over (attributes.cpp).
//
// It goes further than Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, from
// which the distance to triangles in both directions comes: the reference is the original surface
// instead of the previous mesh, new vertices are placed by quadrics instead of at ends or
// midpoints, the link condition keeps a manifold, and a wanted error is certified by measuring, not
// estimated. The paper's own mode is paper_simplify.cpp.
#include "models/simplify/simplify.h"

#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/attributes.h"
#include "models/simplify/collapse_run.h"
#include "models/simplify/passes.h"
#include "models/simplify/polish.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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
/// A wanted error may take this many tries, each with a polish and a certified distance.
constexpr int most_tries = 6;
/// Another try is made only while more than this share of the faces is in question.
constexpr double close_enough = 0.03;

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

/// Searches for the most collapses whose polished mesh keeps a wanted error by its certified
/// distance, so that whoever measures it again with the usual tightness finds it kept.
class ErrorSearch {
public:
    /// The sequence of collapses to a goal, without a polish.
    ErrorSearch(const CollapseSequence& sequence, const SimplifyOptions& options)
        : sequence_(sequence)
        , options_(options)
        , error_m_(*options.goal.error_m)
        , too_many_(sequence.collapses.size() + 1) {}

    /// Returns the number of collapses, and leaves their mesh in best().
    std::size_t find() {
        best_ = finished(sequence_, 0, options_);
        std::size_t next = first_guess();
        // More than most_tries are made only while nothing has been found that keeps the error.
        for (int tries = 0; next != fits_ && (tries < most_tries || fits_ == 0); ++tries) {
            tell(next);
            next = next_guess();
        }
        return fits_;
    }

    TriangleMesh& best() { return best_; }

private:
    /// Tries aim at this share of the wanted error.
    static constexpr double aim = 0.97;
    /// The number of faces is assumed to grow with this power of 1 / error.
    static constexpr double steepness = 1.5;
    /// The first try is where the estimate reaches this many times the wanted error, which the
    /// polish lowers.
    static constexpr double first_try = 1.2;

    /// The number of collapses of the first try, from the estimates in the sequence.
    std::size_t first_guess() const {
        const auto& all = sequence_.collapses;
        const double estimate_m =
            (options_.quality == Quality::Surface ? first_try : 0.9) * error_m_;
        const auto over = std::ranges::find_if(
            all, [estimate_m](const Collapse& collapse) { return collapse.error_m > estimate_m; });
        return static_cast<std::size_t>(over - all.begin());
    }

    /// Tries a number of collapses and narrows the range.
    void tell(std::size_t collapses) {
        TriangleMesh mesh = finished(sequence_, collapses, options_);
        const measure::MeshDistance distance = measure::distance(
            sequence_.original,
            mesh,
            {.tightness = 1.03,
             .negligible_m = 0.9 * error_m_,
             .samples = 100,
             .threads = options_.threads});
        const double about_m = 0.5 * (distance.least_hausdorff_m() + distance.most_hausdorff_m());
        likely_faces_ = faces_after(collapses) *
                        std::clamp(std::pow(about_m / (aim * error_m_), steepness), 0.4, 2.5);
        if (distance.most_hausdorff_m() * measure::DistanceOptions().tightness <= error_m_) {
            fits_ = collapses;
            best_ = std::move(mesh);
        } else {
            too_many_ = collapses;
        }
    }

    /// The number of faces after so many collapses.
    double faces_after(std::size_t collapses) const {
        double faces = static_cast<double>(sequence_.original.triangles.size());
        for (std::size_t i = 0; i < collapses; ++i) {
            const Collapse& collapse = sequence_.collapses[i];
            faces -= collapse.left != none ? 1.0 : 0.0;
            faces -= collapse.right != none ? 1.0 : 0.0;
        }
        return std::max(faces, 1.0);
    }

    /// The number of collapses to try next: where the last try suggests, if that is well inside the
    /// range; else half of the range in the logarithm of the number of faces. Returns fits_ when
    /// the range is narrow enough.
    std::size_t next_guess() const {
        if (too_many_ - fits_ <= 1) {
            return fits_;
        }
        const bool open = too_many_ > sequence_.collapses.size();
        const double most = faces_after(fits_);
        const double least = faces_after(std::min(too_many_, sequence_.collapses.size()));
        if (!open && most <= least * (1.0 + close_enough)) {
            return fits_;
        }
        const double inside = 1.0 + 0.3 * close_enough;
        const bool likely = likely_faces_ * inside < most && likely_faces_ > least * inside;
        const double wanted = likely ? likely_faces_ : std::sqrt(most * least);
        const std::size_t guess = collapses_to_faces(sequence_, static_cast<std::size_t>(wanted));
        return std::clamp(guess, fits_ + 1, too_many_ - 1);
    }

    const CollapseSequence& sequence_;
    const SimplifyOptions& options_;
    double error_m_;
    double likely_faces_ = 0.0; ///< The number of faces that the last try suggests.
    std::size_t fits_ = 0;      ///< The most collapses known to keep the wanted error.
    std::size_t too_many_;      ///< The fewest collapses known not to keep it.
    TriangleMesh best_;
};

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
    ErrorSearch search(result.sequence, options);
    result.sequence.collapses.resize(search.find());
    result.mesh = std::move(search.best());
    return result;
}

/// Simplifies to a goal of vertices or faces in one pass (OnePass).
Simplified
simplified_to_count(TriangleMesh original, const SimplifyOptions& options, Chooser chosen_by) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const WorkingSurface target(original, units);
    WorkingSurface surface = target;
    std::optional<TrackedPoints> points;
    if (chosen_by == Chooser::Distances) {
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
