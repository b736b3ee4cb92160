#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
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

/// The one of which all broad-leaved crowns and bushes are made.
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
        float radius = 1.0F;    ///< on its ray, where the icosphere has 1
        /// Where the vertex's ray meets the straight line between its parents, as a share of the way from the first:
        /// there it changes nothing of the surface of the level before.
        float on_chord = 0.5F;
    };

    std::array<Vertex, Icosphere::vertex_counts[Icosphere::levels - 1]> vertices{};
    float centre = 0.5F;      ///< the height of that point
    float half_height = 0.5F; ///< of the icosphere when its radius is 1
    float lowest = 0.0F;      ///< No vertex lies lower.

    /// The distance of a place on a ray, where the icosphere has 1, or less where the plant's circle and height end.
    float within_room(const glm::vec3& way, float radius) const;
};

/// One of the crowns of broad-leaved trees or shrubs; all of them differ. Loading work.
Crown make_crown(PlantKind kind, std::uint32_t variant);

/// A corner of an edge of a tier.
struct TierVertex {
    float radius = 0.0F;   ///< in radii of the plant
    float openness = 1.0F; ///< the share of light that leaves around it let through
};

using TierRing = std::array<TierVertex, 12>;

/// The crown of a conifer: tiers of boughs, one on another, each a cone cut off below the next. Levels 0 and 1 have
/// three tiers, at level 0 without gaps between boughs; at level 2 each of them is parted into two.
///
/// Painting order: level planes part the tiers. Planes through the axis cut a tier into parts for each of its sides,
/// and the same holds for them as for the cones of a Crown: the order by dot(middle of the side, eye), the greatest
/// nearest.
class TieredCrown {
public:
    static constexpr std::size_t sides = std::tuple_size_v<TierRing>;
    static constexpr std::size_t tiers = 6;
    static constexpr float lowest = 0.13F;
    /// Of the tiers' lower edges, over the plant's.
    static constexpr std::array<float, tiers> heights{lowest, 0.30F, 0.45F, 0.58F, 0.70F, 0.84F};
    static constexpr float inner_openness = 0.35F; ///< at the trunk, over that at the ends of boughs

    /// Loading work. All variants differ.
    explicit TieredCrown(std::uint32_t variant);

    /// From one tier to the next.
    static std::size_t tiers_each(std::size_t level) { return level + 1 < Icosphere::levels ? 2 : 1; }

    /// Whether a bough of a tier ends at a side: boughs stand above gaps.
    static bool is_bough_end(std::size_t tier, std::size_t side) { return (tier + tier / 2 + side) % 2 == 0; }

    /// Finds the edges of a tier, of which the upper one has shrunk to a point at the top. `come`: how far the vertices
    /// of the level have come, 0..1. Levels 0 and 1 have even tiers only.
    void find_tier(std::size_t tier, std::size_t level, float come, TierRing& low, TierRing& high) const;

private:
    std::array<TierRing, tiers> lower_{};
    std::array<float, tiers> upper_share_{};  ///< the upper edge, over the lower one
    std::array<float, tiers> coarse_share_{}; ///< the same of an even tier and the next one taken as one
};

} // namespace octant::visuals::nature
