#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::nature {

/// An icosahedron with a corner at each pole whose edges are halved twice, the middles moved out to the unit sphere.
/// Level 0 has the icosahedron's 20 faces, level 1 has 80, level 2 has 320. The vertices of a level are the first ones
/// of the next.
class Icosphere {
public:
    static constexpr std::size_t levels = 3;
    static constexpr std::array<std::size_t, levels> vertex_counts{12, 42, 162};
    static constexpr std::size_t max_faces = 320;

    struct Face {
        std::array<std::uint8_t, 3> corners{}; ///< counter-clockwise seen from outside
        glm::vec3 plane{0.0F};                 ///< of its corners: dot(plane, corner) = 1
    };

    Icosphere();

    std::array<glm::vec3, vertex_counts[levels - 1]> directions{};
    /// The ends of the edge whose middle the vertex is; both 0 for the icosahedron's.
    std::array<std::array<std::uint8_t, 2>, vertex_counts[levels - 1]> parents{};
    std::array<std::vector<Face>, levels> faces;

private:
    void add_level(std::size_t level);
};

/// The one of which all crowns are made.
const Icosphere& icosphere();

enum class PlantKind : std::uint8_t { Broadleaf, Conifer, Shrub };

/// The surface of a plant's leaves: on each ray from a point on the trunk's axis one place. All its triangles are
/// those of the icosphere, and each lies in the cone over its face.
///
/// Painting order: seen from that point in the space in which the icosphere is a sphere, the cones are the faces of a
/// convex polyhedron with the planes dot(plane, x) = 1. On a line of sight from eye e the cone of a face i is left
/// for that of a face j only if dot(plane_j, e) < dot(plane_i, e). So the order by dot(plane, e), the greatest nearest,
/// holds for every eye, whatever the distances of the places are.
struct Crown {
    struct Vertex {
        glm::vec3 at{0.0F};     ///< east and north in radii of the plant, up in heights, from its foot
        glm::vec3 normal{0.0F}; ///< unit
        float openness = 1.0F;  ///< the share of light that leaves around it let through
        /// Where the vertex's ray meets the straight line between its parents, as a share of the way from the first:
        /// there it changes nothing of the surface of the level before.
        float on_chord = 0.5F;
    };

    std::array<Vertex, Icosphere::vertex_counts[Icosphere::levels - 1]> vertices{};
    float centre = 0.5F;      ///< the height of that point
    float half_height = 0.5F; ///< of the icosphere when its radius is 1
    float lowest = 0.0F;      ///< No vertex lies lower.
};

/// One of the crowns of a kind of plant; all of them differ. Loading work.
Crown make_crown(PlantKind kind, std::uint32_t variant);

} // namespace octant::visuals::nature
