// Even samples of a surface. Point k = 0, 1, ... lies at (k + 1/2) / samples of the accumulated
// area, so that each triangle gets its share (stratified sampling). Within the triangles the points
// follow the R2 sequence of M. Roberts, "The unreasonable effectiveness of quasirandom sequences",
// 2018: a Kronecker sequence in the unit square, folded at its diagonal.
#include "models/measure/surface_samples.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>

namespace octant::models::measure {

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, std::size_t samples)
    : mesh_(&mesh)
    , samples_(samples) {
    assert(!mesh.triangles.empty());
    areas_.reserve(mesh.triangles.size());
    double sum = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        sum += glm::length(area_vector(mesh, triangle));
        areas_.push_back(sum);
    }
    if (!(sum > 0.0)) {
        for (std::size_t i = 0; i < areas_.size(); ++i) {
            areas_[i] = static_cast<double>(i + 1);
        }
    }
}

std::size_t SurfaceSamples::triangle_of(std::size_t k) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(areas_, place_of(k)) - areas_.begin());
}

glm::dvec3 SurfaceSamples::weights_of(std::size_t k) {
    // The plastic number, the real root of x^3 = x + 1.
    constexpr double plastic = 1.32471795724474602596;
    const double n = static_cast<double>(k) + 1.0;
    double unused = 0.0;
    double u = std::modf(0.5 + n / plastic, &unused);
    double v = std::modf(0.5 + n / (plastic * plastic), &unused);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

} // namespace octant::models::measure
