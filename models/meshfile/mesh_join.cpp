#include "models/meshfile/mesh_join.h"

#include <glm/geometric.hpp>

#include <utility>

namespace octant::models::meshfile {

namespace {

/// The colours of materials for the vertices of a mesh that has none: the last triangle's counts.
void colour_vertices(TriangleMesh& mesh) {
    if (!mesh.colours.empty() || mesh.vertices_m.empty()) {
        return;
    }
    mesh.colours.assign(mesh.vertices_m.size(), Material().colour);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            mesh.colours[vertex] = material_colour(mesh, t);
        }
    }
}

/// One material for a mesh of several that has none.
void give_materials(TriangleMesh& mesh) {
    if (mesh.materials.empty() && !mesh.triangles.empty()) {
        mesh.materials.push_back({.name = "default"});
        mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    }
}

void place(TriangleMesh& mesh, const Placement& placement) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) {
        vertex_m = placement.point_m(vertex_m).value_or(placement.shift_m);
    }
    for (glm::vec3& normal : mesh.normals) {
        const glm::dvec3 turned = placement.normal(glm::dvec3(normal));
        const double length = glm::length(turned);
        normal = length > 0.0 ? glm::vec3(turned / length) : normal;
    }
}

Triangle shifted(const Triangle& triangle, std::uint32_t by) {
    return {triangle[0] + by, triangle[1] + by, triangle[2] + by};
}

} // namespace

void join_mesh(TriangleMesh& to, TriangleMesh from, const Placement& placement) {
    if (from.triangles.empty()) {
        to.notes.insert(to.notes.end(), from.notes.begin(), from.notes.end());
        return;
    }
    place(from, placement);
    if (!to.colours.empty() || !from.colours.empty()) {
        colour_vertices(to);
        colour_vertices(from);
    }
    give_materials(to);
    give_materials(from);
    const bool normals =
        (to.triangles.empty() || !to.corner_normals.empty()) && !from.corner_normals.empty();
    const auto first = static_cast<std::uint32_t>(to.vertices_m.size());
    const auto first_normal = static_cast<std::uint32_t>(to.normals.size());
    const auto first_material = static_cast<std::uint32_t>(to.materials.size());
    const auto append = [](auto& list, const auto& more) {
        list.insert(list.end(), more.begin(), more.end());
    };
    append(to.vertices_m, from.vertices_m);
    append(to.colours, from.colours);
    append(to.materials, from.materials);
    append(to.notes, from.notes);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        to.triangles.push_back(shifted(from.triangles[t], first));
        to.triangle_materials.push_back(from.triangle_materials[t] + first_material);
        if (normals) {
            to.corner_normals.push_back(shifted(from.corner_normals[t], first_normal));
        }
    }
    if (normals) {
        append(to.normals, from.normals);
    } else {
        to.normals.clear();
        to.corner_normals.clear();
    }
}

} // namespace octant::models::meshfile
