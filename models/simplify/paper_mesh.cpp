// The mesh of the paper's own mode: Y. Kim, B. U. Lee, "Error measure for vertex simplification",
// 2005, section II, where contraction has no test that keeps a manifold. Plain lists of faces at
// vertices therefore, instead of half-edges.
#include "models/simplify/paper_mesh.h"

#include "models/collapse_sequence.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace octant::models::simplify {

namespace {

bool holds(const Triangle& face, std::uint32_t vertex) {
    return std::find(face.begin(), face.end(), vertex) != face.end();
}

glm::vec3 middle(const glm::vec3& a, const glm::vec3& b) {
    return 0.5F * (a + b);
}

template <typename Value>
Value placed(const Value& first, const Value& second, Place place) {
    switch (place) {
    case Place::First:
        return first;
    case Place::Second:
        return second;
    case Place::Middle:
        break;
    }
    return middle(first, second);
}

} // namespace

PaperMesh::PaperMesh(const TriangleMesh& original, double colour_weight)
    : colours_(original.colours)
    , faces_(original.triangles)
    , collapsed_(original.triangles.size())
    , vertex_faces_(original.vertices_m.size())
    , face_count_(original.triangles.size()) {
    points_.reserve(original.vertices_m.size());
    for (std::size_t i = 0; i < original.vertices_m.size(); ++i) {
        const glm::dvec3& at_m = original.vertices_m[i];
        const glm::dvec3 colour = original.colours.empty()
                                      ? glm::dvec3(0.0)
                                      : colour_weight * glm::dvec3(original.colours[i]);
        points_.push_back(Point6{at_m.x, at_m.y, at_m.z, colour.x, colour.y, colour.z});
    }
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
        const Triangle& t = faces_[face];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            collapsed_[face] = true;
            --face_count_;
            continue;
        }
        for (const std::uint32_t vertex : faces_[face]) {
            vertex_faces_[vertex].push_back(face);
        }
    }
}

Corners PaperMesh::corners(std::uint32_t face) const {
    const Triangle& t = faces_[face];
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
}

Point6 PaperMesh::candidate(std::uint32_t first, std::uint32_t second, Place place) const {
    return placed(points_[first], points_[second], place);
}

void PaperMesh::united_faces(
    std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& faces) const {
    faces.clear();
    std::set_union(
        vertex_faces_[a].begin(),
        vertex_faces_[a].end(),
        vertex_faces_[b].begin(),
        vertex_faces_[b].end(),
        std::back_inserter(faces));
}

void PaperMesh::neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& others) const {
    others.clear();
    for (const std::uint32_t face : vertex_faces_[vertex]) {
        for (const std::uint32_t other : faces_[face]) {
            if (other != vertex) {
                others.push_back(other);
            }
        }
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
}

void PaperMesh::drop(std::uint32_t face, std::uint32_t vertex) {
    std::vector<std::uint32_t>& faces = vertex_faces_[vertex];
    faces.erase(std::remove(faces.begin(), faces.end(), face), faces.end());
}

void PaperMesh::contract(std::uint32_t kept, std::uint32_t gone, Place place) {
    const Point6 target = candidate(kept, gone, place);
    std::vector<std::uint32_t> faces;
    united_faces(kept, gone, faces);
    std::vector<std::uint32_t> staying;
    for (const std::uint32_t face : faces) {
        Triangle& corners = faces_[face];
        if (holds(corners, kept) && holds(corners, gone)) {
            collapsed_[face] = true;
            --face_count_;
            for (const std::uint32_t vertex : corners) {
                if (vertex != kept && vertex != gone) {
                    drop(face, vertex);
                }
            }
            continue;
        }
        std::replace(corners.begin(), corners.end(), gone, kept);
        staying.push_back(face);
    }
    vertex_faces_[gone] = {};
    vertex_faces_[kept] = std::move(staying);
    points_[kept] = target;
    if (!colours_.empty()) {
        colours_[kept] = placed(colours_[kept], colours_[gone], place);
    }
}

TriangleMesh PaperMesh::left_over(const TriangleMesh& original) const {
    TriangleMesh mesh;
    mesh.name = original.name;
    mesh.materials = original.materials;
    std::vector<std::uint32_t> numbers(points_.size(), none);
    for (std::uint32_t vertex = 0; vertex < points_.size(); ++vertex) {
        if (vertex_faces_[vertex].empty()) {
            continue;
        }
        numbers[vertex] = static_cast<std::uint32_t>(mesh.vertices_m.size());
        const Point6& point = points_[vertex];
        mesh.vertices_m.emplace_back(point[0], point[1], point[2]);
        if (!colours_.empty()) {
            mesh.colours.push_back(colours_[vertex]);
        }
    }
    for (std::size_t face = 0; face < faces_.size(); ++face) {
        if (collapsed_[face]) {
            continue;
        }
        const Triangle& t = faces_[face];
        mesh.triangles.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
        if (!original.triangle_materials.empty()) {
            mesh.triangle_materials.push_back(original.triangle_materials[face]);
        }
    }
    return mesh;
}

} // namespace octant::models::simplify
