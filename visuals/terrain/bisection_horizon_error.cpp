// A budget of triangles, spent so that vertices do not jump while the view turns. It has no source.
//
// Most triangles of a level view lie below the horizon, where much ground is in few rows of pixels. A view that looks
// down steeply has none of them and could spend all of its budget on near ground: at a fifth of the error over rugged
// ground. When it is pulled up, all of the horizon comes into the picture within a few degrees, and the error that
// keeps the budget is five times larger a few frames later. Vertices move S pixels for a pixel of that change
// (bisection_tile_builder.cpp).
//
// So the error of such a view is kept at or above that of the same view turned until its border reaches the band of far
// ground, less a share of how far the picture moves in that turn. The band is not turned to but added: the frustum of
// the turned view is widened until it contains all of the band. A larger frustum never needs a smaller error, so this
// error is no less than that of any view on the way through the band, where the error that keeps the budget has its
// peak at a place that only the ground knows. It becomes the view's own error, without a step, where the band is in the
// picture. What a turn does to a vertex stays below S times that share of what it does to the picture.
#include "visuals/terrain/bisection_horizon_error.h"

#include "sim/base/units.h"
#include "visuals/terrain/bisection_tile_builder.h"
#include "visuals/terrain/frustum.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

/// How far inside the picture's border the band's far end is in the widened view.
constexpr double border_rad = rad_from_deg(1.0);
/// Ground that is seen this much lower than the map's end counts as far where the view looks above the horizon.
constexpr double far_ground_rad = rad_from_deg(4.0);
/// The band's elevations are limited to these: where the map's end is near, it is near ground.
constexpr double lowest_band_rad = rad_from_deg(-30.0);
constexpr double highest_band_rad = rad_from_deg(15.0);
/// A picture whose border is nearer to its middle than this is widened by a smaller share of itself, down to the least
/// one: a zoomed view of a tower would need most triangles for what it does not show.
constexpr double wide_view_rad = rad_from_deg(20.0);
constexpr double min_widening = 0.1;
/// How far vertices may move in a turn, as a share of how far that moves the picture.
constexpr double max_vertex_motion_share = 0.056;

/// The angle from the view's middle to the frustum's border in a direction square to `ahead`.
double angle_to_border(const MeshView& view, const glm::dvec3& towards) {
    double min_rad = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& normal : view.frustum_normals) {
        const double falling = -glm::dot(normal, towards);
        if (falling > 0.0) { min_rad = std::min(min_rad, std::atan2(glm::dot(normal, view.ahead), falling)); }
    }
    return min_rad;
}

MeshView turned(const MeshView& view, const glm::dquat& turn) {
    MeshView there = view;
    there.ahead = turn * view.ahead;
    for (glm::dvec3& normal : there.frustum_normals) { normal = turn * normal; }
    return there;
}

/// Calls take(direction) for each corner of a frustum.
template <typename Take>
void for_each_corner(const std::array<glm::dvec3, 4>& normals, const Take& take) {
    for (std::size_t a = 0; a < normals.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            for (const double sign : {1.0, -1.0}) {
                const glm::dvec3 corner = sign * glm::cross(normals[a], normals[b]);
                bool is_corner = true;
                for (std::size_t k = 0; k < normals.size(); ++k) {
                    is_corner &= k == a || k == b || glm::dot(normals[k], corner) > 0.0;
                }
                if (is_corner) { take(corner); }
            }
        }
    }
}

/// The view with each plane of its frustum tilted outwards by as little as makes it contain the frustum turned by
/// `turn`, at most until it is square to `ahead`.
MeshView widened(const MeshView& view, const glm::dquat& turn) {
    MeshView wide = view;
    for (glm::dvec3& normal : wide.frustum_normals) {
        double tilt_rad = 0.0;
        for_each_corner(view.frustum_normals, [&](const glm::dvec3& corner) {
            const glm::dvec3 there = turn * corner;
            const double deep = std::max(glm::dot(view.ahead, there), 0.0);
            tilt_rad = std::max(tilt_rad, std::atan2(-glm::dot(normal, there), deep));
        });
        if (tilt_rad > 0.0) { normal = glm::normalize(std::cos(tilt_rad) * normal + std::sin(tilt_rad) * view.ahead); }
    }
    return wide;
}

