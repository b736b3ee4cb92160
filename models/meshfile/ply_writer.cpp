#include "models/meshfile/byte_writer.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

bool fits_float(const TriangleMesh& mesh) {
    return std::ranges::all_of(
        mesh.vertices_m, [](const glm::dvec3& vertex_m) { return glm::dvec3(glm::vec3(vertex_m)) == vertex_m; });
}

std::uint8_t byte_of(float part) { return static_cast<std::uint8_t>(std::lround(part * 255.0F)); }

bool fits_byte(float part) { return static_cast<float>(byte_of(part) / 255.0) == part; }

bool colours_fit_bytes(const TriangleMesh& mesh) {
    return std::ranges::all_of(mesh.colours,
        [](const glm::vec3& colour) { return fits_byte(colour.x) && fits_byte(colour.y) && fits_byte(colour.z); });
}

/// The only entry of `values` that the corners of each vertex have; empty when one has several. Vertices of no triangle
/// get `without`.
template <typename Value>
std::vector<Value> of_vertices(const TriangleMesh& mesh, const std::vector<Value>& values,
    const std::vector<Triangle>& corners, const Value& without) {
    if (corners.empty()) { return {}; }
    std::vector<std::uint32_t> of_vertex(mesh.vertices_m.size(), invalid_index);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& known = of_vertex[mesh.triangles[t][k]];
            const std::uint32_t value = corners[t][k];
            if (known != invalid_index && (value == invalid_index || values[known] != values[value])) { return {}; }
            known = value;
        }
    }
    std::vector<Value> found;
    found.reserve(of_vertex.size());
    for (const std::uint32_t value : of_vertex) { found.push_back(value == invalid_index ? without : values[value]); }
    return found;
}

std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh) {
    return of_vertices(mesh, mesh.normals, mesh.corner_normals, glm::vec3(0.0F, 0.0F, 1.0F));
}

std::vector<glm::vec2> vertex_textures(const TriangleMesh& mesh) {
    return of_vertices(mesh, mesh.texture_coordinates, mesh.corner_texture_coordinates, glm::vec2(0.0F));
}

/// A face's list of corners and, where `textures`, of their texture coordinates as MeshLab has them.
void append_face(std::string& bytes, const TriangleMesh& mesh, std::size_t t, bool textures) {
    append_number(bytes, std::uint8_t{3});
    for (const std::uint32_t vertex : mesh.triangles[t]) { append_number(bytes, vertex); }
    if (!textures) { return; }
    const Triangle& corners = mesh.corner_texture_coordinates[t];
    append_number(bytes, std::uint8_t{static_cast<std::uint8_t>(corners[0] == invalid_index ? 0 : 6)});
    for (const std::uint32_t corner : corners) {
        if (corner != invalid_index) {
            append_number(bytes, mesh.texture_coordinates[corner].x);
            append_number(bytes, mesh.texture_coordinates[corner].y);
        }
    }
}

template <typename T>
void append_vector(std::string& bytes, const glm::dvec3& vector) {
    append_number(bytes, static_cast<T>(vector.x));
    append_number(bytes, static_cast<T>(vector.y));
    append_number(bytes, static_cast<T>(vector.z));
}

} // namespace

bool has_vertex_normals(const TriangleMesh& mesh) { return !vertex_normals(mesh).empty(); }

std::string ply_bytes(const TriangleMesh& mesh) {
    const bool is_float = fits_float(mesh);
    const bool has_colours = !mesh.colours.empty();
    const bool byte_colours = colours_fit_bytes(mesh);
    const std::vector<glm::vec3> normals = vertex_normals(mesh);
    const std::vector<glm::vec2> textures = vertex_textures(mesh);
    const bool face_textures = textures.empty() && !mesh.corner_texture_coordinates.empty();
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.vertices_m.size());
    const auto add_properties = [&](std::string_view type, std::string_view names) {
        for (const char name : names) { bytes += fmt::format("property {} {}\n", type, name); }
    };
    add_properties(is_float ? "float" : "double", "xyz");
    if (!normals.empty()) { bytes += "property float nx\nproperty float ny\nproperty float nz\n"; }
    if (has_colours) {
        for (const std::string_view part : {"red", "green", "blue"}) {
            bytes += fmt::format("property {} {}\n", byte_colours ? "uchar" : "float", part);
        }
    }
    if (!textures.empty()) { add_properties("float", "st"); }
    bytes += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n{}end_header\n",
        mesh.triangles.size(), face_textures ? "property list uchar float texcoord\n" : "");
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        if (is_float) {
            append_vector<float>(bytes, mesh.vertices_m[v]);
        } else {
            append_vector<double>(bytes, mesh.vertices_m[v]);
        }
        if (!normals.empty()) { append_vector<float>(bytes, glm::dvec3(normals[v])); }
        for (int part = 0; has_colours && part < 3; ++part) {
            if (byte_colours) {
                append_number(bytes, byte_of(mesh.colours[v][part]));
            } else {
                append_number(bytes, mesh.colours[v][part]);
            }
        }
        if (!textures.empty()) {
            append_number(bytes, textures[v].x);
            append_number(bytes, textures[v].y);
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) { append_face(bytes, mesh, t, face_textures); }
    return bytes;
}

} // namespace octant::models::meshfile
