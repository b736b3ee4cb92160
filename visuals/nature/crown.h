#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::nature {

enum class PlantKind : std::uint8_t { Broadleaf, Conifer, Shrub };

/// The leaves of a plant on a ray from the crown's centre.
struct CrownPoint {
    float radius = 1.0F;    ///< the distance from the centre, in the space in which the crown is about a unit sphere
    float openness = 1.0F;  ///< the share of light that leaves around it let through
    glm::vec3 normal{0.0F}; ///< of any length
};

/// The surface of a plant's leaves, clumps of them or boughs around a cone: on each ray from a point on the trunk's
/// axis one place. Its space is scaled so that the crown is about as high as wide.
class Crown {
public:
    /// Loading work. All variants of a kind differ.
    Crown(PlantKind kind, std::uint32_t variant);

    /// On the ray of a unit vector, within the plant's circle and height.
    CrownPoint at(const glm::vec3& way) const;

    /// The place in the plant of a point of the crown's space: east and north in radii of the plant, up in heights,
    /// from its foot.
    glm::vec3 in_plant(const glm::vec3& from_centre) const {
        return {from_centre.x, from_centre.y, centre_ + half_height_ * from_centre.z};
    }

    /// The inverse of in_plant().
    glm::vec3 from_centre(const glm::vec3& in_plant) const {
        return {in_plant.x, in_plant.y, (in_plant.z - centre_) / half_height_};
    }

    /// The lowest height of the surface, in heights of the plant. The surface has it straight below the centre.
    float lowest() const { return lowest_; }

    /// True for conifers. The outline of a cone is widest on the spokes of CrownSide, that of others between them.
    bool is_cone() const { return is_cone_; }

    /// How much nearer to the middle the outline is between two ends, as a share. `number`: of a spoke.
    float notch_depth(std::size_t number) const { return notch_depths_[number]; }

    /// Of the points at the map's nodes.
    template <class Visit>
    void for_each_direction(const Visit& visit) const {
        for (std::size_t row = 0; row < nodes; ++row) {
            for (std::size_t column = 0; column < nodes; ++column) {
                visit(direction_of(column, row), points_[row * nodes + column]);
            }
        }
    }

private:
    /// Along a side of the map of directions: an octahedron unfolded to a square, with the upper half in its middle
    /// (Meyer and others, "On Floating-Point Normal Vectors", 2010). Nodes on its border are there twice.
    static constexpr std::size_t nodes = 17;

    static glm::vec3 direction_of(std::size_t column, std::size_t row);
    float within_room(const glm::vec3& way, float radius) const;

    std::array<CrownPoint, nodes * nodes> points_;
    float centre_ = 0.5F;      ///< the centre's height
    float half_height_ = 0.5F; ///< of what is one high in the crown's space
    float lowest_ = 0.0F;
    bool is_cone_;
    std::array<float, 12> notch_depths_{};
};

/// What an eye sees of a crown: a surface of corners on its outline, a ring of corners before them and one in its
/// middle. All lie on spokes from the middle, and on each of these the eye sees the outline farther out than the ring.
/// So no part of the surface hides another one, whatever the clumps are like, and its triangles have no order.
struct CrownSide {
    struct Corner {
        glm::vec3 from_centre{0.0F}; ///< in the crown's space
        glm::vec3 normal{0.0F};      ///< of any length
        float openness = 1.0F;
        /// From the line between the eye and the centre, over the distance from the eye along that line.
        float off_axis = 0.0F;
    };

    static constexpr std::size_t spokes = 12;
    static constexpr std::size_t max_corners = 4 * spokes;

    /// `eye`: in the crown's space. `fineness`, 0 to 3: at 0 the outline has 12 corners and there is no ring; from 0
    /// to 1 the ring moves to its place; at 2 the outline has 24 corners and at 3 it has 48.
    CrownSide(const Crown& crown, const glm::vec3& eye, float fineness);

    Corner middle;
    bool has_ring = false;
    std::array<Corner, spokes> ring;
    /// Counter-clockwise as the eye sees it from the right: every `step`th is there, and those of a multiple of 4 lie
    /// on the spokes of the ring.
    std::array<Corner, max_corners> outline;
    std::size_t step = 4;
};

} // namespace octant::visuals::nature
