#include "models/simplify/simplify.h"

#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/attributes.h"
#include "models/simplify/collapse_run.h"
#include "models/simplify/polish.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace octant::models::simplify {

namespace {

/// Points that stand for the original surface: at least that many.
constexpr std::size_t least_points = 24'000;
constexpr int polish_rounds = 8;
/// How far collapses go beyond an error goal by their estimate: what comes after may lessen it.
constexpr double beyond_goal = 2.0;
/// Tries that an error goal may cost, each a polish and a certified distance.
constexpr int most_tries = 6;
/// A larger part than that of the faces would have to go for another try.
constexpr double close_enough = 0.03;

TriangleMesh polished_in(
    WorkingSurface& surface,
    TrackedPoints& points,
    const TriangleMesh& names,
    const WorkingSurface& target,
    const WorkingUnits& units,
    const SimplifyOptions& options) {
    std::vector<Triangle> triangles;
    for (std::uint32_t face = 0; face < target.mesh.face_slots(); ++face) {
        triangles.push_back(target.mesh.corners(face));
    }
    const measure::TriangleBvh bvh(target.places, triangles);
    polish(surface, points, {target, bvh}, {polish_rounds, options.threads});
    return surface.to_mesh(names, units);
}

TriangleMesh with_normals(TriangleMesh mesh, const TriangleMesh& original) {
    if (!original.corner_normals.empty()) {
        take_normals(mesh, original, measure::TriangleBvh(original));
    }
    return mesh;
}

/// The mesh of a sequence as it is handed out.
TriangleMesh
finished(const CollapseSequence& sequence, std::size_t collapses, const SimplifyOptions& options) {
    TriangleMesh mesh = mesh_after(sequence, collapses);
    if (options.quality == Quality::Surface && collapses > 0) {
        return polished(std::move(mesh), sequence.original, options);
    }
    return with_normals(std::move(mesh), sequence.original);
}

/// Looks for the most collapses whose mesh keeps an error goal, by certified distances.
class ErrorSearch {
public:
    ErrorSearch(const CollapseSequence& sequence, const SimplifyOptions& options)
        : sequence_(sequence)
        , options_(options)
        , error_m_(*options.goal.error_m)
        , too_many_(sequence.collapses.size() + 1) {}

    /// Leaves the mesh of the returned number of collapses in best().
    std::size_t find() {
        best_ = finished(sequence_, 0, options_);
        std::size_t next = first_guess();
        // More than that only as long as there is nothing to show for them.
        for (int tries = 0; next != fits_ && (tries < most_tries || fits_ == 0); ++tries) {
            tell(next);
            next = next_guess();
        }
        return fits_;
    }

    TriangleMesh& best() { return best_; }

private:
    /// Of the goal: where tries are made.
    static constexpr double aim = 0.97;
    /// Faces grow with that power of 1 / error.
    static constexpr double steepness = 1.5;
    /// Of the goal: the estimate that a polished mesh may start from.
    static constexpr double first_try = 1.2;

    std::size_t first_guess() const {
        const auto& all = sequence_.collapses;
        const double estimate_m =
            (options_.quality == Quality::Surface ? first_try : 0.9) * error_m_;
        const auto over = std::ranges::find_if(
            all, [estimate_m](const Collapse& collapse) { return collapse.error_m > estimate_m; });
        return static_cast<std::size_t>(over - all.begin());
    }

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
        if (distance.most_hausdorff_m() <= error_m_) {
            fits_ = collapses;
            best_ = std::move(mesh);
        } else {
            too_many_ = collapses;
        }
    }

    double faces_after(std::size_t collapses) const {
        double faces = static_cast<double>(sequence_.original.triangles.size());
        for (std::size_t i = 0; i < collapses; ++i) {
            const Collapse& collapse = sequence_.collapses[i];
            faces -= collapse.left != none ? 1.0 : 0.0;
            faces -= collapse.right != none ? 1.0 : 0.0;
        }
        return std::max(faces, 1.0);
    }

    /// As many faces as the last try lets expect, where that is well inside of
    /// the range, else half of it, as a ratio; fits_ itself when the range is close enough.
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
    double likely_faces_ = 0.0; ///< that the last try tells of
    std::size_t fits_ = 0;      ///< collapses that keep the goal
    std::size_t too_many_;      ///< collapses that do not
    TriangleMesh best_;
};

} // namespace

Simplified simplified(TriangleMesh original, const SimplifyOptions& options) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    WorkingSurface surface(original, units);
    std::optional<TrackedPoints> points;
    if (options.quality == Quality::Surface) {
        points.emplace(surface, least_points);
    }
    CollapseRun run(surface, units, points ? &*points : nullptr, options.length_share);
    Goal goal = options.goal;
    if (goal.error_m && points) {
        goal.error_m = *goal.error_m * beyond_goal;
    }
    run.run(goal, options.show_progress);
    Simplified result;
    result.sequence = {std::move(original), std::move(run.collapses())};
    CollapseSequence& sequence = result.sequence;
    if (options.goal.error_m) {
        ErrorSearch search(sequence, options);
        sequence.collapses.resize(search.find());
        result.mesh = std::move(search.best());
    } else if (points && !sequence.collapses.empty()) {
        const WorkingSurface target(sequence.original, units);
        result.mesh = with_normals(
            polished_in(surface, *points, sequence.original, target, units, options),
            sequence.original);
    } else {
        result.mesh = finished(sequence, sequence.collapses.size(), options);
    }
    return result;
}

TriangleMesh
polished(TriangleMesh mesh, const TriangleMesh& original, const SimplifyOptions& options) {
    if (mesh.triangles.empty() || original.triangles.empty()) {
        return mesh;
    }
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const WorkingSurface target(original, units);
    WorkingSurface surface(mesh, units);
    TrackedPoints points(target, least_points);
    const measure::TriangleBvh bvh(surface.places, mesh.triangles);
    std::vector<std::uint32_t> faces(points.size());
    for (std::uint32_t point = 0; point < points.size(); ++point) {
        const auto& place = points.place(point);
        faces[point] = bvh.nearest({place[0], place[1], place[2]}).triangle;
    }
    points.assign_all(faces, mesh.triangles.size());
    return with_normals(polished_in(surface, points, mesh, target, units, options), original);
}

} // namespace octant::models::simplify
