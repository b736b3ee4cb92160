#pragma once

#include "models/simplify/foot_of_perpendicular.h"
#include "models/simplify/point6.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// The three candidates of the paper for the vertex that a contraction makes: v1, v2 and (v1 + v2)
/// / 2.
enum class Place { First, Second, Middle };

/// A mesh whose vertices are contracted two by two, whatever becomes of the surface, as in the
/// paper: triangles may come to lie on each other, and edges may get more than two triangles.
class PaperMesh {
public:
    /// `colour_weight` is what a colour difference of 1 counts as, in metres.
    PaperMesh(const TriangleMesh& original, double colour_weight);

    const Point6& point(std::uint32_t vertex) const { return points_[vertex]; }

    const Triangle& face(std::uint32_t face) const { return faces_[face]; }

    Corners corners(std::uint32_t face) const;

    /// The faces at a vertex in ascending order; none for a vertex that was contracted away.
    std::span<const std::uint32_t> faces_at(std::uint32_t vertex) const {
        return vertex_faces_[vertex];
    }

    /// Where the contraction of two vertices may lead.
    Point6 candidate(std::uint32_t first, std::uint32_t second, Place place) const;

    std::size_t vertex_count() const { return points_.size(); }

    /// The number of faces that have not collapsed.
    std::size_t face_count() const { return face_count_; }

    /// Fills `faces` with the faces at either vertex, each once, in ascending order.
    void united_faces(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& faces) const;

    /// Fills `others` with the vertices that share a face with this one, each once, in ascending
    /// order.
    void neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& others) const;

    /// Contracts an edge: moves `kept` to candidate(kept, gone, place) and puts it in the place of
    /// `gone` in every face. Faces that had both collapse.
    void contract(std::uint32_t kept, std::uint32_t gone, Place place);

    /// The present mesh without vertices that no face uses, with the original's materials.
    TriangleMesh left_over(const TriangleMesh& original) const;

private:
    /// Takes a face out of a vertex's list.
    void drop(std::uint32_t face, std::uint32_t vertex);

    std::vector<Point6> points_;
    std::vector<glm::vec3> colours_; ///< Without the weight; empty = no colours.
    std::vector<Triangle> faces_;
    std::vector<bool> collapsed_; ///< One flag for each face.
    /// For each vertex its faces, ascending.
    std::vector<std::vector<std::uint32_t>> vertex_faces_;
    std::size_t face_count_ = 0;
};

} // namespace octant::models::simplify
