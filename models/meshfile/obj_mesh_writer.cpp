#include "models/meshfile/material_names.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/format_once.h"

#include <fmt/format.h>
#include <iterator>

namespace octant::models::meshfile {

namespace {

std::string mtl_text(const TriangleMesh& mesh, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t m = 0; m < names.size(); ++m) {
        const glm::vec3& colour = mesh.materials[m].colour;
        text += fmt::format("newmtl {}\nKd {} {} {}\n", names[m], colour.x, colour.y, colour.z);
        if (!mesh.materials[m].picture.empty()) { text += fmt::format("map_Kd {}\n", mesh.materials[m].picture); }
    }
    return text;
}

void append_vertices(std::string& text, const TriangleMesh& mesh) {
    auto out = std::back_inserter(text);
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        const glm::dvec3& place_m = mesh.vertices_m[v];
        fmt::format_to(out, "v {} {} {}", place_m.x, place_m.y, place_m.z);
        if (!mesh.colours.empty()) {
            const glm::vec3& colour = mesh.colours[v];
            fmt::format_to(out, " {} {} {}", colour.x, colour.y, colour.z);
        }
        text += '\n';
    }
    for (const glm::vec2& place : mesh.texture_coordinates) { fmt::format_to(out, "vt {} {}\n", place.x, place.y); }
    for (const glm::vec3& normal : mesh.normals) { fmt::format_to(out, "vn {} {} {}\n", normal.x, normal.y, normal.z); }
}

} // namespace

ObjMeshText obj_mesh_text(const TriangleMesh& mesh, std::string_view mtl_name) {
    const std::vector<std::string> names = unique_material_names(mesh.materials);
    ObjMeshText text;
    text.mtl = mtl_text(mesh, names);
    text.obj = fmt::format("# {} vertices, {} triangles\n", mesh.vertices_m.size(), mesh.triangles.size());
    if (!names.empty()) { text.obj += fmt::format("mtllib {}\n", mtl_name); }
    append_vertices(text.obj, mesh);
    const auto out = std::back_inserter(text.obj);
    std::uint32_t material = invalid_index;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!mesh.triangle_materials.empty() && mesh.triangle_materials[t] != material) {
            material = mesh.triangle_materials[t];
            text.obj += fmt::format("usemtl {}\n", names[material]);
        }
        text.obj += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            fmt::format_to(out, " {}", mesh.triangles[t][k] + 1);
            const bool has_texture =
                !mesh.corner_texture_coordinates.empty() && mesh.corner_texture_coordinates[t][k] != invalid_index;
            if (has_texture) { fmt::format_to(out, "/{}", mesh.corner_texture_coordinates[t][k] + 1); }
            if (!mesh.corner_normals.empty()) {
                fmt::format_to(out, "{}{}", has_texture ? "/" : "//", mesh.corner_normals[t][k] + 1);
            }
        }
        text.obj += '\n';
    }
    return text;
}

} // namespace octant::models::meshfile
