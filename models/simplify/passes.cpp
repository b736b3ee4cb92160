// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So several ways are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/simplify/fault.h"
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

/// A result and how far it is off.
struct Candidate {
    Simplified result;
    bool misses = false;
    Fault fault;
    bool fits_slivers = false; ///< By SimplifyOptions::fits_slivers.

    /// One that misses the goal comes after all that reach it.
    bool is_better_than(const Candidate& other, const Yardstick& yardstick) const {
        constexpr double clearly = 0.99;
        return misses != other.misses
                   ? other.misses
                   : yardstick.badness(fault) < clearly * yardstick.badness(other.fault);
    }
};

Candidate judged(Simplified result, const SimplifyOptions& options) {
    constexpr double tightness = 1.02;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const bool misses = !is_reached(result, options.goal);
    Fault fault;
    if (result.mesh.triangles.empty()) {
        fault = {infinite, infinite, 1.0};
    } else if (!result.sequence.collapses.empty()) {
        fault = fault_of(result.mesh, result.sequence.original, tightness, options.threads);
    }
    return {std::move(result), misses, fault, options.fits_slivers};
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

/// What the plain ones of the passes reached before their polish. Nothing is known where none was
/// tried.
Yardstick yardstick_of(std::span<const Candidate> tried, const SimplifyOptions& options) {
    Yardstick yardstick;
    for (const Candidate& one : tried) {
        const CollapseSequence& sequence = one.result.sequence;
        if (measures_distances(one.result.chosen_by) || one.misses || sequence.collapses.empty()) {
            continue;
        }
        const TriangleMesh mesh = mesh_after(sequence, sequence.collapses.size());
        if (!mesh.triangles.empty()) {
            yardstick.add(mesh, sequence.original, options.threads);
        }
    }
    return yardstick;
}

/// Tries to lower the largest distance of the best result so far: passes that avoid all beyond a
/// part of it, side by side, as long as one of them is better, turns no more over and is hardly
/// farther off in the mean, or clearly less than plain passes are. Where most triangles stay there
/// is room for that.
Candidate lowered(
    Candidate best,
    const Yardstick& yardstick,
    const SimplifyOptions& options,
    const OnePass& one_pass) {
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
    const double plain_m =
        std::isfinite(yardstick.rms_m()) ? clearly_less * yardstick.rms_m() : 0.0;
    const double most_rms_m = std::max(hardly * best.fault.rms_m, plain_m);
    bool is_better = !best.misses && best.fault.off_m > 0.0;
    for (int time = 0; time < most_times && is_better; ++time) {
        std::array<Candidate, tries.size()> tried;
        share_out(tried.size(), options.threads, [&](std::size_t i, std::size_t) {
            SimplifyOptions how = options;
            how.fits_slivers = best.fits_slivers;
            how.avoided_m = tries[i].part * best.fault.off_m;
            how.slivers_too = tries[i].slivers_too;
            tried[i] = judged(one_pass(best.result.sequence.original, how, tries[i].chooser), how);
        });
        is_better = false;
        for (Candidate& other : tried) {
            if (other.fault.rms_m <= most_rms_m && other.fault.turned <= most_turned &&
                other.is_better_than(best, yardstick)) {
                best = std::move(other);
                is_better = true;
            }
        }
    }
    return best;
}

/// The best result so far, or a better balanced one where plain passes beat it in one value, or
/// nearly so: of the passes that were tried, and of the same ones with a polish that makes slivers.
/// It turns no more over.
Candidate beside_plain(
    std::vector<Candidate> tried,
    std::size_t best,
    const Yardstick& yardstick,
    const SimplifyOptions& options,
    const OnePass& one_pass) {
    const Fault fault = tried[best].fault;
    if (tried[best].misses || !(fault.off_m > 0.0) || yardstick.is_beaten_by(fault)) {
        return std::move(tried[best]);
    }
    const std::size_t passes = tried.size();
    tried.resize(2 * passes);
    SimplifyOptions how = options;
    how.fits_slivers = true;
    share_out(passes, options.threads, [&](std::size_t i, std::size_t) {
        const Simplified& other = tried[i].result;
        tried[passes + i] = judged(one_pass(other.sequence.original, how, other.chosen_by), how);
    });
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (tried[i].fault.turned <= fault.turned &&
            tried[i].is_better_than(tried[best], yardstick)) {
            best = i;
        }
    }
    return std::move(tried[best]);
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
        best = tried[i].is_better_than(tried[best], Yardstick()) ? i : best;
    }
    const bool is_small = tried[best].result.sequence.original.triangles.size() <= small;
    if (options.quality == Quality::Fast || !is_small) {
        return std::move(tried[best].result);
    }
    const Yardstick yardstick = yardstick_of(tried, options);
    Candidate found = beside_plain(std::move(tried), best, yardstick, quiet, one_pass);
    return lowered(std::move(found), yardstick, quiet, one_pass).result;
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
