// Bounds the nodes of a vertex hierarchy by spheres and normal cones, for the view criterion.
#include "visuals/refine/progressive_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace octant::visuals::refine {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
/// A factor that makes up for the rounding of distances taken in float.
constexpr float rounding = 1.0F + 4e-6F;

float angle_rad(const glm::vec3& a, const glm::vec3& b) { return std::acos(glm::clamp(glm::dot(a, b), -1.0F, 1.0F)); }

/// An angle in steps of pi / 65535, rounded up so that a cone never gets too narrow.
std::uint16_t packed_angle(float angle_rad) {
    return static_cast<std::uint16_t>(std::min(65535.0F, std::ceil(angle_rad / pi * 65535.0F + 0.01F)));
}

} // namespace

/// Finds centre and diagonal of the bounding box.
void ProgressiveMesh::bound_all() {
    if (leaf_count() == 0) { return; }
    glm::vec3 min_m = position_m(0);
    glm::vec3 max_m = min_m;
    for (std::uint32_t leaf = 0; leaf < leaf_count(); ++leaf) {
        min_m = glm::min(min_m, position_m(leaf));
        max_m = glm::max(max_m, position_m(leaf));
    }
    middle_m_ = parts_.origin_m + 0.5 * (glm::dvec3(min_m) + glm::dvec3(max_m));
    half_diagonal_m_ = 0.5 * glm::distance(glm::dvec3(min_m), glm::dvec3(max_m));
}

/// Bounds each leaf by its adjacent original faces: their corners by a sphere, their normals by a cone.
void ProgressiveMesh::bound_leaves() {
    for (std::uint32_t face = 0; face < face_count(); ++face) {
        const glm::vec3 normal_of_face = face_normal(face);
        const bool flat = normal_of_face == glm::vec3(0.0F);
        const Triangle& corners = parts_.faces[face];
        for (const std::uint32_t leaf : corners) {
            NodeGeometry& here = shape(leaf);
            for (const std::uint32_t other : corners) {
                here.radius_m = std::max(here.radius_m, rounding * glm::distance(here.position_m, position_m(other)));
            }
            const float angle = flat ? 0.0F : angle_rad(normal(leaf), normal_of_face);
            here.cone = std::max(here.cone, packed_angle(angle));
        }
    }
}

/// Bounds each inner node by the spheres and cones of its children, from the finest nodes up.
void ProgressiveMesh::bound_nodes() {
    for (auto node = static_cast<std::uint32_t>(leaf_count()); node < node_count(); ++node) {
        const VertexSplit split = split_of(node);
        NodeGeometry& here = shape(node);
        float cone = 0.0F;
        for (const std::uint32_t child : {split.first, split.second}) {
            const float away_m = glm::distance(here.position_m, position_m(child));
            here.radius_m = std::max(here.radius_m, rounding * (away_m + radius_m(child)));
            cone = std::max(cone, angle_rad(normal(node), normal(child)) + cone_rad(child));
        }
        here.cone = packed_angle(cone);
    }
}

float ProgressiveMesh::cone_rad(std::uint32_t node) const {
    return static_cast<float>(shape(node).cone) / 65535.0F * pi;
}

glm::vec3 ProgressiveMesh::face_normal(std::uint32_t face) const {
    const Triangle& corners = parts_.faces[face];
    const glm::dvec3 a(position_m(corners[0]));
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(position_m(corners[1])) - a, glm::dvec3(position_m(corners[2])) - a);
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F);
}

} // namespace octant::visuals::refine
