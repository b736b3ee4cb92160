#pragma once

#include <cstddef>
#include <future>
#include <utility>

namespace octant::visuals::draworder {

/// Calls both functions, the first one on a thread of its own if `worthwhile`, and returns both
/// results. Neither may write to what the other one uses, so that the result is the same either
/// way.
template <typename First, typename Second>
auto both(bool worthwhile, First first, Second second) {
    auto there =
        std::async(worthwhile ? std::launch::async : std::launch::deferred, std::move(first));
    auto here = second();
    return std::pair(there.get(), std::move(here));
}

} // namespace octant::visuals::draworder
