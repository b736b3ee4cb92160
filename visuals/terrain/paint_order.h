#pragma once

#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

// Everything that a node may consist of, by number:
//   0 to 7   triangle from the centre to the samples k and k + 1 of fan_ring,
//   8 to 11  triangle from the centre to a whole edge of fan_edges,
//   12 to 15 the quadrant k - 12, left to a child.
// Each fills a wedge around the centre, and no two that are there together overlap.
inline constexpr unsigned first_edge_part = 8;
inline constexpr unsigned first_child_part = 12;
inline constexpr std::size_t fan_parts = 16;

/// The samples of fan_ring between which a part lies, counter-clockwise.
struct PartSides {
    std::uint8_t from;
    std::uint8_t to;
};

inline constexpr std::array<PartSides, fan_parts> part_sides = {
    {{0, 1},
     {1, 2},
     {2, 3},
     {3, 4},
     {4, 5},
     {5, 6},
     {6, 7},
     {7, 0},
     {0, 2},
     {2, 4},
     {4, 6},
     {6, 0},
     {7, 1},
     {1, 3},
     {5, 7},
     {3, 5}}};

/// An order of all parts, and which places in it are taken.
struct PartOrder {
    std::array<std::uint8_t, fan_parts> part{}; ///< by place
    // Sets of places as bits:
    std::array<std::uint16_t, 16>
        with_middles{}; ///< triangles, by the set of edges with mid-points
    std::array<std::uint16_t, 16>
        uncovered{};                          ///< all but half-edge triangles in a set of quadrants
    std::array<std::uint16_t, 16> children{}; ///< by the set of quadrants drawn by children

    /// The places of the triangles of a fan; `covered`: quadrants without half-edge triangles.
    unsigned triangles(unsigned middles, unsigned covered) const {
        return unsigned{with_middles[middles]} & uncovered[covered];
    }
};

/// The wedge between the samples k and k + 1 of fan_ring in which a point lies, seen from the
/// centre of a fan that is not cut. Either one on a line between two.
inline unsigned wedge_towards(double east, double north) {
    constexpr std::array<std::uint8_t, 8> wedges = {0, 1, 5, 4, 7, 2, 6, 3};
    const unsigned which = (east >= 0.0 ? 1U : 0U) | (north >= 0.0 ? 2U : 0U) |
                           (std::abs(east) >= std::abs(north) ? 4U : 0U);
    return wedges[which];
}

/// Parts in painting order, by the wedge with the eye, for fans that are not cut.
const std::array<PartOrder, 8>& painting_orders(PaintOrder order);

/// The set of parts of a fan, as bits; arguments as those of PartOrder.
unsigned parts_of(unsigned middles, unsigned covered, unsigned children);

/// Some parts in a row.
struct PartRow {
    std::array<std::uint8_t, fan_parts> part{};
    unsigned count = 0;
};

/// Those of a set of parts of a fan that have an area though the field's edge has cut it, in
/// painting order. `eye`: in samples east and north of the fan's centre.
PartRow parts_of_cut_fan(
    const FanSamples& samples, unsigned parts, const glm::dvec2& eye, PaintOrder order);

} // namespace octant::visuals::terrain
