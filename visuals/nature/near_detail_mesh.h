#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/near_detail_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::nature {

class Scenery;

/// Own colour of a place of the world with its alpha, packed; where it lies from the eye.
using ColourAtPoint =
    std::function<std::uint32_t(const glm::dvec2& place_m, const glm::vec3& from_eye_m)>;

/// Adds detail below the distance of samples to ground near the eye: edges that look long are
/// halved, and the halves' middles are moved up or down and take the colours of their places, in
/// other shades where it is steep. All follow from the middle's place in the world, the steepness
/// of its edge and how long that looks, growing from nothing. What lies at samples stays where it
/// is. Triangles that share an edge halve it alike, so that there are no cracks, and the parts of a
/// triangle come from near to far. Under what stands on the ground, the ground stays even, and each
/// thing goes with the part in which it stands.
class NearDetailMesh {
public:
    /// Begins a frame: vertices of the mesh, with the eye subtracted, to which more are added.
    /// `scenery`: what stands on the ground; null = nothing. `colour`: of middles; null = between
    /// those of the ends.
    void begin(
        const NearDetailView& view,
        std::span<const models::ColourVertex> vertices,
        Scenery* scenery,
        const ColourAtPoint* colour);

    /// Appends a triangle in its parts to `indices`, nearest first; each part after what stands on
    /// it where `has_scenery` says that anything does.
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
    void
    add_subdivided(const TriangleIndices& triangle, int depth, bool has_scenery, std::vector<std::uint32_t>& indices);

    NearDetailView view_;
    Scenery* scenery_ = nullptr;
    const ColourAtPoint* colour_ = nullptr;
    std::uint32_t frame_ = 0;
    std::size_t added_ = 0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<EdgeMidpoint> midpoints_; ///< a table by edge
};

} // namespace octant::visuals::nature
