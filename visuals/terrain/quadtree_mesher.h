#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/budget_search.h"
#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/paint_order.h"
#include "visuals/terrain/quadtree.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// An axis-aligned box in world axes.
struct NodeBox {
    glm::dvec3 min_m;
    glm::dvec3 max_m;
};

/// Decides which nodes of a quadtree a view switches on, and which are out of view.
class QuadtreeCriterion {
public:
    /// The constants of a level of the tree.
    struct Level {
        int edge;    ///< In samples.
        int columns; ///< In nodes.
        int rows;    ///< In nodes.
        float edge_samples;
        float half_edge_samples;
    };

    /// The tree must outlive the criterion.
    explicit QuadtreeCriterion(const Quadtree& tree);

    /// Takes a view; `detail.resolution` is not used.
    void set_view(const MeshView& view, const QuadtreeDetail& detail);

    const Quadtree& tree() const { return *tree_; }

    const MeshView& view() const { return view_; }

    const Level& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

    /// The index of a node in Quadtree::nodes().
    std::uint32_t node_at(int level, int column, int row) const {
        return static_cast<std::uint32_t>(tree_->index_of(level, column, row));
    }

    /// The x coordinate of the field's west border relative to the eye.
    double west_m() const { return west_m_; }

    /// The y coordinate of the field's south border relative to the eye.
    double south_m() const { return south_m_; }

    /// The limit that critical values are compared with: the square of C, which is raised to the tree's smallest, times
    /// the magnification.
    float limit_squared(double resolution) const {
        const double seen = std::max(resolution, tree_->options().min_resolution) * view_.magnification;
        return static_cast<float>(seen * seen);
    }

    /// The C of a limit that is not below the smallest one; limit_squared of it is `limit` again.
    double resolution_of(float limit) const;

    /// Equation (3) solved for C and squared. A node's quadrant of its parent is switched on if this is below the limit
    /// and the parent is on. The root is always on.
    float critical_squared(int level, int column, int row) const {
        if (level == 0) { return 0.0F; }
        return fan_kind_ == FanKind::Partial ? own_critical_squared(level, column, row)
                                             : own_critical_squared(level - 1, column / 2, row / 2);
    }

    /// critical_squared() of the four children at (column, row) and east and north of it, by quadrant; meaningless for
    /// children that do not exist.
    std::array<float, 4> critical_squared_of_four(int level, int column, int row) const;

    /// A box around all samples of a node, a little wider than the tree's height bounds.
    NodeBox box_of(const GroundFan& node) const;

