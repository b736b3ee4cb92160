#pragma once

#include "models/colour_vertex.h"
#include "visuals/terrain/error_rule.h"
#include "visuals/terrain/error_survey.h"
#include "visuals/terrain/fan_shape.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/paint_order.h"
#include "visuals/terrain/triangle_runs.h"

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

/// Makes the mesh of a ground by screen-space error, frame after frame in the same memory, its
/// triangles in the view's painting order. Its memory grows with the mesh, not with the ground.
///
/// The triangles neither gap nor overlap nor touch an edge between its ends, and those of a
/// narrower frustum are triangles of the unculled mesh. Without geomorphs no sample of the ground
/// is seen farther from the triangles than the mesh's error_px. With them a vertex that comes or
/// goes does so in the middle of the edge that it halves.
class ErrorMesher {
public:
    /// `ground` must outlive the mesher and stay where it is.
    explicit ErrorMesher(const GroundTiles& ground);
    ErrorMesher(const ErrorMesher&) = delete;
    ErrorMesher& operator=(const ErrorMesher&) = delete;
    ErrorMesher(ErrorMesher&&) = delete;
    ErrorMesher& operator=(ErrorMesher&&) = delete;
    ~ErrorMesher() = default;

    /// The mesh at the smallest error, at or above the target's, up from which none has more
    /// triangles than the target's, whatever was meshed before; the same as before, without work,
    /// where view and target are. Colours are left to vertices(). Beside used samples, vertices may
    /// be ends of others. Vertices and indices last until the next mesh but one, so that a mesh can
    /// be drawn while the next is made; origins until the next.
    GroundMesh mesh(const MeshView& view, const ErrorTarget& target);

    /// Those of the last mesh, to be coloured.
    std::span<models::ColourVertex> vertices() { return std::span(vertices_).first(vertex_count_); }

    /// Does now the work that triangles_in() would else do first. Colours are not looked at.
    void measure_boxes() const;

    /// Whether a box (world axes, metres) is looked for.
    using BoxTest = std::function<bool(const glm::dvec3& least_m, const glm::dvec3& most_m)>;

    /// Appends the numbers of those triangles of the last mesh, ascending, that belong to nodes of
    /// whose box around all their triangles as drawn `wanted` says yes, as it does of their
    /// ancestors'. Not from two threads at a time.
    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const GroundTiles& ground() const { return *ground_; }

private:
    static constexpr std::uint32_t root_node = 1; ///< ErrorSurvey::nodes

    using Four = std::array<std::uint32_t, 4>; ///< vertices or nodes

    /// Lowest and highest of the triangles of a node as drawn, eye subtracted.
    struct DrawnHeights {
        float lowest_m = std::numeric_limits<float>::infinity();
        float highest_m = -std::numeric_limits<float>::infinity();
    };

    /// A fan while it is put into the mesh.
    struct EmittedFan {
        std::uint32_t node;
        std::array<std::uint32_t, 9> ring; ///< vertices by fan_ring, mid-points only where they are
                                           ///< used, then the centre
        std::uint32_t end_a;               ///< of the centre
        std::uint32_t end_b;
        Four beyond; ///< nodes beyond fan_edges; 0 = none
    };

    /// A vertex to be made.
    struct NewVertex {
        Sample at{};
        std::uint32_t end_a = 0;
        std::uint32_t end_b = 0;
        float share = 0.5F;      ///< of end b where it appears
        std::int16_t height = 0; ///< as stored
        float critical = 0.0F;
    };

    void make_room();
    EmittedFan root_fan();
    std::uint32_t fixed_vertex(Sample at, std::int16_t height);
    std::uint32_t add_vertex(const NewVertex& made);
    std::uint32_t cut_vertex(NewVertex made);
    void emit(EmittedFan& fan);
    void emit_part(const EmittedFan& fan, unsigned part);
    EmittedFan child_of(const EmittedFan& fan, unsigned quadrant);
    void add_centre(const FanSamples& samples, std::int16_t height, EmittedFan& fan);
    void add_middles(
        const FanSamples& samples,
        const LevelMemory::Spot& spot,
        unsigned middles,
        EmittedFan& fan);
    std::uint32_t add_middle(
        const FanSamples& samples, std::int16_t height, const EmittedFan& fan, std::size_t edge);
    bool is_at(Sample at, std::uint32_t vertex) const;
    bool is_drawn(const ErrorNode& node, unsigned quadrant) const;
    Four drawn_children(const ErrorNode& node) const;
    void measure_drawn(std::uint32_t node) const;
    void add_triangles_in(
        std::uint32_t node, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const;

    const GroundTiles* ground_;
    ErrorRule rule_;
    ErrorSurvey survey_;
    MeshView view_; ///< of the last mesh
    ErrorTarget target_;
    GroundMesh mesh_;
    bool meshed_ = false;

    std::span<const ErrorNode> nodes_;
    std::vector<Four> middle_vertex_;         ///< of nodes_; 0 = none yet
    std::vector<TriangleRun> runs_;           ///< of nodes_ in the mesh
    mutable std::vector<DrawnHeights> drawn_; ///< of nodes_ in the mesh
    mutable bool drawn_measured_ = false;
    float limit_ = 0.0F;
    float morph_limit_ = 0.0F;          ///< limit_, infinite without geomorphs
    double height_base_m_ = 0.0;        ///< of the stored 0, eye subtracted
    const PartOrder* orders_ = nullptr; ///< painting_orders of the view
    glm::dvec2 eye_{0.0};               ///< samples east and north of the field's first
    std::vector<models::ColourVertex> vertices_;
    std::vector<VertexOrigin> origins_;
    std::vector<float> height_m_; ///< of vertices_ before they are lowered, eye subtracted
    std::vector<std::uint32_t> indices_;
    std::vector<models::ColourVertex> last_vertices_; ///< of the last mesh but one
    std::vector<std::uint32_t> last_indices_;
    std::uint32_t vertex_count_ = 0;
    std::size_t index_count_ = 0;
    MeshCounters counters_;
};

} // namespace octant::visuals::terrain
