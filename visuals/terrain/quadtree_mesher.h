#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/quadtree_selection.h"
#include "visuals/terrain/detail_settings.h"
#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/paint_order.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/quadtree_criterion.h"
#include "visuals/terrain/triangle_ranges.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// Makes the mesh of a quadtree for an eye point, frame after frame in the same memory, with the
/// triangles in the view's painting order. The order is exact up to the rounding of the eye's
/// position in samples, wherever the eye is.
///
/// With crack-free propagation the mesh is conforming: triangles neither gap nor overlap nor touch
/// an edge between its ends. The triangles for a narrower frustum are triangles of the unculled
/// mesh, and every one of those that reaches into the frustum is there.
class QuadtreeMesher {
public:
    /// `colours` has one colour for each sample, as in ColourVertex, row after row from the south
    /// (its size is asserted). Tree and colours must outlive the mesher.
    QuadtreeMesher(const Quadtree& tree, std::span<const std::uint32_t> colours);

    /// Takes these colours in place of those before, from the next mesh on.
    void set_colours(std::span<const std::uint32_t> colours);

    /// The mesh at a given C. `detail.roughness_weight` must be at least 0 and below 1e6
    /// (asserted).
    GroundMesh mesh(const MeshView& view, const QuadtreeDetail& detail);

    /// The mesh at the largest C up to which none has more triangles than the budget, whatever was
    /// meshed before; `detail.resolution` is not used. It has as many triangles as the steps of
    /// N(C) allow: fewer where C ends at `budget.max_resolution`, and more only if even the tree's
    /// smallest C has more. mesh() at the returned C makes the same triangles.
    GroundMesh
    mesh_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget);

    /// What mesh() and mesh_within() would return of a mesh but its triangles, for less than half
    /// of the work. The mesh before is lost: fans() and triangles_in() are right again once a mesh
    /// is made.
    CountedMesh count(const MeshView& view, const QuadtreeDetail& detail);
    CountedMesh
    count_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget);

    /// The mesh that was counted last; only once after each count (asserted).
    GroundMesh counted_mesh();

    /// The nodes of the last mesh, parents before children, including those without triangles of
    /// their own.
    std::span<const GroundFan> fans() const { return fans_; }

    /// Decides whether the triangles in a box (world axes, metres) are wanted.
    using BoxTest = std::function<bool(const glm::dvec3& min_m, const glm::dvec3& max_m)>;

    /// Appends the numbers of some triangles of the last mesh, ascending: those of the nodes for
    /// which `wanted` accepts the box around all of their samples, and also accepts those of all
    /// their ancestors.
    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree& tree() const { return *tree_; }

private:
    /// Whether a node is switched on by its own f < 1, equation (3).
    bool is_split_by_distance(int level, int column, int row) const {
        return rule_.critical_squared(level, column, row) < limit_;
    }

    static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

    /// Where a fan is in the mesh.
    struct FanRecord {
        /// The fan of each quadrant's child, where there is one.
        std::array<std::uint32_t, 4> child{};
        /// The vertices of the mid-points of fan_edges; no_vertex while there are none.
        std::array<std::uint32_t, 4> middle{no_vertex, no_vertex, no_vertex, no_vertex};
        TriangleRange triangles;    ///< Its own triangles and all of those below it.
        std::uint8_t middles = 0; ///< Bit k: edge k of fan_edges has a mid-point.
    };

    /// A fan while it is put into the mesh. Corners are vertices of the parent's fan, and centres
    /// are nobody else's; mid-points are shared with the fan of the same level beyond the edge.
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

    bool is_split(int level, int column, int row) const;
    void visit(GroundFan fan, unsigned planes);
    std::size_t add(const GroundFan& fan, unsigned middles);
    void start(const MeshView& view);
    void collect(const MeshView& view, const QuadtreeDetail& detail);
    void collect_within(const MeshView& view, const QuadtreeDetail& detail, const TriangleBudget& budget);
    CountedMesh count_fans();
    unsigned triangle_count_of(std::size_t own) const;
    void reserve();
    void emit(std::uint32_t own, EmittedFan* parent, unsigned quadrant);
    void emit_part(EmittedFan& fan, unsigned part);
    std::array<std::uint32_t, 4> fans_beyond(const EmittedFan& parent, unsigned quadrant) const;
    std::uint32_t vertex_of(EmittedFan& fan, std::size_t place);
    std::uint32_t middle_vertex(const EmittedFan& fan, std::size_t edge);
    std::uint32_t add_vertex(GridSample at);
    unsigned midpoints_of(const GroundFan& fan) const;
    bool has_neighbour(const GroundFan& fan, int east, int north) const;
    void add_triangles_in(
        std::uint32_t fan, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree* tree_;
    std::span<const std::uint32_t> colours_;

    QuadtreeCriterion rule_;
    QuadtreeSelection survey_;
    float limit_ = 0.0F;        ///< QuadtreeCriterion::limit_squared of the mesh.
    double resolution_ = 0.0;   ///< C of the mesh.
    bool is_collected_ = false; ///< fans_ are those of a mesh that is to be made.

    std::vector<GroundFan> fans_;
    std::vector<FanRecord> fan_records_; ///< One for each of fans_.
    /// For each level the last fan, while they are collected.
    std::array<std::uint32_t, 16> last_fan_of_level_{};
    const PartOrder* orders_ = nullptr; ///< The painting_orders of the view.
    glm::dvec2 eye_{0.0};               ///< In samples east and north of the field's first sample.
    std::vector<std::uint8_t> in_mesh_; ///< One flag for each node; all are 0 between frames.
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::uint32_t vertex_count_ = 0;
    std::size_t index_count_ = 0;
    MeshCounters counters_;
};

} // namespace octant::visuals::terrain
