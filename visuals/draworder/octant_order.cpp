// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989,
// section III.1, steps 1, 5 and 6, equations (1)-(4), and section III.2, equations (30)-(36). Steps 2 to 4 have their
// own list of deviations below. Deviations:
// - "Any point P of the octant" is one stated point, (1, 1, 1) * 3 R with the octant's signs.
// - The normal is Newell's sum over all corners, not u x v of the first three, which may lie on one
//   line.
// - A polygon is listed when it faces some eye of the octant, not only P: near an axis
//   an eye sees polygons that P does not, and the renderer drops those that face away. Polygons
//   that face away from P are compared like the others, by their outlines as seen from P.
// - The paper does not say how a sequence is made from its pairs; here they are the edges of a
//   graph, sorted with the lowest polygon number first. Cycles, which the paper does not mention,
//   are broken and counted.
// - (33) multiplies by the transposed rotations (30)-(32); this equals the inverse of
//   T Rx Ry Rz on column vectors, which is what eye_in_body computes from any attitude.
#include "visuals/draworder/octant_order.h"

#include "visuals/draworder/occlusion_graph.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

namespace octant::visuals::draworder {

namespace {

/// Where one axis of a coordinate system points in another one: along which axis, and whether in the opposite
/// direction.
struct AxisPlace {
    std::size_t axis = 0;
    bool turned_round = false;
};

AxisPlace place_of(const glm::dvec3& unit) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(unit[i]) > 0.5) { return {static_cast<std::size_t>(i), unit[i] < 0.0}; }
    }
    assert(false);
    return {};
}

/// Converts an octant path to other axes. Signs move with their axes. Children 0, 1, 2 are those at the corners on x,
/// y, z, and the corners of each child are named alike, so that every level changes in the same way.
template <typename ToOther>
std::string with_axes_changed(const std::string& path, ToOther to_other) {
    assert(is_octant_path(path));
    std::string out = path;
    std::array<AxisPlace, 3> places;
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[static_cast<int>(i)] = 1.0;
        places[i] = place_of(to_other(unit));
        out[places[i].axis] = (path[i] == '-') != places[i].turned_round ? '-' : '+';
    }
    for (std::size_t at = 4; at < path.size(); at += 2) {
        const auto child = static_cast<std::size_t>(path[at] - '0');
        if (child < 3) { out[at] = static_cast<char>('0' + places[child].axis); }
    }
    return out;
}

} // namespace

bool is_octant_path(std::string_view text) {
    if (text.size() < 3 || text.size() % 2 == 0 || text.size() > 3 + 2 * max_path_levels) { return false; }
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool good = i < 3        ? text[i] == '+' || text[i] == '-'
                          : i % 2 == 1 ? text[i] == '/'
                                       : text[i] >= '0' && text[i] <= '3';
        if (!good) { return false; }
    }
    return true;
}

std::array<OctantTriangle, 4> subdivided(const OctantTriangle& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = (a + b) / 2.0;
    const glm::dvec3 bc = (b + c) / 2.0;
    const glm::dvec3 ca = (c + a) / 2.0;
    return {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
}

OctantTriangle octant_triangle(std::string_view path) {
    assert(is_octant_path(path));
    OctantTriangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = glm::dvec3(0.0);
        corners[i][static_cast<int>(i)] = path[i] == '+' ? 1.0 : -1.0;
    }
    for (std::size_t at = 4; at < path.size(); at += 2) {
        corners = subdivided(corners)[static_cast<std::size_t>(path[at] - '0')];
    }
    return corners;
}

std::string path_in_file(const std::string& path, const models::polygons::FileAxes& axes) {
    return with_axes_changed(path, [&](const glm::dvec3& v) { return axes.file_from_body(v); });
}

std::string path_in_body(const std::string& path, const models::polygons::FileAxes& axes) {
    return with_axes_changed(path, [&](const glm::dvec3& v) { return axes.body_from_file(v); });
}

// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989,
// section III.1, steps 2 to 4, equations (5)-(29). Deviations:
// - The screen coordinates are not defined in the paper. Here they are a parallel projection along the line from P to
//   the origin, so that a plane stays a plane: aXs + bYs + cZs + d = 0.
// - (8) is printed ZminB > ZminB and means ZminB > ZminA.
// - (13)-(20) are printed as conditions for a crossing; any one that holds means that the edges do
//   NOT cross.
// - Depths count as equal within 1e-9 of the scale, so that rounding decides nothing. A crossing
//   where both depths are equal (a shared corner or edge) says nothing: the next one is looked at.
// - The depths at a crossing are taken along the two edges instead of from the plane equations
//   (21)-(29). Both edges lie in their planes, so the numbers are the same; they stay defined for
//   a polygon that is seen edge-on.
// Kept as printed, though it can be wrong: the depth ranges of step 2 decide also where the polygons are slanted, and a
// polygon that lies inside the outline of another with overlapping depth ranges is left free.

namespace {

constexpr double equal_within = 1e-9; ///< Depths and shares that differ by no more count as equal.

/// The cross product on the screen.
double cross(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; }

/// The depths of two edges where they cross on the screen.
struct Crossing {
    double depth_a = 0.0;
    double depth_b = 0.0;
};

/// Whether a point is between the ends of an edge, given its share of the way along it.
bool inside_edge(double share) { return share >= -equal_within && share <= 1.0 + equal_within; }

/// The crossing of two edges, (13)-(20). Nothing for edges that are parallel, coincident, seen end-on or that do not
/// meet.
std::optional<Crossing> crossing(
    const glm::dvec3& a_from, const glm::dvec3& a_to, const glm::dvec3& b_from, const glm::dvec3& b_to) {
    const glm::dvec3 a = a_to - a_from;
    const glm::dvec3 b = b_to - b_from;
    const double area = cross(a, b);
    if (std::abs(area) <= equal_within * std::hypot(a.x, a.y) * std::hypot(b.x, b.y)) { return std::nullopt; }
    const double share_a = cross(b_from - a_from, b) / area;
    const double share_b = cross(b_from - a_from, a) / area;
    if (!inside_edge(share_a) || !inside_edge(share_b)) { return std::nullopt; }
    return Crossing{a_from.z + share_a * a.z, b_from.z + share_b * b.z};
}

/// Step 2, (5)-(8): decides by the depth ranges.
PaintFirst by_depth_range(const ScreenPolygon& a, const ScreenPolygon& b) {
    const double most = a.most.z - b.most.z;
    const double least = a.least.z - b.least.z;
    if (most > equal_within && least > equal_within) { return PaintFirst::B; }
    if (most < -equal_within && least < -equal_within) { return PaintFirst::A; }
    return PaintFirst::Either;
}

/// Step 3, (9)-(12): whether the screen bounding boxes are disjoint.
bool boxes_apart(const ScreenPolygon& a, const ScreenPolygon& b) {
    return a.most.x < b.least.x || b.most.x < a.least.x || a.most.y < b.least.y || b.most.y < a.least.y;
}

/// Step 4, (13)-(29): decides by the depths at the first true crossing of two edges.
PaintFirst by_first_crossing(const ScreenPolygon& a, const ScreenPolygon& b) {
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        for (std::size_t j = 0; j < b.corners.size(); ++j) {
            const auto at = crossing(a.corners[i], a.corners[(i + 1) % a.corners.size()], b.corners[j],
                b.corners[(j + 1) % b.corners.size()]);
            if (at && std::abs(at->depth_a - at->depth_b) > equal_within) {
                return at->depth_a < at->depth_b ? PaintFirst::A : PaintFirst::B;
            }
        }
    }
    return PaintFirst::Either;
}

} // namespace

PaintFirst paint_first(const ScreenPolygon& a, const ScreenPolygon& b) {
    const PaintFirst by_depth = by_depth_range(a, b);
    if (by_depth != PaintFirst::Either) { return by_depth; }
    return boxes_apart(a, b) ? PaintFirst::Either : by_first_crossing(a, b);
}

namespace {

/// Normal components below this are rounding.
constexpr double min_component = 1e-12;

/// Maps body axes to screen coordinates in units of the model's radius.
class ScreenView {
public:
    ScreenView(const glm::dvec3& viewpoint_m, double radius_m)
        : towards_eye_(viewpoint_m / glm::length(viewpoint_m)), radius_m_(radius_m) {
        const bool along_x = std::abs(towards_eye_.x) > 0.9;
        const glm::dvec3 aside = along_x ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        right_ = glm::normalize(glm::cross(aside, towards_eye_));
        up_ = glm::cross(towards_eye_, right_);
    }

