#pragma once

#include "models/aircraft/painted_solid.h"
#include "sim/base/plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <string>
#include <vector>

namespace octant::models::aircraft {

/// Where to paint: what lies in front of all planes, on faces that are turned towards `facing` (by at least
/// `min_cosine`; a zero vector: all).
struct Stencil {
    std::vector<Plane> planes;
    glm::dvec3 facing{0.0};
    double min_cosine = 0.2;
};

/// Cuts faces along the stencil and gives what is inside a material.
void paint(PaintedSolid& solid, const Stencil& stencil, const std::string& material);

/// A line of that width along the plane through a point.
Stencil stripe(const glm::dvec3& point_m, const glm::dvec3& across, double width_m);

/// A convex outline that is seen along an axis of the body (0 = x, 1 = y, 2 = z), given by the two other coordinates in
/// their order, either way round.
Stencil outline(std::span<const glm::dvec2> corners_m, int axis);

/// A star in a disc, seen along an axis as by outline.
struct Roundel {
    glm::dvec2 middle_m{0.0};
    double radius_m = 0.5;
    glm::dvec2 to_top{1.0, 0.0}; ///< unit vector
    int axis = 2;
    glm::dvec3 facing{0.0};
};

void paint_roundel(PaintedSolid& solid, const Roundel& roundel, const std::string& disc, const std::string& star);

} // namespace octant::models::aircraft
