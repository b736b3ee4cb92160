#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Coordinates of a check: in units of the diagonal of the model's bounding box, from its middle.
struct CheckFrame {
    glm::dvec3 middle_m{0.0};
    double diagonal_m = 1.0;

    glm::dvec3 from_body(const glm::dvec3& point_m) const {
        return (point_m - middle_m) / diagonal_m;
    }

    Plane from_body(const Plane& plane) const {
        return {plane.normal, distance_m(plane, middle_m) / diagonal_m};
    }
};

CheckFrame check_frame(const models::polygons::PolygonModel& model);

/// A polygon as a check sees it, in a CheckFrame. Its corners are drawn towards their middle by
/// check_tolerance, so that polygons which touch do not overlap.
struct CheckShape {
    std::vector<glm::dvec3> corners;    ///< as in the file
    std::vector<Plane> fronts;          ///< eyes that see it are in front of one of them; 1 or 2
    std::optional<std::uint32_t> pivot; ///< that turns it

    // Over all angles of the pivot; as above when there is none.
    std::vector<glm::dvec3> swept; ///< their convex hull holds the polygon at every angle
    /// Eyes that see it at some angle are in front of one of them; as many as `fronts` when they
    /// are the same for every angle.
    std::vector<Plane> swept_fronts;
};

std::vector<CheckShape> check_shapes(
    const models::polygons::PolygonModel& model,
    const CheckFrame& frame,
    std::span<const std::uint32_t> two_sided);

} // namespace octant::visuals::draworder
