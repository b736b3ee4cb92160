#include "models/aircraft/stations.h"

#include "models/aircraft/stencil.h"

namespace octant::models::aircraft {

Section Stations::section(double s, double half, double top_u, double bottom_u, double flat, double side) const {
    const glm::dvec3 middle_m = at(s, 0.0, 0.5 * (top_u + bottom_u));
    const double tall = 0.5 * (top_u - bottom_u);
    return {middle_m.x, 0.0, middle_m.z, half, tall, tall, flat, side};
}

void Stations::ring_line(PaintedSolid& solid, double s) const {
    paint(solid, stripe(at(s, 0.0, 0.0), {1.0, 0.0, 0.0}, panel_line_m), "line");
}

} // namespace octant::models::aircraft
