// Transfers normals from the original to a simplified mesh. At a crease the nearest point may lie
// on the wrong side, so a corner whose nearest triangle faces another way tries again a little
// further inside its own triangle.
#include "models/simplify/attributes.h"

#include <glm/geometric.hpp>

#include <array>
#include <map>
#include <optional>

namespace octant::models::simplify {

namespace {

/// Normals agree when the cosine between them is at least this.
constexpr double agreeing_cosine = 0.7;
/// Where the original is asked, one after the other: at the corner itself and at these shares of
/// the way to the triangle's centroid.
constexpr std::array<double, 4> pulls = {0.0, 0.1, 0.4, 1.0};

glm::dvec3 unit_normal(const TriangleMesh& mesh, std::size_t triangle) {
    return normal_of(mesh, mesh.triangles[triangle]);
}

/// The original's interpolated normal at the point nearest to `place_m`; nothing if the triangle
/// there does not face as `facing` does.
std::optional<glm::vec3> normal_near(
    const TriangleMesh& original,
    const measure::TriangleBvh& bvh,
    const glm::dvec3& place_m,
    const glm::dvec3& facing) {
    const measure::NearestOnMesh nearest = bvh.nearest(place_m);
    if (glm::dot(unit_normal(original, nearest.triangle), facing) < agreeing_cosine) {
        return std::nullopt;
    }
    const Triangle& corners = original.corner_normals[nearest.triangle];
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto corner = static_cast<std::size_t>(i);
        sum += nearest.weights[i] * glm::dvec3(original.normals[corners[corner]]);
    }
    const double length = glm::length(sum);
    if (!(length > 0.0)) {
        return std::nullopt;
    }
    return glm::vec3(sum / length);
}

} // namespace

void take_normals(
    TriangleMesh& mesh, const TriangleMesh& original, const measure::TriangleBvh& bvh) {
    mesh.normals.clear();
    mesh.corner_normals.clear();
    if (original.corner_normals.empty()) {
        return;
    }
    std::map<std::array<float, 3>, std::uint32_t> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 facing = unit_normal(mesh, t);
        const Triangle& corners = mesh.triangles[t];
        const glm::dvec3 middle_m = (mesh.vertices_m[corners[0]] + mesh.vertices_m[corners[1]] +
                                     mesh.vertices_m[corners[2]]) /
                                    3.0;
        Triangle& numbers = mesh.corner_normals.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            std::optional<glm::vec3> normal;
            for (std::size_t pull = 0; pull < pulls.size() && !normal; ++pull) {
                const glm::dvec3& corner_m = mesh.vertices_m[corners[i]];
                normal = normal_near(
                    original, bvh, corner_m + pulls[pull] * (middle_m - corner_m), facing);
            }
            const glm::vec3 taken = normal.value_or(glm::vec3(facing));
            const auto [at, added] = known.try_emplace(
                {taken.x, taken.y, taken.z}, static_cast<std::uint32_t>(mesh.normals.size()));
            if (added) {
                mesh.normals.push_back(taken);
            }
            numbers[i] = at->second;
        }
    }
}

} // namespace octant::models::simplify
