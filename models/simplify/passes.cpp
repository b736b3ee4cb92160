// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So both are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/measure/mesh_distance.h"
#include "models/simplify/shells.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace octant::models::simplify {

namespace {

/// A plain pass is tried where no more than this share of the triangles is to be left: then it
/// costs a fraction of the other, and the other may go astray.
constexpr double deep = 0.1;
/// Quality::Fast tries a second plain pass on meshes of no more triangles, and then takes still
/// less time than Quality::Surface by far.
constexpr std::size_t small = 100'000;

bool is_reached(const Simplified& result, const Goal& goal) {
    return (!goal.faces || result.mesh.triangles.size() <= *goal.faces) &&
           (!goal.vertices || result.mesh.vertices_m.size() <= *goal.vertices);
}

/// How far a result is off: certified distance times root mean square; 0 where it lies on the
/// original.
double fault_of(const Simplified& result, const SimplifyOptions& options) {
    measure::DistanceOptions how;
    how.tightness = 1.05;
    how.samples = 50'000;
    how.negligible_m = 1e-6 * diagonal_m(result.sequence.original);
    how.threads = options.threads;
    const measure::MeshDistance distance =
        measure::distance(result.sequence.original, result.mesh, how);
    const double off_m = distance.most_hausdorff_m();
    return off_m > 2.0 * how.negligible_m ? off_m * distance.rms_m() : 0.0;
}

/// A result and how far it is off; one that misses the goal comes after all that reach it.
struct Candidate {
    Simplified result;
    bool misses = false;
    double fault = 0.0;

    bool is_better_than(const Candidate& other) const {
        constexpr double clearly = 0.99;
        return misses != other.misses ? other.misses : fault < clearly * other.fault;
    }
};

Candidate judged(Simplified result, const SimplifyOptions& options) {
    const bool misses = !is_reached(result, options.goal);
    const double fault = fault_of(result, options);
    return {std::move(result), misses, fault};
}

/// The plain passes that are tried beside the first one.
std::vector<Chooser> plain_passes(const Simplified& first, const SimplifyOptions& options) {
    const std::size_t before = first.sequence.original.triangles.size();
    const bool coloured = !first.sequence.original.colours.empty();
    std::vector<Chooser> plain;
    if (options.quality == Quality::Surface) {
        const bool is_deep =
            static_cast<double>(first.mesh.triangles.size()) <= deep * static_cast<double>(before);
        if (is_deep) {
            plain.push_back(Chooser::Quadrics);
        }
        if (is_deep && !coloured) {
            plain.push_back(Chooser::Volumes);
        }
    } else if (before <= small && !coloured) {
        plain.push_back(Chooser::Volumes);
    }
    return plain;
}

Simplified
best_pass(TriangleMesh original, const SimplifyOptions& options, const OnePass& one_pass) {
    const Chooser usual =
        options.quality == Quality::Surface ? Chooser::Distances : Chooser::Quadrics;
    Simplified first = one_pass(std::move(original), options, usual);
    const std::vector<Chooser> plain = plain_passes(first, options);
    if (first.mesh.triangles.empty() || first.sequence.collapses.empty() || plain.empty()) {
        return first;
    }
    Candidate best = judged(std::move(first), options);
    for (const Chooser chooser : plain) {
        Candidate next = judged(one_pass(best.result.sequence.original, options, chooser), options);
        if (next.is_better_than(best)) {
            best = std::move(next);
        }
    }
    return std::move(best.result);
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
