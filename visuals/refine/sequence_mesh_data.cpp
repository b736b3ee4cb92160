// From a sequence of edge collapses to the parts of a vertex hierarchy: J. Kim, S. Lee, "Truly
// Selective Refinement of Progressive Meshes", Graphics Interface 2001, section 3 (vertex
// hierarchy). The sequence names nodes by vertex and collapse numbers; here leaves are renumbered
// in depth-first order, so that the region S(v) of any node is a range of leaves.
#include "visuals/refine/sequence_mesh_data.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace octant::visuals::refine {

namespace {

using models::Collapse;
using models::CollapseSequence;
using models::TriangleMesh;

/// A unit normal times the area of the surface that it was averaged over (twice the area, to be
/// exact).
using WeightedNormal = glm::dvec3;

/// Whether every coordinate of the original is a float already, so that it can be kept bit for bit.
bool all_floats(const CollapseSequence& sequence) {
    const auto is_float = [](const glm::dvec3& point_m) {
        return glm::dvec3(glm::vec3(point_m)) == point_m;
    };
    return std::ranges::all_of(sequence.original.vertices_m, is_float);
}

/// For each original vertex its leaf number, in an order in which the leaves below any node are
/// consecutive.
std::vector<std::uint32_t> leaf_order(const CollapseSequence& sequence) {
    const std::size_t leaves = sequence.original.vertices_m.size();
    const std::size_t nodes = leaves + sequence.collapses.size();
    std::vector<std::uint32_t> sizes(nodes, 1); // the number of leaves below each node
    std::vector<bool> has_parent(nodes, false);
    for (std::size_t i = 0; i < sequence.collapses.size(); ++i) {
        const Collapse& collapse = sequence.collapses[i];
        sizes[leaves + i] = sizes[collapse.first] + sizes[collapse.second];
        has_parent[collapse.first] = true;
        has_parent[collapse.second] = true;
    }
    std::vector<std::uint32_t> begins(nodes, 0);
    std::uint32_t next = 0;
    for (std::size_t node = 0; node < nodes; ++node) {
        if (!has_parent[node]) {
            begins[node] = next;
            next += sizes[node];
        }
    }
    for (std::size_t i = sequence.collapses.size(); i-- > 0;) {
        const Collapse& collapse = sequence.collapses[i];
        begins[collapse.first] = begins[leaves + i];
        begins[collapse.second] = begins[leaves + i] + sizes[collapse.first];
    }
    begins.resize(leaves);
    return begins;
}

/// For each original vertex the sum of its given corner normals weighted by area, or of the normals
/// of its faces where it has none.
std::vector<WeightedNormal> vertex_normals(const TriangleMesh& mesh) {
    std::vector<WeightedNormal> from_faces(mesh.vertices_m.size(), WeightedNormal(0.0));
    std::vector<glm::dvec3> given(mesh.normals.empty() ? 0 : mesh.vertices_m.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const glm::dvec3& a_m = mesh.vertices_m[corners[0]];
        const glm::dvec3 area =
            glm::cross(mesh.vertices_m[corners[1]] - a_m, mesh.vertices_m[corners[2]] - a_m);
        for (std::size_t k = 0; k < 3; ++k) {
            from_faces[corners[k]] += area;
            if (!given.empty()) {
                const std::uint32_t normal = mesh.corner_normals[t][k];
                given[corners[k]] += glm::length(area) * glm::dvec3(mesh.normals[normal]);
            }
        }
    }
    for (std::size_t v = 0; v < given.size(); ++v) {
        from_faces[v] = glm::length(given[v]) > 0.0 ? given[v] : from_faces[v];
    }
    return from_faces;
}

PackedNormal packed_direction(const WeightedNormal& normal) {
    const double length = glm::length(normal);
    return packed(length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F));
}

void add_leaves(const CollapseSequence& sequence, ProgressiveMeshData& parts) {
    const TriangleMesh& mesh = sequence.original;
    for (const std::uint32_t vertex : parts.original_vertices) {
        parts.positions_m.emplace_back(mesh.vertices_m[vertex] - parts.origin_m);
        if (!mesh.colours.empty()) {
            parts.colours.push_back(packed_rgb16(mesh.colours[vertex]));
        }
    }
}

void add_splits(
    const CollapseSequence& sequence,
    const std::vector<std::uint32_t>& places,
    ProgressiveMeshData& parts) {
    const std::size_t leaves = places.size();
    const auto node_of = [&](std::uint32_t vertex) {
        return vertex < leaves ? places[vertex] : vertex;
    };
    parts.splits.reserve(sequence.collapses.size());
    for (const Collapse& collapse : sequence.collapses) {
        parts.splits.push_back(
            {node_of(collapse.first),
             node_of(collapse.second),
             collapse.left,
             collapse.right,
             static_cast<float>(collapse.error_m)});
        parts.positions_m.emplace_back(collapse.position_m - parts.origin_m);
        if (!sequence.original.colours.empty()) {
            parts.colours.push_back(packed_rgb16(collapse.colour));
        }
    }
}

/// Adds the normals of leaves and of inner nodes; an inner node's is the area-weighted mean of its
/// leaves'.
void add_normals(const TriangleMesh& mesh, ProgressiveMeshData& parts) {
    const std::vector<WeightedNormal> by_vertex = vertex_normals(mesh);
    std::vector<WeightedNormal> sums;
    sums.reserve(parts.positions_m.size());
    for (const std::uint32_t vertex : parts.original_vertices) {
        sums.push_back(by_vertex[vertex]);
    }
    for (const VertexSplit& split : parts.splits) {
        sums.push_back(sums[split.first] + sums[split.second]);
    }
    parts.normals.reserve(sums.size());
    for (const WeightedNormal& sum : sums) {
        parts.normals.push_back(packed_direction(sum));
    }
}

void add_faces(
    const TriangleMesh& mesh, const std::vector<std::uint32_t>& places, ProgressiveMeshData& parts) {
    parts.faces.reserve(mesh.triangles.size());
    for (const Triangle& corners : mesh.triangles) {
        parts.faces.push_back({places[corners[0]], places[corners[1]], places[corners[2]]});
    }
    parts.materials = mesh.materials;
    parts.face_materials.assign(mesh.triangle_materials.begin(), mesh.triangle_materials.end());
}

} // namespace

ProgressiveMeshData mesh_data_of(const CollapseSequence& sequence) {
    const TriangleMesh& mesh = sequence.original;
    assert(mesh.materials.size() < 65536);
    const std::size_t nodes = mesh.vertices_m.size() + sequence.collapses.size();
    ProgressiveMeshData parts;
    parts.name = mesh.name;
    if (!all_floats(sequence)) {
        const models::BoundingBox bounds = models::bounds_of(mesh);
        parts.origin_m = glm::dvec3(glm::vec3(0.5 * (bounds.min_m + bounds.max_m)));
    }
    const std::vector<std::uint32_t> places = leaf_order(sequence);
    parts.original_vertices.resize(places.size());
    for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
        parts.original_vertices[places[vertex]] = vertex;
    }
    parts.positions_m.reserve(nodes);
    parts.colours.reserve(mesh.colours.empty() ? 0 : nodes);
    add_leaves(sequence, parts);
    add_splits(sequence, places, parts);
    add_normals(mesh, parts);
    add_faces(mesh, places, parts);
    return parts;
}

} // namespace octant::visuals::refine
