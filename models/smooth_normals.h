#pragma once

#include "models/triangle_mesh.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models {

/// The angle between two vectors of any length, 0 to pi.
inline double angle_rad(const glm::dvec3& one, const glm::dvec3& other) {
    return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other));
}

/// Faces that meet at a larger angle than this keep a visible edge, where a file gives neither normals nor an angle.
inline constexpr double default_crease_rad = rad_from_deg(40.0);

/// How a face is shaded.
struct Smoothing {
    static constexpr std::uint32_t unknown = 0; ///< the file does not say
    static constexpr std::uint32_t flat = 1;

    /// unknown, flat, or the number of the set of faces among which edges are smooth.
    std::uint32_t group = unknown;
    /// Edges at which the surface bends more than this stay sharp, radians, 0 to pi.
    float crease_rad = 3.1415927F;

    bool operator==(const Smoothing&) const = default;
};

/// A face whose corners get normals.
struct SmoothFace {
    std::span<const std::uint32_t> corners; ///< vertices, counter-clockwise seen from outside
    glm::dvec3 normal{0.0};                 ///< a unit vector; zero for a face without an area, which counts for none
    Smoothing smoothing;
};

/// A unit normal for each corner, face after face: the mean of the normals of the faces around its vertex, each
/// weighted by its angle there. Those faces count that can be reached from the corner's own across edges at the vertex,
/// all of its group and with normals within both crease angles of its own. Corners of flat faces, and of those of
/// unknown smoothing, have the normal of their face. Around a vertex of more than 4,096 faces all of the group count.
/// However many faces share an edge, the work at a vertex grows at most as the square of its corners. `compared` gets
/// the number of comparisons of two corners, null = nobody asks: at a vertex of n corners at most 2 n^2.
std::vector<glm::vec3> smooth_normals(
    std::span<const SmoothFace> faces, std::span<const glm::dvec3> vertices_m, std::size_t* compared = nullptr);

/// Gives all corners of a mesh that point to no normal (invalid_index) that of smooth_normals(); corners of triangles
/// of unknown smoothing stay as they are. `smoothings` has one entry a triangle, and so has mesh.corner_normals.
void add_smooth_normals(TriangleMesh& mesh, std::span<const Smoothing> smoothings);

} // namespace octant::models