    ScreenPolygon polygon(const models::polygons::PolygonModel& model, std::size_t polygon) const {
        ScreenPolygon seen;
        for (const std::uint32_t vertex : model.corners(polygon)) {
            const glm::dvec3& point_m = model.vertices_m[vertex];
            seen.corners.push_back(
                glm::dvec3(glm::dot(point_m, right_), glm::dot(point_m, up_), glm::dot(point_m, towards_eye_)) /
                radius_m_);
        }
        seen.least = seen.most = seen.corners.front();
        for (const glm::dvec3& corner : seen.corners) {
            seen.least = glm::min(seen.least, corner);
            seen.most = glm::max(seen.most, corner);
        }
        return seen;
    }

private:
    glm::dvec3 right_{0.0};
    glm::dvec3 up_{0.0};
    glm::dvec3 towards_eye_;
    double radius_m_;
};

glm::dvec3 first_corner_m(const models::polygons::PolygonModel& model, std::size_t polygon) {
    return model.vertices_m[model.corners(polygon)[0]];
}

/// Step 1: whether n . (eye - V1) > 0 for some eye of the octant with |eye| >= R. If a component of n has the octant's
/// sign, eyes far out along its axis see the front. If none has, n . eye is largest at distance R on the axis where n
/// has its smallest component.
bool faces_some_eye(
    const models::polygons::PolygonModel& model, std::size_t polygon, const glm::dvec3& signs, double radius_m) {
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const glm::dvec3 outward = normal * signs;
    const double largest = std::max({outward.x, outward.y, outward.z});
    if (largest > min_component) { return true; }
    const double offset_m = glm::dot(normal, first_corner_m(model, polygon));
    return std::min(largest, 0.0) * radius_m - offset_m > min_component * radius_m;
}

/// Step 5: compares all pairs. The precedences hold indices into `polygons`.
std::vector<Precedence> all_pairs(std::span<const ScreenPolygon> polygons) {
    std::vector<Precedence> precedences;
    for (std::uint32_t a = 0; a < polygons.size(); ++a) {
        for (std::uint32_t b = a + 1; b < polygons.size(); ++b) {
            const PaintFirst first = paint_first(polygons[a], polygons[b]);
            if (first == PaintFirst::A) {
                precedences.push_back({a, b});
            } else if (first == PaintFirst::B) {
                precedences.push_back({b, a});
            }
        }
    }
    return precedences;
}

} // namespace

std::string octant_name(int octant) {
    assert(octant >= 0 && octant < 8);
    std::string name;
    for (int axis = 0; axis < 3; ++axis) { name += octant_signs(octant)[axis] < 0.0 ? '-' : '+'; }
    return name;
}

glm::dvec3 octant_signs(int octant) {
    assert(octant >= 0 && octant < 8);
    return {octant % 2 == 0 ? 1.0 : -1.0, octant / 2 % 2 == 0 ? 1.0 : -1.0, octant < 4 ? 1.0 : -1.0};
}

OctantOrders paper_orders(const models::polygons::PolygonModel& model) {
    const double radius_m = models::polygons::radius_m(model);
    OctantOrders orders;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs = octant_signs(octant);
        const ScreenView view(signs * 3.0 * radius_m, radius_m);
        std::vector<std::uint32_t> listed;
        std::vector<ScreenPolygon> seen;
        for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
            if (faces_some_eye(model, i, signs, radius_m)) {
                listed.push_back(i);
                seen.push_back(view.polygon(model, i));
            }
        }
        const TopologicalOrder sequence = topological_order(seen.size(), all_pairs(seen));
        for (const std::uint32_t place : sequence.order) {
            orders.lists[static_cast<std::size_t>(octant)].push_back(listed[place]);
        }
        orders.broken_cycles += sequence.broken_cycles;
        orders.cyclic_octants += sequence.broken_cycles > 0 ? 1 : 0;
    }
    return orders;
}

glm::dvec3 eye_in_body(const glm::dvec3& eye_m, const glm::dvec3& position_m, const glm::dquat& body_to_world) {
    return glm::conjugate(body_to_world) * (eye_m - position_m);
}

} // namespace octant::visuals::draworder
