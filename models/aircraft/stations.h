#pragma once

#include "models/aircraft/painted_solid.h"

#include <glm/vec3.hpp>

namespace octant::models::aircraft {

/// How the parts of an aircraft are given: by stations behind the nose, distances to the right and heights over a
/// reference line, metres.
struct Stations {
    /// Where station 0 and height 0 lie in body axes: x, and downwards z.
    double nose_m = 0.0;
    double line_down_m = 0.0;
    /// The width of a panel line.
    double panel_line_m = 0.02;

    /// A place by station, distance to the right and height, in body axes.
    glm::dvec3 at(double s, double r, double u) const { return {nose_m - s, r, line_down_m - u}; }

    /// A section between two heights, `half` wide to each side; flat and upright parts as Section has them.
    Section section(double s, double half, double top_u, double bottom_u, double flat = 0.0, double side = 0.0) const;

    /// Paints a panel line around a solid at a station.
    void ring_line(PaintedSolid& solid, double s) const;
};

inline const glm::dvec3 up(0.0, 0.0, -1.0);
inline const glm::dvec3 down(0.0, 0.0, 1.0);
inline const glm::dvec3 right(0.0, 1.0, 0.0);

} // namespace octant::models::aircraft
