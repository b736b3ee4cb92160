// The cost that orders collapses with Quality::Surface: Y. Kim, B. U. Lee, "Error measure for
// vertex simplification", 2005, section II.2, distance to triangles in both directions, measured
// from points of the original surface instead of the vertices of the mesh before (collapse_run.cpp
// says why).
#include "models/simplify/surface_cost.h"

#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::models::simplify {

FlatTriangle flat(const WorkingSurface& surface, std::uint32_t face) {
    const std::array<glm::dvec3, 3> corners = surface.corner_places(face);
    if (!surface.coloured()) {
        return flat(corners);
    }
    const auto [a, b, c] = surface.mesh.corners(face);
    return flat(corners, {surface.colours[a], surface.colours[b], surface.colours[c]});
}

void SurfaceCost::gather(const TrackedPoints& points, std::span<const std::uint32_t> faces) {
    block_.clear();
    cost_now_ = 0.0;
    coloured_ = points.coloured();
    for (const std::uint32_t face : faces) {
        points.gather(face, block_);
        cost_now_ += points.cost(face);
    }
}

void SurfaceCost::set_triangles(
    const WorkingSurface& surface,
    std::span<const RingFace> ring,
    const glm::dvec3& place,
    const glm::dvec3& colour) {
    triangles.clear();
    for (const RingFace& face : ring) {
        const std::array<glm::dvec3, 3> corners = moved_corners(surface, face, place);
        if (!surface.coloured()) {
            triangles.push_back(flat(corners));
            continue;
        }
        triangles.push_back(flat(
            corners,
            {colour,
             surface.colours[surface.mesh.target(face.half_edge)],
             surface.colours[surface.mesh.origin(previous_of(face.half_edge))]}));
    }
}

double SurfaceCost::total() {
    if (block_.size() == 0) {
        return 0.0;
    }
    find_nearest(block_, 0, block_.size(), triangles, coloured_);
    return cost_sum(block_, 0, block_.size(), coloured_);
}

double SurfaceCost::most2() const {
    float most = 0.0F;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        most = std::max(most, block_.distances2[i]);
    }
    return static_cast<double>(most);
}

double SurfaceCost::area() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        sum += static_cast<double>(block_.weights[i]);
    }
    return sum;
}

double SurfaceCost::negligible() const {
    return point_rounding * point_rounding * area();
}

double SurfaceCost::way_back(
    const WorkingSurface& surface, std::span<const RingFace> ring, const glm::dvec3& place) {
    if (block_.size() == 0) {
        return 0.0;
    }
    // The squared spacing of the points, about: a triangle's centre may be this far from a point
    // although the surfaces coincide.
    const double apart2 = 2.0 * area() / static_cast<double>(block_.size());
    const auto beyond = [&](const glm::dvec3& sample) {
        const std::array<float, 3> at = {
            static_cast<float>(sample.x),
            static_cast<float>(sample.y),
            static_cast<float>(sample.z)};
        return std::max(0.0, static_cast<double>(least_distance2(block_, at)) - apart2);
    };
    double sum = 0.0;
    const CollapsibleMesh& mesh = surface.mesh;
    for (const RingFace& face : ring) {
        const std::array<glm::dvec3, 3> corners = moved_corners(surface, face, place);
        const double weight = 0.5 * glm::length(area_vector(corners));
        sum += weight * beyond((corners[0] + corners[1] + corners[2]) / 3.0);
        if (mesh.twin(face.half_edge) == none) {
            sum += weight * beyond(0.5 * (corners[0] + corners[1]));
        }
        if (mesh.twin(previous_of(face.half_edge)) == none) {
            sum += weight * beyond(0.5 * (corners[0] + corners[2]));
        }
    }
    return sum;
}

} // namespace octant::models::simplify
