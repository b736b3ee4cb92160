#pragma once

#include "visuals/terrain/float4.h"

#include <glm/vec3.hpp>

namespace octant::visuals::terrain {

/// Bounds how far errors in boxes are seen to reach in a picture, as the beginning of
/// error_rule.cpp tells.
class BoxErrorBound {
public:
    /// The boxes of influence of four samples: their ends in samples from the eye, and the least
    /// vertical share of their distance squared and of their depth.
    struct FourBoxes {
        Float4 west;
        Float4 east;
        Float4 south;
        Float4 north;
        Float4 gap_m2;
        Float4 ahead_m;
    };

    explicit BoxErrorBound(double spacing_m)
        : spacing_m_(spacing_m)
        , spacing_squared_m2_(static_cast<float>(spacing_m * spacing_m)) {}

    /// Bounds for pictures in this direction from now on, by the cosine of the angle to their
    /// corners; for all around the eye where the direction is zero.
    void set_direction(const glm::dvec3& ahead, double corner_cos);

    /// Whether the view has a direction.
    bool has_direction() const { return has_direction_; }

    /// The squares of lower bounds of m, where an error e anywhere in a box is at most focal length
    /// * e / m pixels.
    Float4 squared_m2(const FourBoxes& boxes) const;

private:
    /// What a sample east and a sample north bring along a level direction, in metres.
    struct AxisProjection {
        float east_m = 0.0F;
        float north_m = 0.0F;
    };

    /// The ends of what boxes reach along a direction.
    struct Range {
        Float4 min_m;
        Float4 max_m;
    };

    static Range range_along(const FourBoxes& boxes, const AxisProjection& along);
    Float4 min_share(const FourBoxes& boxes, const Range& level) const;

    double spacing_m_;
    float spacing_squared_m2_;
    bool has_direction_ = false;
    AxisProjection ahead_;        ///< The level part of the direction.
    AxisProjection aside_;        ///< Square to it, times the sine of the pitch.
    float level_ = 1.0F; ///< The cosine of the pitch.
    float corner_cos_squared_ = 1.0F;
    float max_aside_squared_ = 0.0F; ///< Of what lies aside in a picture, by depth.
    float near_factor_ = 1.0F;
};

/// The squared distances along one axis from the eye to four boxes that reach from `before` to
/// `after`, in samples^2.
inline Float4 squared_distance(Float4 before, Float4 after) {
    const Float4 off = max4(max4(before, -after), splat4(0.0F));
    return off * off;
}

/// A linear function at `before` where it rises and at `after` where it falls: its least over what
/// reaches from `before` to `after`, and its most with the ends exchanged.
inline Float4 min_along(Float4 before, Float4 after, float slope) {
    return splat4(slope) * (slope > 0.0F ? before : after);
}

inline BoxErrorBound::Range BoxErrorBound::range_along(const FourBoxes& b, const AxisProjection& along) {
    return {
        min_along(b.west, b.east, along.east_m) + min_along(b.south, b.north, along.north_m),
        min_along(b.east, b.west, along.east_m) + min_along(b.north, b.south, along.north_m)};
}

/// Lower bounds of the depth over the level distance ahead or behind, at or above zero, of what a
/// picture may show.
inline Float4 BoxErrorBound::min_share(const FourBoxes& b, const Range& level) const {
    constexpr float min_divisor_m = 1e-6F; // in place of a division by zero
    // Only a picture that shows what lies straight below or above the eye shows what lies behind
    // it; sums up to this count, because of rounding.
    constexpr float sees_nadir = 1.0001F;
    const Float4 worst_m = b.ahead_m < splat4(0.0F) ? level.min_m : level.max_m;
    const Float4 before = splat4(1.0F) + b.ahead_m / max4(worst_m, splat4(min_divisor_m));
    Float4 share = before;
    if (level_ * level_ + corner_cos_squared_ < sees_nadir) {
        const Float4 behind = b.ahead_m / max4(-level.min_m, splat4(min_divisor_m)) - splat4(1.0F);
        share = level.min_m < splat4(0.0F) ? min4(before, behind) : before;
    }
    return splat4(level_) * max4(share, splat4(0.0F));
}

inline Float4 BoxErrorBound::squared_m2(const FourBoxes& b) const {
    const Float4 distance_m2 = max4(
        splat4(spacing_squared_m2_) *
                (squared_distance(b.west, b.east) + squared_distance(b.south, b.north)) +
            b.gap_m2,
        splat4(1.0F));
    if (!has_direction_) {
        return distance_m2;
    }
    const Range level = range_along(b, ahead_);
    const Float4 depth_m = max4(level.min_m + b.ahead_m, splat4(0.0F));
    const Float4 depth_m2 = max4(depth_m * depth_m, splat4(corner_cos_squared_) * distance_m2);
    const Range aside = range_along(b, aside_);
    const Float4 aside_m2 = max4(aside.min_m * aside.min_m, aside.max_m * aside.max_m);
    const Float4 share = min_share(b, level);
    const Float4 across =
        splat4(1.0F) / (share * share) + min4(aside_m2 / depth_m2, splat4(max_aside_squared_));
    return depth_m2 * max4(splat4(1.0F) / across, splat4(near_factor_));
}

} // namespace octant::visuals::terrain
