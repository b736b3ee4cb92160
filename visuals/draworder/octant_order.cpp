// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time
// Animation", 1989, section III.1, steps 1, 5 and 6, equations (1)-(4), and section III.2,
// equations (30)-(36). Steps 2 to 4 are in paper_rule.cpp.
// Deviations:
// - "Any point P of the octant" is one stated point, (1, 1, 1) * 3 R with the octant's signs.
// - The normal is Newell's sum over all corners, not u x v of the first three, which may lie on one
//   line.
// - By default a polygon is listed when it faces some eye of the octant, not only P: near an axis
//   an eye sees polygons that P does not, and the renderer drops those that face away. Polygons
//   that face away from P are compared like the others, by their outlines as seen from P.
// - The paper does not say how a sequence is made from its pairs; here they are the edges of a
//   graph, sorted with the lowest polygon number first. Cycles, which the paper does not mention,
//   are broken and counted.
// - (33) multiplies by the transposed rotations (30)-(32); this equals the inverse of
//   T Rx Ry Rz on column vectors, which is what eye_in_body computes from any attitude.

#include "visuals/draworder/octant_order.h"

#include "visuals/draworder/precedence.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cassert>
#include <span>

namespace octant::visuals::draworder {

namespace {

/// Normal components below this are rounding.
constexpr double min_component = 1e-12;

glm::dvec3 first_corner_m(const models::polygons::PolygonModel& model, std::size_t polygon) {
    return model.vertices_m[model.corners(polygon)[0]];
}

/// Step 1, n . l > 0: whether a polygon is seen from a point.
bool faces_point(
    const models::polygons::PolygonModel& model, std::size_t polygon, const glm::dvec3& point_m) {
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    return glm::dot(normal, point_m - first_corner_m(model, polygon)) > 0.0;
}

/// Whether n . (eye - V1) > 0 for some eye of the octant with |eye| >= R. If a component of n has
/// the octant's sign, eyes far out along its axis see the front. If none has, n . eye is largest at
/// distance R on the axis where n has its smallest component.
bool faces_some_eye(
    const models::polygons::PolygonModel& model,
    std::size_t polygon,
    const glm::dvec3& signs,
    double radius_m) {
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const glm::dvec3 outward = normal * signs;
    const double largest = std::max({outward.x, outward.y, outward.z});
    if (largest > min_component) {
        return true;
    }
    const double offset_m = glm::dot(normal, first_corner_m(model, polygon));
    return std::min(largest, 0.0) * radius_m - offset_m > min_component * radius_m;
}

/// The polygons of an octant's list, ascending.
std::vector<std::uint32_t> listed_polygons(
    const models::polygons::PolygonModel& model,
    const PaperOrderOptions& options,
    const glm::dvec3& signs,
    double radius_m) {
    std::vector<std::uint32_t> listed;
    const glm::dvec3 viewpoint_m = signs * options.viewpoint_radii * radius_m;
    for (std::uint32_t i = 0; i < model.polygons.size(); ++i) {
        const bool faces = options.listed == ListingRule::FromPoint
                               ? faces_point(model, i, viewpoint_m)
                               : faces_some_eye(model, i, signs, radius_m);
        if (faces) {
            listed.push_back(i);
        }
    }
    return listed;
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
    for (int axis = 0; axis < 3; ++axis) {
        name += octant_signs(octant)[axis] < 0.0 ? '-' : '+';
    }
    return name;
}

glm::dvec3 octant_signs(int octant) {
    assert(octant >= 0 && octant < 8);
    return {
        octant % 2 == 0 ? 1.0 : -1.0, octant / 2 % 2 == 0 ? 1.0 : -1.0, octant < 4 ? 1.0 : -1.0};
}

OctantOrders
paper_orders(const models::polygons::PolygonModel& model, const PaperOrderOptions& options) {
    assert(glm::all(glm::greaterThan(options.viewpoint_radii, glm::dvec3(0.0))));
    const double radius_m = models::polygons::radius_m(model);
    OctantOrders orders;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs = octant_signs(octant);
        const ScreenView view(signs * options.viewpoint_radii * radius_m, options.screen, radius_m);
        const auto listed = listed_polygons(model, options, signs, radius_m);
        std::vector<ScreenPolygon> seen;
        seen.reserve(listed.size());
        for (const std::uint32_t polygon : listed) {
            seen.push_back(screen_polygon(model, polygon, view));
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

glm::dvec3 eye_in_body(
    const glm::dvec3& eye_m, const glm::dvec3& position_m, const glm::dquat& body_to_world) {
    return glm::conjugate(body_to_world) * (eye_m - position_m);
}

} // namespace octant::visuals::draworder
