#pragma once

#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace octant::tests {

/// Meshes for tests of measures, metres.

/// Numbers that are the same on every platform.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    double between(double least, double most);
    glm::dvec3 point(double least, double most);

private:
    std::uint64_t state_;
};

/// A flat square of n x n fields, two triangles each, from (0, 0, z) to (edge, edge, z), seen from above.
models::TriangleMesh plate(int n, double edge_m = 1.0, double z_m = 0.0);

/// A ball of `rings` rings and as many meridians around the origin, closed, seen from outside.
models::TriangleMesh ball(int rings, double radius_m = 1.0);

/// Triangles anywhere in a cube of edge 2, of edges up to `size_m`; every tenth one is degenerate.
models::TriangleMesh scattered(std::uint64_t seed, int triangles, double size_m = 0.4);

/// Every vertex moved by up to `max_m` along each axis.
models::TriangleMesh shaken(models::TriangleMesh mesh, std::uint64_t seed, double max_m);

} // namespace octant::tests