/// How far the ground reaches at least in directions that the picture may show, level.
double min_reach_m(const MeshView& view, const glm::dvec2& half_m) {
    const double corner_rad = std::acos(std::min(view.corner_cos, 1.0));
    double min_m = std::numeric_limits<double>::infinity();
    for (const double aside_rad : {-corner_rad, 0.0, corner_rad}) {
        const double azimuth_rad = std::atan2(view.ahead.y, view.ahead.x) + aside_rad;
        const glm::dvec2 along(std::cos(azimuth_rad), std::sin(azimuth_rad));
        for (const int axis : {0, 1}) {
            const double to_end_m = std::copysign(half_m[axis], along[axis]) - view.eye_m[axis];
            if (along[axis] != 0.0) { min_m = std::min(min_m, to_end_m / along[axis]); }
        }
    }
    return min_m;
}

} // namespace

std::optional<TurnedView> turned_to_band(const MeshView& view, const ElevationBand& band) {
    const glm::dvec3 level_axis = glm::cross(view.ahead, glm::dvec3(0.0, 0.0, 1.0));
    const double level = glm::length(level_axis);
    if (level < 1e-6) { return std::nullopt; }
    const glm::dvec3 axis = level_axis / level;
    const double own_rad = std::atan2(view.ahead.z, level);
    const double middle_rad = 0.5 * (band.low_rad + band.high_rad);
    const double way = own_rad < middle_rad ? 1.0 : -1.0;
    const double to_border_rad = angle_to_border(view, way * glm::cross(axis, view.ahead));
    const double margin_rad = std::min(border_rad, 0.5 * to_border_rad);
    // A picture with the band's middle in its own middle shows all that counts of the band.
    const double half_rad =
        std::min(way > 0.0 ? band.high_rad - middle_rad : middle_rad - band.low_rad + far_ground_rad,
            std::clamp(to_border_rad / wide_view_rad, min_widening, 1.0) * (to_border_rad - margin_rad));
    const double whole_rad = way * (middle_rad - own_rad) + half_rad - to_border_rad + margin_rad;
    if (!(whole_rad > 0.0)) { return std::nullopt; }
    const double near_half_rad = std::min(way > 0.0 ? middle_rad - band.low_rad : band.high_rad - middle_rad, half_rad);
    const double wide_rad = std::min(whole_rad, half_rad + near_half_rad + margin_rad);
    const double moved_rad = whole_rad - wide_rad;
    const MeshView there = turned(view, glm::angleAxis(way * moved_rad, axis));
    return TurnedView{widened(there, glm::angleAxis(way * wide_rad, axis)), moved_rad};
}

HorizonError::HorizonError(const GroundTiles& ground)
    : criterion_(ground), selection_(criterion_),
      motion_share_(max_vertex_motion_share /
                    static_cast<double>(far_morph_rate_on(ground.metadata().highest_m - ground.metadata().lowest_m))) {}

ErrorTarget HorizonError::raise_to_horizon_error(const MeshView& view, const ErrorTarget& target) {
    if (!target.geomorphs || target.max_triangles >= unlimited_triangles) { return target; }
    const auto there = turned_to_band(view, far_ground(view));
    if (!there) { return target; }
    criterion_.set_view(there->view);
    const double there_px = criterion_.error_px_of(selection_.limit_for(target));
    const double moved_px = view.focal_px * there->turned_rad;
    ErrorTarget raised = target;
    raised.error_px = std::max(target.error_px, there_px - motion_share_ * moved_px);
    return raised;
}

/// Between which elevations ground at the map's end may be seen.
ElevationBand HorizonError::far_ground(const MeshView& view) const {
    const GroundTiles& ground = criterion_.ground();
    const double away_m = std::max(min_reach_m(view, ground.half_extent_m()), ground.spacing_m());
    const double lowered_m = curvature_drop_m(away_m * away_m, view.earth_radius_m) + view.eye_m.z;
    const auto elevation_rad = [&](float height_m) {
        return std::clamp(
            std::atan2(static_cast<double>(height_m) - lowered_m, away_m), lowest_band_rad, highest_band_rad);
    };
    // A degree more, because the picture's corners may show ends that are nearer.
    const double low_rad = std::min(elevation_rad(ground.metadata().lowest_m), 0.0) - border_rad;
    return {low_rad, std::max(elevation_rad(ground.metadata().highest_m), low_rad + border_rad)};
}

} // namespace octant::visuals::terrain
