#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::draworder {

/// How the paper's screen coordinates are made from a viewpoint; the paper does not say.
enum class Screen {
    Parallel,   ///< seen from afar along the line viewpoint -> origin
    Perspective ///< seen from the viewpoint, which looks at the origin
};

/// Body axes to screen coordinates (Xs, Ys, Zs), larger Zs = nearer to the eye. Straight lines and
/// planes stay straight. Coordinates are in units of `scale_m` near the origin.
class ScreenView {
public:
    /// The viewpoint is not the origin, scale_m > 0 (asserted). For Screen::Perspective every point
    /// that is turned into screen coordinates must lie before the viewpoint.
    ScreenView(const glm::dvec3& viewpoint_m, Screen screen, double scale_m);

    glm::dvec3 screen_from_body(const glm::dvec3& point_m) const;

private:
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 towards_eye_{0.0};
    double distance_m_ = 0.0;
    double scale_m_ = 0.0;
    Screen screen_;
};

/// A polygon on the screen and its bounds.
struct ScreenPolygon {
    std::vector<glm::dvec3> corners;
    glm::dvec3 least{0.0};
    glm::dvec3 most{0.0};
};

ScreenPolygon
on_screen(const models::polygons::PolygonModel& model, std::size_t polygon, const ScreenView& view);

/// Which of two polygons has to be painted first.
enum class First { A, B, Either };

/// Steps 2 to 4 of the paper for one pair of polygons: depth ranges, bounding boxes, first true
/// crossing of their edges. O(corners of a * corners of b).
First paint_first(const ScreenPolygon& a, const ScreenPolygon& b);

} // namespace octant::visuals::draworder
