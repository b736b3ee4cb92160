#include "models/meshfile/mesh_join.h"

#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::meshfile {

std::optional<glm::dvec3> AffineTransform::point_m(const glm::dvec3& own_m) const {
    const glm::dvec3 place_m = turn * own_m + shift_m;
    for (int part = 0; part < 3; ++part) {
        if (!(std::abs(place_m[part]) <= max_coordinate)) { // also NaN
            return std::nullopt;
        }
    }
    return place_m;
}

glm::dvec3 AffineTransform::normal(const glm::dvec3& own) const {
    if (turn == glm::dmat3(1.0)) { return own; }
    // The matrix of cofactors: the inverse's transpose times the determinant, which mirrors change.
    const glm::dmat3 cofactors(
        glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
    return (mirrors() ? -1.0 : 1.0) * (cofactors * own);
}

bool AffineTransform::mirrors() const { return glm::determinant(turn) < 0.0; }

namespace {

/// The colours of materials for the vertices of a mesh that has none: the last triangle's counts.
void colour_vertices(TriangleMesh& mesh) {
    if (!mesh.colours.empty() || mesh.vertices_m.empty()) { return; }
    mesh.colours.assign(mesh.vertices_m.size(), Material().colour);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) { mesh.colours[vertex] = material_colour(mesh, t); }
    }
}

/// One material for a mesh of several that has none.
void give_materials(TriangleMesh& mesh) {
    if (mesh.materials.empty() && !mesh.triangles.empty()) {
        mesh.materials.push_back({.name = "default"});
        mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    }
}

void place(TriangleMesh& mesh, const AffineTransform& placement) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = placement.point_m(vertex_m).value_or(placement.shift_m); }
    for (glm::vec3& normal : mesh.normals) {
        const glm::dvec3 turned = placement.normal(glm::dvec3(normal));
        const double length = glm::length(turned);
        normal = length > 0.0 ? glm::vec3(turned / length) : normal;
    }
}

/// No texture coordinates for the triangles of a mesh that has none.
void give_texture_coordinates(TriangleMesh& mesh) {
    if (mesh.corner_texture_coordinates.empty()) {
        mesh.corner_texture_coordinates.assign(mesh.triangles.size(), {invalid_index, invalid_index, invalid_index});
    }
}

Triangle shifted(const Triangle& triangle, std::uint32_t by) {
    return {triangle[0] + by, triangle[1] + by, triangle[2] + by};
}

/// Keeps the entries of `values` that `corners` points to.
template <typename Value>
void keep_used(std::vector<Value>& values, std::vector<Triangle>& corners) {
    std::vector<std::uint32_t> numbers(values.size(), invalid_index);
    for (const Triangle& triangle : corners) {
        for (const std::uint32_t corner : triangle) {
            if (corner != invalid_index) { numbers[corner] = 0; }
        }
    }
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (numbers[i] != invalid_index) {
            numbers[i] = count;
            values[count++] = values[i];
        }
    }
    values.resize(count);
    for (Triangle& triangle : corners) {
        for (std::uint32_t& corner : triangle) { corner = corner == invalid_index ? invalid_index : numbers[corner]; }
    }
}

} // namespace

void erase_triangles(TriangleMesh& mesh, const std::vector<bool>& gone) {
    const auto erase = [&gone](auto& list) {
        std::size_t t = 0;
        if (!list.empty()) {
            std::erase_if(list, [&](const auto&) { return gone[t++]; });
        }
    };
    erase(mesh.triangles);
    erase(mesh.corner_normals);
    erase(mesh.corner_texture_coordinates);
    erase(mesh.triangle_materials);
}

void erase_unused_vertices(TriangleMesh& mesh) {
    if (!mesh.colours.empty()) {
        std::vector<Triangle> corners = mesh.triangles;
        keep_used(mesh.colours, corners);
    }
    keep_used(mesh.vertices_m, mesh.triangles);
}

TriangleMesh take_transparent(TriangleMesh& mesh) {
    std::vector<bool> is_clear;
    for (const std::uint32_t material : mesh.triangle_materials) {
        is_clear.push_back(is_transparent(mesh.materials[material]));
    }
    const auto count = std::ranges::count(is_clear, true);
    if (count == 0 || static_cast<std::size_t>(count) == is_clear.size()) { return {}; }
    TriangleMesh clear = mesh;
    clear.notes.clear();
    erase_triangles(mesh, is_clear);
    is_clear.flip();
    erase_triangles(clear, is_clear);
    for (TriangleMesh* part : {&mesh, &clear}) { erase_unused_vertices(*part); }
    return clear;
}

TriangleMesh part_of_materials(const TriangleMesh& mesh, std::uint32_t first_material, std::uint32_t count) {
    TriangleMesh part = mesh;
    const auto from = mesh.materials.begin() + first_material;
    part.materials.assign(from, from + count);
    std::vector<bool> gone;
    for (std::uint32_t& material : part.triangle_materials) {
        material -= first_material;
        gone.push_back(material >= count); // Smaller ones have wrapped round.
    }
    erase_triangles(part, gone);
    erase_unused_vertices(part);
    keep_used(part.normals, part.corner_normals);
    keep_used(part.texture_coordinates, part.corner_texture_coordinates);
    return part;
}

void join_mesh(TriangleMesh& to, TriangleMesh from, const AffineTransform& placement) {
    if (from.triangles.empty()) {
        to.notes.insert(to.notes.end(), from.notes.begin(), from.notes.end());
        return;
    }
    place(from, placement);
    const auto has_own = [](const TriangleMesh& mesh) { return !mesh.colours.empty() && !mesh.colours_are_means; };
    const bool has_means = to.colours_are_means || from.colours_are_means;
    to.colours_are_means = has_means && !has_own(to) && !has_own(from);
    if (!to.colours.empty() || !from.colours.empty()) {
        colour_vertices(to);
        colour_vertices(from);
    }
    give_materials(to);
    give_materials(from);
    if (!to.texture_coordinates.empty() || !from.texture_coordinates.empty()) {
        give_texture_coordinates(to);
        give_texture_coordinates(from);
    }
    const auto first_texture = static_cast<std::uint32_t>(to.texture_coordinates.size());
    const bool normals = (to.triangles.empty() || !to.corner_normals.empty()) && !from.corner_normals.empty();
    const auto first = static_cast<std::uint32_t>(to.vertices_m.size());
    const auto first_normal = static_cast<std::uint32_t>(to.normals.size());
    const auto first_material = static_cast<std::uint32_t>(to.materials.size());
    const auto append = [](auto& list, const auto& more) { list.insert(list.end(), more.begin(), more.end()); };
    append(to.vertices_m, from.vertices_m);
    append(to.colours, from.colours);
    append(to.texture_coordinates, from.texture_coordinates);
    for (const Triangle& corners : from.corner_texture_coordinates) {
        to.corner_texture_coordinates.push_back(
            corners[0] == invalid_index ? corners : shifted(corners, first_texture));
    }
    append(to.materials, from.materials);
    append(to.notes, from.notes);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
        to.triangles.push_back(shifted(from.triangles[t], first));
        to.triangle_materials.push_back(from.triangle_materials[t] + first_material);
        if (normals) { to.corner_normals.push_back(shifted(from.corner_normals[t], first_normal)); }
    }
    if (normals) {
        append(to.normals, from.normals);
    } else {
        to.normals.clear();
        to.corner_normals.clear();
    }
}

} // namespace octant::models::meshfile
