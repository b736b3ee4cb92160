#pragma once

#include "visuals/terrain/bisection_criterion.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/budget_search.h"
#include "visuals/terrain/terrain_lod.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

/// The target of a mesh by screen-space error.
struct ErrorTarget {
    /// The target error, at or above zero. With 0 every sample is used that is not on a straight line.
    double error_px = 1.0;
    /// The error becomes larger where the mesh would exceed this number. unlimited_triangles: there is no budget.
    int max_triangles = 32000;
    bool geomorphs = true;

    bool operator==(const ErrorTarget&) const = default;
};

/// The smallest target error with the full morph margin, without a budget. S, the speed of a vertex, is
/// |d offset / d ln(distance)| / target error, where the offset is the distance of the vertex from its sample
/// (bisection_tile_builder.cpp). Below this target error the largest speed is S * full_margin_px pixels. With 14,
/// vertices jump by at most 0.25 px a frame along the four paths over three maps at 2 px, with 18 by 0.31 px.
inline constexpr double full_margin_px = 14.0;

/// Above this target error the share of the margin grows with its square, because S grows with a sample's error: a
/// larger error makes its vertex move farther away from the eye.
inline constexpr double near_margin_px = 2.0;

/// The share of the full morph margin that vertices get: 1 with a budget, because it changes the target error from
/// frame to frame; otherwise proportional to the target error.
double margin_share(const ErrorTarget& target);

/// A node whose fan is in the mesh at some limits. A limit is about (focal length / error in pixels)^2
/// (BisectionCriterion::limit_of), so that a larger one gives a finer mesh. The limits of the node's members are the
/// smallest at which each part exists.
struct alignas(64) BisectionNode {
    Float4 middle{};   ///< The mid-points of fan_edges.
    Float4 quadrant{}; ///< The fans of the children.
    /// The nodes of those children that were visited; 0 = none.
    std::array<std::uint32_t, 4> child{};
    float node_limit = 0.0F; ///< The fan itself, by its centre.
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    std::uint8_t level = 0;
    std::uint8_t hidden = 0; ///< The quadrants outside the frustum or the field.
};

/// Collects the nodes of a mesh by screen-space error, and finds the error at which the mesh has a budget of triangles,
/// exactly and before the mesh is made.
class BisectionSelection {
public:
    /// The criterion must outlive the selection.
    explicit BisectionSelection(const BisectionCriterion& criterion) : criterion_(&criterion) {}

    /// The limit that belongs to the smallest error, at or above the target's, for which no larger error gives more
    /// triangles than allowed. The root's fan is always in the mesh.
    float limit_for(const ErrorTarget& target);

    /// Says that the next view has nothing in common with the last one. Only saves time: the result is the same.
    void expect_other_view() { is_other_view_ = true; }

    /// At least the nodes of all meshes up to the limit that was found, parents before children. Entry 0 stands for no
    /// node; entry 1 is the root.
    std::span<const BisectionNode> nodes() const { return std::span(nodes_).first(count_); }

    int nodes_tested() const { return nodes_tested_; }

private:
    /// A node that is to be collected.
    struct NewNode {
        NodeContext place;         ///< `distances` is not set.
        std::size_t distances = 0; ///< Those of its parent.
        unsigned planes = 0;       ///< The frustum planes that it may reach beyond.
        float node_limit = 0.0F;   ///< The critical value of its centre.
        float error_m = 0.0F;      ///< The error of its centre.
        int replaced = 0;          ///< How many triangles of its parent it replaces.
    };

    /// What is known of a collected node for counting it and for collecting its children.
    struct NodeState {
        Float4 quadrant_error_m{};
        std::array<std::uint8_t, 4> planes{};      ///< Those that the children may reach beyond.
        std::array<std::uint8_t, 4> of_quadrant{}; ///< The triangles that a child replaces.
        std::uint32_t distances = 0;               ///< The index of its VerticalDistances.
        std::uint8_t replaced = 0;
        bool is_cut = false; ///< By the field's border.
    };

    void start();
    std::uint32_t collect(const NewNode& made);
    template <bool counting>
    bool walk(float high, int max_triangles);
    void collect_child(std::uint32_t parent, unsigned quadrant);
    bool is_cut(const GroundLayout::Level& at, const NodeContext& place) const;
    unsigned test_children(const NewNode& made, const VerticalDistances& distances, NodeState& state);
    bool count(std::uint32_t own, float high);

    const BisectionCriterion* criterion_;
    std::vector<BisectionNode> nodes_;
    std::vector<NodeState> states_; ///< Of nodes_.
    std::size_t count_ = 0;
    StepFunction steps_;
    std::vector<VerticalDistances> distances_; ///< Of the collected nodes of levels with height ranges.
    /// With geomorphs a vertex is drawn off its sample, by at most the error of the centre of its node's parent. The
    /// box of a node is then larger by that error when it is tested against the frustum.
    bool geomorphs_ = false;
    bool is_other_view_ = true;
    int nodes_tested_ = 0;
    double last_error_px_ = 0.0; ///< 0 before the first call.
};

} // namespace octant::visuals::terrain
