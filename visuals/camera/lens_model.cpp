#include "visuals/camera/lens_model.h"

#include "sim/base/units.h"
#include "visuals/camera/trigonometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::camera {

namespace {

using Coefficients = std::array<double, 5>;

double length_of(const glm::dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// A place in the plane at z = 1 after Brown-Conrady distortion, and its derivatives.
struct Distorted {
    glm::dvec2 at{0.0};
    double xx = 1.0; ///< d at.x / d x
    double xy = 0.0; ///< d at.x / d y = d at.y / d x
    double yy = 1.0; ///< d at.y / d y

    double determinant() const { return xx * yy - xy * xy; }
    bool is_upright() const { return determinant() > 1e-12 && xx + yy > 0.0; }
};

Distorted distorted(const Coefficients& k, const glm::dvec2& u) {
    const double r2 = u.x * u.x + u.y * u.y;
    const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    const double slope = 2.0 * (k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4])); // d radial / d r, over r
    const double p1 = k[2];
    const double p2 = k[3];
    Distorted to;
    to.at.x = u.x * radial + 2.0 * p1 * u.x * u.y + p2 * (r2 + 2.0 * u.x * u.x);
    to.at.y = u.y * radial + p1 * (r2 + 2.0 * u.y * u.y) + 2.0 * p2 * u.x * u.y;
    to.xx = radial + u.x * u.x * slope + 2.0 * p1 * u.y + 6.0 * p2 * u.x;
    to.xy = u.x * u.y * slope + 2.0 * p1 * u.x + 2.0 * p2 * u.y;
    to.yy = radial + u.y * u.y * slope + 6.0 * p1 * u.y + 2.0 * p2 * u.x;
    return to;
}

/// What is distorted to `target`, by Newton's method from `start`; nothing where that leaves the upright region that
/// the start lies in, or does not end.
std::optional<glm::dvec2> found_from(const Coefficients& k, const glm::dvec2& start, const glm::dvec2& target) {
    constexpr int max_steps = 24;
    glm::dvec2 at = start;
    double last_step = 0.0;
    for (int i = 0; i < max_steps; ++i) {
        const Distorted here = distorted(k, at);
        if (!here.is_upright()) { return std::nullopt; }
        const glm::dvec2 left = target - here.at;
        const glm::dvec2 step =
            glm::dvec2(here.yy * left.x - here.xy * left.y, here.xx * left.y - here.xy * left.x) / here.determinant();
        const double size = length_of(step);
        const double unit = 1.0 + length_of(at);
        if (!(size < 0.5 * unit)) { return std::nullopt; }
        at += step;
        const bool is_at_rest = i > 0 && size >= last_step && size < 1e-12 * unit;
        if (size < 1e-16 * unit || is_at_rest) {
            constexpr int places = 8;
            for (int place = 1; place <= places; ++place) {
                const double share = static_cast<double>(place) / places;
                if (!distorted(k, start + (at - start) * share).is_upright()) { return std::nullopt; }
            }
            return at;
        }
        last_step = size;
    }
    return std::nullopt;
}

/// A walk from one place of the distorted picture straight to another one, with what each place is the picture of.
struct Walk {
    glm::dvec2 undistorted{0.0};
    double share = 0.0; ///< of the way that could be gone
};

/// Halves its steps where Newton's method fails; a way that ends in spite of that ends at a fold.
Walk walk(const Coefficients& k, const glm::dvec2& undistorted, const glm::dvec2& from, const glm::dvec2& to) {
    Walk now{undistorted, 0.0};
    double step = 1.0;
    while (now.share < 1.0) {
        const double next = std::min(now.share + step, 1.0);
        if (const auto found = found_from(k, now.undistorted, next == 1.0 ? to : from + (to - from) * next)) {
            now = {*found, next};
            step *= 2.0;
        } else {
            step *= 0.5;
            if (step < 0x1p-20) { break; }
        }
    }
    return now;
}

double fisheye_radius(const Coefficients& k, double angle_rad) {
    const double square = angle_rad * angle_rad;
    return angle_rad * (1.0 + square * (k[0] + square * (k[1] + square * (k[2] + square * k[3]))));
}

double fisheye_slope(const Coefficients& k, double angle_rad) {
    const double square = angle_rad * angle_rad;
    return 1.0 + square * (3.0 * k[0] + square * (5.0 * k[1] + square * (7.0 * k[2] + square * 9.0 * k[3])));
}

/// Where a fisheye folds, at most pi.
double fisheye_limit(const Coefficients& k) {
    constexpr int steps = 256;
    for (int i = 1; i <= steps; ++i) {
        double inside = pi * (i - 1) / steps;
        double outside = pi * i / steps;
        if (fisheye_slope(k, outside) > 0.0) { continue; }
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = 0.5 * (inside + outside);
            (fisheye_slope(k, middle) > 0.0 ? inside : outside) = middle;
        }
        return inside;
    }
    return pi;
}

