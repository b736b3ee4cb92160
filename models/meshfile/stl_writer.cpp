#include "models/meshfile/byte_writer.h"
#include "models/meshfile/mesh_formats.h"

#include <glm/geometric.hpp>

namespace octant::models::meshfile {

namespace {

void append_vector(std::string& bytes, const glm::vec3& vector) {
    append_number(bytes, vector.x);
    append_number(bytes, vector.y);
    append_number(bytes, vector.z);
}

} // namespace

std::string stl_bytes(const TriangleMesh& mesh) {
    std::string bytes = "binary STL";
    bytes.resize(80, ' ');
    append_number(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3& a_m = mesh.vertices_m[a];
        const glm::dvec3& b_m = mesh.vertices_m[b];
        const glm::dvec3& c_m = mesh.vertices_m[c];
        const glm::dvec3 across = glm::cross(b_m - a_m, c_m - a_m);
        const double length = glm::length(across);
        append_vector(bytes, length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F));
        append_vector(bytes, glm::vec3(a_m));
        append_vector(bytes, glm::vec3(b_m));
        append_vector(bytes, glm::vec3(c_m));
        append_number(bytes, std::uint16_t{0});
    }
    return bytes;
}

} // namespace octant::models::meshfile
