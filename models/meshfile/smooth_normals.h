#pragma once

#include "models/triangle_mesh.h"

#include <cstdint>
#include <span>

namespace octant::models::meshfile {

/// How a file says that a triangle is shaded.
struct Smoothing {
    static constexpr std::uint32_t unknown = 0; ///< the file does not say
    static constexpr std::uint32_t flat = 1;

    /// unknown, flat, or the number of the set of triangles among which edges are smooth.
    std::uint32_t group = unknown;
    /// Edges at which the surface bends more than this stay sharp, radians.
    float crease_rad = 3.1415927F;

    bool operator==(const Smoothing&) const = default;
};

/// Gives all corners that point to no normal (invalid_index) one: that of the triangle in flat ones, the mean of the
/// triangles of the same group around the vertex whose normals are within both crease angles, weighted by their angles
/// there. Corners of triangles of unknown smoothing stay as they are. `smoothings` has one entry a triangle, and so has
/// mesh.corner_normals. Around a vertex of more than 64 triangles all of the group count.
void add_smooth_normals(TriangleMesh& mesh, std::span<const Smoothing> smoothings);

} // namespace octant::models::meshfile
