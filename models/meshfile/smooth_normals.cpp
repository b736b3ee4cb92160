#include "models/meshfile/smooth_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t most_compared = 64;

double angle_between_rad(const glm::dvec3& one, const glm::dvec3& other) {
    return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other));
}

class SmoothNormals {
public:
    SmoothNormals(TriangleMesh& mesh, std::span<const Smoothing> smoothings) : mesh_(mesh), smoothings_(smoothings) {
        face_normals_.reserve(mesh.triangles.size());
        for (const Triangle& triangle : mesh.triangles) {
            face_normals_.push_back(normal_of(mesh, triangle, glm::dvec3(0.0, 0.0, 1.0)));
        }
        count_around();
    }

    void add() {
        for (std::size_t t = 0; t < smoothings_.size(); ++t) {
            if (smoothings_[t].group == Smoothing::flat) { add_flat(t); }
        }
        for (std::size_t vertex = 0; vertex + 1 < firsts_.size(); ++vertex) {
            made_.clear();
            for (std::uint32_t at = firsts_[vertex]; at < firsts_[vertex + 1]; ++at) {
                const Corner& corner = corners_[at];
                std::uint32_t& normal = mesh_.corner_normals[corner.triangle].at(corner.k);
                if (normal != invalid_index || smoothings_[corner.triangle].group == Smoothing::unknown) { continue; }
                normal = index_of(glm::vec3(normal_at(vertex, corner)));
            }
        }
    }

private:
    struct Corner {
        std::uint32_t triangle = 0;
        std::uint32_t k = 0;
    };

    /// One normal for all corners that have none.
    void add_flat(std::size_t triangle) {
        Triangle& corners = mesh_.corner_normals[triangle];
        if (std::ranges::find(corners, invalid_index) == corners.end()) { return; }
        mesh_.normals.emplace_back(face_normals_[triangle]);
        std::ranges::replace(corners, invalid_index, static_cast<std::uint32_t>(mesh_.normals.size() - 1));
    }

    /// The corners of the triangles around each vertex, in the order of the triangles.
    void count_around() {
        firsts_.assign(mesh_.vertices_m.size() + 1, 0);
        for (const Triangle& triangle : mesh_.triangles) {
            for (const std::uint32_t vertex : triangle) { ++firsts_[vertex + 1]; }
        }
        for (std::size_t v = 1; v < firsts_.size(); ++v) { firsts_[v] += firsts_[v - 1]; }
        corners_.resize(3 * mesh_.triangles.size());
        std::vector<std::uint32_t> next(firsts_.begin(), firsts_.end() - 1);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) { corners_[next[mesh_.triangles[t].at(k)]++] = {t, k}; }
        }
    }

    glm::dvec3 normal_at(std::size_t vertex, const Corner& corner) const {
        const glm::dvec3& own = face_normals_[corner.triangle];
        const Smoothing& smoothing = smoothings_[corner.triangle];
        const bool compares = firsts_[vertex + 1] - firsts_[vertex] <= most_compared;
        glm::dvec3 sum(0.0);
        for (std::uint32_t at = firsts_[vertex]; at < firsts_[vertex + 1]; ++at) {
            const std::uint32_t other = corners_[at].triangle;
            const Smoothing& its = smoothings_[other];
            const auto crease_rad = static_cast<double>(std::min(smoothing.crease_rad, its.crease_rad));
            if (its.group == smoothing.group &&
                (!compares || other == corner.triangle || angle_between_rad(own, face_normals_[other]) <= crease_rad)) {
                sum += corner_angle(corners_[at]) * face_normals_[other];
            }
        }
        const double length = glm::length(sum);
        return length > 1e-9 ? sum / length : own;
    }

    double corner_angle(const Corner& corner) const {
        const Triangle& triangle = mesh_.triangles[corner.triangle];
        const glm::dvec3& at_m = mesh_.vertices_m[triangle.at(corner.k)];
        return angle_between_rad(mesh_.vertices_m[triangle.at((corner.k + 1) % 3)] - at_m,
            mesh_.vertices_m[triangle.at((corner.k + 2) % 3)] - at_m);
    }

    /// Corners of a vertex that have one direction share a normal.
    std::uint32_t index_of(const glm::vec3& normal) {
        const auto known =
            std::ranges::find_if(made_, [&](std::uint32_t index) { return mesh_.normals[index] == normal; });
        if (known != made_.end()) { return *known; }
        mesh_.normals.push_back(normal);
        const auto index = static_cast<std::uint32_t>(mesh_.normals.size() - 1);
        if (made_.size() < most_compared) { made_.push_back(index); }
        return index;
    }

    TriangleMesh& mesh_;
    std::span<const Smoothing> smoothings_;
    std::vector<glm::dvec3> face_normals_;
    std::vector<std::uint32_t> firsts_; ///< for each vertex the first of its corners, and the end of the last one's
    std::vector<Corner> corners_;
    std::vector<std::uint32_t> made_; ///< normals of the vertex at hand
};

} // namespace

void add_smooth_normals(TriangleMesh& mesh, std::span<const Smoothing> smoothings) {
    assert(smoothings.size() == mesh.triangles.size() && mesh.corner_normals.size() == mesh.triangles.size());
    SmoothNormals(mesh, smoothings).add();
}

} // namespace octant::models::meshfile
