#pragma once

#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/quadtree_criterion.h"
#include "visuals/terrain/step_function.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// A node that is in the mesh at some limits (QuadtreeCriterion::limit_squared). Its members tell from
/// which limit on each of its parts is there; infinite means above all limits that were looked at.
struct SelectedNode {
    GroundFan fan;                 ///< Its `split` is left empty.
    float node_limit = 0.0F;               ///< The node itself.
    std::array<float, 4> split{};  ///< Its quadrants, in the order of their bits.
    std::array<float, 4> middle{}; ///< The mid-points of its fan_edges.
};

/// Finds the resolution C at which a mesh has a given number of triangles, before the mesh is made.
///
/// The number of triangles at any C is known exactly: a node adds one triangle for each of its
/// sides; the mid-point of a side replaces that triangle by one for each adjoining quadrant that is
/// not hidden; a quadrant that splits takes its two away. One walk down the tree, to a little more
/// than the C of the last call, collects the values of C at which this happens. The last call only
/// makes the walk short; the answer does not depend on it.
class QuadtreeSelection {
public:
    /// The tree must outlive the survey.
    explicit QuadtreeSelection(const Quadtree& tree)
        : tree_(&tree) {}

    /// The largest limit, at most that of `budget.max_resolution`, up to which no mesh has more
    /// than `budget.triangles` triangles; the limit of the tree's smallest C where even that one
    /// has more.
    float limit_for(const QuadtreeCriterion& rule, const TriangleBudget& budget);

    /// The nodes of all meshes up to the limit that was found, and some more: parents before
    /// children.
    std::span<const SelectedNode> nodes() const { return nodes_; }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node that is to be surveyed.
    struct PendingNode {
        GroundFan fan;
        unsigned planes = 0; ///< The frustum planes that its box may reach beyond.
        float node_limit = 0.0F;     ///< The limit above which it is in the mesh.
        /// The same for the nodes beyond its edges; 0 at the field's border.
        std::array<float, 4> beyond{};
        int replaced = 0; ///< How many triangles of its parent it replaces.
    };

    bool survey(float low, float high, int max_triangles);
    void visit(const PendingNode& from);
    void test_quadrants(const PendingNode& from, SelectedNode& node, std::array<unsigned, 4>& planes);
    PendingNode child_pending(const PendingNode& from, const SelectedNode& node, unsigned quadrant) const;
    float neighbour_limit(float parent, int level, int column, int row) const;

    const Quadtree* tree_;
    const QuadtreeCriterion* rule_ = nullptr;
    std::vector<SelectedNode> nodes_;
    StepFunction steps_;
    float high_ = 0.0F;
    int max_triangles_ = 0;  ///< A walk stops once it has counted more.
    bool has_steps_above_ = false; ///< Something visible appears only above the limits looked at.
    int nodes_tested_ = 0;
    double last_resolution_ = 0.0; ///< 0 before the first call.
};

} // namespace octant::visuals::terrain
