// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So both are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/measure/mesh_distance.h"
#include "models/simplify/shells.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace octant::models::simplify {

namespace {

/// A plain pass is tried where no more than this share of the triangles is to be left: then it
/// costs a fraction of the other, and the other may go astray.
constexpr double deep = 0.1;

bool is_reached(const Simplified& result, const Goal& goal) {
    return (!goal.faces || result.mesh.triangles.size() <= *goal.faces) &&
           (!goal.vertices || result.mesh.vertices_m.size() <= *goal.vertices);
}

/// How far a result is off: certified distance times root mean square.
double fault_of(const Simplified& result, const SimplifyOptions& options) {
    measure::DistanceOptions how;
    how.tightness = 1.05;
    how.samples = 50'000;
    how.negligible_m = 1e-6 * diagonal_m(result.sequence.original);
    how.threads = options.threads;
    const measure::MeshDistance distance =
        measure::distance(result.sequence.original, result.mesh, how);
    return distance.most_hausdorff_m() * distance.rms_m();
}

/// The better one of two results of one mesh; one that misses the goal is none.
Simplified better_of(Simplified one, Simplified other, const SimplifyOptions& options) {
    const bool one_fits = is_reached(one, options.goal);
    if (one_fits != is_reached(other, options.goal)) {
        return one_fits ? std::move(one) : std::move(other);
    }
    return fault_of(other, options) < fault_of(one, options) ? std::move(other) : std::move(one);
}

Simplified
best_pass(TriangleMesh original, const SimplifyOptions& options, const OnePass& one_pass) {
    Simplified best = one_pass(std::move(original), options, options.quality);
    const auto before = static_cast<double>(best.sequence.original.triangles.size());
    const bool is_deep = static_cast<double>(best.mesh.triangles.size()) <= deep * before;
    if (options.quality != Quality::Surface || !is_deep || best.mesh.triangles.empty()) {
        return best;
    }
    Simplified plain = one_pass(best.sequence.original, options, Quality::Fast);
    return better_of(std::move(best), std::move(plain), options);
}

std::size_t wanted_faces(const Goal& goal) {
    return goal.faces.value_or(2 * goal.vertices.value_or(0));
}

} // namespace

Simplified
best_of_passes(TriangleMesh original, const SimplifyOptions& options, const OnePass& one_pass) {
    Simplified best = best_pass(std::move(original), options, one_pass);
    if (options.keep_shells || is_reached(best, options.goal)) {
        return best;
    }
    const Shells shells = shells_of(best.sequence.original);
    const std::vector<bool> stays =
        shells_that_stay(shells, best.sequence, wanted_faces(options.goal));
    const auto gone = static_cast<std::size_t>(std::ranges::count(stays, false));
    if (gone == 0) {
        return best;
    }
    Simplified fewer =
        best_pass(only_shells(best.sequence.original, shells, stays), options, one_pass);
    fewer.shells_gone = gone;
    return fewer;
}

} // namespace octant::models::simplify