    /// crossed_planes (frustum.h) for the box of a node's samples.
    unsigned crossed_planes_of_node(const GroundFan& node, unsigned planes) const;

private:
    float own_critical_squared(int level, int column, int row) const {
        return critical_squared_at(levels_[static_cast<std::size_t>(level)], column, row,
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

/// A node that is in the mesh at some limits (QuadtreeCriterion::limit_squared). Its members tell from which limit on
/// each of its parts is there; infinite means above all limits of the last walk.
struct SelectedNode {
    GroundFan fan;                 ///< Its `split` is left empty.
    float node_limit = 0.0F;       ///< The node itself.
    std::array<float, 4> split{};  ///< Its quadrants, in the order of their bits.
    std::array<float, 4> middle{}; ///< The mid-points of its fan_edges.
};

/// Collects the nodes of a mesh, and finds the resolution C at which it has a given number of triangles.
///
/// The number of triangles at any C is known exactly: a node adds one triangle for each of its sides; the mid-point of
/// a side replaces that triangle by one for each adjoining quadrant that is not hidden; a quadrant that splits takes
/// its two away. One walk down the tree, to a little more than the C of the last call, collects the values of C at
/// which this happens. The last call only makes the walk short; the answer does not depend on it.
class QuadtreeSelection {
public:
    /// The tree must outlive the selection.
    explicit QuadtreeSelection(const Quadtree& tree) : tree_(&tree) {}

    /// The largest limit, at most that of `budget.max_resolution`, up to which no mesh has more than `budget.triangles`
    /// triangles; the limit of the tree's smallest C where even that one has more.
    float limit_for(const QuadtreeCriterion& criterion, const TriangleBudget& budget);

    /// Collects the nodes of the mesh at a given limit.
    void collect(const QuadtreeCriterion& criterion, float limit);

    /// The nodes of all meshes up to the limit that was found or given, and some more: parents before children.
    std::span<const SelectedNode> nodes() const { return nodes_; }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node that is to be visited.
    struct PendingNode {
        GroundFan fan;
        unsigned planes = 0;     ///< The frustum planes that its box may reach beyond.
        float node_limit = 0.0F; ///< The limit above which it is in the mesh.
        /// The same for the nodes beyond its edges; 0 at the field's border.
        std::array<float, 4> beyond{};
        int replaced = 0; ///< How many triangles of its parent it replaces.
    };

    bool walk(float low, float high, int max_triangles);
    void visit(const PendingNode& from);
    void test_quadrants(const PendingNode& from, SelectedNode& node, std::array<unsigned, 4>& planes);
    PendingNode child_pending(const PendingNode& from, const SelectedNode& node, unsigned quadrant) const;
    float neighbour_limit(float parent, int level, int column, int row) const;

    const Quadtree* tree_;
    const QuadtreeCriterion* criterion_ = nullptr;
    std::vector<SelectedNode> nodes_;
    StepFunction steps_;
    float high_ = 0.0F;
    int max_triangles_ = 0;        ///< A walk stops once it has counted more.
    bool has_steps_above_ = false; ///< Something visible appears only above the limits of the walk.
    int nodes_tested_ = 0;
    double last_resolution_ = 0.0; ///< 0 before the first call.
};

/// Makes the mesh of a quadtree for an eye point, frame after frame in the same memory, with the triangles in the
/// view's painting order. The order is exact up to the rounding of the eye's position in samples, wherever the eye is.
///
/// With crack-free propagation the mesh is conforming: triangles neither gap nor overlap nor touch an edge between its
/// ends. The triangles for a narrower frustum are triangles of the unculled mesh, and every one of those that reaches
/// into the frustum is there.
class QuadtreeMesher {
public:
    /// `colours` has one colour for each sample, as in ColourVertex, row after row from the south (its size is
    /// asserted). Tree and colours must outlive the mesher.
    QuadtreeMesher(const Quadtree& tree, std::span<const std::uint32_t> colours);

    /// Takes these colours in place of those before, from the next mesh on.
    void set_colours(std::span<const std::uint32_t> colours);

    /// The mesh at a given C. `detail.roughness_weight` must be at least 0 and below 1e6 (asserted).
    GroundMesh mesh(const MeshView& view, const QuadtreeDetail& detail);

    /// The mesh at the largest C up to which none has more triangles than the budget, whatever was meshed before;
    /// `detail.resolution` is not used. It has as many triangles as the steps of N(C) allow: fewer where C ends at
    /// `budget.max_resolution`, and more only if even the tree's smallest C has more. mesh() at the returned C makes
    /// the same triangles.
    GroundMesh mesh_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget);

    /// What mesh() and mesh_within() would return of a mesh but its triangles, for less than half of the work. The mesh
    /// before is lost: fans() and triangles_in() are right again once a mesh is made.
    CountedMesh count(const MeshView& view, const QuadtreeDetail& detail);
    CountedMesh count_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget);

    /// The mesh that was counted last; only once after each count (asserted).
    GroundMesh counted_mesh();

    /// The nodes of the last mesh, parents before children, including those without triangles of their own.
    std::span<const GroundFan> fans() const { return fans_; }

    /// Decides whether the triangles in a box (world axes, metres) are wanted.
    using BoxTest = std::function<bool(const glm::dvec3& min_m, const glm::dvec3& max_m)>;

    /// Appends the numbers of some triangles of the last mesh, ascending: those of the nodes for which `wanted` accepts
    /// the box around all of their samples, and also accepts those of all their ancestors.
    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree& tree() const { return *tree_; }

private:
    static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

    /// Where a fan is in the mesh.
    struct FanRecord {
        /// The fan of each quadrant's child, where there is one.
        std::array<std::uint32_t, 4> child{};
        /// The vertices of the mid-points of fan_edges; no_vertex while there are none.
        std::array<std::uint32_t, 4> middle{no_vertex, no_vertex, no_vertex, no_vertex};
        TriangleRange triangles;  ///< Its own triangles and all of those below it.
        std::uint8_t middles = 0; ///< Bit k: edge k of fan_edges has a mid-point.
    };

    /// A fan while it is put into the mesh. Corners are vertices of the parent's fan, and centres are nobody else's;
    /// mid-points are shared with the fan of the same level beyond the edge.
    struct EmittedFan {
        const FanSamples& samples;
        std::uint32_t own; ///< The index in fans_.
        unsigned quadrant; ///< The parent's, in which this fan lies.
        EmittedFan* parent;
        std::array<std::uint32_t, 4> beyond; ///< The fans beyond fan_edges; 0 = none in the mesh.
        const std::uint8_t* place_of;        ///< A row of coinciding_places.
        /// The vertices of the ring and the centre; no_vertex while they are not known.
        std::array<std::uint32_t, 9> vertex;
    };

    void collect(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget* budget);
    void add(const SelectedNode& node);
    CountedMesh count_fans();
    unsigned triangle_count_of(std::size_t own) const;
    void reserve();
    void emit(std::uint32_t own, EmittedFan* parent, unsigned quadrant);
    void emit_part(EmittedFan& fan, unsigned part);
    std::array<std::uint32_t, 4> fans_beyond(const EmittedFan& parent, unsigned quadrant) const;
    std::uint32_t vertex_of(EmittedFan& fan, std::size_t place);
    std::uint32_t middle_vertex(const EmittedFan& fan, std::size_t edge);
    std::uint32_t add_vertex(GridSample at);
    void add_triangles_in(std::uint32_t fan, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree* tree_;
    std::span<const std::uint32_t> colours_;

    QuadtreeCriterion criterion_;
    QuadtreeSelection selection_;
    float limit_ = 0.0F;        ///< QuadtreeCriterion::limit_squared of the mesh.
    double resolution_ = 0.0;   ///< C of the mesh.
    bool is_collected_ = false; ///< fans_ are those of a mesh that is to be made.

    std::vector<GroundFan> fans_;
    std::vector<FanRecord> fan_records_; ///< One for each of fans_.
    /// For each level the last fan, while they are collected.
    std::array<std::uint32_t, 16> last_fan_of_level_{};
    const PartOrder* orders_ = nullptr; ///< The painting_orders of the view.
    glm::dvec2 eye_{0.0};               ///< In samples east and north of the field's first sample.
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::uint32_t vertex_count_ = 0;
    std::size_t index_count_ = 0;
    MeshCounters counters_;
};

/// The resolution C at which a mesh comes nearest to `target_triangles` from this view, by bisection between the tree's
/// smallest one and `max_resolution`; `detail.resolution` is not used. It counts about 24 meshes, so it is meant for
/// loading, where it lets the first picture of a run meet its target already.
double resolution_for_target(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail,
    double target_triangles, double max_resolution);

/// N'(C), in triangles for a unit of C, around `detail.resolution`: the difference of two meshes 4 % of C apart, so
/// that single steps of N(C) do not matter. Divided by a of equation (4) it is the loop gain g.
double triangle_count_slope(QuadtreeMesher& mesher, const MeshView& view, const QuadtreeDetail& detail);

} // namespace octant::visuals::terrain
