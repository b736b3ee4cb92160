#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/fine_view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::nature {

class Scenery;

/// Adds detail below the distance of samples to ground near the eye: edges that look long are
/// halved, and the halves' middles are moved up or down and given other shades. Both follow from
/// the middle's place in the world, the steepness of its edge and how long that looks, growing from
/// nothing. What lies at samples stays where it is. Triangles that share an edge halve it alike, so
/// that there are no cracks, and the parts of a triangle come from near to far. Under what stands
/// on the ground, the ground stays even, and each thing goes with the part in which it stands.
class FineGround {
public:
    /// Begins a frame: vertices of the mesh, with the eye subtracted, to which more are added.
    /// `scenery`: what stands on the ground; null = nothing.
    void
    begin(const FineView& view, std::span<const models::ColourVertex> vertices, Scenery* scenery);

    /// Appends a triangle, in parts if it is near, to `indices`; each part after what stands on it
    /// where `bears` says that anything does.
    void add(const std::uint32_t* corners, bool bears, std::vector<std::uint32_t>& indices);

    /// Those of the mesh, then new ones.
    std::vector<models::ColourVertex>& vertices() { return vertices_; }

    /// The most by which a middle is moved, over the sample distance.
    static constexpr double most_moved = 0.06;

private:
    struct Middle {
        std::uint64_t edge = 0; ///< both ends; 0 = unused
        std::uint32_t vertex = 0;
        std::uint32_t frame = 0;
    };

    struct Corners {
        std::uint32_t a;
        std::uint32_t b;
        std::uint32_t c;
    };

    bool looks_long(std::uint32_t a, std::uint32_t b) const;
    std::uint32_t middle_of(std::uint32_t a, std::uint32_t b);
    std::uint32_t make_middle(std::uint32_t a, std::uint32_t b);
    bool is_outside(const Corners& triangle) const;
    bool is_quarter_of_cell(const Corners& triangle) const;
    void add_things(const Corners& triangle, std::vector<std::uint32_t>& indices);
    void
    add_parts(const Corners& triangle, int depth, bool bears, std::vector<std::uint32_t>& indices);

    FineView view_;
    Scenery* scenery_ = nullptr;
    std::uint32_t frame_ = 0;
    std::size_t added_ = 0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<Middle> middles_; ///< a table by edge
};

} // namespace octant::visuals::nature
