// Greedy collapses leave a surface where no single collapse was a mistake and yet some vertices
// would be needed elsewhere more. H. Hoppe et al., "Mesh Optimization", 1993, section 4.2, try
// splits, collapses and flips at random; here a few edges are split where the distance is largest
// and the cheapest others collapse, several numbers of them side by side.
#include "models/simplify/revisions.h"

#include "models/simplify/material_borders.h"
#include "sim/base/worker_team.h"

#include <algorithm>
#include <array>
#include <utility>

namespace octant::models::simplify {

namespace {

struct Try {
    SplitBy split_by;
    double splits; ///< The share of the triangles that are split.
    double part;   ///< Distances beyond this part of the largest are avoided.
    Chooser chooser;
};

constexpr std::array<Try, 5> tries = {
    Try{SplitBy::Peaks, 0.002, 0.9, Chooser::Distances},
    {SplitBy::Peaks, 0.01, 0.8, Chooser::Distances},
    {SplitBy::Squares, 0.03, 0.9, Chooser::Distances},
    {SplitBy::Squares, 0.004, 1.0, Chooser::Volumes},
    {SplitBy::Squares, 0.03, 1.0, Chooser::Volumes}};
constexpr int most_times = 6;
/// A time that leaves more than this share of the badness is the last one.
constexpr double most_badness_left = 0.98;

Candidate tried_out(
    const Candidate& before,
    const Try& one,
    const Yardstick& yardstick,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const Revise& revise) {
    SimplifyOptions how = options;
    how.fits_slivers = before.fits_slivers;
    how.slivers_too = true;
    how.avoided_m = one.part * before.fault.off_m;
    // Where the mean has to become less, the largest distance may be as large as is wanted.
    if (one.split_by == SplitBy::Squares && yardstick.is_better_in_the_mean_than(before.fault)) {
        how.avoided_m = std::max(how.avoided_m, yardstick.wanted_off_m());
    }
    Simplified other = before.result;
    const double splits = one.splits * static_cast<double>(other.mesh.triangles.size());
    other.mesh = revise(
        before.result.mesh,
        original.mesh(),
        how,
        {one.split_by, 1 + static_cast<std::size_t>(splits), one.chooser});
    return judged(std::move(other), original, how, [&](const Fault& least) {
        return !before.is_worse_than(least, yardstick);
    });
}

} // namespace

Candidate revised(
    Candidate best,
    const Yardstick& yardstick,
    double most_badness,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const Revise& revise) {
    const double most = most_turned(best, yardstick);
    const BorderDistance borders = material_border_distance(best.result.mesh, original.mesh());
    bool is_better = !best.misses && best.fault.off_m > 0.0;
    for (int time = 0; time < most_times && is_better; ++time) {
        std::array<Candidate, tries.size()> tried;
        share_out(tried.size(), options.threads, [&](std::size_t i, std::size_t) {
            tried[i] = tried_out(best, tries[i], yardstick, original, options, revise);
        });
        const double before = yardstick.badness(best.fault);
        for (Candidate& other : tried) {
            if (other.fault.turned <= most && other.is_better_than(best, yardstick) &&
                material_border_distance(other.result.mesh, original.mesh()).keeps(borders)) {
                best = std::move(other);
            }
        }
        const double after = yardstick.badness(best.fault);
        is_better = after < most_badness_left * before && after <= most_badness;
    }
    return best;
}

} // namespace octant::models::simplify
