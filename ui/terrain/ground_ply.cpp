#include "ui/terrain/ground_ply.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>

namespace octant::ui::terrain {

namespace {

static_assert(std::endian::native == std::endian::little);

template <class Value>
void append(std::string& bytes, const Value& value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
    bytes.append(raw.data(), raw.size());
}

} // namespace

std::string ply_of(const visuals::terrain::GroundMesh& mesh, const glm::dvec3& eye_m, bool ascii) {
    std::string bytes =
        fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty "
                    "double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            ascii ? "ascii" : "binary_little_endian", mesh.vertices.size(), mesh.indices.size() / 3);
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const glm::dvec3 world_m = eye_m + glm::dvec3(vertex.position_m);
        if (ascii) {
            bytes += fmt::format("{:.9g} {:.9g} {:.9g}\n", world_m.x, world_m.y, world_m.z);
        } else {
            append(bytes, world_m.x);
            append(bytes, world_m.y);
            append(bytes, world_m.z);
        }
    }
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        if (ascii) {
            bytes += fmt::format("3 {} {} {}\n", mesh.indices[k], mesh.indices[k + 1], mesh.indices[k + 2]);
        } else {
            append(bytes, std::uint8_t{3});
            for (std::size_t i = 0; i < 3; ++i) { append(bytes, static_cast<std::int32_t>(mesh.indices[k + i])); }
        }
    }
    return bytes;
}

} // namespace octant::ui::terrain
