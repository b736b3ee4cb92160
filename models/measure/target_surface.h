#pragma once

#include "models/measure/nearest_point.h"
#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace octant::models::measure {

/// A mesh to which distances are measured, with a tree over its triangles. The mesh must outlive
/// this.
class TargetSurface {
public:
    explicit TargetSurface(const TriangleMesh& mesh)
        : mesh_(&mesh)
        , bvh_(mesh) {}

    const TriangleMesh& mesh() const { return *mesh_; }

    const TriangleBvh& bvh() const { return bvh_; }

    /// The square of the distance from a point to one triangle.
    double distance2_to(std::uint32_t triangle, const glm::dvec3& point) const {
        const auto& [a, b, c] = mesh_->triangles[triangle];
        const auto& at = mesh_->vertices_m;
        return detail::nearest_to_origin({at[a] - point, at[b] - point, at[c] - point}).distance2;
    }

    double longest_edge_m(std::uint32_t triangle) const {
        const auto& [a, b, c] = mesh_->triangles[triangle];
        const auto& at = mesh_->vertices_m;
        return std::max(
            {glm::distance(at[a], at[b]),
             glm::distance(at[b], at[c]),
             glm::distance(at[c], at[a])});
    }

    /// The nearest point of the mesh. `guess` is a triangle that may be near, or none; a good guess
    /// makes the search faster but never changes what is found.
    NearestOnMesh nearest(const glm::dvec3& point, std::uint32_t guess) const {
        if (guess == NearestOnMesh::none) {
            return bvh_.nearest(point);
        }
        constexpr double margin = 1.0 + 1e-12; // Makes up for the rounding of the square root.
        return bvh_.nearest(point, std::sqrt(distance2_to(guess, point)) * margin);
    }

private:
    const TriangleMesh* mesh_;
    TriangleBvh bvh_;
};

} // namespace octant::models::measure
