#pragma once

#include "models/material.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace octant::models {

/// The index of no normal, no material or no vertex.
inline constexpr std::uint32_t invalid_index = std::numeric_limits<std::uint32_t>::max();

/// Three indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// The colours of a triangle's corners, display values 0..1.
using CornerColours = std::array<glm::vec3, 3>;

/// A triangle mesh as files hold it, in the file's own axes and units (metres for aircraft). Corners share vertices;
/// colours belong to vertices, normals and texture coordinates to corners, materials to triangles. Where texture
/// coordinates or normals break along a seam, the corners of one vertex point to several of them.
struct TriangleMesh {
    std::string name;
    std::vector<glm::dvec3> vertices_m;
    std::vector<glm::vec3> colours; ///< one a vertex, display values 0..1; empty = no colours
    /// Whether `colours` are means of textures and materials around the vertices, for drawing without either.
    bool colours_are_means = false;
    std::vector<Triangle> triangles;
    std::vector<glm::vec3> normals;       ///< unit vectors that corner_normals points into; often empty
    std::vector<Triangle> corner_normals; ///< one a triangle; empty where `normals` is
    /// Places on the pictures of materials that corner_texture_coordinates points into: u to the right and v up from a
    /// picture's lower left corner, 1 is its width or height; often empty.
    std::vector<glm::vec2> texture_coordinates;
    /// One a triangle, three times invalid_index for a triangle without; empty where `texture_coordinates` is.
    std::vector<Triangle> corner_texture_coordinates;
    std::vector<Material> materials;               ///< empty = none
    std::vector<std::uint32_t> triangle_materials; ///< one a triangle; empty where `materials` is
    std::vector<std::string> notes;                ///< messages of the reader and of repairs
};

/// Smallest and largest coordinates of the vertices that triangles use; both 0 without triangles.
struct BoundingBox {
    glm::dvec3 min_m{0.0};
    glm::dvec3 max_m{0.0};
};

BoundingBox bounds_of(const TriangleMesh& mesh);

/// The length of the diagonal of bounds_of(), the unit of relative errors.
double diagonal_m(const TriangleMesh& mesh);

/// Renumbers vertices and triangles along a Morton curve: those near in space become near in memory. The surface stays
/// the same.
void sort_spatially(TriangleMesh& mesh);

/// A vector along a triangle's normal with twice the area as its length.
glm::dvec3 area_vector(const TriangleMesh& mesh, const Triangle& triangle);

/// The unit normal of a triangle; `degenerate_normal` for one without area.
glm::dvec3 normal_of(
    const TriangleMesh& mesh, const Triangle& triangle, const glm::dvec3& degenerate_normal = glm::dvec3(0.0));

/// The colour of a triangle's material; that of a default Material without one.
glm::vec3 material_colour(const TriangleMesh& mesh, std::size_t triangle);

/// The mean colour of a triangle's vertices; material_colour() if the mesh has no vertex colours.
glm::vec3 mean_colour(const TriangleMesh& mesh, std::size_t triangle);

} // namespace octant::models
