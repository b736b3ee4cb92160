#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace octant::visuals::camera {

// Axes of a camera here: x right, y down, z forward, as in OpenCV. Pixels: column and row, whole numbers in the middle
// of pixels, 0, 0 in the upper left one.

enum class Distortion {
    None,
    BrownConrady, ///< k1, k2, p1, p2, k3 of OpenCV's projectPoints
    Fisheye       ///< k1, k2, k3, k4 of OpenCV's fisheye::projectPoints: equidistant
};

/// Which direction each pixel of a camera sees.
struct LensModel {
    glm::ivec2 size_px{0};
    glm::dvec2 focal_px{0.0}; ///< more than 0
    glm::dvec2 centre_px{0.0};
    Distortion distortion = Distortion::None;
    std::array<double, 5> coefficients{}; ///< in the order of the distortion's comment

    /// A camera without distortion whose picture is that high, with square pixels and the centre in its middle.
    static LensModel of_vertical_fov(const glm::ivec2& size_px, double vertical_fov_rad);

    /// The pixel that shows a point. Nothing where no pixel can: behind the camera (a fisheye sees there) or beyond the
    /// radius at which the distortion folds, where OpenCV gives the place of another point.
    std::optional<glm::dvec2> project(const glm::dvec3& point) const;

    /// Rays that are farther from straight ahead than 89.9 degrees have the length 1, others z = 1.
    static constexpr double unit_length_cos = 0.0017453283658983088;

    /// What a pixel sees: the inverse of project(). Nothing beyond the
    /// radius at which the distortion folds, and beyond 180 degrees from straight ahead.
    std::optional<glm::dvec3> ray(const glm::dvec2& at_px) const;

    /// How far the lens reaches from the centre towards a place outside it: the share, 0 to 1, of that way in which
    /// there are rays.
    double reach_towards(const glm::dvec2& at_px) const;
};

/// project() for many points.
class PointProjector {
public:
    /// `safe_radius`: up to that radius, in focal lengths in the undistorted picture, nothing folds: it is not looked
    /// for there.
    explicit PointProjector(const LensModel& lens, double safe_radius = 0.0);

    const LensModel& lens() const { return lens_; }

    std::optional<glm::dvec2> project(const glm::dvec3& point) const;

private:
    LensModel lens_;
    double safe_radius_ = 0.0;
    double fisheye_limit_rad_ = 0.0;
};

/// ray() for many pixels; those that follow each other take the least time.
class RayFinder {
public:
    explicit RayFinder(const LensModel& lens);

    std::optional<glm::dvec3> ray(const glm::dvec2& at_px);

private:
    LensModel lens_;
    double fisheye_limit_rad_ = 0.0;
    glm::dvec2 undistorted_{0.0}; ///< of the pixel before
    glm::dvec2 distorted_{0.0};
};

} // namespace octant::visuals::camera
