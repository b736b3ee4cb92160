#pragma once

#include "visuals/terrain/budget_search.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

// Quadrants of a node are numbered 0 south-west, 1 south-east, 2 north-west, 3 north-east; in a set of them quadrant q
// is bit q.

/// An edge of a fan, between the corners of two quadrants. Corners are in half edges from the south-west corner.
struct FanEdge {
    int corner_a_east;
    int corner_a_north;
    int corner_b_east;
    int corner_b_north;
    unsigned quadrant_a;
    unsigned quadrant_b;
    int beyond_east; ///< The step to the node beyond the edge.
    int beyond_north;
};

/// The four edges of a fan counter-clockwise: south, east, north, west.
inline constexpr std::array<FanEdge, 4> fan_edges = {{
    {0, 0, 2, 0, 0, 1, 0, -1},
    {2, 0, 2, 2, 1, 3, 1, 0},
    {2, 2, 0, 2, 3, 2, 0, 1},
    {0, 2, 0, 0, 2, 0, -1, 0},
}};

/// A sample on the outline of a fan, in half edges from its south-west corner.
struct RingSample {
    int east;
    int north;
};

/// The outline counter-clockwise from the south-west corner: corners at even places, the mid-points of fan_edges at odd
/// ones.
inline constexpr std::array<RingSample, 8> fan_ring = {
    {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// The index of a fan's centre, after those of fan_ring.
inline constexpr std::size_t centre_of_ring = 8;

/// For each child its corners, in the order of fan_ring, as places of its parent's ring and centre.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> child_corners = {
    {{0, 1, 8, 7}, {1, 2, 3, 8}, {7, 8, 5, 6}, {8, 3, 4, 5}}};

/// For each child which of its fan_edges lie inside its parent.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> inner_edges = {
    {{0, 1, 1, 0}, {0, 0, 1, 1}, {1, 1, 0, 0}, {1, 0, 0, 1}}};

/// A sample of the field.
struct GridSample {
    int column;
    int row;
};

/// The nine samples that the triangles of a node's fan may use. Samples beyond the field are moved onto its last column
/// and row, except by padded().
class FanSamples {
public:
    /// `ground` is anything that has columns() and rows() in samples; `edge` is the node's edge in samples.
    template <typename Ground>
    FanSamples(const Ground& ground, int edge, int column, int row)
        : last_column_(ground.columns() - 1), last_row_(ground.rows() - 1), half_(edge / 2), west_(column * edge),
          south_(row * edge) {}

    /// Whether some samples lie beyond the field, so that moved triangles may have no area.
    bool is_cut() const { return west_ + 2 * half_ > last_column_ || south_ + 2 * half_ > last_row_; }

    GridSample at(int half_edges_east, int half_edges_north) const {
        return {std::min(west_ + half_edges_east * half_, last_column_),
            std::min(south_ + half_edges_north * half_, last_row_)};
    }

    GridSample padded(int half_edges_east, int half_edges_north) const {
        return {west_ + half_edges_east * half_, south_ + half_edges_north * half_};
    }

    /// padded() of a place of fan_ring or of the centre.
    GridSample padded_ring(std::size_t place) const {
        return place == centre_of_ring ? padded(1, 1) : padded(fan_ring[place].east, fan_ring[place].north);
    }

    GridSample last() const { return {last_column_, last_row_}; }

    /// The sample of an index of fan_ring or of the centre.
    GridSample ring(std::size_t place) const {
        return place == centre_of_ring ? at(1, 1) : at(fan_ring[place].east, fan_ring[place].north);
    }

    /// Whether the middle column was moved onto the eastern one.
    bool columns_coincide() const { return west_ + half_ >= last_column_; }

    /// Whether the middle row was moved onto the northern one.
    bool rows_coincide() const { return south_ + half_ >= last_row_; }

    GridSample corner_a(const FanEdge& edge) const { return at(edge.corner_a_east, edge.corner_a_north); }

    GridSample corner_b(const FanEdge& edge) const { return at(edge.corner_b_east, edge.corner_b_north); }

    GridSample middle(const FanEdge& edge) const {
        return at((edge.corner_a_east + edge.corner_b_east) / 2, (edge.corner_a_north + edge.corner_b_north) / 2);
    }

private:
    int last_column_;
    int last_row_;
    int half_;
    int west_;
    int south_;
};