/// Newton's method between bounds, which are halved where it leaves them.
std::optional<double> fisheye_angle(const Coefficients& k, double radius, double limit_rad) {
    if (radius > fisheye_radius(k, limit_rad)) { return std::nullopt; }
    double low = 0.0;
    double high = limit_rad;
    double angle = std::min(radius, limit_rad);
    for (int i = 0; i < 100; ++i) {
        const double excess = fisheye_radius(k, angle) - radius;
        (excess > 0.0 ? high : low) = angle;
        const double slope = fisheye_slope(k, angle);
        double next = slope > 0.0 ? angle - excess / slope : low;
        if (!(next >= low && next <= high)) { next = 0.5 * (low + high); }
        if (std::abs(next - angle) <= 2e-16 * (1.0 + angle)) { return next; }
        angle = next;
    }
    return angle;
}

double limit_of(const LensModel& lens) {
    return lens.distortion == Distortion::Fisheye ? fisheye_limit(lens.coefficients) : pi;
}

} // namespace

LensModel LensModel::of_vertical_fov(const glm::ivec2& size_px, double vertical_fov_rad) {
    LensModel lens;
    lens.size_px = size_px;
    const glm::dvec2 half = cosine_and_sine(vertical_fov_rad / 2.0);
    lens.focal_px = glm::dvec2(0.5 * size_px.y * half.x / half.y);
    lens.centre_px = (glm::dvec2(size_px) - 1.0) * 0.5;
    return lens;
}

std::optional<glm::dvec2> LensModel::project(const glm::dvec3& point) const {
    return PointProjector(*this).project(point);
}

std::optional<glm::dvec3> LensModel::ray(const glm::dvec2& at_px) const { return RayFinder(*this).ray(at_px); }

double LensModel::reach_towards(const glm::dvec2& at_px) const {
    const glm::dvec2 at = (at_px - centre_px) / focal_px;
    if (distortion == Distortion::BrownConrady) { return walk(coefficients, {}, {}, at).share; }
    if (distortion == Distortion::None) { return 1.0; }
    const double radius = length_of(at);
    return std::min(fisheye_radius(coefficients, fisheye_limit(coefficients)) / std::max(radius, 1e-300), 1.0);
}

PointProjector::PointProjector(const LensModel& lens, double safe_radius)
    : lens_(lens), safe_radius_(safe_radius), fisheye_limit_rad_(limit_of(lens)) {}

std::optional<glm::dvec2> PointProjector::project(const glm::dvec3& point) const {
    const Coefficients& k = lens_.coefficients;
    if (lens_.distortion == Distortion::Fisheye) {
        const double across = length_of({point.x, point.y});
        const double angle_rad = angle_of(point.z, across);
        if (!(angle_rad <= fisheye_limit_rad_) || (across == 0.0 && point.z <= 0.0)) { return std::nullopt; }
        const double scale = across > 0.0 ? fisheye_radius(k, angle_rad) / across : 0.0;
        return lens_.centre_px + lens_.focal_px * glm::dvec2(point.x, point.y) * scale;
    }
    if (!(point.z > 0.0)) { return std::nullopt; }
    const glm::dvec2 plane = glm::dvec2(point.x, point.y) / point.z;
    if (lens_.distortion == Distortion::None) { return lens_.centre_px + lens_.focal_px * plane; }
    const glm::dvec2 at = distorted(k, plane).at;
    if (length_of(plane) > safe_radius_) {
        // Beyond a fold it would be the place of another point.
        const Walk back = walk(k, {}, {}, at);
        const double distance = length_of(back.undistorted - plane);
        if (back.share < 1.0 || distance > 1e-6 * (1.0 + length_of(plane))) { return std::nullopt; }
    }
    return lens_.centre_px + lens_.focal_px * at;
}

RayFinder::RayFinder(const LensModel& lens) : lens_(lens), fisheye_limit_rad_(limit_of(lens)) {}

std::optional<glm::dvec3> RayFinder::ray(const glm::dvec2& at_px) {
    const glm::dvec2 at = (at_px - lens_.centre_px) / lens_.focal_px;
    if (lens_.distortion == Distortion::None) { return glm::dvec3(at, 1.0); }
    if (lens_.distortion == Distortion::BrownConrady) {
        const Walk found = walk(lens_.coefficients, undistorted_, distorted_, at);
        if (found.share < 1.0) { return std::nullopt; }
        undistorted_ = found.undistorted;
        distorted_ = at;
        return glm::dvec3(undistorted_, 1.0);
    }
    const double radius = length_of(at);
    if (radius == 0.0) { return glm::dvec3(0.0, 0.0, 1.0); }
    const auto angle_rad = fisheye_angle(lens_.coefficients, radius, fisheye_limit_rad_);
    if (!angle_rad) { return std::nullopt; }
    const glm::dvec2 direction = cosine_and_sine(*angle_rad);
    const glm::dvec2 across = at * (direction.y / radius);
    if (direction.x > LensModel::unit_length_cos) { return glm::dvec3(across / direction.x, 1.0); }
    return glm::dvec3(across, direction.x);
}

} // namespace octant::visuals::camera
