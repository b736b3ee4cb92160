#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::draworder {

/// How screen coordinates are made from a viewpoint; the paper does not say.
enum class ScreenProjection {
    Parallel,   ///< A parallel projection along the line from the viewpoint to the origin.
    Perspective ///< A perspective projection from the viewpoint, which looks at the origin.
};

/// Maps body axes to screen coordinates (Xs, Ys, Zs), where a larger Zs is nearer to the eye.
/// Straight lines and planes stay straight. Near the origin coordinates are in units of `scale_m`.
class ScreenView {
public:
    /// The viewpoint must not be the origin, and scale_m > 0 (asserted). With Screen::Perspective
    /// every point that is mapped must be in front of the viewpoint (asserted).
    ScreenView(const glm::dvec3& viewpoint_m, ScreenProjection screen, double scale_m);

    glm::dvec3 screen_from_body(const glm::dvec3& point_m) const;

private:
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 towards_eye_{0.0};
    double distance_m_ = 0.0;
    double scale_m_ = 0.0;
    ScreenProjection screen_;
};

/// A polygon in screen coordinates, with its bounding box.
struct ScreenPolygon {
    std::vector<glm::dvec3> corners;
    glm::dvec3 least{0.0};
    glm::dvec3 most{0.0};
};

/// A polygon of the model in screen coordinates.
ScreenPolygon
screen_polygon(const models::polygons::PolygonModel& model, std::size_t polygon, const ScreenView& view);

/// Which of two polygons must be painted first.
enum class PaintFirst { A, B, Either };

/// Steps 2 to 4 of the paper for one pair of polygons: depth ranges, bounding boxes, and the first
/// true crossing of their edges. The time is that of comparing all edges of a with all of b.
PaintFirst paint_first(const ScreenPolygon& a, const ScreenPolygon& b);

} // namespace octant::visuals::draworder
