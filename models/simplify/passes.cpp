// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So several ways are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/measure/flipped_area.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/shells.h"
#include "sim/base/worker_team.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
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

/// How far a result is off.
struct Fault {
    double off_m = 0.0; ///< The certified distance; 0 where it lies on the original.
    double rms_m = 0.0;
    double turned = 0.0; ///< The share of its area that is turned over.
    /// The one times the other, more where triangles are turned over.
    double product = 0.0;
};

Fault fault_of(const Simplified& result, const SimplifyOptions& options) {
    if (result.mesh.triangles.empty()) {
        return {0.0, 0.0, 0.0, std::numeric_limits<double>::infinity()};
    }
    if (result.sequence.collapses.empty()) {
        return {};
    }
    constexpr std::size_t samples = 50'000;
    measure::DistanceOptions how;
    how.tightness = 1.02;
    how.samples = samples;
    how.negligible_m = 1e-6 * diagonal_m(result.sequence.original);
    how.threads = options.threads;
    how.larger_alone = true;
    const measure::MeshDistance distance =
        measure::distance(result.sequence.original, result.mesh, how);
    const double off_m = distance.most_hausdorff_m();
    if (!(off_m > 2.0 * how.negligible_m)) {
        return {};
    }
    const double turned = measure::flipped_area_share(
        result.mesh, result.sequence.original, {.samples = samples, .threads = options.threads});
    const double rms_m = distance.rms_m();
    return {off_m, rms_m, turned, off_m * rms_m * (1.0 + turned_price * turned)};
}

/// A result and how far it is off; one that misses the goal comes after all that reach it.
struct Candidate {
    Simplified result;
    bool misses = false;
    Fault fault;

    bool is_better_than(const Candidate& other) const {
        constexpr double clearly = 0.99;
        return misses != other.misses ? other.misses
                                      : fault.product < clearly * other.fault.product;
    }
};

Candidate judged(Simplified result, const SimplifyOptions& options) {
    const bool misses = !is_reached(result, options.goal);
    const Fault fault = fault_of(result, options);
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

/// The root mean square distance of the better one of the plain passes before its polish: about
/// what others reach. 0 where no plain one was tried.
double plain_rms_m(std::span<const Candidate> tried, const SimplifyOptions& options) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Candidate& one : tried) {
        const CollapseSequence& sequence = one.result.sequence;
        if (measures_distances(one.result.chosen_by) || one.misses || sequence.collapses.empty()) {
            continue;
        }
        measure::DistanceOptions how;
        how.tightness = 4.0;
        how.samples = 50'000;
        how.threads = options.threads;
        const TriangleMesh mesh = mesh_after(sequence, sequence.collapses.size());
        if (mesh.triangles.empty()) {
            continue;
        }
        least_m = std::min(least_m, measure::distance(sequence.original, mesh, how).rms_m());
    }
    return std::isinf(least_m) ? 0.0 : least_m;
}

/// Tries to lower the largest distance of the best result so far: passes that avoid all beyond a
/// part of it, side by side, as long as one of them is better, turns no more over and is hardly
/// farther off in the mean, or clearly less than plain passes are. Where most triangles stay there
/// is room for that.
Candidate
lowered(Candidate best, double plain_m, const SimplifyOptions& options, const OnePass& one_pass) {
    struct Try {
        Chooser chooser;
        double part;
        bool slivers_too;
    };

    constexpr std::array<Try, 4> tries = {
        Try{Chooser::Distances, 0.85, true},
        {Chooser::Distances, 0.65, true},
        {Chooser::Distances, 0.75, false},
        {Chooser::Peaks, 0.75, false}};
    constexpr int most_times = 3;
    constexpr double hardly = 1.02;
    constexpr double clearly_less = 0.88;
    const double most_turned = best.fault.turned;
    const double most_rms_m = std::max(hardly * best.fault.rms_m, clearly_less * plain_m);
    bool is_better = !best.misses && best.fault.off_m > 0.0;
    for (int time = 0; time < most_times && is_better; ++time) {
        std::array<Candidate, tries.size()> tried;
        share_out(tried.size(), options.threads, [&](std::size_t i, std::size_t) {
            SimplifyOptions how = options;
            how.avoided_m = tries[i].part * best.fault.off_m;
            how.slivers_too = tries[i].slivers_too;
            tried[i] =
                judged(one_pass(best.result.sequence.original, how, tries[i].chooser), options);
        });
        is_better = false;
        for (Candidate& other : tried) {
            if (other.fault.rms_m <= most_rms_m && other.fault.turned <= most_turned &&
                other.is_better_than(best)) {
                best = std::move(other);
                is_better = true;
            }
        }
    }
    return best;
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
    const bool is_small = tried[best].result.sequence.original.triangles.size() <= small;
    if (options.quality == Quality::Fast || !is_small) {
        return std::move(tried[best].result);
    }
    const double plain_m = plain_rms_m(tried, options);
    return lowered(std::move(tried[best]), plain_m, quiet, one_pass).result;
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
