#pragma once

#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace octant::models::measure {

/// A point on a mesh's surface.
struct SurfacePoint {
    std::size_t triangle = 0;
    glm::dvec3 weights{0.0}; ///< The barycentric weights of the triangle's corners.
    glm::dvec3 point_m{0.0};
};

/// The values at the corners of a triangle, mixed by barycentric weights.
template <typename Vector>
glm::dvec3
mixed(const std::vector<Vector>& values, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * glm::dvec3(values[triangle[0]]) +
           weights.y * glm::dvec3(values[triangle[1]]) +
           weights.z * glm::dvec3(values[triangle[2]]);
}

/// Points spread evenly over the area of a mesh, always the same ones for the same mesh and number.
/// On a mesh without area they are spread evenly over its triangles. The mesh must outlive this.
class SurfaceSamples {
public:
    /// The mesh needs triangles (asserted).
    SurfaceSamples(const TriangleMesh& mesh, std::size_t samples);

    /// The number of chunks, into which the points are divided by a fixed size. Sums over each
    /// chunk, added in order, are the same for any number of threads.
    std::size_t chunks() const { return (samples_ + chunk_size - 1) / chunk_size; }

    /// Calls `take(point)` for each point of a chunk. Successive points are mostly close to each
    /// other.
    template <typename Take>
    void for_each(std::size_t chunk, const Take& take) const {
        const std::size_t first = chunk * chunk_size;
        std::size_t triangle = triangle_of(first);
        for (std::size_t k = first; k < std::min(samples_, first + chunk_size); ++k) {
            while (triangle + 1 < areas_.size() && areas_[triangle] <= place_of(k)) {
                ++triangle;
            }
            const glm::dvec3 weights = weights_of(k);
            take(SurfacePoint{
                triangle, weights, mixed(mesh_->vertices_m, mesh_->triangles[triangle], weights)});
        }
    }

private:
    static constexpr std::size_t chunk_size = 4096;

    /// The place of point k on the line of accumulated areas.
    double place_of(std::size_t k) const {
        return areas_.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(samples_);
    }

    /// The triangle that point k lies on.
    std::size_t triangle_of(std::size_t k) const;
    /// The barycentric weights of point k in its triangle.
    static glm::dvec3 weights_of(std::size_t k);

    const TriangleMesh* mesh_;
    std::size_t samples_;
    std::vector<double> areas_; ///< Twice the accumulated area up to and including each triangle.
};

} // namespace octant::models::measure
