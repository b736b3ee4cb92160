#include "models/smooth_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstddef>
#include <map>
#include <numeric>

namespace octant::models {

namespace {

constexpr std::size_t max_compared = 4096; ///< faces around a vertex, each with each
/// The tolerance on cosines and on the length of a sum of normals.
constexpr double same_direction = 1e-9;

/// One corner of a face.
struct Corner {
    std::uint32_t face = 0;
    std::uint32_t vertex = 0;
    std::uint32_t before = 0; ///< the vertex of the face's previous corner
    std::uint32_t after = 0;  ///< that of its next one
    double angle_rad = 0.0;   ///< the face's interior angle
};

/// The corners at one vertex, and which of them are neighbours across an edge: those whose faces run along it in
/// opposite directions.
class Around {
public:
    Around(std::span<const SmoothFace> faces, std::span<const Corner> all) : faces_(faces), all_(all) {}

    /// How often two corners were compared up to now.
    std::size_t compared() const { return compared_; }

    /// Turns to another vertex. `corners` are the indices of all corners there, in ascending order.
    void look_at(std::span<const std::uint32_t> corners) {
        corners_ = corners;
        sums_.clear();
        if (corners.size() > max_compared) {
            for (std::uint32_t i = 0; i < corners.size(); ++i) { sums_[group(i)] += weighted_normal(i); }
            return;
        }
        edges_.clear();
        sides_.clear();
        across_.assign(corners.size(), {});
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            edges_.push_back({corner(i).before, false, i});
            edges_.push_back({corner(i).after, true, i});
        }
        std::ranges::sort(edges_);
        for (std::size_t first = 0; first < edges_.size();) {
            std::size_t end = first;
            while (end < edges_.size() && edges_[end].other_end == edges_[first].other_end) { ++end; }
            add_sides(std::span(edges_).subspan(first, end - first));
            first = end;
        }
    }

    /// The normal of one corner, by its index among those looked at.
    glm::vec3 normal_at(std::uint32_t at) {
        const glm::dvec3& own = face(at).normal;
        if (own == glm::dvec3(0.0)) { return glm::vec3(0.0F, 0.0F, 1.0F); }
        if (group(at) <= Smoothing::flat) { return glm::vec3(own); }
        const glm::dvec3 sum = sums_.empty() ? sum_of_reached(at) : sums_[group(at)];
        const double length = glm::length(sum);
        return glm::vec3(length > same_direction ? sum / length : own);
    }

private:
    struct Edge {
        std::uint32_t other_end = 0;
        bool leaves = false; ///< The face runs from this vertex to the other end, not towards it.
        std::uint32_t corner = 0;

        auto operator<=>(const Edge&) const = default;
    };

    const Corner& corner(std::uint32_t i) const { return all_[corners_[i]]; }

    const SmoothFace& face(std::uint32_t i) const { return faces_[corner(i).face]; }

    std::uint32_t group(std::uint32_t i) const { return face(i).smoothing.group; }

    glm::dvec3 weighted_normal(std::uint32_t i) const { return corner(i).angle_rad * face(i).normal; }

    /// Splits the faces at one edge by their direction; `same_edge` is sorted.
    void add_sides(std::span<const Edge> same_edge) {
        const auto coming = static_cast<std::size_t>(std::ranges::count(same_edge, false, &Edge::leaves));
        const auto side = static_cast<std::uint32_t>(sides_.size());
        sides_.push_back(same_edge.first(coming));
        sides_.push_back(same_edge.subspan(coming));
        for (const Edge& edge : same_edge) {
            across_[edge.corner].at(edge.leaves ? 1 : 0) = edge.leaves ? side : side + 1;
        }
    }

    /// Over the corners that share a smooth surface with `start`; in the order of corners, so that corners with the
    /// same faces get the same bits. Whether a corner counts depends on it and `start` alone, so that each side of an
    /// edge is looked at once.
    glm::dvec3 sum_of_reached(std::uint32_t start) {
        reached_.assign(corners_.size(), 0);
        reached_[start] = 1;
        is_done_.assign(sides_.size(), 0);
        waiting_.assign(1, start);
        while (!waiting_.empty()) {
            const std::uint32_t from = waiting_.back();
            waiting_.pop_back();
            for (const std::uint32_t side : across_[from]) {
                if (is_done_[side] != 0) { continue; }
                is_done_[side] = 1;
                reach(start, sides_[side]);
            }
        }
        glm::dvec3 sum(0.0);
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            sum += reached_[i] != 0 ? weighted_normal(i) : glm::dvec3(0.0);
        }
        return sum;
    }

    void reach(std::uint32_t start, std::span<const Edge> side) {
        compared_ += side.size();
        for (const Edge& edge : side) {
            if (reached_[edge.corner] != 0 || !is_smooth_with(start, edge.corner)) { continue; }
            reached_[edge.corner] = 1;
            waiting_.push_back(edge.corner);
        }
    }

