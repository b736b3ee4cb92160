#pragma once

#include "models/measure/target_surface.h"
#include "models/simplify/fault.h"
#include "models/simplify/simplified.h"
#include "models/simplify/simplify_options.h"

#include <cstddef>
#include <span>
#include <vector>

namespace octant::models::simplify {

bool is_reached(const Simplified& result, const Goal& goal);

/// A result and how far it is off.
struct Candidate {
    Simplified result;
    bool misses = false; ///< The goal.
    Fault fault;
    bool fits_slivers = false; ///< By SimplifyOptions::fits_slivers.

    /// One that misses the goal comes after all that reach it.
    bool is_better_than(const Candidate& other, const Yardstick& yardstick) const;

    /// Whether a result with this fault that reaches the goal, as this one does, is better.
    bool is_worse_than(const Fault& other, const Yardstick& yardstick) const;
};

/// The result with its fault. If `is_hopeless` is true of a part of the fault (FaultOptions), all
/// of it is infinite.
Candidate judged(
    Simplified result,
    const measure::TargetSurface& original,
    const SimplifyOptions& options,
    const IsHopeless& is_hopeless = {});

/// The yardstick with what the plain ones of the passes reached before their polish. Nothing more
/// is known where none was tried.
Yardstick yardstick_of(
    Yardstick yardstick,
    std::span<const Candidate> tried,
    const measure::TargetSurface& original,
    const SimplifyOptions& options);

/// The share of its area that what takes the place of a candidate may turn over: no more than that
/// one, or than plain ways do.
double most_turned(const Candidate& candidate, const Yardstick& yardstick);

/// The numbers of the candidates from which revisions lead farthest, the most promising first, one
/// for each way to choose collapses.
std::vector<std::size_t> starts(std::span<const Candidate> tried, const Yardstick& yardstick);

} // namespace octant::models::simplify