inline bool has_area(GridSample a, GridSample b, GridSample c) {
    return (b.column - a.column) * (c.row - a.row) != (b.row - a.row) * (c.column - a.column);
}

/// The number of triangles with an area in each part of a fan: a side without its mid-point, the half of a side with
/// its mid-point in either quadrant, and a quadrant.
struct FanTriangles {
    std::array<int, 4> whole{1, 1, 1, 1};
    std::array<int, 4> a{1, 1, 1, 1};
    std::array<int, 4> b{1, 1, 1, 1};
    std::array<int, 4> of_quadrant{2, 2, 2, 2}; ///< With mid-points.
};

/// The triangles of a node that the field's end does not cut.
inline constexpr FanTriangles uncut_fan_triangles;

/// The triangles of a node at the field's north or east end whose samples are moved onto it.
inline FanTriangles triangles_with_area(const FanSamples& samples) {
    FanTriangles triangles;
    triangles.of_quadrant = {};
    const GridSample centre = samples.at(1, 1);
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const GridSample a = samples.corner_a(edge);
        const GridSample b = samples.corner_b(edge);
        const GridSample middle = samples.middle(edge);
        triangles.whole[k] = has_area(centre, a, b) ? 1 : 0;
        triangles.a[k] = has_area(centre, a, middle) ? 1 : 0;
        triangles.b[k] = has_area(centre, middle, b) ? 1 : 0;
        triangles.of_quadrant[edge.quadrant_a] += triangles.a[k];
        triangles.of_quadrant[edge.quadrant_b] += triangles.b[k];
    }
    return triangles;
}

/// A corner of a triangle of the padded square, or of the part of one within the field's border.
struct ClipVertex {
    GridSample at{};
    float height = 0.0F;
    /// The vertex at this corner; nothing where the border crosses an edge.
    std::uint32_t vertex = no_vertex;

    static constexpr std::uint32_t no_vertex = 0xffffffffU;
};

/// The part of a triangle within the field, counter-clockwise as the triangle; it has no area where there are fewer
/// than three corners.
struct ClippedPolygon {
    std::array<ClipVertex, 5> corner{};
    unsigned count = 0;

    int triangles() const { return count < 3 ? 0 : static_cast<int>(count) - 2; }
};

/// The part of a bisection's triangle up to the field's last column and row. Edges are level, upright or diagonal, so
/// that the border crosses them at samples, and at the same height from either side.
ClippedPolygon clip_to_border(const std::array<ClipVertex, 3>& triangle, const GridSample& last);

/// The triangles of a node at the field's north or east end that are left within the field.
FanTriangles triangles_within_border(const FanSamples& samples);

/// The smallest limits at which the parts of a fan are in the mesh.
struct FanLimits {
    float node_limit = 0.0F;            ///< The fan itself.
    const std::array<float, 4>& middle; ///< The mid-points of fan_edges.
    unsigned hidden = 0;                ///< The quadrants without triangles.
    int replaced = 0;                   ///< How many triangles of its parent it replaces.
};

/// Adds the steps of N at which a fan appears and at which its mid-points do, those below `high`. The step of a
/// quadrant that splits is counted with the child. Returns whether there are steps above.
inline bool count_fan(const FanLimits& fan, const FanTriangles& triangles, float high, StepFunction& steps) {
    const auto unless_hidden = [&](unsigned quadrant, int some) {
        return (fan.hidden >> quadrant & 1U) == 0 ? some : 0;
    };
    bool more_above = false;
    int first = -fan.replaced;
    for (std::size_t k = 0; k < 4; ++k) {
        const FanEdge& edge = fan_edges[k];
        const int with_middle =
            unless_hidden(edge.quadrant_a, triangles.a[k]) + unless_hidden(edge.quadrant_b, triangles.b[k]);
        if (fan.middle[k] <= fan.node_limit) {
            first += with_middle;
            continue;
        }
        first += triangles.whole[k];
        if (fan.middle[k] < high) {
            steps.add(fan.middle[k], with_middle - triangles.whole[k]);
        } else {
            more_above = true;
        }
    }
    steps.add(fan.node_limit, first);
    return more_above;
}

} // namespace octant::visuals::terrain
