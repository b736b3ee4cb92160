// The quadtree of node roughness: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering
// Effect", equation (2) and steps 1 and 2 of section 2, after S. Roettger, W. Heidrich, P. Slusallek, H.-P. Seidel,
// "Real-Time Generation of Continuous Levels of Detail for Height Fields", 1998.
//
// Deviations:
// - Roughness is measured at every node, not only at the leaves, and the larger of the own and the
//   propagated value counts.
// - The printed propagation (the plain maximum in the own parent) leaves cracks. The crack-free one
//   serves three parents: a fan whose child quadrant is split needs the edge mid-points at the
//   child's outer corners, so the two nodes beyond those edges must be split far enough as well.
//   Their centres are at most sqrt(2.5) child edges away from the child's. If the child has l < d C
//   m with m = max(c d2, 1), such a parent has l' < d C m + sqrt(2.5) d, and that is below 2 d C m'
//   whenever m' >= m / 2 + sqrt(2.5) / (2 C). For C >= C_min this follows from d2' >= K d2 with K =
//   0.5 + sqrt(2.5) / (2 C_min).
// - The paper does not speak of sizes other than 2^n + 1; the header describes the padding. A line
//   that the padding cuts short is compared with the straight line at its shifted middle.
#include "visuals/terrain/quadtree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

constexpr float smallest_roughness = 0x1p-14F;
constexpr float largest_roughness = 131040.0F;

/// A roughness in 16 bits, rounded up. Slopes below the smallest one never decide anything and are raised to it.
std::uint16_t packed_roughness(float roughness) {
    if (roughness <= 0.0F) { return 0; }
    const float clamped = std::clamp(roughness, smallest_roughness, largest_roughness);
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(clamped * 0x1p-112F) + 0xfffU) >> 12U);
}

/// The nine samples by which a node is judged, padding included, at the west (south) end, middle and east (north) end
/// of columns (rows).
struct NineSamples {
    std::array<int, 3> columns;
    std::array<int, 3> rows;
    std::array<std::array<float, 3>, 3> height_m; ///< Indexed [row][column].
};

NineSamples nine_samples(const models::heights::HeightField& field, int west, int south, int edge) {
    NineSamples nine{};
    for (std::size_t k = 0; k < 3; ++k) {
        const int along = static_cast<int>(k) * edge / 2;
        nine.columns[k] = std::min(west + along, field.columns() - 1);
        nine.rows[k] = std::min(south + along, field.rows() - 1);
    }
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) { nine.height_m[j][i] = field.height_m(nine.columns[i], nine.rows[j]); }
    }
    return nine;
}

/// The largest |height difference| between any two corners, which covers all six lines at once.
float corner_range_m(const NineSamples& nine) {
    const auto& h = nine.height_m;
    const auto [low, high] = std::minmax({h[0][0], h[0][2], h[2][0], h[2][2]});
    return high - low;
}

/// The largest deviation of the middles of the four sides and two diagonals from the straight lines.
float middle_deviation_m(const NineSamples& nine) {
    const auto& h = nine.height_m;
    const auto off = [](float middle, float a, float b) { return std::abs(middle - 0.5F * (a + b)); };
    return std::max({off(h[0][1], h[0][0], h[0][2]), off(h[2][1], h[2][0], h[2][2]), off(h[1][0], h[0][0], h[2][0]),
        off(h[1][2], h[0][2], h[2][2]), off(h[1][1], h[0][0], h[2][2]), off(h[1][1], h[0][2], h[2][0])});
}

/// middle_deviation_m() for a node in which the padding has moved middles and ends: each middle is held against what
/// the sides, or the triangles next to the diagonals, have at its place.
float cut_middle_deviation_m(const NineSamples& nine) {
    const auto& h = nine.height_m;
    const auto share = [](const std::array<int, 3>& at) {
        return static_cast<float>(at[1] - at[0]) / static_cast<float>(at[2] - at[0]);
    };
    const float s = share(nine.columns);
    const float t = share(nine.rows);
    const auto off = [](float middle, float a, float b, float part) { return std::abs(middle - (a + (b - a) * part)); };
    // The shifted centre lies on neither diagonal, but within one triangle next to each.
    const float rising = s > t ? h[0][0] + (h[0][2] - h[0][0]) * s + (h[2][2] - h[0][2]) * t
                               : h[0][0] + (h[2][0] - h[0][0]) * t + (h[2][2] - h[2][0]) * s;
    const float falling = s + t < 1.0F ? h[0][0] + (h[0][2] - h[0][0]) * s + (h[2][0] - h[0][0]) * t
                                       : h[2][2] + (h[2][0] - h[2][2]) * (1.0F - s) + (h[0][2] - h[2][2]) * (1.0F - t);
    return std::max(
        {off(h[0][1], h[0][0], h[0][2], s), off(h[2][1], h[2][0], h[2][2], s), off(h[1][0], h[0][0], h[2][0], t),
            off(h[1][2], h[0][2], h[2][2], t), std::abs(h[1][1] - rising), std::abs(h[1][1] - falling)});
}

} // namespace

