#include "models/triangle_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace octant::models {

Bounds bounds_of(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        return {};
    }
    const glm::dvec3& first_m = mesh.vertices_m[mesh.triangles.front()[0]];
    Bounds bounds{first_m, first_m};
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            bounds.least_m = glm::min(bounds.least_m, mesh.vertices_m[vertex]);
            bounds.most_m = glm::max(bounds.most_m, mesh.vertices_m[vertex]);
        }
    }
    return bounds;
}

double diagonal_m(const TriangleMesh& mesh) {
    const Bounds bounds = bounds_of(mesh);
    return glm::distance(bounds.least_m, bounds.most_m);
}

glm::dvec3 area_vector(const TriangleMesh& mesh, const Triangle& triangle) {
    const glm::dvec3& first_m = mesh.vertices_m[triangle[0]];
    return glm::cross(
        mesh.vertices_m[triangle[1]] - first_m, mesh.vertices_m[triangle[2]] - first_m);
}

glm::dvec3
normal_of(const TriangleMesh& mesh, const Triangle& triangle, const glm::dvec3& without_area) {
    const glm::dvec3 across = area_vector(mesh, triangle);
    const double length = glm::length(across);
    return length > 0.0 ? across / length : without_area;
}

glm::vec3 material_colour(const TriangleMesh& mesh, std::size_t triangle) {
    return mesh.triangle_materials.empty()
               ? Material().colour
               : mesh.materials[mesh.triangle_materials[triangle]].colour;
}

glm::vec3 mean_colour(const TriangleMesh& mesh, std::size_t triangle) {
    if (mesh.colours.empty()) {
        return material_colour(mesh, triangle);
    }
    const Triangle& corners = mesh.triangles[triangle];
    return (mesh.colours[corners[0]] + mesh.colours[corners[1]] + mesh.colours[corners[2]]) / 3.0F;
}

} // namespace octant::models
