#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/detail_settings.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/quadtree.h"

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

    /// Nodes of the last mesh in drawing order, parents before children, also those without
    /// triangles of their own.
    std::span<const GroundFan> fans() const { return fans_; }

    const Quadtree& tree() const { return *tree_; }

private:
    struct Sample {
        int column;
        int row;
    };

    /// What the split rule and the culling need of a level in this frame.
    struct LevelView {
        int edge;          ///< samples
        int columns;       ///< nodes
        int rows;          ///< nodes
        std::size_t first; ///< node
        float half_edge;   ///< samples
        float reach;       ///< C d in samples: flat nodes nearer than this split
    };

    void look_from(const MeshView& view, const Detail& detail);
    bool wants_split(int level, int column, int row) const;
    bool is_split(int level, int column, int row) const;
    unsigned planes_cutting_node(const GroundFan& node, unsigned planes) const;
    void visit(GroundFan fan, unsigned planes);
    void make_room();
    void emit(const GroundFan& fan);
    unsigned middles_of(const GroundFan& fan) const;
    bool has_neighbour(const GroundFan& fan, int east, int north) const;
    std::uint32_t vertex_at(Sample at);

    const Quadtree* tree_;
    std::span<const std::uint32_t> colours_;

    MeshView view_;
    FanKind fan_kind_ = FanKind::Partial;
    float roughness_weight_ = 0.0F;
    float eye_column_ = 0.0F;
    float eye_row_ = 0.0F;
    float eye_height_squared_ = 0.0F; ///< samples^2
    double west_m_ = 0.0;             ///< of the field, eye subtracted
    double south_m_ = 0.0;            ///< of the field, eye subtracted
    std::vector<LevelView> levels_;

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
