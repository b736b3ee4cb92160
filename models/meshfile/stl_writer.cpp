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
    for (const Triangle& triangle : mesh.triangles) {
        append_vector(bytes, glm::vec3(normal_of(mesh, triangle)));
        for (const std::uint32_t vertex : triangle) { append_vector(bytes, glm::vec3(mesh.vertices_m[vertex])); }
        append_number(bytes, std::uint16_t{0});
    }
    return bytes;
}

} // namespace octant::models::meshfile
