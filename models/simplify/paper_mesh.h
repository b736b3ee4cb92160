#pragma once

#include "models/simplify/foot_of_perpendicular.h"
#include "models/simplify/point6.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Of the vertex that a contraction makes.
enum class Place { First, Second, Middle };

/// Triangles whose vertices are contracted two by two, whatever becomes of the surface: triangles
/// may come to lie on each other, edges may get more than two.
class PaperMesh {
public:
    /// Colours count by `colour_weight`, in metres for a colour difference of 1.
    PaperMesh(const TriangleMesh& original, double colour_weight);

    const Point6& point(std::uint32_t vertex) const { return points_[vertex]; }

    const Triangle& face(std::uint32_t face) const { return faces_[face]; }

    Corners corners(std::uint32_t face) const;

    /// Faces at a vertex, in the order of their numbers; none for one that was contracted away.
    std::span<const std::uint32_t> faces_at(std::uint32_t vertex) const {
        return vertex_faces_[vertex];
    }

    /// Where the contraction of two vertices may lead.
    Point6 candidate(std::uint32_t first, std::uint32_t second, Place place) const;

    std::size_t vertex_count() const { return points_.size(); }

    /// Faces that were not collapsed.
    std::size_t face_count() const { return face_count_; }

    /// Faces at either vertex, each once, in the order of their numbers.
    void united_faces(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& faces) const;

    /// Vertices that share a face with this one, each once, in the order of their numbers.
    void neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& others) const;

    /// Moves `kept` to candidate(kept, gone, place) and puts it in the place of `gone` in every
    /// face; faces that had both collapse.
    void contract(std::uint32_t kept, std::uint32_t gone, Place place);

    /// What is left of the original, without vertices that no face uses.
    TriangleMesh left_over(const TriangleMesh& original) const;

private:
    void drop(std::uint32_t face, std::uint32_t vertex);

    std::vector<Point6> points_;
    std::vector<glm::vec3> colours_; ///< without weight; empty = no colours
    std::vector<Triangle> faces_;
    std::vector<bool> collapsed_;                          ///< by face
    std::vector<std::vector<std::uint32_t>> vertex_faces_; ///< sorted
    std::size_t face_count_ = 0;
};

} // namespace octant::models::simplify
