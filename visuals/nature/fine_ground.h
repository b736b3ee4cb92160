#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::nature {

/// From where ground is looked at, and how finely it is sampled.
struct FineView {
    glm::dvec3 eye_m{0.0}; ///< world axes
    double spacing_m = 30.0;
    terrain::PaintOrder order = terrain::PaintOrder::BackToFront;
    /// Unit normals of planes through the eye, world axes, that point inside: what lies outside one
    /// is not halved. Zero = no plane.
    std::array<glm::vec3, 4> frustum_normals{
        glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)};
    std::size_t most_splits = 2000; ///< triangles that may be added to the ground in a frame
    std::size_t most_things = 5000; ///< triangles of what stands on it
};

/// Adds detail below the distance of samples to ground near the eye: edges that look long are
/// halved, and the halves' middles are moved up or down and given other shades. Both follow from
/// the middle's place in the world, the steepness of its edge and how long that looks, growing from
/// nothing. What lies at samples stays where it is. Triangles that share an edge halve it alike, so
/// that there are no cracks, and the parts of a triangle come in painting order.
class FineGround {
public:
    /// Begins a frame: vertices of the mesh, with the eye subtracted, to which more are added.
    void begin(const FineView& view, std::span<const models::ColourVertex> vertices);

    /// Appends a triangle, in parts if it is near, to `indices`.
    void add(const std::uint32_t* corners, std::vector<std::uint32_t>& indices);

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
    void add_parts(const Corners& triangle, int depth, std::vector<std::uint32_t>& indices);

    FineView view_;
    std::uint32_t frame_ = 0;
    std::size_t added_ = 0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<Middle> middles_; ///< a table by edge
};

} // namespace octant::visuals::nature
