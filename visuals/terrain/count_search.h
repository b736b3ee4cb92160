#pragma once

#include "visuals/terrain/step_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

/// A search for the limit at which a mesh has a given number of triangles N.
struct CountSearch {
    int triangles = 0;  ///< The budget.
    float least = 0.0F; ///< The least allowed limit, above zero.
    float most = 0.0F;
    float last = 0.0F;  ///< The limit found for the frame before; 0 = none.
    float first = 0.0F; ///< How far to look when there is none.
};

/// The largest limit up to which no mesh has more triangles than the budget; the least allowed one if even that has
/// more. The last frame's limit only makes the search short; the answer does not depend on it.
///
/// `walk(low, high, max_triangles)` must start `steps` with (low, high) and add all steps of N below high; it may stop
/// once there are more than `max_triangles`. It returns whether there are steps above.
template <typename Walk>
float find_limit(const CountSearch& search, StepFunction& steps, const Walk& walk) {
    // How far a walk looks, as factors of the limit. They influence the time only. Below the last limit: single steps
    // are known from here on.
    constexpr float look_below = 0.7F;
    constexpr float look_above = 1.08F; // Above the last limit: the walk ends here.
    constexpr float step_back = 0.1F;   // After far too many triangles.
    constexpr float min_growth = 1.25F; // After too few triangles.
    constexpr float max_growth = 8.0F;

    const float least = search.least;
    const float most = std::max(search.most, least);
    const bool first = search.last <= 0.0F;
    float low = std::clamp(search.last * look_below, least, most);
    float high = std::clamp(first ? search.first : search.last * look_above, least, most);
    float too_high = std::numeric_limits<float>::infinity();
    int max_triangles = 2 * search.triangles + 1000;
    while (true) {
        const int stop = high > least ? max_triangles : std::numeric_limits<int>::max();
        const bool more_above = walk(low, high, stop);
        if (steps.at_high() > stop) {
            too_high = high;
            high = std::max(high * step_back, least);
            low = least;
            max_triangles += max_triangles / 4;
        } else if (low > least && steps.max_below_low() > search.triangles) {
            low = least;
        } else if (steps.at_low() > search.triangles) {
            return least;
        } else if (const auto place = steps.first_above(search.triangles)) {
            return *place;
        } else if (high >= most || !more_above) {
            return most;
        } else {
            const float missing =
                static_cast<float>(search.triangles) / static_cast<float>(std::max(steps.at_high(), 1));
            const float grown = high * std::clamp(1.1F * missing, min_growth, max_growth);
            high = std::min({grown, std::sqrt(high) * std::sqrt(too_high), most});
        }
    }
}

} // namespace octant::visuals::terrain