    bool is_smooth_with(std::uint32_t start, std::uint32_t to) const {
        const float crease_rad = std::min(face(start).smoothing.crease_rad, face(to).smoothing.crease_rad);
        return group(to) == group(start) && face(to).normal != glm::dvec3(0.0) &&
               glm::dot(face(to).normal, face(start).normal) >=
                   std::cos(static_cast<double>(crease_rad)) - same_direction;
    }

    std::span<const SmoothFace> faces_;
    std::span<const Corner> all_;
    std::span<const std::uint32_t> corners_;
    std::map<std::uint32_t, glm::dvec3> sums_; ///< by groups, where there are too many corners to compare
    std::vector<Edge> edges_;
    std::vector<std::span<const Edge>> sides_;         ///< of each edge: the faces of one direction
    std::vector<std::array<std::uint32_t, 2>> across_; ///< for each corner the sides opposite to it, at its two edges
    std::vector<std::uint8_t> reached_;
    std::vector<std::uint8_t> is_done_; ///< for each side
    std::vector<std::uint32_t> waiting_;
    std::size_t compared_ = 0;
};

std::vector<Corner> corners_of(std::span<const SmoothFace> faces, std::span<const glm::dvec3> vertices_m) {
    std::vector<Corner> corners;
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
        const std::span<const std::uint32_t> vertices = faces[face].corners;
        const std::size_t count = vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t here = vertices[i];
            const std::uint32_t before = vertices[(i + count - 1) % count];
            const std::uint32_t after = vertices[(i + 1) % count];
            corners.push_back({face, here, before, after,
                angle_rad(vertices_m[before] - vertices_m[here], vertices_m[after] - vertices_m[here])});
        }
    }
    return corners;
}

} // namespace

std::vector<glm::vec3> smooth_normals(
    std::span<const SmoothFace> faces, std::span<const glm::dvec3> vertices_m, std::size_t* compared) {
    const std::vector<Corner> corners = corners_of(faces, vertices_m);
    std::vector<std::uint32_t> sorted(corners.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::stable_sort(sorted, {}, [&](std::uint32_t c) { return corners[c].vertex; });
    std::vector<glm::vec3> normals(corners.size());
    Around around(faces, corners);
    for (std::size_t first = 0; first < sorted.size();) {
        std::size_t end = first;
        while (end < sorted.size() && corners[sorted[end]].vertex == corners[sorted[first]].vertex) { ++end; }
        const auto here = std::span<const std::uint32_t>(sorted).subspan(first, end - first);
        around.look_at(here);
        for (std::uint32_t i = 0; i < here.size(); ++i) { normals[here[i]] = around.normal_at(i); }
        first = end;
    }
    if (compared != nullptr) { *compared = around.compared(); }
    return normals;
}

namespace {

/// Numbers for the normals of a mesh's corners: those of one vertex that are equal are one.
class SharedNormals {
public:
    explicit SharedNormals(TriangleMesh& mesh) : mesh_(mesh), newest_(mesh.vertices_m.size(), invalid_index) {}

    std::uint32_t number_of(const glm::vec3& normal, std::uint32_t vertex) {
        constexpr int most_compared = 64;
        std::uint32_t at = newest_[vertex];
        for (int compared = 0; at != invalid_index && compared < most_compared; at = older_[at - first_], ++compared) {
            if (mesh_.normals[at] == normal) { return at; }
        }
        mesh_.normals.push_back(normal);
        older_.push_back(newest_[vertex]);
        return newest_[vertex] = static_cast<std::uint32_t>(mesh_.normals.size() - 1);
    }

private:
    TriangleMesh& mesh_;
    std::uint32_t first_ = static_cast<std::uint32_t>(mesh_.normals.size());
    std::vector<std::uint32_t> newest_; ///< for each vertex
    std::vector<std::uint32_t> older_;  ///< for each new normal another one of its vertex
};

} // namespace

void add_smooth_normals(TriangleMesh& mesh, std::span<const Smoothing> smoothings) {
    assert(smoothings.size() == mesh.triangles.size() && mesh.corner_normals.size() == mesh.triangles.size());
    std::vector<SmoothFace> faces;
    faces.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        faces.push_back({triangle, normal_of(mesh, triangle), smoothings[t]});
        Triangle& corners = mesh.corner_normals[t];
        if (smoothings[t].group != Smoothing::flat || std::ranges::find(corners, invalid_index) == corners.end()) {
            continue;
        }
        mesh.normals.emplace_back(normal_of(mesh, triangle, glm::dvec3(0.0, 0.0, 1.0)));
        std::ranges::replace(corners, invalid_index, static_cast<std::uint32_t>(mesh.normals.size() - 1));
    }
    const std::vector<glm::vec3> normals = smooth_normals(faces, mesh.vertices_m);
    SharedNormals shared(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (smoothings[t].group == Smoothing::unknown) { continue; }
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& normal = mesh.corner_normals[t].at(k);
            if (normal == invalid_index) { normal = shared.number_of(normals[3 * t + k], mesh.triangles[t].at(k)); }
        }
    }
}

} // namespace octant::models
