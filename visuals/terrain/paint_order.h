#pragma once

#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::visuals::terrain {

/// The triangles of a fan and of all fans below it, which follow one another in a mesh.
struct TriangleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Walks through a fan's run in drawing order: calls `own(triangle)` for each of its own triangles, and `below(child)`
/// for each of `children` (0 = none) with a run that is not empty. `run_of(child)` returns that run.
template <typename RunOf, typename Own, typename Below>
void for_each_in_range(const TriangleRange& run, const std::array<std::uint32_t, 4>& children, const RunOf& run_of,
    const Own& own, const Below& below) {
    std::array<std::uint32_t, 4> drawn{}; // In drawing order.
    std::size_t count = 0;
    for (const std::uint32_t child : children) {
        if (child == 0 || run_of(child).first == run_of(child).end) { continue; }
        drawn[count] = child;
        for (std::size_t k = count++; k > 0; --k) {
            if (run_of(drawn[k - 1]).first > run_of(drawn[k]).first) { std::swap(drawn[k - 1], drawn[k]); }
        }
    }
    std::uint32_t triangle = run.first;
    const auto own_up_to = [&](std::uint32_t end) {
        for (; triangle < end; ++triangle) { own(triangle); }
    };
    for (std::size_t k = 0; k < count; ++k) {
        const TriangleRange taken = run_of(drawn[k]);
        own_up_to(taken.first);
        below(drawn[k]);
        triangle = taken.end;
    }
    own_up_to(run.end);
}

// The parts that a node's fan may consist of, by number:
//   0 to 7   the triangle from the centre to the samples k and k + 1 of fan_ring,
//   8 to 11  the triangle from the centre to a whole edge of fan_edges,
//   12 to 15 the quadrant k - 12, which is left to a child.
// Each part is a wedge around the centre, and parts that are present together do not overlap.
inline constexpr unsigned first_edge_part = 8;
inline constexpr unsigned first_child_part = 12;
inline constexpr std::size_t fan_parts = 16;

/// The samples of fan_ring between which a part lies, counter-clockwise.
struct PartBounds {
    std::uint8_t from;
    std::uint8_t to;
};

inline constexpr std::array<PartBounds, fan_parts> part_sides = {{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6},
    {6, 7}, {7, 0}, {0, 2}, {2, 4}, {4, 6}, {6, 0}, {7, 1}, {1, 3}, {5, 7}, {3, 5}}};

/// An order of all parts. Sets of places in the order are bit masks.
struct PartOrder {
    std::array<std::uint8_t, fan_parts> part{}; ///< The part at each place.
    /// For each set of edges with mid-points the places of the triangles.
    std::array<std::uint16_t, 16> with_middles{};
    /// For each set of quadrants all places but those of half-edge triangles in these quadrants.
    std::array<std::uint16_t, 16> uncovered{};
    /// For each set of quadrants drawn by children their places.
    std::array<std::uint16_t, 16> children{};

    /// The places of a fan's triangles; `covered` are the quadrants without half-edge triangles.
    unsigned triangles(unsigned middles, unsigned covered) const {
        return unsigned{with_middles[middles]} & uncovered[covered];
    }
};

/// The wedge between the samples k and k + 1 of fan_ring that contains a point, seen from the centre of a fan that is
/// not cut; either one for a point on the line between two wedges.
inline unsigned wedge_containing(double east, double north) {
    constexpr std::array<std::uint8_t, 8> wedges = {0, 1, 5, 4, 7, 2, 6, 3};
    const unsigned which =
        (east >= 0.0 ? 1U : 0U) | (north >= 0.0 ? 2U : 0U) | (std::abs(east) >= std::abs(north) ? 4U : 0U);
    return wedges[which];
}

/// The painting orders of fans that are not cut, by the wedge that contains the eye.
const std::array<PartOrder, 8>& painting_orders(PaintOrder order);

/// The set of a fan's parts as a bit mask by part number; the arguments are those of PartOrder.
unsigned parts_of(unsigned middles, unsigned covered, unsigned children);

/// Some parts in painting order.
struct PartList {
    std::array<std::uint8_t, fan_parts> part{};
    unsigned count = 0;
};

/// Those of a set of parts that have an area although the field's border cuts the fan, in painting order. `eye` is in
/// samples east and north of the fan's centre.
PartList parts_of_cut_fan(const FanSamples& samples, unsigned parts, const glm::dvec2& eye, PaintOrder order);

} // namespace octant::visuals::terrain
