#pragma once

#include <algorithm>

namespace octant::models::simplify {

/// What distances there are around some triangles.
struct Heights {
    double most2 = 0.0;   ///< largest squared distance
    double squares = 0.0; ///< sum of weight times squared distance
    double powers = 0.0;  ///< sum of weight times squared distance to the fourth
    double turned = 0.0;  ///< area that faces against the target

    void add(double distance2, double weight) {
        const double fourth = distance2 * distance2;
        most2 = std::max(most2, distance2);
        squares += weight * distance2;
        powers += weight * fourth * fourth;
    }

    void add(const Heights& other) {
        most2 = std::max(most2, other.most2);
        squares += other.squares;
        powers += other.powers;
        turned += other.turned;
    }
};

} // namespace octant::models::simplify
