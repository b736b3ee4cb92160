#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/bisection_criterion.h"
#include "visuals/terrain/bisection_horizon_error.h"
#include "visuals/terrain/bisection_selection.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/paint_order.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// With geomorphs a vertex is at its own sample when its error, as seen from its region of influence, is this many
/// times the wanted one, or earlier where samples need it (bisection_mesher.cpp), and still between its ends when it is
/// no more than the wanted one.
inline constexpr float morph_ratio = 2.5F;

/// Makes the mesh of a ground by screen-space error, frame after frame in the same memory, with the triangles in the
/// view's painting order. Its memory grows with the mesh, not with the ground.
///
/// The mesh is conforming: triangles neither gap nor overlap nor touch an edge between its ends. The triangles for a
/// narrower frustum are triangles of the unculled mesh. Every sample in the picture is within the mesh's error_px of
/// the triangles, where the view has a direction. With geomorphs a vertex appears and disappears in the middle of the
/// edge that it halves, and moves to its sample as far as that bound asks.
class BisectionMesher {
public:
    /// `ground` must outlive the mesher and stay where it is.
    explicit BisectionMesher(const GroundTiles& ground);
    BisectionMesher(const BisectionMesher&) = delete;
    BisectionMesher& operator=(const BisectionMesher&) = delete;
    BisectionMesher(BisectionMesher&&) = delete;
    BisectionMesher& operator=(BisectionMesher&&) = delete;
    ~BisectionMesher() = default;

    /// The mesh at the smallest error, at or above the target's, at which and above which it has at most the target's
    /// number of triangles. It does not depend on earlier meshes. With geomorphs and a budget it is also at or above
    /// that of HorizonError: where the horizon is not in the picture, the budget may not be used up. The mesh is
    /// returned again, without work, when view and target are those of the last call. Colours are left to vertices().
    /// Besides the vertices of triangles there may be others from whose middle a vertex appears. Vertices and indices
    /// stay valid until the next mesh but one, so that a mesh can be drawn while the next is made; morphs until the
    /// next mesh.
    GroundMesh mesh(const MeshView& view, const ErrorTarget& target);

    /// The vertices of the last mesh, so that their colours can be set.
    std::span<models::ColourVertex> vertices() { return std::span(vertices_).first(vertex_count_); }

    /// Says that the next view has nothing in common with the last one. Only saves time: the mesh is the same.
    void expect_other_view();

    /// Decides whether the triangles in a box (world axes, metres) are wanted.
    using BoxTest = std::function<bool(const glm::dvec3& min_m, const glm::dvec3& max_m)>;

    /// Appends the numbers of some triangles of the last mesh, ascending: those of the nodes for which `wanted` accepts
    /// the box around all of their triangles as drawn, and also accepts those of all their ancestors.
    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const GroundTiles& ground() const { return *ground_; }

private:
    static constexpr std::uint32_t root_node = 1; ///< BisectionSelection::nodes

    /// Four vertices or nodes of a fan.
    using Four = std::array<std::uint32_t, 4>;

    /// The lowest and highest point of a node's triangles as drawn, relative to the eye.
    struct DrawnHeights {
        float lowest_m = std::numeric_limits<float>::infinity();
        float highest_m = -std::numeric_limits<float>::infinity();
    };

    /// A fan while it is put into the mesh.
    struct EmittedFan {
        std::uint32_t node;
        /// The vertices in the order of fan_ring, mid-points only where they are used, and then the centre.
        std::array<std::uint32_t, 9> ring;
        std::uint32_t parent_a; ///< An end of the edge whose middle the centre is.
        std::uint32_t parent_b;
        Four beyond; ///< The nodes beyond fan_edges; 0 = none.
        /// Of the triangles that are in the mesh so far, those of the nodes below included.
        DrawnHeights heights;
    };

    /// A vertex before it is made.
    struct NewVertex {
        GridSample at{};
        std::uint32_t parent_a = 0;
        std::uint32_t parent_b = 0;
        std::int16_t height = 0; ///< The height as stored.
        float weight = 1.0F;
    };

    /// The vertex at a sample where the field's border crosses an edge of the mesh.
    struct BorderVertex {
        std::uint32_t mesh = 0; ///< The last mesh that had it, by mesh_number_.
        std::uint32_t vertex = 0;
    };

    void reserve();
    EmittedFan root_fan();
    std::uint32_t fixed_vertex(GridSample at, std::int16_t height);
    template <typename ShareBelow>
    float weight_of(float critical, const ShareBelow& share_below) const;
    std::uint32_t add_vertex(const NewVertex& made);
    void emit(EmittedFan& fan);
    void emit_part(EmittedFan& fan, unsigned part);
    void reserve_border();
    void emit_part_within_border(EmittedFan& fan, const FanSamples& samples, unsigned part);
    std::uint32_t border_vertex(const ClipVertex& corner);
    EmittedFan child_of(const EmittedFan& fan, unsigned quadrant);
    void add_centre(const FanSamples& samples, std::int16_t height, EmittedFan& fan);
    void add_midpoints(const FanSamples& samples, const LevelReader::NodeSlot& slot, unsigned middles, EmittedFan& fan);
    std::uint32_t add_midpoint(const FanSamples& samples, std::int16_t height, const EmittedFan& fan, std::size_t edge);
    bool is_drawn(const BisectionNode& node, unsigned quadrant) const;
    Four drawn_children(const BisectionNode& node) const;
    void add_height(std::uint32_t vertex, DrawnHeights& heights) const;
    void add_triangles_in(std::uint32_t node, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const GroundTiles* ground_;
    BisectionCriterion criterion_;
    BisectionSelection selection_;
    HorizonError horizon_;
    MeshView view_; ///< The view of the last mesh.
    ErrorTarget target_;
    GroundMesh mesh_;
    bool has_mesh_ = false;

    std::span<const BisectionNode> nodes_;
    /// For each node the vertices of its mid-points; 0 = none yet.
    std::vector<Four> middle_vertex_;
    std::vector<TriangleRange> triangle_ranges_; ///< For each node that is in the mesh.
    std::vector<DrawnHeights> drawn_heights_;    ///< For each node that is in the mesh.
    float limit_ = 0.0F;
    float morph_limit_ = 0.0F;          ///< Equal to limit_, or infinite without geomorphs.
    double height_base_m_ = 0.0;        ///< The height of the stored number 0, relative to the eye.
    const PartOrder* orders_ = nullptr; ///< The painting_orders of the view.
    glm::dvec2 eye_{0.0};               ///< In samples east and north of the field's first sample.
    std::vector<models::ColourVertex> vertices_;
    std::vector<VertexMorph> morphs_;
    std::vector<std::uint32_t> indices_;
    std::vector<models::ColourVertex> last_vertices_; ///< The vertices of the last mesh but one.
    std::vector<std::uint32_t> last_indices_;
    /// For each sample on the last column and then on the last row.
    std::vector<BorderVertex> border_vertices_;
    std::uint32_t mesh_number_ = 0;
    std::size_t cut_nodes_ = 0; ///< The number of nodes of this mesh that the field's border cuts.
    std::uint32_t vertex_count_ = 0;
    std::size_t index_count_ = 0;
    MeshCounters counters_;
};

} // namespace octant::visuals::terrain
