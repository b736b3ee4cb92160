#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace octant::visuals::draworder {

// An octant path names an octant of eyes, or a part of it that was divided into four, once or several times: "+-+/0/3"
// is the fourth quarter of the first quarter of the octant +-+.

/// The greatest number of quarters that a path may name.
inline constexpr std::size_t max_path_levels = 24;

/// Whether a text is an octant path: the signs of x, y and z, then at most max_path_levels children 0 to 3, each after
/// a slash.
bool is_octant_path(std::string_view text);

/// The corners A, B, C of the flat triangle that stands for a part of an octant, on |x| + |y| + |z| = 1.
using OctantTriangle = std::array<glm::dvec3, 3>;

/// The children of (A, B, C): with AB the midpoint of an edge, 0 = (A, AB, CA), 1 = (AB, B, BC), 2 = (CA, BC, C) and 3
/// = (BC, CA, AB).
std::array<OctantTriangle, 4> subdivided(const OctantTriangle& corners);

/// The triangle that an octant path names; A, B, C of an octant lie on the axes of x, y, z.
OctantTriangle octant_triangle(std::string_view path);

/// An octant path of the body axes as the file's axes say it: signs and children change places.
std::string path_in_file(const std::string& path, const models::polygons::FileAxes& axes);

/// The inverse of path_in_file.
std::string path_in_body(const std::string& path, const models::polygons::FileAxes& axes);

/// A polygon in screen coordinates (Xs, Ys, Zs), with its bounding box. A larger Zs is nearer to the eye.
struct ScreenPolygon {
    std::vector<glm::dvec3> corners;
    glm::dvec3 least{0.0};
    glm::dvec3 most{0.0};
};

/// Which of two polygons must be painted first.
enum class PaintFirst { A, B, Either };

/// Steps 2 to 4 of the paper for one pair of polygons: depth ranges, bounding boxes, and the first true crossing of
/// their edges. The time is that of comparing all edges of a with all of b.
PaintFirst paint_first(const ScreenPolygon& a, const ScreenPolygon& b);

// Octants of the eye in body axes are numbered 0 to 7: bit 0 is set where x is negative, bit 1 where y is, and bit 2
// where z is. Zero, of either sign, counts as positive.

/// The signs of x, y, z as the paper writes them: octant 0 is "+++", 1 is "-++", 4 is "++-".
std::string octant_name(int octant);

/// The direction (+-1, +-1, +-1) in the middle of an octant.
glm::dvec3 octant_signs(int octant);

/// The painting orders of the eight octants.
struct OctantOrders {
    std::array<std::vector<std::uint32_t>, 8> lists; ///< Indexed by octant; first painted first.
    /// The number of broken cycles in all octants; 0 = every precedence is kept.
    int broken_cycles = 0;
    int cyclic_octants = 0; ///< The number of octants with broken cycles.
};

/// Steps 1 to 6 of the paper: the 8 painting orders of a model. A list has the polygons that face some eye of the
/// octant at or beyond the model's radius. Where the paper leaves the order free, the lower polygon number comes first.
/// The time grows with the square of the polygons listed.
OctantOrders paper_orders(const models::polygons::PolygonModel& model);

/// The eye in body axes, metres: inverse(T R) * eye for an aircraft at `position_m` in the world with the attitude
/// `body_to_world` (a unit quaternion). Its octant is the paper's run-time step, equations (33)-(36).
glm::dvec3 eye_in_body(const glm::dvec3& eye_m, const glm::dvec3& position_m, const glm::dquat& body_to_world);

} // namespace octant::visuals::draworder
