#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What tests of meshes by resolution and of meshes by screen-space error share.
namespace octant::visuals::terrain::test {

/// Samples of a field.
struct FieldSize {
    int columns;
    int rows;
};

/// On a circle low over a ground of 257 by 257 samples, 1 m apart.
MeshView circling(int frame);

MeshView into_the_sky();

/// A triangle's corners, eye subtracted.
using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const GroundMesh& mesh, std::size_t triangle);

/// Any of 21 points spread over a triangle is inside the frustum.
bool reaches_into(const Corners& corners, const MeshView& view);

/// A box, world axes, in which triangles are looked for.
struct SearchBox {
    glm::dvec3 middle_m;
    glm::dvec3 half_m;

    /// Whether it meets another.
    bool meets(const glm::dvec3& min_m, const glm::dvec3& max_m) const;
};

/// How many triangles of a mesh meet the box. Fails the test unless `found` are numbers of the mesh's triangles,
/// ascending, and those are among them.
long checked_count_in(
    const SearchBox& box, const GroundMesh& mesh, const glm::dvec3& eye_m, std::span<const std::uint32_t> found);

/// What a copy of a mesh is compared by.
struct MeshCopy {
    explicit MeshCopy(const GroundMesh& mesh);
    bool operator==(const MeshCopy& other) const;

    std::vector<models::ColourVertex> vertices;
    std::vector<VertexMorph> morphs;
    std::vector<std::uint32_t> indices;
    int triangles;
    int fans;
    double resolution;
    double error_px;
};

} // namespace octant::visuals::terrain::test
