#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/budget_survey.h"
#include "visuals/terrain/detail_settings.h"
#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/paint_order.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/split_rule.h"
#include "visuals/terrain/triangle_runs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// Makes the mesh of a quadtree for an eye point, frame after frame in the same memory, its
/// triangles in the view's painting order. The order is exact up to the rounding of the eye's place
/// in samples, wherever the eye is.
///
/// With crack-free propagation the triangles neither gap nor overlap nor touch an edge between its
/// ends, and those of a narrower frustum are triangles of the unculled mesh: every one that
/// reaches into the frustum is there.
class Mesher {
public:
    /// `colours`: one per sample as in ColourVertex, row after row from the south (size asserted).
    /// Tree and colours must outlive the mesher.
    Mesher(const Quadtree& tree, std::span<const std::uint32_t> colours);

    /// `detail.roughness_weight` is at least 0 and below 1e6 (asserted).
    GroundMesh mesh(const MeshView& view, const Detail& detail);

    /// The mesh at the largest C up to which none has more triangles than the budget, whatever was
    /// meshed before; `detail.resolution` is not looked at. It has as many as the steps of N(C)
    /// allow, fewer where C ends at `budget.max_resolution`, and more only where those at the
    /// tree's smallest C already are. mesh() at the C returned makes the same triangles.
    GroundMesh
    mesh_within(const MeshView& view, const Detail& detail, const TriangleBudget& budget);

    /// Nodes of the last mesh, parents before children, also those without triangles of their own.
    std::span<const GroundFan> fans() const { return fans_; }

    /// Whether a box (world axes, metres) is looked for.
    using BoxTest = std::function<bool(const glm::dvec3& least_m, const glm::dvec3& most_m)>;

    /// Appends the numbers of those triangles of the last mesh, ascending, that belong to nodes of
    /// whose box around all their samples `wanted` says yes, as it does of their ancestors'.
    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree& tree() const { return *tree_; }

private:
    bool wants_split(int level, int column, int row) const {
        return rule_.critical_squared(level, column, row) < limit_;
    }

    /// Where a fan stands in the mesh.
    struct FanPlace {
        std::array<std::uint32_t, 4> child{}; ///< fan by quadrant, where there is one
        TriangleRun triangles;                ///< its own and all below it
        std::uint8_t middles = 0;             ///< bit k: edge k of fan_edges has a mid-point
    };

    /// Indices of the samples of fan_ring less the centre's.
    using Ring = std::array<std::ptrdiff_t, 8>;

    static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

    /// A fan while it is put into the mesh.
    struct EmittedFan {
        const FanSamples& samples;
        const std::array<std::uint32_t, 4>& child; ///< as FanPlace::child
        const std::ptrdiff_t* ring;                ///< eight
        std::ptrdiff_t centre;                     ///< index of the sample
        std::uint32_t centre_vertex = no_vertex;
    };

    bool is_split(int level, int column, int row) const;
    void visit(GroundFan fan, unsigned planes);
    std::size_t add(const GroundFan& fan, unsigned middles);
    void start(const MeshView& view);
    void make_room();
    GroundMesh finished(double resolution);
    void emit(std::uint32_t fan);
    void emit_part(EmittedFan& fan, unsigned part);
    std::ptrdiff_t index_of(Sample at) const;
    template <typename At>
    std::uint32_t vertex_at(std::ptrdiff_t sample, const At& at);
    void add_vertex(Sample at, std::uint32_t colour);
    unsigned middles_of(const GroundFan& fan) const;
    bool has_neighbour(const GroundFan& fan, int east, int north) const;
    void add_triangles_in(
        std::uint32_t fan, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const Quadtree* tree_;
    std::span<const std::uint32_t> colours_;

    SplitRule rule_;
    BudgetSurvey survey_;
    float limit_ = 0.0F; ///< SplitRule::limit_squared of the mesh

    std::vector<Ring> rings_; ///< of fans that are not cut, by level
    std::vector<GroundFan> fans_;
    std::vector<FanPlace> places_;                ///< of fans_
    std::array<std::uint32_t, 16> newest_{};      ///< fan by level, while they are collected
    const PartOrder* orders_ = nullptr;           ///< painting_orders of the view
    glm::dvec2 eye_{0.0};                         ///< samples east and north of the field's first
    std::vector<std::uint8_t> in_mesh_;           ///< per node, all 0 between frames
    std::vector<std::uint32_t> vertex_of_sample_; ///< first_stamp_ + vertex, smaller: none yet
    std::uint32_t first_stamp_ = 1;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::uint32_t vertex_count_ = 0;
    std::size_t index_count_ = 0;
    MeshCounters counters_;
};

} // namespace octant::visuals::terrain
