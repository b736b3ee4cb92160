#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/cell_orders.h"
#include "visuals/draworder/draw_order.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::draworder {

struct EyeSamples {
    int eyes = 1000;
    int rays_per_eye = 20;
    double least_distance_radii = 1.0; ///< from the origin, in the model's radius
    double most_distance_radii = 20.0; ///< distances spread evenly in their logarithm
    int octant = -1;                   ///< only eyes of this octant; -1 = all
    std::uint64_t seed = 1989;
    double turn_rad = 0.0; ///< how far the parts with a pivot have turned
};

struct RayCount {
    long eyes = 0;        ///< that have a list
    long eyes_in_gap = 0; ///< that no cell contains, although cells reach nearer and farther
    long hits = 0;        ///< rays that meet a polygon's front
    long wrong = 0;       ///< of these, rays whose last painted polygon is not the nearest

    double wrong_share() const {
        return hits == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(hits);
    }

    RayCount& operator+=(const RayCount& other);
};

/// Rays from random eyes in perspective, spread evenly over the disc of the model's radius around
/// the origin as an eye that looks at it sees it, so that shares are shares of pixels; eyes inside
/// that radius look in all directions. Polygons that face away from the eye are not painted.
RayCount count_wrong_rays(
    const models::polygons::PolygonModel& model, const DrawOrder& order, const EyeSamples& samples);

/// The same for orders by cells: eyes out of their range are passed over.
RayCount count_wrong_rays(
    const models::polygons::PolygonModel& model,
    const CellOrders& orders,
    const EyeSamples& samples);

/// Rays from one eye for one list.
RayCount count_wrong_rays_from(
    const models::polygons::PolygonModel& model,
    std::span<const std::uint32_t> painted,
    const glm::dvec3& eye_m,
    int rays);

} // namespace octant::visuals::draworder
