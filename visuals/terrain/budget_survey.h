#pragma once

#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/split_rule.h"
#include "visuals/terrain/step_count.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// A node that is in the mesh at some limits (SplitRule::limit_squared), with the limits above
/// which each of its parts is there. Infinite: only above the limits looked at.
struct SurveyedNode {
    GroundFan fan;                 ///< `split` is left empty
    float on = 0.0F;               ///< the node
    std::array<float, 4> split{};  ///< its quadrants, by bit
    std::array<float, 4> middle{}; ///< the mid-points of fan_edges
};

/// Finds, before a mesh is made, the C at which it has a given number of triangles.
///
/// The number of triangles at any C is known exactly: a node adds one triangle for each side; a
/// side's mid-point replaces it by one for each adjoining quadrant that is not hidden; a split
/// quadrant takes its two away. One walk down to a little more than the C of the last call collects
/// the values of C at which this happens. The last call only makes the walk short: the answer does
/// not depend on it.
class BudgetSurvey {
public:
    /// The tree must outlive the survey.
    explicit BudgetSurvey(const Quadtree& tree)
        : tree_(&tree) {}

    /// The largest limit, at most that of `budget.max_resolution`, up to which no mesh has more
    /// than `budget.triangles`. The limit of the tree's smallest C where even that has more.
    float limit_for(const SplitRule& rule, const TriangleBudget& budget);

    /// What meshes up to the limit last found are made of, and more: in drawing order, parents
    /// before children.
    std::span<const SurveyedNode> nodes() const { return nodes_; }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node to be surveyed.
    struct Visit {
        GroundFan fan;
        unsigned planes = 0;           ///< that its box may reach beyond
        float on = 0.0F;               ///< limit above which it is in the mesh
        std::array<float, 4> beyond{}; ///< the same of the nodes beyond its edges; 0 at the border
        int replaced = 0;              ///< triangles of its parent that it takes the place of
    };

    bool survey(float low, float high, int most_triangles);
    void visit(const Visit& from);
    void test_quadrants(const Visit& from, SurveyedNode& node, std::array<unsigned, 4>& planes);
    Visit below(const Visit& from, const SurveyedNode& node, unsigned quadrant) const;
    float on_beyond(float parent, int level, int column, int row) const;

    const Quadtree* tree_;
    const SplitRule* rule_ = nullptr;
    std::vector<SurveyedNode> nodes_;
    StepCount steps_;
    float high_ = 0.0F;
    int most_triangles_ = 0;  ///< a walk stops where it has counted more
    bool more_above_ = false; ///< something visible is infinite
    int nodes_tested_ = 0;
    double last_resolution_ = 0.0; ///< 0: none yet
};

} // namespace octant::visuals::terrain
