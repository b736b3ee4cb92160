#pragma once

#include "visuals/terrain/four_floats.h"

#include <glm/vec3.hpp>

namespace octant::visuals::terrain {

/// Bounds how far errors in boxes are seen to reach in a picture, as the beginning of
/// error_rule.cpp tells.
class BoxReach {
public:
    /// The boxes of influence of four samples: their ends in samples from the eye, and the least
    /// vertical share of their distance squared and of their depth.
    struct FourBoxes {
        FourFloats west;
        FourFloats east;
        FourFloats south;
        FourFloats north;
        FourFloats gap_m2;
        FourFloats ahead_m;
    };

    explicit BoxReach(double spacing_m)
        : spacing_m_(spacing_m)
        , spacing_squared_m2_(static_cast<float>(spacing_m * spacing_m)) {}

    /// Bounds for pictures in this direction from now on, by the cosine of the angle to their
    /// corners; for all around the eye where the direction is zero.
    void look(const glm::dvec3& ahead, double corner_cos);

    /// Whether the view has a direction.
    bool in_picture() const { return in_picture_; }

    /// The squares of lower bounds of m, where an error e anywhere in a box is at most focal length
    /// * e / m pixels.
    FourFloats squared_m2(const FourBoxes& boxes) const;

private:
    /// What a sample east and a sample north bring along a level direction, in metres.
    struct Along {
        float east_m = 0.0F;
        float north_m = 0.0F;
    };

    /// The ends of what boxes reach along a direction.
    struct Range {
        FourFloats min_m;
        FourFloats max_m;
    };

    static Range range_along(const FourBoxes& boxes, const Along& along);
    FourFloats min_share(const FourBoxes& boxes, const Range& level) const;

    double spacing_m_;
    float spacing_squared_m2_;
    bool in_picture_ = false;
    Along ahead_;        ///< The level part of the direction.
    Along aside_;        ///< Square to it, times the sine of the pitch.
    float level_ = 1.0F; ///< The cosine of the pitch.
    float corner_cos_squared_ = 1.0F;
    float max_aside_squared_ = 0.0F; ///< Of what lies aside in a picture, by depth.
    float near_factor_ = 1.0F;
};

/// The squared distances along one axis from the eye to four boxes that reach from `before` to
/// `after`, in samples^2.
inline FourFloats squared_distance(FourFloats before, FourFloats after) {
    const FourFloats off = larger(larger(before, -after), four(0.0F));
    return off * off;
}

/// A linear function at `before` where it rises and at `after` where it falls: its least over what
/// reaches from `before` to `after`, and its most with the ends exchanged.
inline FourFloats min_along(FourFloats before, FourFloats after, float slope) {
    return four(slope) * (slope > 0.0F ? before : after);
}

inline BoxReach::Range BoxReach::range_along(const FourBoxes& b, const Along& along) {
    return {
        min_along(b.west, b.east, along.east_m) + min_along(b.south, b.north, along.north_m),
        min_along(b.east, b.west, along.east_m) + min_along(b.north, b.south, along.north_m)};
}

/// Lower bounds of the depth over the level distance ahead or behind, at or above zero, of what a
/// picture may show.
inline FourFloats BoxReach::min_share(const FourBoxes& b, const Range& level) const {
    constexpr float no_way_m = 1e-6F; // in place of a division by zero
    // Only a picture that shows what lies straight below or above the eye shows what lies behind
    // it; sums up to this count, because of rounding.
    constexpr float sees_under = 1.0001F;
    const FourFloats worst_m = b.ahead_m < four(0.0F) ? level.min_m : level.max_m;
    const FourFloats before = four(1.0F) + b.ahead_m / larger(worst_m, four(no_way_m));
    FourFloats share = before;
    if (level_ * level_ + corner_cos_squared_ < sees_under) {
        const FourFloats behind = b.ahead_m / larger(-level.min_m, four(no_way_m)) - four(1.0F);
        share = level.min_m < four(0.0F) ? smaller(before, behind) : before;
    }
    return four(level_) * larger(share, four(0.0F));
}

inline FourFloats BoxReach::squared_m2(const FourBoxes& b) const {
    const FourFloats distance_m2 = larger(
        four(spacing_squared_m2_) *
                (squared_distance(b.west, b.east) + squared_distance(b.south, b.north)) +
            b.gap_m2,
        four(1.0F));
    if (!in_picture_) {
        return distance_m2;
    }
    const Range level = range_along(b, ahead_);
    const FourFloats depth_m = larger(level.min_m + b.ahead_m, four(0.0F));
    const FourFloats depth_m2 = larger(depth_m * depth_m, four(corner_cos_squared_) * distance_m2);
    const Range aside = range_along(b, aside_);
    const FourFloats aside_m2 = larger(aside.min_m * aside.min_m, aside.max_m * aside.max_m);
    const FourFloats share = min_share(b, level);
    const FourFloats across =
        four(1.0F) / (share * share) + smaller(aside_m2 / depth_m2, four(max_aside_squared_));
    return depth_m2 * larger(four(1.0F) / across, four(near_factor_));
}

} // namespace octant::visuals::terrain
