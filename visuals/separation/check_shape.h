#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::separation {

/// The coordinates of a check: the centre of the model's bounding box is the origin, and its diagonal is 1. Axes as the
/// body's.
struct CheckFrame {
    glm::dvec3 middle_m{0.0};
    double diagonal_m = 1.0;

    glm::dvec3 from_body(const glm::dvec3& point_m) const { return (point_m - middle_m) / diagonal_m; }

    Plane from_body(const Plane& plane) const { return {plane.normal, distance_m(plane, middle_m) / diagonal_m}; }
};

CheckFrame check_frame(const models::polygons::PolygonModel& model);

/// A polygon as a check sees it, in a CheckFrame. Its corners are drawn towards its centre by check_tolerance, so that
/// polygons which only touch do not overlap.
struct CheckShape {
    std::vector<glm::dvec3> corners; ///< At the angle of the file.
    /// One plane, or two for a two-sided polygon; eyes that see the polygon are in front of one of them.
    std::vector<Plane> fronts;
    std::optional<std::uint32_t> pivot; ///< The pivot that turns the polygon.

    /// Points whose convex hull holds the polygon at every angle of the pivot; the corners when there is none.
    std::vector<glm::dvec3> swept;
    /// Eyes that see the polygon at some angle are in front of one of these. There are as many as `fronts` when they
    /// are the same at every angle.
    std::vector<Plane> swept_fronts;
};

/// The shapes of all polygons of a model; `two_sided` are the polygons seen from both sides.
std::vector<CheckShape> check_shapes(
    const models::polygons::PolygonModel& model, const CheckFrame& frame, std::span<const std::uint32_t> two_sided);

} // namespace octant::visuals::separation
