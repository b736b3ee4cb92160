// When to choose again. Intensities change little while eye and light turn by a small angle about the model, so a
// choice is kept until the tolerance is exceeded. This saves the selection (9 operations a polygon in the 2008 paper's
// count) in most frames and keeps polygons from flickering between flat and smooth.
#include "visuals/shading/reselection.h"

#include "visuals/shading/angle.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::visuals::shading {

namespace {} // namespace

bool needs_reselection(const ViewAndLight& before, const ViewAndLight& now, const glm::dvec3& centre_m,
    const ReselectionTolerance& tolerance) {
    if (now.eye_m == before.eye_m && now.light == before.light) { return false; }
    ShadingLight turned = before.light;
    turned.to_light = now.light.to_light;
    if (turned != now.light ||
        angle_rad(glm::dvec3(now.light.to_light), glm::dvec3(before.light.to_light)) > tolerance.angle_rad) {
        return true;
    }
    const glm::dvec3 before_m = before.eye_m - centre_m;
    const glm::dvec3 now_m = now.eye_m - centre_m;
    const double farther_m = std::abs(glm::length(now_m) - glm::length(before_m));
    return farther_m > tolerance.distance_share * glm::length(before_m) ||
           angle_rad(before_m, now_m) > tolerance.angle_rad;
}

} // namespace octant::visuals::shading
