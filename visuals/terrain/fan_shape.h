#pragma once

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

/// The place of a fan's centre behind those of fan_ring.
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

/// The nine samples that the triangles of a node's fan may use. at() and what uses it move those beyond the field onto
/// its last column and row; padded() leaves them where they are.
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

    /// Of a place of fan_ring or of the centre.
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

} // namespace octant::visuals::terrain
