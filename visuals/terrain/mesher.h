#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/budget_survey.h"
#include "visuals/terrain/detail_settings.h"
#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/split_rule.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// Makes the mesh of a quadtree for an eye point, frame after frame in the same memory.
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

    /// Nodes of the last mesh in drawing order, parents before children, also those without
    /// triangles of their own.
    std::span<const GroundFan> fans() const { return fans_; }

    const Quadtree& tree() const { return *tree_; }

private:
    bool wants_split(int level, int column, int row) const {
        return rule_.critical_squared(level, column, row) < limit_;
    }

    bool is_split(int level, int column, int row) const;
    void visit(GroundFan fan, unsigned planes);
    void make_room(std::size_t fans);
    GroundMesh finished(double resolution);
    void emit(const GroundFan& fan, unsigned middles);
    unsigned middles_of(const GroundFan& fan) const;
    bool has_neighbour(const GroundFan& fan, int east, int north) const;
    std::uint32_t vertex_at(Sample at);

    const Quadtree* tree_;
    std::span<const std::uint32_t> colours_;

    SplitRule rule_;
    BudgetSurvey survey_;
    float limit_ = 0.0F; ///< SplitRule::limit_squared of the mesh

    std::vector<GroundFan> fans_;
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
