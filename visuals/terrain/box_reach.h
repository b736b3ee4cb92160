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
    double spacing_m_;
    float spacing_squared_m2_;
    bool in_picture_ = false;
    float ahead_east_m_ = 0.0F; ///< What a sample east brings ahead.
    float ahead_north_m_ = 0.0F;
    float tilt_m2_ = 0.0F; ///< The square of the sine of the pitch, times a sample's.
    float corner_cos_squared_ = 1.0F;
    float near_factor_ = 1.0F;
};

/// The squared distances along one axis from the eye to four boxes that reach from `before` to
/// `after`, in samples^2.
inline FourFloats squared_distance(FourFloats before, FourFloats after) {
    const FourFloats off = larger(larger(before, -after), four(0.0F));
    return off * off;
}

/// The larger square of the ends of four boxes.
inline FourFloats squared_reach(FourFloats before, FourFloats after) {
    return larger(before * before, after * after);
}

/// The least of a linear function over what reaches from `before` to `after`.
inline FourFloats least_along(FourFloats before, FourFloats after, float slope) {
    return four(slope) * (slope > 0.0F ? before : after);
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
    const FourFloats level_m =
        least_along(b.west, b.east, ahead_east_m_) + least_along(b.south, b.north, ahead_north_m_);
    const FourFloats most_level_m = least_along(b.west, b.east, -ahead_east_m_) +
                                    least_along(b.south, b.north, -ahead_north_m_);
    const FourFloats depth_m = larger(level_m + b.ahead_m, four(0.0F));
    const FourFloats depth_m2 = larger(depth_m * depth_m, four(corner_cos_squared_) * distance_m2);
    const FourFloats across_m2 =
        larger(level_m * level_m, most_level_m * most_level_m) +
        four(tilt_m2_) * (squared_reach(b.west, b.east) + squared_reach(b.south, b.north));
    return depth_m2 * larger(depth_m2 / across_m2, four(near_factor_));
}

} // namespace octant::visuals::terrain
