// What was tried, measured against each other.
#include "models/simplify/candidate.h"

#include "models/collapse_sequence.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace octant::models::simplify {

bool is_reached(const Simplified& result, const Goal& goal) {
    return (!goal.faces || result.mesh.triangles.size() <= *goal.faces) &&
           (!goal.vertices || result.mesh.vertices_m.size() <= *goal.vertices);
}

bool Candidate::is_better_than(const Candidate& other, const Yardstick& yardstick) const {
    return misses != other.misses ? other.misses : other.is_worse_than(fault, yardstick);
}

bool Candidate::is_worse_than(const Fault& other, const Yardstick& yardstick) const {
    constexpr double clearly = 0.99;
    return yardstick.badness(other) < clearly * yardstick.badness(fault);
}

Candidate judged(
    Simplified result,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const IsHopeless& is_hopeless) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const bool misses = !is_reached(result, options.goal);
    Fault fault;
    if (result.mesh.triangles.empty()) {
        fault = {infinite, infinite, 1.0};
    } else if (!result.sequence.collapses.empty()) {
        FaultOptions how;
        how.threads = options.threads;
        how.is_hopeless = is_hopeless;
        fault = fault_of(result.mesh, original, how);
    }
    return {std::move(result), misses, fault, options.fits_slivers};
}

Yardstick yardstick_of(
    std::span<const Candidate> tried,
    const measure::TargetSurface& original,
    const SimplifyOptions& options) {
    Yardstick yardstick;
    for (const Candidate& one : tried) {
        const CollapseSequence& sequence = one.result.sequence;
        if (measures_distances(one.result.chosen_by) || one.misses || sequence.collapses.empty()) {
            continue;
        }
        const TriangleMesh mesh = mesh_after(sequence, sequence.collapses.size());
        if (!mesh.triangles.empty()) {
            yardstick.add(mesh, original, options.threads);
        }
    }
    return yardstick;
}

double most_turned(const Candidate& candidate, const Yardstick& yardstick) {
    return std::max(candidate.fault.turned, yardstick.allowed_turned());
}

std::size_t
least_in_the_mean(std::span<const Candidate> tried, std::size_t best, const Yardstick& yardstick) {
    const double most = most_turned(tried[best], yardstick);
    std::size_t least = best;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (!tried[i].misses && tried[i].fault.turned <= most &&
            tried[i].fault.rms_m < tried[least].fault.rms_m) {
            least = i;
        }
    }
    return least;
}

} // namespace octant::models::simplify
