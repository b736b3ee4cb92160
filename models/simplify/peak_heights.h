#pragma once

#include <algorithm>

namespace octant::models::simplify {

/// Statistics of the distances seen around some triangles, both ways, in working units.
struct Heights {
    double most2 = 0.0;   ///< The largest squared distance.
    double squares = 0.0; ///< The sum of weight times squared distance.
    /// The sum of weight times distance to the eighth, which the largest distances dominate.
    double powers = 0.0;
    double turned = 0.0; ///< The area that faces against the target.

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
