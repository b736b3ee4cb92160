// Which collapses are best is known only afterwards: the cheapest next one leads astray now and
// then, by distances as by quadrics. So several ways are tried where that is cheap, and measured.
#include "models/simplify/passes.h"

#include "models/simplify/candidate.h"
#include "models/simplify/fault.h"
#include "models/simplify/material_borders.h"
#include "models/simplify/shells.h"
#include "sim/base/worker_team.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
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

/// So many passes run again with a polish that makes slivers.
constexpr std::size_t most_again = 4;
/// So many results are revised where the first one does not beat the yardstick.
constexpr std::size_t most_starts = 2;
/// A later one is given up where it stays more than so many times as bad as the best.
constexpr double most_behind = 1.25;

/// Whether a mesh shows nothing but its shape.
bool is_plain(const TriangleMesh& mesh) {
    return mesh.colours.empty() && !has_material_borders(mesh);
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
        if (before <= small && is_plain(original)) {
            choosers.push_back(Chooser::Planes);
        }
        choosers.push_back(Chooser::Volumes);
    }
    return choosers;
}

/// Tries to lower the largest distance of the best result so far: passes that avoid all beyond a
/// part of it, side by side, up to `most_times` as long as one of them is better, turns no more
/// over and is hardly farther off in the mean, or clearly less than plain passes are. Where most
/// triangles stay there is room for that.
Candidate lowered(
    Candidate best,
    const Yardstick& yardstick,
    int most_times,
    const measure::TargetSurface& original,
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
    constexpr double hardly = 1.02;
    constexpr double clearly_less = 0.88;
    const double most_turned = best.fault.turned;
    const double plain_m =
        std::isfinite(yardstick.rms_m()) ? clearly_less * yardstick.rms_m() : 0.0;
    const double most_rms_m = std::max(hardly * best.fault.rms_m, plain_m);
    bool is_better = !best.misses && best.fault.off_m > 0.0;
    for (int time = 0; time < most_times && is_better; ++time) {
        const auto is_hopeless = [&](const Fault& least) {
            return least.rms_m > most_rms_m || !best.is_worse_than(least, yardstick);
        };
        std::array<Candidate, tries.size()> tried;
        share_out(tried.size(), options.threads, [&](std::size_t i, std::size_t) {
            SimplifyOptions how = options;
            how.fits_slivers = best.fits_slivers;
            how.avoided_m = tries[i].part * best.fault.off_m;
            how.slivers_too = tries[i].slivers_too;
            tried[i] = judged(
                one_pass(original.mesh(), how, tries[i].chooser), original, how, is_hopeless);
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

/// Where plain passes beat the best result in one value, or nearly so, the same passes are tried
/// with a polish that makes slivers. Returns the number of the best of all, which turns no more
/// over than most_turned.
std::size_t beside_plain(
    std::vector<Candidate>& tried,
    std::size_t best,
    const Yardstick& yardstick,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const OnePass& one_pass) {
    const Fault fault = tried[best].fault;
    if (tried[best].misses || !(fault.off_m > 0.0) || yardstick.is_beaten_by(fault)) {
        return best;
    }
    const double most = most_turned(tried[best], yardstick);
    std::vector<std::size_t> again = starts(tried, yardstick);
    std::stable_partition(
        again.begin(), again.end(), [](std::size_t i) { return i == 0; }); // The usual one.
    again.resize(std::min(again.size(), most_again));
    const std::size_t passes = tried.size();
    tried.resize(passes + again.size());
    SimplifyOptions how = options;
    how.fits_slivers = true;
    if (fault.off_m > yardstick.wanted_off_m()) {
        how.avoided_m = yardstick.wanted_off_m();
    }
    share_out(again.size(), options.threads, [&](std::size_t i, std::size_t) {
        tried[passes + i] =
            judged(one_pass(original.mesh(), how, tried[again[i]].result.chosen_by), original, how);
    });
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (tried[i].fault.turned <= most && tried[i].is_better_than(tried[best], yardstick)) {
            best = i;
        }
    }
    return best;
}

/// Improves the passes that were tried by revisions, the most promising one first, and another one
/// where that does not beat the yardstick. Returns the best of all.
Simplified improved(
    std::vector<Candidate> tried,
    std::size_t best,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const Ways& ways) {
    const Yardstick yardstick = yardstick_of({}, tried, original, options);
    const bool plain = is_plain(original.mesh());
    if (plain || yardstick.is_better_than(tried[best].fault)) {
        best = beside_plain(tried, best, yardstick, original, options, ways.one_pass);
    }
    if (!plain) {
        Candidate one =
            lowered(std::move(tried[best]), Yardstick(), 3, original, options, ways.one_pass);
        constexpr double all = std::numeric_limits<double>::infinity();
        if (original.mesh().colours.empty()) {
            one = revised(std::move(one), yardstick, all, original, options, ways.revise);
        } // Distances do not tell where colours should end.
        return std::move(one.result);
    }
    const std::vector<std::size_t> from = starts(tried, yardstick);
    Candidate found = tried[best];
    for (std::size_t i = 0; i < std::min(most_starts, from.size()); ++i) {
        if (found.misses || (i > 0 && yardstick.is_beaten_by(found.fault))) {
            break;
        }
        Candidate start = tried[from[i]];
        const double wanted_m = yardstick.wanted_off_m();
        if (i == 0 && (start.fault.off_m > wanted_m || std::isinf(wanted_m))) {
            start = lowered(std::move(start), yardstick, 1, original, options, ways.one_pass);
        }
        const double rival = i == 0 ? std::numeric_limits<double>::infinity()
                                    : most_behind * yardstick.badness(found.fault);
        Candidate other =
            revised(std::move(start), yardstick, rival, original, options, ways.revise);
        if (other.is_better_than(found, yardstick)) {
            found = std::move(other);
        }
    }
    return std::move(found.result);
}

/// The number of the best candidate, the first one where none is clearly better.
std::size_t best_of(std::span<const Candidate> tried, const Yardstick& yardstick) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < tried.size(); ++i) {
        best = tried[i].is_better_than(tried[best], yardstick) ? i : best;
    }
    return best;
}

/// The best result of Quality::Fast. Where the pass after Garland and Heckbert is no farther off
/// before its polish, or hardly, the best pass and then the others run again with a polish that
/// lowers the largest distance.
Simplified best_fast(
    std::vector<Candidate> tried,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const OnePass& one_pass) {
    const auto printed = std::ranges::find(
        tried, Chooser::Planes, [](const Candidate& one) { return one.result.chosen_by; });
    if (printed == tried.end()) {
        return std::move(tried[best_of(tried, Yardstick())].result);
    }
    constexpr double nearly = 0.95; // Other ones of the same kind are somewhat better now and then.
    const Yardstick yardstick =
        yardstick_of(Yardstick(nearly, nearly), {printed, 1}, original, options);
    std::size_t best = best_of(tried, yardstick);
    SimplifyOptions how = options;
    how.lowers_peaks = true;
    for (const std::size_t i : starts(tried, yardstick)) {
        if (tried[best].misses || yardstick.is_beaten_by(tried[best].fault)) {
            break;
        }
        tried.push_back(judged(
            one_pass(original.mesh(), how, tried[i].result.chosen_by),
            original,
            how,
            [&](const Fault& least) { return !tried[best].is_worse_than(least, yardstick); }));
        best = best_of(tried, yardstick);
    }
    return std::move(tried[best].result);
}

/// Tries the passes side by side and returns the best result, the first one where none is clearly
/// better.
Simplified best_pass(TriangleMesh original, const SimplifyOptions& options, const Ways& ways) {
    const OnePass& one_pass = ways.one_pass;
    const std::vector<Chooser> choosers = choosers_for(original, options);
    if (choosers.size() == 1) {
        return one_pass(std::move(original), options, choosers.front());
    }
    SimplifyOptions quiet = options;
    quiet.show_progress = nullptr;
    std::vector<Candidate> tried(choosers.size());
    share_out(choosers.size(), options.threads, [&](std::size_t i, std::size_t) {
        const SimplifyOptions& how = i == 0 ? options : quiet;
        tried[i].result = one_pass(original, how, choosers[i]);
    });
    const measure::TargetSurface surface(original);
    share_out(tried.size(), options.threads, [&](std::size_t i, std::size_t) {
        tried[i] = judged(std::move(tried[i].result), surface, quiet);
    });
    const std::size_t best = best_of(tried, Yardstick());
    if (original.triangles.size() > small) {
        return std::move(tried[best].result);
    }
    if (options.quality == Quality::Fast) {
        return best_fast(std::move(tried), surface, quiet, one_pass);
    }
    return improved(std::move(tried), best, surface, quiet, ways);
}

/// The shells with which alone a plain pass comes nearest to the whole.
std::vector<bool> shells_to_stay(
    const Shells& shells,
    const CollapseSequence& exhausted,
    const SimplifyOptions& options,
    const OnePass& one_pass) {
    const TriangleMesh& whole = exhausted.original;
    std::vector<std::vector<bool>> sets =
        shells_that_may_stay(shells, exhausted, wanted_faces(options.goal));
    if (sets.size() == 1) {
        return std::move(sets.front());
    }
    SimplifyOptions plain = options;
    plain.quality = Quality::Fast;
    plain.show_progress = nullptr;
    const measure::TargetSurface surface(whole);
    std::vector<Candidate> tried(sets.size());
    share_out(sets.size(), options.threads, [&](std::size_t i, std::size_t) {
        tried[i] = judged(
            one_pass(only_shells(whole, shells, sets[i]), plain, Chooser::Quadrics),
            surface,
            plain);
    });
    return std::move(sets[best_of(tried, Yardstick())]);
}

} // namespace

Simplified best_of_passes(TriangleMesh original, const SimplifyOptions& options, const Ways& ways) {
    Simplified best = best_pass(std::move(original), options, ways);
    if (options.keep_shells || is_reached(best, options.goal)) {
        return best;
    }
    const TriangleMesh& whole = best.sequence.original;
    const Shells shells = shells_of(whole);
    const std::vector<bool> stays = shells_to_stay(shells, best.sequence, options, ways.one_pass);
    const auto gone = static_cast<std::size_t>(std::ranges::count(stays, false));
    if (gone == 0) {
        return best;
    }
    Simplified fewer = best_pass(only_shells(whole, shells, stays), options, ways);
    fewer.shells_gone = gone;
    return fewer;
}

} // namespace octant::models::simplify
