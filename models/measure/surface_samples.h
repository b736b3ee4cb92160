#pragma once

#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace octant::models::measure {

/// A point of a mesh's surface.
struct SurfacePoint {
    std::size_t triangle = 0;
    glm::dvec3 weights{0.0}; ///< of its corners
    glm::dvec3 point_m{0.0};
};

/// The mixture of what the corners of a triangle have.
template <typename Vector>
glm::dvec3
mixed(const std::vector<Vector>& values, const Triangle& triangle, const glm::dvec3& weights) {
    return weights.x * glm::dvec3(values[triangle[0]]) +
           weights.y * glm::dvec3(values[triangle[1]]) +
           weights.z * glm::dvec3(values[triangle[2]]);
}

/// Points spread evenly over the area of a mesh, always the same ones; over the number of its
/// triangles where it has no area. The mesh must stay.
class SurfaceSamples {
public:
    /// The mesh needs triangles (asserted).
    SurfaceSamples(const TriangleMesh& mesh, std::size_t samples);

    /// Points come in chunks of a fixed size: sums over each, added in order, are the same for any
    /// number of threads.
    std::size_t chunks() const { return (samples_ + chunk_size - 1) / chunk_size; }

    /// Calls `take(point)` for each point of a chunk, neighbours mostly after one another.
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

    double place_of(std::size_t k) const {
        return areas_.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(samples_);
    }

    std::size_t triangle_of(std::size_t k) const;
    static glm::dvec3 weights_of(std::size_t k);

    const TriangleMesh* mesh_;
    std::size_t samples_;
    std::vector<double> areas_; ///< twice that of the triangles up to each one, itself included
};

} // namespace octant::models::measure
