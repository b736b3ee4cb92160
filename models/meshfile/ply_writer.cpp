#include "models/meshfile/byte_writer.h"
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

bool fits_float(const TriangleMesh& mesh) {
    return std::ranges::all_of(mesh.vertices_m, [](const glm::dvec3& vertex_m) {
        return glm::dvec3(glm::vec3(vertex_m)) == vertex_m;
    });
}

std::uint8_t byte_of(float part) {
    return static_cast<std::uint8_t>(std::lround(part * 255.0F));
}

bool fits_byte(float part) {
    return static_cast<float>(byte_of(part) / 255.0) == part;
}

bool colours_fit_bytes(const TriangleMesh& mesh) {
    return std::ranges::all_of(mesh.colours, [](const glm::vec3& colour) {
        return fits_byte(colour.x) && fits_byte(colour.y) && fits_byte(colour.z);
    });
}

/// The only normal that each vertex has; empty when one has several. Vertices of no triangle get
/// any.
std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh) {
    if (mesh.corner_normals.empty()) {
        return {};
    }
    std::vector<std::uint32_t> of_vertex(mesh.vertices_m.size(), no_index);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& known = of_vertex[mesh.triangles[t][k]];
            const std::uint32_t normal = mesh.corner_normals[t][k];
            if (known != no_index && mesh.normals[known] != mesh.normals[normal]) {
                return {};
            }
            known = normal;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(of_vertex.size());
    for (const std::uint32_t normal : of_vertex) {
        normals.push_back(normal == no_index ? glm::vec3(0.0F, 0.0F, 1.0F) : mesh.normals[normal]);
    }
    return normals;
}

template <typename T>
void append_vector(std::string& bytes, const glm::dvec3& vector) {
    append_number(bytes, static_cast<T>(vector.x));
    append_number(bytes, static_cast<T>(vector.y));
    append_number(bytes, static_cast<T>(vector.z));
}

} // namespace

std::string ply_bytes(const TriangleMesh& mesh) {
    const bool is_float = fits_float(mesh);
    const bool has_colours = !mesh.colours.empty();
    const bool byte_colours = colours_fit_bytes(mesh);
    const std::vector<glm::vec3> normals = vertex_normals(mesh);
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.vertices_m.size());
    const auto add_properties = [&](std::string_view type, std::string_view names) {
        for (const char name : names) {
            bytes += fmt::format("property {} {}\n", type, name);
        }
    };
    add_properties(is_float ? "float" : "double", "xyz");
    if (!normals.empty()) {
        bytes += "property float nx\nproperty float ny\nproperty float nz\n";
    }
    if (has_colours) {
        for (const std::string_view part : {"red", "green", "blue"}) {
            bytes += fmt::format("property {} {}\n", byte_colours ? "uchar" : "float", part);
        }
    }
    bytes += fmt::format(
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        if (is_float) {
            append_vector<float>(bytes, mesh.vertices_m[v]);
        } else {
            append_vector<double>(bytes, mesh.vertices_m[v]);
        }
        if (!normals.empty()) {
            append_vector<float>(bytes, glm::dvec3(normals[v]));
        }
        for (int part = 0; has_colours && part < 3; ++part) {
            if (byte_colours) {
                append_number(bytes, byte_of(mesh.colours[v][part]));
            } else {
                append_number(bytes, mesh.colours[v][part]);
            }
        }
    }
    for (const Triangle& triangle : mesh.triangles) {
        append_number(bytes, std::uint8_t{3});
        for (const std::uint32_t vertex : triangle) {
            append_number(bytes, vertex);
        }
    }
    return bytes;
}

} // namespace octant::models::meshfile
