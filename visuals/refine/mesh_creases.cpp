#include "visuals/refine/mesh_creases.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// Normals that differ by less than this, about 3 degrees, are one: packing rounds them.
constexpr float same_cosine = 0.9986F;

bool differ(const PackedNormal& one, const PackedNormal& other) {
    return one != other && glm::dot(unpacked(one), unpacked(other)) < same_cosine;
}

/// For each vertex whether its corners have several normals.
std::vector<bool> creased_vertices(
    std::size_t vertices, std::span<const Triangle> triangles, std::span<const CornerNormals> normals) {
    std::vector<PackedNormal> first(vertices);
    std::vector<bool> has_first(vertices, false);
    std::vector<bool> is_creased(vertices, false);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = triangles[t].at(k);
            if (!has_first[vertex]) {
                first[vertex] = normals[t].at(k);
                has_first[vertex] = true;
            } else if (differ(first[vertex], normals[t].at(k))) {
                is_creased[vertex] = true;
            }
        }
    }
    return is_creased;
}

} // namespace

std::vector<CornerNormals> creased_normals(const models::TriangleMesh& mesh) {
    std::vector<CornerNormals> normals;
    normals.reserve(mesh.corner_normals.size());
    for (const Triangle& corners : mesh.corner_normals) {
        normals.push_back(
            {packed(mesh.normals[corners[0]]), packed(mesh.normals[corners[1]]), packed(mesh.normals[corners[2]])});
    }
    const std::vector<bool> is_creased =
        creased_vertices(mesh.vertices_m.size(), std::span(mesh.triangles).first(normals.size()), normals);
    return std::ranges::find(is_creased, true) == is_creased.end() ? std::vector<CornerNormals>() : normals;
}

std::shared_ptr<const MeshCreases> mesh_creases(
    const ProgressiveMesh& hierarchy, const std::vector<CornerNormals>& corner_normals) {
    if (corner_normals.empty() || corner_normals.size() != hierarchy.face_count()) { return nullptr; }
    MeshCreases creases;
    creases.corner_normals.reserve(corner_normals.size());
    for (std::uint32_t face = 0; face < hierarchy.face_count(); ++face) {
        creases.corner_normals.push_back(corner_normals[hierarchy.original_face(face)]);
    }
    creases.is_creased = creased_vertices(hierarchy.leaf_count(), hierarchy.faces(), creases.corner_normals);
    creases.is_creased.resize(hierarchy.node_count(), false);
    const std::vector<std::uint32_t> coarsest_first = hierarchy.coarsest_first();
    for (std::size_t i = coarsest_first.size(); i-- > 0;) { // children before their parents
        const VertexSplit split = hierarchy.split_of(coarsest_first[i]);
        creases.is_creased[coarsest_first[i]] = creases.is_creased[split.first] || creases.is_creased[split.second];
    }
    return std::make_shared<const MeshCreases>(std::move(creases));
}

} // namespace octant::visuals::refine
