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

/// A node that is in the mesh at some limits (SplitRule::limit_squared). Its members tell from
/// which limit on each of its parts is there; infinite means above all limits that were looked at.
struct SurveyedNode {
    GroundFan fan;                 ///< Its `split` is left empty.
    float on = 0.0F;               ///< The node itself.
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
class BudgetSurvey {
public:
    /// The tree must outlive the survey.
    explicit BudgetSurvey(const Quadtree& tree)
        : tree_(&tree) {}

    /// The largest limit, at most that of `budget.max_resolution`, up to which no mesh has more
    /// than `budget.triangles` triangles; the limit of the tree's smallest C where even that one
    /// has more.
    float limit_for(const SplitRule& rule, const TriangleBudget& budget);

    /// The nodes of all meshes up to the limit that was found, and some more: parents before
    /// children.
    std::span<const SurveyedNode> nodes() const { return nodes_; }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node that is to be surveyed.
    struct Visit {
        GroundFan fan;
        unsigned planes = 0; ///< The frustum planes that its box may reach beyond.
        float on = 0.0F;     ///< The limit above which it is in the mesh.
        /// The same for the nodes beyond its edges; 0 at the field's border.
        std::array<float, 4> beyond{};
        int replaced = 0; ///< How many triangles of its parent it replaces.
    };

    bool survey(float low, float high, int max_triangles);
    void visit(const Visit& from);
    void test_quadrants(const Visit& from, SurveyedNode& node, std::array<unsigned, 4>& planes);
    Visit below(const Visit& from, const SurveyedNode& node, unsigned quadrant) const;
    float on_beyond(float parent, int level, int column, int row) const;

    const Quadtree* tree_;
    const SplitRule* rule_ = nullptr;
    std::vector<SurveyedNode> nodes_;
    StepCount steps_;
    float high_ = 0.0F;
    int max_triangles_ = 0;  ///< A walk stops once it has counted more.
    bool more_above_ = false; ///< Something visible appears only above the limits looked at.
    int nodes_tested_ = 0;
    double last_resolution_ = 0.0; ///< 0 before the first call.
};

} // namespace octant::visuals::terrain
