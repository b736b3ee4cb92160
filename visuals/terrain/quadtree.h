#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/terrain_lod.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// What a node of the quadtree stores, rounded to the safe side. 4 bytes.
struct QuadtreeNode {
    std::uint16_t roughness = 0; ///< d2 as five bits of exponent and eleven bits of fraction.
    std::uint8_t lowest = 0;     ///< In 255ths of the field's height range.
    std::uint8_t highest = 0;    ///< In 255ths of the field's height range.
};

/// The d2 that a node stands for: at most 0.05 % above the value that was stored.
inline float roughness_of(const QuadtreeNode& node) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(node.roughness) << 12U) * 0x1p112F;
}

/// A quadtree over a height field of any size. Level 0 is the root; each level halves the edge; the nodes of the last
/// level have an edge of two samples. The field is thought of as padded to a square of 2^n + 1 samples by repeating its
/// last column and row *in place* (a padded sample lies on the field's border), so that everything beyond the field has
/// no area. Nodes without area do not exist. Node (column, row) of a level covers the samples from column *
/// edge_samples(level) to (column + 1) * edge_samples(level), as far as they are within the field.
class Quadtree {
public:
    /// Computes all nodes. The field must outlive the tree and stay where it is. The options must be as their comments
    /// demand (asserted).
    explicit Quadtree(const models::heights::HeightField& field, const QuadtreeOptions& options = {});

    const models::heights::HeightField& field() const { return *field_; }

    const QuadtreeOptions& options() const { return options_; }

    int levels() const { return static_cast<int>(levels_.size()); }

    /// The edge of a node in samples: a power of two, 2 on the last level.
    int edge_samples(int level) const { return 1 << (levels() - level); }

    /// The number of nodes with an area from west to east.
    int columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }

    /// The number of nodes with an area from south to north.
    int rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }

    /// The index of a node in nodes().
    std::size_t index_of(int level, int column, int row) const {
        const Level& at = levels_[static_cast<std::size_t>(level)];
        return at.first + static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
               static_cast<std::size_t>(column);
    }

    /// All nodes, level after level from the root, row after row from the south.
    std::span<const QuadtreeNode> nodes() const { return nodes_; }

    /// d2 of a node after propagation, equation (2).
    float roughness(int level, int column, int row) const { return roughness_of(nodes_[index_of(level, column, row)]); }

    /// A height at or below every sample of the node, in metres, and never far below.
    double lowest_m(const QuadtreeNode& node) const { return base_m_ + node.lowest * step_m_; }

    /// A height at or above every sample of the node, in metres, and never far above.
    double highest_m(const QuadtreeNode& node) const { return base_m_ + node.highest * step_m_; }

private:
    struct Level {
        std::size_t first;
        int columns;
        int rows;
    };

    void measure(int level);
    void measure_last_bounds();
    void merge_child_bounds(int level, int column, int row);
    void propagate_from_children(int level);
    float max_child_roughness(int level, int column, int row) const;

    const models::heights::HeightField* field_;
    QuadtreeOptions options_;
    double base_m_;
    double step_m_;
    std::vector<Level> levels_;
    std::vector<QuadtreeNode> nodes_;
};

} // namespace octant::visuals::terrain
