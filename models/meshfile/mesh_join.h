#pragma once

#include "models/triangle_mesh.h"
#include "sim/base/text_scanner.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::models::meshfile {

/// Limits of polygons and coordinates in files. A larger coordinate is a fault of the file in any unit of length.
inline constexpr std::size_t max_polygon_corners = 10'000;
inline constexpr double max_coordinate = 1e12;
inline constexpr TextRules mesh_text{.max_number = max_coordinate}; ///< words between blanks

/// The placement of a scene node: world = turn * own + shift.
struct AffineTransform {
    glm::dmat3 turn{1.0}; ///< may scale and mirror
    glm::dvec3 shift_m{0.0};

    /// The placement of a child node whose placement in this node is `child`.
    AffineTransform of(const AffineTransform& child) const {
        return {turn * child.turn, turn * child.shift_m + shift_m};
    }

    /// Transforms a point; nothing where a coordinate exceeds max_coordinate.
    std::optional<glm::dvec3> point_m(const glm::dvec3& own_m) const;

    /// Transforms a normal. The result has any length; zero for a singular matrix.
    glm::dvec3 normal(const glm::dvec3& own) const;

    bool mirrors() const;
};

/// Appends a transformed mesh to another. If one of them has colours, the other gets its material colours. Normals are
/// kept where both have them. Notes are appended.
void join_mesh(TriangleMesh& to, TriangleMesh from, const AffineTransform& placement);

/// Removes the triangles whose entry in `gone` is true, with their entries in all lists of triangles.
void erase_triangles(TriangleMesh& mesh, const std::vector<bool>& gone);

/// Removes vertices that no triangle uses.
void erase_unused_vertices(TriangleMesh& mesh);

/// Moves the triangles of transparent materials into a mesh of their own, with the attributes that they use. Where all
/// are transparent none is moved: nothing is to be seen through them.
TriangleMesh take_transparent(TriangleMesh& mesh);

/// Returns the triangles of `count` materials from `first_material` on, with the materials, vertices and attributes
/// that they use, in the same order.
TriangleMesh part_of_materials(const TriangleMesh& mesh, std::uint32_t first_material, std::uint32_t count);

} // namespace octant::models::meshfile
