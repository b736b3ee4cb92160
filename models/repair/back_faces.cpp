#include "models/repair/back_faces.h"

#include "models/mesh_edges.h"
#include "models/repair/vertex_welding.h"
#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace octant::models::repair {

namespace {

constexpr double behind = 1e-5; ///< of the diagonal

/// The triangles by the first vertex at each place.
std::vector<Triangle> welded(const TriangleMesh& mesh, std::span<const std::uint32_t> firsts) {
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& vertex : triangle) { vertex = firsts[vertex]; }
    }
    return triangles;
}

/// For each vertex whether its connected piece has an edge of one triangle only.
std::vector<bool> in_open_piece(std::span<const Triangle> triangles, std::size_t vertices) {
    DisjointSets pieces(vertices);
    for (const Triangle& triangle : triangles) {
        pieces.join(triangle[0], triangle[1]);
        pieces.join(triangle[0], triangle[2]);
    }
    std::vector<bool> is_open(vertices, false);
    const std::vector<TriangleEdge> sides = sorted_triangle_edges(triangles);
    for_each_edge(sides, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() == 1 && edge[0].min_vertex != edge[0].max_vertex) {
            is_open[pieces.group_of(edge[0].min_vertex)] = true;
        }
    });
    for (std::uint32_t v = 0; v < vertices; ++v) { is_open[v] = is_open[pieces.group_of(v)]; }
    return is_open;
}

class Backs {
public:
    Backs(TriangleMesh& mesh, std::vector<glm::dvec3> fronts)
        : mesh_(mesh), fronts_(std::move(fronts)), behind_m_(behind * diagonal_m(mesh)),
          backs_(mesh.vertices_m.size(), invalid_index), normals_(mesh.normals.size(), invalid_index) {}

    void add(std::size_t t) {
        const Triangle front = mesh_.triangles[t];
        mesh_.triangles.push_back({back_of(front[0]), back_of(front[2]), back_of(front[1])});
        if (!mesh_.corner_normals.empty()) {
            const Triangle normals = mesh_.corner_normals[t];
            mesh_.corner_normals.push_back({turned(normals[0]), turned(normals[2]), turned(normals[1])});
        }
        if (!mesh_.corner_texture_coordinates.empty()) {
            const auto [a, b, c] = mesh_.corner_texture_coordinates[t];
            mesh_.corner_texture_coordinates.push_back({a, c, b});
        }
        if (!mesh_.triangle_materials.empty()) {
            mesh_.triangle_materials.push_back(std::uint32_t{mesh_.triangle_materials[t]});
        }
    }

private:
    std::uint32_t back_of(std::uint32_t vertex) {
        if (backs_[vertex] == invalid_index) {
            backs_[vertex] = static_cast<std::uint32_t>(mesh_.vertices_m.size());
            const double length = glm::length(fronts_[vertex]);
            const glm::dvec3 off_m = length > 0.0 ? fronts_[vertex] * (behind_m_ / length) : glm::dvec3(behind_m_);
            mesh_.vertices_m.push_back(mesh_.vertices_m[vertex] - off_m);
            if (!mesh_.colours.empty()) { mesh_.colours.push_back(glm::vec3(mesh_.colours[vertex])); }
        }
        return backs_[vertex];
    }

    std::uint32_t turned(std::uint32_t normal) {
        if (normals_[normal] == invalid_index) {
            normals_[normal] = static_cast<std::uint32_t>(mesh_.normals.size());
            mesh_.normals.push_back(-mesh_.normals[normal]);
        }
        return normals_[normal];
    }

    TriangleMesh& mesh_;
    std::vector<glm::dvec3> fronts_; ///< of each vertex, the sum of the area vectors around it
    double behind_m_;
    std::vector<std::uint32_t> backs_;
    std::vector<std::uint32_t> normals_;
};

} // namespace

std::size_t add_back_faces(TriangleMesh& mesh, const std::vector<bool>& two_sided) {
    const std::size_t count = mesh.triangles.size();
    const std::vector<std::uint32_t> firsts =
        first_duplicates(mesh.vertices_m, {}, std::vector<bool>(mesh.vertices_m.size(), true));
    const std::vector<Triangle> triangles = welded(mesh, firsts);
    const std::vector<bool> is_open = in_open_piece(triangles, mesh.vertices_m.size());
    std::vector<glm::dvec3> sums(mesh.vertices_m.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < count; ++t) {
        for (const std::uint32_t vertex : triangles[t]) { sums[vertex] += area_vector(mesh, triangles[t]); }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) { sums[v] = sums[firsts[v]]; }
    Backs backs(mesh, std::move(sums));
    for (std::size_t t = 0; t < count; ++t) {
        if (two_sided[t] && is_open[triangles[t][0]]) { backs.add(t); }
    }
    return mesh.triangles.size() - count;
}

} // namespace octant::models::repair
