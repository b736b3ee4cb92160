// Where octants should meet. The 1989 paper takes the origin of the object's axes. Its coordinate
// planes may cut badly through the parts of an aircraft; shifted to run between them, they order
// more pairs, and fewer cells have to be divided.
#include "visuals/draworder/cell_centres.h"

#include "visuals/draworder/candidate_planes.h"
#include "visuals/draworder/components.h"
#include "visuals/draworder/view_cell.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace octant::visuals::draworder {

namespace {

/// At most this many planes of each model are tried.
constexpr std::size_t max_axis_planes = 3'000;

/// The number of edges that lie on cycles on either side of a plane.
std::size_t left_on_rings(const Plane& plane, const WorkingModel& work, const CyclicPart& cycles) {
    const PolygonsByPlaneSide sides = sides_of(plane, work.faces, cycles.polygons);
    const auto& [front, back] = sides.sets;
    CyclicEdgeCounter rings;
    return rings.count(cycles.inner, cycles.polygons, back, front, sides.back_facing_in_front) +
           rings.count(cycles.inner, cycles.polygons, front, back, sides.back_facing_behind);
}

/// The best coordinate along each axis, in the faces' space.
glm::dvec3 best_coordinates(const WorkingModel& work, const CyclicPart& cycles) {
    glm::dvec3 best(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        std::size_t fewest = left_on_rings({normal, 0.0}, work, cycles);
        for (const Plane& plane : axis_planes(work.faces, cycles.polygons, max_axis_planes)) {
            if (plane.normal != normal) {
                continue;
            }
            const std::size_t left = left_on_rings(plane, work, cycles);
            if (left < fewest) {
                fewest = left;
                best[axis] = -plane.offset_m;
            }
        }
    }
    return best;
}

/// The centre of the bounding box, body axes.
glm::dvec3 middle_m(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(-std::numeric_limits<double>::max());
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    return (least + most) / 2.0;
}

} // namespace

std::vector<glm::dvec3> cell_centres(const WorkingModel& work) {
    OcclusionGraphBuilder graphs(work.faces);
    const ViewCell root = view_cell(graphs, ViewRegion::all_space());
    const glm::dvec3 best_m = best_coordinates(work, root.cycles) * work.faces.unit_m;
    std::vector<glm::dvec3> centres;
    const auto add = [&](const glm::dvec3& centre_m) {
        if (std::ranges::find(centres, centre_m) == centres.end()) {
            centres.push_back(centre_m);
        }
    };
    for (int mask = 0; mask < 8; ++mask) {
        glm::dvec3 centre_m(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            centre_m[axis] = (mask >> axis) % 2 == 0 ? 0.0 : best_m[axis];
        }
        add(centre_m);
    }
    add(middle_m(work.model));
    return centres;
}

} // namespace octant::visuals::draworder
