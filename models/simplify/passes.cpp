// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So several ways are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/measure/flipped_area.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/shells.h"
#include "sim/base/worker_team.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace octant::models::simplify {

namespace {

/// A plain pass is tried where no more than this share of the triangles is to be left: then it
/// costs a fraction of the other, and the other may go astray.
constexpr double deep = 0.1;
/// On meshes of no more triangles Quality::Surface tries every way.
constexpr std::size_t small = 30'000;
/// Quality::Fast tries a second plain pass on meshes of no more triangles, and then takes still
/// less time than Quality::Surface by far.
constexpr std::size_t small_for_fast = 100'000;

bool is_reached(const Simplified& result, const Goal& goal) {
    return (!goal.faces || result.mesh.triangles.size() <= *goal.faces) &&
           (!goal.vertices || result.mesh.vertices_m.size() <= *goal.vertices);
}

/// With one percent of its area turned over a result counts as twice as far off.
constexpr double turned_price = 100.0;

/// How far a result is off: certified distance times root mean square, more where triangles are
/// turned over; 0 where it lies on the original.
double fault_of(const Simplified& result, const SimplifyOptions& options) {
    if (result.mesh.triangles.empty()) {
        return std::numeric_limits<double>::infinity();
    }
    if (result.sequence.collapses.empty()) {
        return 0.0;
    }
    constexpr std::size_t samples = 50'000;
    measure::DistanceOptions how;
    how.tightness = 1.05;
    how.samples = samples;
    how.negligible_m = 1e-6 * diagonal_m(result.sequence.original);
    how.threads = options.threads;
    how.larger_alone = true;
    const measure::MeshDistance distance =
        measure::distance(result.sequence.original, result.mesh, how);
    const double off_m = distance.most_hausdorff_m();
    if (!(off_m > 2.0 * how.negligible_m)) {
        return 0.0;
    }
    const double turned = measure::flipped_area_share(
        result.mesh, result.sequence.original, {.samples = samples, .threads = options.threads});
    return off_m * distance.rms_m() * (1.0 + turned_price * turned);
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

/// What chooses the collapses of each pass that is tried; the usual one first.
std::vector<Chooser> choosers_for(const TriangleMesh& original, const SimplifyOptions& options) {
    const std::size_t before = original.triangles.size();
    const bool is_deep =
        static_cast<double>(wanted_faces(options.goal)) <= deep * static_cast<double>(before);
    const bool is_fast = options.quality == Quality::Fast;
    const bool has_plain = is_fast ? before <= small_for_fast : is_deep || before <= small;
    std::vector<Chooser> choosers{is_fast ? Chooser::Quadrics : Chooser::Distances};
    if (!is_fast && before <= small) {
        choosers.push_back(Chooser::Peaks);
    }
    if (!is_fast && has_plain) {
        choosers.push_back(Chooser::Quadrics);
    }
    if (original.colours.empty() && has_plain) {
        choosers.push_back(Chooser::Volumes);
    }
    return choosers;
}

/// Tries the passes side by side and returns the best result, the first one where none is clearly
/// better.
Simplified
best_pass(TriangleMesh original, const SimplifyOptions& options, const OnePass& one_pass) {
    const std::vector<Chooser> choosers = choosers_for(original, options);
    if (choosers.size() == 1) {
        return one_pass(std::move(original), options, choosers.front());
    }
    SimplifyOptions quiet = options;
    quiet.show_progress = nullptr;
    std::vector<Candidate> tried(choosers.size());
    share_out(choosers.size(), options.threads, [&](std::size_t i, std::size_t) {
        const SimplifyOptions& how = i == 0 ? options : quiet;
        tried[i] = judged(one_pass(original, how, choosers[i]), how);
    });
    std::size_t best = 0;
    for (std::size_t i = 1; i < tried.size(); ++i) {
        best = tried[i].is_better_than(tried[best]) ? i : best;
    }
    return std::move(tried[best].result);
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
