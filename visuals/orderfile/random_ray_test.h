#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/orderfile/cell_orders.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace octant::visuals::orderfile {

/// Which random eyes and rays are tried.
struct RaySampling {
    int eyes = 1000;
    int rays_per_eye = 20;
    /// The least distance from the origin, in radii of the model; from the model's middle where the origin lies outside
    /// of the model.
    double min_distance_radii = 1.0;
    /// The greatest distance; the logarithm of the distance is evenly distributed.
    double max_distance_radii = 20.0;
    int octant = -1; ///< Only eyes of this octant; -1 = all.
    std::uint64_t seed = 1989;
    double turn_rad = 0.0; ///< The angle by which the parts with a pivot have turned.
};

/// What was seen along the rays.
struct RayTestCounts {
    long eyes = 0; ///< The number of eyes that have a list.
    /// Eyes that no cell contains although they are within the range of distances.
    long eyes_without_cell = 0;
    long hits = 0;  ///< Rays that meet the front of a polygon.
    long wrong = 0; ///< Of these, rays on which the polygon painted last is not the nearest.

    double wrong_share() const { return hits == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(hits); }

    RayTestCounts& operator+=(const RayTestCounts& other);
};

/// Gives the list that is painted for an eye, first painted first, valid until the next call; nothing: the eye is
/// skipped.
using PaintedListOfEye = std::function<std::optional<std::span<const std::uint32_t>>(const glm::dvec3& eye_m)>;

/// Tries painted lists by rays from random eyes in perspective. Rays are spread evenly over the disc of the model's
/// radius around the origin as the eye sees it, so that shares are shares of pixels; eyes inside that radius look in
/// all directions. Polygons that face away from the eye are not painted, those of `two_sided` apart.
RayTestCounts count_wrong_rays(const models::polygons::PolygonModel& model, const PaintedListOfEye& painted_from,
    const RaySampling& samples, std::span<const std::uint32_t> two_sided = {});

/// Tries an order for all eyes.
RayTestCounts count_wrong_rays(const models::polygons::PolygonModel& model, const draworder::DrawOrder& order,
    const RaySampling& samples, std::span<const std::uint32_t> two_sided = {});

/// Tries orders by cells; eyes outside the range of distances are skipped.
RayTestCounts count_wrong_rays(
    const models::polygons::PolygonModel& model, const CellOrders& orders, const RaySampling& samples);

} // namespace octant::visuals::orderfile
