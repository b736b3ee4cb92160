#include "tests/visuals/terrain/both_meshes.h"

#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace octant::visuals::terrain::test {

namespace {

template <typename Item>
bool same_bytes(const std::vector<Item>& a, const std::vector<Item>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Item)) == 0);
}

} // namespace

MeshView circling(int frame) {
    const double angle = frame * 0.02;
    return camera_view({70.0 * std::cos(angle), 70.0 * std::sin(angle), 15.0}, angle + 1.57, -0.2, 0.9);
}

MeshView into_the_sky() { return camera_view({0.0, 0.0, 200.0}, 0.3, 1.2, 0.9); }

Corners corners_of(const GroundMesh& mesh, std::size_t triangle) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = glm::dvec3(mesh.vertices[mesh.indices[3 * triangle + k]].position_m);
    }
    return corners;
}

bool reaches_into(const Corners& corners, const MeshView& view) {
    constexpr int parts = 5;
    for (int i = 0; i <= parts; ++i) {
        for (int j = 0; i + j <= parts; ++j) {
            const glm::dvec3 point = corners[0] + (corners[1] - corners[0]) * (1.0 * i / parts) +
                                     (corners[2] - corners[0]) * (1.0 * j / parts);
            if (std::all_of(view.frustum_normals.begin(), view.frustum_normals.end(),
                    [&](const glm::dvec3& normal) { return glm::dot(normal, point) >= 0.0; })) {
                return true;
            }
        }
    }
    return false;
}

bool SearchBox::meets(const glm::dvec3& min_m, const glm::dvec3& max_m) const {
    const glm::dvec3 above = max_m - (middle_m - half_m);
    const glm::dvec3 below = middle_m + half_m - min_m;
    return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) >= 0.0;
}

long checked_count_in(
    const SearchBox& box, const GroundMesh& mesh, const glm::dvec3& eye_m, std::span<const std::uint32_t> found) {
    constexpr double rounding_m = 1e-4; // positions are floats
    REQUIRE(std::adjacent_find(found.begin(), found.end(), std::greater_equal<>()) == found.end());
    REQUIRE((found.empty() || 3 * found.back() < mesh.indices.size()));
    long count = 0;
    for (std::uint32_t triangle = 0; 3 * triangle < mesh.indices.size(); ++triangle) {
        const auto [a, b, c] = corners_of(mesh, triangle);
        const glm::dvec3 min_m = glm::min(a, glm::min(b, c)) + eye_m + rounding_m;
        const glm::dvec3 max_m = glm::max(a, glm::max(b, c)) + eye_m - rounding_m;
        if (box.meets(min_m, max_m)) {
            ++count;
            REQUIRE(std::binary_search(found.begin(), found.end(), triangle));
        }
    }
    return count;
}

MeshCopy::MeshCopy(const GroundMesh& mesh)
    : vertices(mesh.vertices.begin(), mesh.vertices.end()), morphs(mesh.morphs.begin(), mesh.morphs.end()),
      indices(mesh.indices.begin(), mesh.indices.end()), triangles(mesh.counters.triangles), fans(mesh.counters.fans),
      resolution(mesh.resolution), error_px(mesh.error_px) {}

bool MeshCopy::operator==(const MeshCopy& other) const {
    return same_bytes(vertices, other.vertices) && same_bytes(morphs, other.morphs) && indices == other.indices &&
           triangles == other.triangles && fans == other.fans && resolution == other.resolution &&
           error_px == other.error_px;
}

} // namespace octant::visuals::terrain::test