Quadtree::Quadtree(const models::heights::HeightField& field, const QuadtreeOptions& options)
    : field_(&field), options_(options), base_m_(static_cast<double>(field.lowest_m())),
      step_m_((static_cast<double>(field.highest_m()) - base_m_) / 255.0) {
    assert(options.min_resolution >= 1.6);
    const int intervals_east = field.columns() - 1;
    const int intervals_north = field.rows() - 1;
    int side = 2;
    while (side < std::max(intervals_east, intervals_north)) { side *= 2; }
    std::size_t count = 0;
    for (int edge = side; edge >= 2; edge /= 2) {
        const int columns = (intervals_east + edge - 1) / edge;
        const int rows = (intervals_north + edge - 1) / edge;
        levels_.push_back({count, columns, rows});
        count += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    nodes_.resize(count);
    for (int level = 0; level < levels(); ++level) { measure(level); }
    measure_last_bounds();
    for (int level = levels() - 2; level >= 0; --level) { propagate_from_children(level); }
}

/// Measures the roughness of all nodes of a level.
void Quadtree::measure(int level) {
    const int edge = edge_samples(level);
    const float per_edge = static_cast<float>(1.0 / (edge * field_->spacing_m()));
    QuadtreeNode* node = nodes_.data() + index_of(level, 0, 0);
    for (int row = 0; row < rows(level); ++row) {
        const bool cut_north = (row + 1) * edge >= field_->rows();
        for (int column = 0; column < columns(level); ++column, ++node) {
            const bool cut = cut_north || (column + 1) * edge >= field_->columns();
            const NineSamples nine = nine_samples(*field_, column * edge, row * edge, edge);
            const float difference_m = options_.roughness == Roughness::Printed
                                           ? corner_range_m(nine)
                                           : (cut ? cut_middle_deviation_m(nine) : middle_deviation_m(nine));
            node->roughness = packed_roughness(difference_m * per_edge);
        }
    }
}

/// Finds the height bounds of the last level's nodes.
void Quadtree::measure_last_bounds() {
    const int level = levels() - 1;
    const double per_step = step_m_ > 0.0 ? 1.0 / step_m_ : 0.0;
    const auto steps = [&](float height_m) { return (static_cast<double>(height_m) - base_m_) * per_step; };
    QuadtreeNode* node = nodes_.data() + index_of(level, 0, 0);
    for (int row = 0; row < rows(level); ++row) {
        for (int column = 0; column < columns(level); ++column, ++node) {
            const NineSamples nine = nine_samples(*field_, column * 2, row * 2, 2);
            float low_m = nine.height_m[0][0];
            float high_m = low_m;
            for (const auto& line : nine.height_m) {
                low_m = std::min({low_m, line[0], line[1], line[2]});
                high_m = std::max({high_m, line[0], line[1], line[2]});
            }
            node->lowest = static_cast<std::uint8_t>(std::floor(steps(low_m)));
            node->highest = static_cast<std::uint8_t>(std::min(std::ceil(steps(high_m)), 255.0));
        }
    }
}

/// Finds a node's height bounds from those of its existing children.
void Quadtree::merge_child_bounds(int level, int column, int row) {
    QuadtreeNode& node = nodes_[index_of(level, column, row)];
    node.lowest = 255;
    node.highest = 0;
    const int below = level + 1;
    for (int j = 2 * row; j < std::min(2 * row + 2, rows(below)); ++j) {
        for (int i = 2 * column; i < std::min(2 * column + 2, columns(below)); ++i) {
            const QuadtreeNode& child = nodes_[index_of(below, i, j)];
            node.lowest = std::min(node.lowest, child.lowest);
            node.highest = std::max(node.highest, child.highest);
        }
    }
}

/// The largest d2 of those nodes one level down whose splitting needs this node: its own four and, with crack-free
/// propagation, the eight beyond its edges.
float Quadtree::max_child_roughness(int level, int column, int row) const {
    const int below = level + 1;
    const int reach = options_.propagation == RoughnessPropagation::CrackFree ? 1 : 0;
    std::uint16_t roughest = 0;
    for (int j = -reach; j < 2 + reach; ++j) {
        const int child_row = 2 * row + j;
        if (child_row < 0 || child_row >= rows(below)) { continue; }
        // The corners of the 4 x 4 block touch nothing.
        const int side = j < 0 || j > 1 ? 0 : reach;
        const int first = std::max(2 * column - side, 0);
        const int last = std::min(2 * column + 1 + side, columns(below) - 1);
        const QuadtreeNode* child = nodes_.data() + index_of(below, first, child_row);
        for (int i = first; i <= last; ++i, ++child) {
            // Packed values have the same order as the values themselves.
            roughest = std::max(roughest, child->roughness);
        }
    }
    return roughness_of({roughest, 0, 0});
}

/// Takes the height bounds and the propagated roughness of a level from the one below.
void Quadtree::propagate_from_children(int level) {
    const double share = options_.propagation == RoughnessPropagation::CrackFree
                             ? 0.5 + std::sqrt(2.5) / (2.0 * options_.min_resolution)
                             : 1.0;
    for (int row = 0; row < rows(level); ++row) {
        for (int column = 0; column < columns(level); ++column) {
            merge_child_bounds(level, column, row);
            const float propagated = static_cast<float>(share) * max_child_roughness(level, column, row);
            QuadtreeNode& node = nodes_[index_of(level, column, row)];
            node.roughness = std::max(node.roughness, packed_roughness(propagated));
        }
    }
}

} // namespace octant::visuals::terrain
