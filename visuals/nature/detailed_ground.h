#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/scenery.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::nature {

class Scenery;

/// Own colour of a place of the world with its alpha, packed; where it lies from the eye.
using ColourAtPoint = std::function<std::uint32_t(const glm::dvec2& place_m, const glm::vec3& from_eye_m)>;

/// Adds detail below the distance of samples to ground near the eye: edges that look long are halved, and the halves'
/// middles are moved up or down and take the colours of their places, in other shades where it is steep. All follow
/// from the middle's place in the world, the steepness of its edge and how long that looks, growing from nothing. What
/// lies at samples stays where it is. Triangles that share an edge halve it alike, so that there are no cracks, and the
/// parts of a triangle come from near to far. Under what stands on the ground, the ground stays even, and each thing
/// goes with the part in which it stands.
class NearDetailMesh {
public:
    /// Begins a frame: vertices of the mesh, with the eye subtracted, to which more are added. `scenery`: what stands
    /// on the ground; null = nothing. `colour`: of middles; null = between those of the ends.
    void begin(const NearDetailView& view, std::span<const models::ColourVertex> vertices, Scenery* scenery,
        const ColourAtPoint* colour);

    /// Appends a triangle in its parts to `indices`, nearest first; each part after what stands on it where
    /// `has_scenery` says that anything does.
    void add(const std::uint32_t* corners, bool has_scenery, std::vector<std::uint32_t>& indices);

    /// Those of the mesh, then new ones.
    std::vector<models::ColourVertex>& vertices() { return vertices_; }

private:
    struct EdgeMidpoint {
        std::uint64_t edge = 0; ///< both ends; 0 = unused
        std::uint32_t vertex = 0;
        std::uint32_t frame = 0;
    };

    struct TriangleIndices {
        std::uint32_t a;
        std::uint32_t b;
        std::uint32_t c;
    };

    bool exceeds_min_edge(std::uint32_t a, std::uint32_t b) const;
    std::uint32_t midpoint_of(std::uint32_t a, std::uint32_t b);
    std::uint32_t add_midpoint(std::uint32_t a, std::uint32_t b);
    float vertical_offset_m(const glm::vec3& from_m, const glm::vec3& to_m, const glm::dvec2& place_m) const;
    bool is_outside(const TriangleIndices& triangle) const;
    bool is_quarter_cell(const TriangleIndices& triangle) const;
    void add_scenery(const TriangleIndices& triangle, std::vector<std::uint32_t>& indices);
    void add_subdivided(
        const TriangleIndices& triangle, int depth, bool has_scenery, std::vector<std::uint32_t>& indices);

    NearDetailView view_;
    Scenery* scenery_ = nullptr;
    const ColourAtPoint* colour_ = nullptr;
    std::uint32_t frame_ = 0;
    std::size_t added_ = 0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<EdgeMidpoint> midpoints_; ///< a table by edge
};

/// Counts how many halvings the near triangles of a mesh take, by how long edges must look to be halved, so that a
/// number of them can be held without cutting any off.
class NearDetailHistogram {
public:
    /// Returns how long edges must look, no less than `view.min_edge_rad`, for a little less than `view.max_splits`
    /// halvings. It changes steadily with the view.
    float min_edge_rad_for_budget(const terrain::GroundMesh& mesh, const NearDetailView& view);

    /// Whether a triangle of the last mesh has edges that may look long: most are too far off.
    bool is_near(std::size_t triangle) const { return is_near_[triangle] != 0; }

private:
    using Triangle = std::array<glm::vec3, 3>;

    static constexpr std::uint32_t bins_an_octave = 32;
    static constexpr std::size_t bins = std::size_t{16} * bins_an_octave;

    void count(const Triangle& triangle, float max_look2, int depth);

    NearDetailView view_;
    float min_angular_size2_ = 0.0F;
    std::size_t counted_ = 0;
    /// Halvings by the square of how long the edge looks, over min_angular_size2_.
    std::array<std::uint32_t, bins> split_counts_{};
    std::vector<std::uint8_t> is_near_;
};

/// The mesh of a frame with what stands on it and detail below its samples.
class DetailedGround {
public:
    explicit DetailedGround(Scenery scenery) : scenery_(std::move(scenery)) {}

    Scenery& scenery() { return scenery_; }

    struct Triangles {
        std::span<const models::ColourVertex> vertices;
        std::span<const std::uint32_t> indices; ///< in the order of the mesh
        std::size_t detail_triangles = 0;       ///< triangles that halving has added
        std::size_t scenery_triangles = 0;      ///< triangles of what stands on the ground
    };

    /// The mesh comes coloured; `colour` as NearDetailMesh::begin() has it. The triangles stay valid until the next
    /// call but one.
    Triangles detailed_mesh(const terrain::GroundMesh& mesh, const NearDetailView& view,
        const NearDetailOptions& detail, const ColourAtPoint* colour = nullptr);

    /// Replaces numbers of triangles of the last mesh, ascending, by those of the triangles that were made in their
    /// places.
    void replace(std::vector<std::uint32_t>& triangles, std::size_t first) const;

private:
    NearDetailHistogram histogram_;
    NearDetailMesh mesh_builder_;
    Scenery scenery_;

    struct Frame {
        std::vector<models::ColourVertex> vertices;
        std::vector<std::uint32_t> indices;
    };

    std::array<Frame, 2> frames_;
    std::size_t frame_ = 0;
    std::vector<std::uint32_t> first_index_of_; ///< for each triangle of the mesh, and the end
    mutable std::vector<std::uint32_t> replaced_;
};

} // namespace octant::visuals::nature
