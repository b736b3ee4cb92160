// What was tried, measured against each other.
#include "models/simplify/candidate.h"

#include "models/collapse_sequence.h"

#include <algorithm>
#include <limits>
#include <numeric>
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
    } else if (
        !result.sequence.collapses.empty() ||
        result.mesh.triangles.size() != original.mesh().triangles.size()) {
        FaultOptions how;
        how.threads = options.threads;
        if (options.quality == Quality::Fast) {
            how.tightness = 1.05;
            how.most_samples = 15'000;
        }
        how.is_hopeless = is_hopeless;
        fault = fault_of(result.mesh, original, how);
    }
    return {std::move(result), misses, fault, options.fits_slivers};
}

Yardstick yardstick_of(
    Yardstick yardstick,
    std::span<const Candidate> tried,
    const measure::TargetSurface& original,
    const SimplifyOptions& options) {
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

std::vector<std::size_t> starts(std::span<const Candidate> tried, const Yardstick& yardstick) {
    std::vector<std::size_t> order(tried.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t one, std::size_t other) {
        const Candidate& a = tried[one];
        const Candidate& b = tried[other];
        return a.misses != b.misses
                   ? b.misses
                   : yardstick.hopelessness(a.fault) < yardstick.hopelessness(b.fault);
    });
    std::vector<std::size_t> found;
    for (const std::size_t i : order) {
        if (std::ranges::none_of(found, [&](std::size_t other) {
                return tried[other].result.chosen_by == tried[i].result.chosen_by;
            })) {
            found.push_back(i);
        }
    }
    return found;
}

} // namespace octant::models::simplify
