// A budget of triangles, spent so that vertices do not jump while the view turns. It has no source.
//
// Most triangles of a level view lie below the horizon, where much ground is in few rows of pixels.
// A view that looks down steeply has none of them and could spend all of its budget on near ground:
// at a fifth of the error over rugged ground. When it is pulled up, all of the horizon comes into
// the picture within a few degrees, and the error that keeps the budget is five times larger a few
// frames later. Vertices move S pixels for a pixel of that change (tile_builder_errors.cpp).
//
// So the error of such a view is kept at or above that of the same view turned to the horizon, less
// a share of how far the picture moves in that turn. The first degrees of the turn are not counted:
// the horizon comes in there, and the error that keeps the budget changes fastest. So what a turn
// does to a vertex stays below S times that share of what it does to the picture.
#include "visuals/terrain/horizon_error.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

/// How far from the picture's border the horizon is turned.
constexpr double border_rad = rad_from_deg(1.0);
/// Far ground lies within this angle below its end: it comes into the picture or leaves it while
/// the view turns by as much.
constexpr double far_ground_rad = rad_from_deg(4.0);
/// How much the error may change in a turn, as a share of how far that moves the picture.
constexpr double share_of_turn = 0.006;

/// The angle from `ahead` to the frustum's border in a direction square to it.
double angle_to_border(const MeshView& view, const glm::dvec3& towards) {
    double least_rad = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& normal : view.frustum_normals) {
        const double falling = -glm::dot(normal, towards);
        if (falling > 0.0) {
            least_rad = std::min(least_rad, std::atan2(glm::dot(normal, view.ahead), falling));
        }
    }
    return least_rad;
}

MeshView turned(const MeshView& view, double angle_rad, const glm::dvec3& axis) {
    const glm::dquat turn = glm::angleAxis(angle_rad, axis);
    MeshView there = view;
    there.ahead = turn * view.ahead;
    for (glm::dvec3& normal : there.frustum_normals) {
        normal = turn * normal;
    }
    return there;
}

} // namespace

std::optional<TurnedView> turned_to(const MeshView& view, double elevation_rad) {
    const glm::dvec3 level_axis = glm::cross(view.ahead, glm::dvec3(0.0, 0.0, 1.0));
    const double level = glm::length(level_axis);
    if (level < 1e-6) {
        return std::nullopt;
    }
    const glm::dvec3 axis = level_axis / level;
    const double up_rad = elevation_rad - std::atan2(view.ahead.z, level);
    const double way = up_rad < 0.0 ? -1.0 : 1.0;
    const double to_border_rad = angle_to_border(view, way * glm::cross(axis, view.ahead));
    const double to_horizon_rad =
        std::abs(up_rad) - to_border_rad + std::min(border_rad, 0.5 * to_border_rad);
    if (!(to_horizon_rad > 0.0)) {
        return std::nullopt;
    }
    return TurnedView{turned(view, way * to_horizon_rad, axis), to_horizon_rad};
}

HorizonError::HorizonError(const GroundTiles& ground)
    : rule_(ground)
    , survey_(rule_) {}

ErrorTarget HorizonError::eased(const MeshView& view, const ErrorTarget& target) {
    if (!target.geomorphs || target.most_triangles >= any_triangles) {
        return target;
    }
    const auto there = turned_to(view, missing_rad(view));
    if (!there) {
        return target;
    }
    rule_.look_from(there->view);
    const double there_px = rule_.error_px_of(survey_.limit_for(target));
    const double moved_px = view.focal_px * std::max(there->turned_rad - far_ground_rad, 0.0);
    ErrorTarget eased = target;
    eased.error_px = std::max(target.error_px, there_px - share_of_turn * moved_px);
    return eased;
}

/// The elevation of that border of far ground that leaves the picture first: of the highest ground
/// at its end when the view turns down, so that mountains there count, else of where it begins,
/// below its end at the ground's mean height but not above level.
double HorizonError::missing_rad(const MeshView& view) const {
    const GroundTiles& ground = rule_.ground();
    const glm::dvec2 half_m = ground.half_extent_m();
    double end = std::numeric_limits<double>::infinity(); // in lengths of `ahead`
    for (const int axis : {0, 1}) {
        const double ahead = view.ahead[axis];
        if (ahead != 0.0) {
            end = std::min(end, (std::copysign(half_m[axis], ahead) - view.eye_m[axis]) / ahead);
        }
    }
    const double level = glm::length(glm::dvec2(view.ahead));
    const double away_m = std::max(end * level, ground.spacing_m());
    const auto over_m = [&view](float height_m) {
        return view.eye_m.z - static_cast<double>(height_m);
    };
    const double end_rad = -std::atan2(std::max(over_m(ground.facts().mean_m), 0.0), away_m);
    const bool above = std::atan2(view.ahead.z, level) > end_rad;
    return above ? end_rad - far_ground_rad : -std::atan2(over_m(ground.facts().highest_m), away_m);
}

} // namespace octant::visuals::terrain
