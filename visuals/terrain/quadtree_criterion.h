#pragma once

#include "visuals/terrain/detail_settings.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/quadtree.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// An axis-aligned box in world axes.
struct NodeBox {
    glm::dvec3 min_m;
    glm::dvec3 max_m;
};

/// Which nodes of a quadtree a view switches on, and which it cannot see.
class QuadtreeCriterion {
public:
    /// What the rule must know of a level of the tree.
    struct Level {
        int edge;          ///< In samples.
        int columns;       ///< In nodes.
        int rows;          ///< In nodes.
        std::size_t first; ///< The index of its first node.
        float edge_samples;
        float half_edge_samples;
    };

    /// The tree must outlive the rule.
    explicit QuadtreeCriterion(const Quadtree& tree);

    /// Takes a view; `detail.resolution` is not used.
    void set_view(const MeshView& view, const QuadtreeDetail& detail);

    const Quadtree& tree() const { return *tree_; }

    const MeshView& view() const { return view_; }

    const Level& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

    /// The index of a node in Quadtree::nodes().
    std::uint32_t node_at(int level_index, int column, int row) const {
        const Level& at = levels_[static_cast<std::size_t>(level_index)];
        return static_cast<std::uint32_t>(
            at.first + static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
            static_cast<std::size_t>(column));
    }

    /// The x coordinate of the field's west border relative to the eye.
    double west_m() const { return west_m_; }

    /// The y coordinate of the field's south border relative to the eye.
    double south_m() const { return south_m_; }

    /// The limit that critical values are compared with: the square of C, which is raised to the
    /// tree's smallest, times the magnification.
    float limit_squared(double resolution) const {
        const double seen =
            std::max(resolution, tree_->options().min_resolution) * view_.magnification;
        return static_cast<float>(seen * seen);
    }

    /// The C of a limit that is not below the smallest one; limit_squared of it is `limit` again.
    double resolution_of(float limit) const;

    /// Equation (3) solved for C and squared. A node's quadrant of its parent is switched on if
    /// this is below the limit and the parent is on. The root is always on.
    float critical_squared(int level, int column, int row) const {
        if (level == 0) {
            return 0.0F;
        }
        return fan_kind_ == FanKind::Partial ? own_critical_squared(level, column, row)
                                             : own_critical_squared(level - 1, column / 2, row / 2);
    }

    /// The same for the four children at (column, row) and east and north of it, by quadrant;
    /// meaningless for those that do not exist.
    std::array<float, 4> critical_squared_of_four(int level, int column, int row) const;

    /// A box around all samples of a node, a little wider than the tree's height bounds.
    NodeBox box_of(const GroundFan& node) const;

    /// crossed_planes (frustum.h) for the box of a node's samples.
    unsigned crossed_planes_of_node(const GroundFan& node, unsigned planes) const;

private:
    float own_critical_squared(int level, int column, int row) const {
        return critical_squared_at(
            levels_[static_cast<std::size_t>(level)],
            column,
            row,
            roughness_of(tree_->nodes()[node_at(level, column, row)]));
    }

    float critical_squared_at(const Level& at, int column, int row, float roughness) const {
        const float east = static_cast<float>(2 * column + 1) * at.half_edge_samples - eye_column_;
        const float north = static_cast<float>(2 * row + 1) * at.half_edge_samples - eye_row_;
        const float scale = at.edge_samples * std::max(roughness_weight_ * roughness, 1.0F);
        return (east * east + north * north + eye_height_squared_) / (scale * scale);
    }

    const Quadtree* tree_;
    std::vector<Level> levels_;
    MeshView view_;
    FanKind fan_kind_ = FanKind::Partial;
    float roughness_weight_ = 0.0F;
    float eye_column_ = 0.0F;
    float eye_row_ = 0.0F;
    float eye_height_squared_ = 0.0F; ///< In samples^2.
    double west_m_ = 0.0;
    double south_m_ = 0.0;
};

} // namespace octant::visuals::terrain
