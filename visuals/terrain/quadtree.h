#pragma once

#include "models/heights/height_field.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::terrain {

// All constants by which the terrain's detail is tuned. "Paper" is E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD
// Method that Minimize Flickering Effect", with its equation numbers.

/// What is measured as the roughness d2 of a node, equation (2): (1/d) max |dh_i|, i = 1..6, over the four sides and
/// two diagonals of a node with edge length d.
enum class Roughness {
    Printed, ///< As printed: dh is the height difference between the two ends of a line.
    Midpoint ///< Roettger: dh is the true height at a line's middle minus the mean of its ends.
};

/// How a rough node makes its ancestors rough.
enum class RoughnessPropagation {
    /// d2 = max(own, K d2(child)) in the parent and in the two parents beyond the child's outer edges, so that
    /// neighbouring leaves differ by one level at most.
    CrackFree,
    /// d2 = max(own, d2(child)) in the parent only, as printed; this leaves cracks.
    Printed
};

/// Which children a node gets when it splits.
enum class FanKind {
    Partial, ///< Each child quadrant is switched on by its own f < 1; the others stay in the fan.
    Full     ///< All four children are switched on together.
};

/// What is fixed when a quadtree is built.
struct QuadtreeOptions {
    Roughness roughness = Roughness::Midpoint;
    RoughnessPropagation propagation = RoughnessPropagation::CrackFree;
    /// C_min, the smallest resolution with which the tree may be meshed, at least 1.6 (below that even flat ground
    /// cracks). It sets K = 0.5 + sqrt(2.5) / (2 C_min): a smaller one makes the ancestors rougher. The paper has none.
    double min_resolution = 2.0;
};

/// What may change from frame to frame.
struct QuadtreeDetail {
    /// C of equations (1) and (3): flat nodes split when they are nearer than C times their edge length. The number of
    /// triangles grows at most with its square. Raised to C_min where it is below. Paper: controlled.
    double resolution = 16.0;
    /// c of equation (3): a node of roughness d2 splits up to max(c d2, 1) times farther away; 0 ignores roughness. The
    /// paper finds 1 best and compares with 5, both for literal roughness. Mid-point roughness is smaller; 20 for it
    /// and 5 for the literal one are the values above which the error on real ground does not get any less.
    double roughness_weight = 20.0;
    FanKind fans = FanKind::Partial; ///< The paper mentions both.
};

/// Which rule takes C from one frame to the next.
enum class ControlMethod {
    Previous, ///< Equation (4): C + (target - N) / a.
    Damped,   ///< Equation (5): the weighted mean of the last r + 1 results of (4).
    /// Equation (4) with the a that makes g = 1, which is found out while flying: several meshes of a frame tell it. No
    /// a, r or g is to be chosen.
    Tuned,
    Printed ///< Figure 6: C - (N - N of the frame before) / a. It holds no target.
};

/// How the number of triangles N is held near a target. Only the loop gain g = (dN/dC) / a decides what happens at a
/// fixed view: Previous converges steadily for g < 1, rings for g < 2 and oscillates for ever above that; Damped (r =
/// 4) settles up to g = 6.
struct ControlSettings {
    ControlMethod method = ControlMethod::Damped;
    /// N_target, in triangles, above zero. Paper: not given.
    double target_triangles = 20000.0;
    /// a of equation (4), in triangles for a unit of C. Paper: 5000, in units that it does not state. 0 or less means
    /// that it is chosen anew in each frame for the loop gain below.
    double triangles_per_resolution = 0.0;
    /// g of the automatic a = p max(N, target) / (g C), which assumes N ~ C^p. Stable below 2 (Previous) and 6
    /// (Damped). Paper: none.
    double loop_gain = 1.0;
    /// p of the automatic a. Values of 1.1 to 1.9 were observed on real ground; when it is taken too high, the loop
    /// only gets calmer. Paper: none.
    double growth_exponent = 2.0;
    /// r of equation (5): how many earlier frames are averaged, with weights r+1, ..., 2, 1 over their sum, newest
    /// first. Even, so that up and down cancel; 0 to max_averaged_frames. Paper: 4.
    int averaged_frames = 4;
    /// For Damped: the share of the target by which N may miss it without C being changed, or one step of N(C) where
    /// that is higher (without this C creeps over the same step for ever). At a standing view it is reached within 15
    /// frames and kept, for any gain up to 5. From 0 to about 0.05; 0 is equation (5) as printed. Paper: none.
    double dead_band = 0.005;
    /// For Tuned: a frame's mesh is made again, up to max_tuned_meshes in all, while N misses the target by more than
    /// this share of it and C can still bring it nearer.
    double tuned_band = 0.0004;
    double min_resolution = 2.0;    ///< C is kept at or above it; it is the quadtree's C_min.
    double max_resolution = 1000.0; ///< C is kept at or below it.
};

inline constexpr int max_averaged_frames = 8;
inline constexpr int max_tuned_meshes = 4;

/// How many triangles a mesh may have. The paper has no budget; it steers by the meshes of earlier frames.
struct TriangleBudget {
    int triangles = 20000; ///< At least 1.
    /// C is kept at or below it, even if that leaves triangles unspent. At 500 the short sides of flat triangles, half
    /// a node's edge, are 1 mrad, which is 0.87 pixels of 720 lines over 45 degrees.
    double max_resolution = 500.0;
};

/// What a node of the quadtree stores, rounded to the safe side. 4 bytes.
struct QuadtreeNode {
    std::uint16_t roughness = 0; ///< d2 as five bits of exponent and eleven bits of fraction.
    std::uint8_t lowest = 0;     ///< In 255ths of the field's height range.
    std::uint8_t highest = 0;    ///< In 255ths of the field's height range.
};

/// The d2 that a node stands for: at most 0.05 % above the value that was stored.
inline float roughness_of(const QuadtreeNode& node) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(node.roughness) << 12U) * 0x1p112F;
}

/// A quadtree over a height field of any size. Level 0 is the root; each level halves the edge; the nodes of the last
/// level have an edge of two samples. The field is thought of as padded to a square of 2^n + 1 samples by repeating its
/// last column and row *in place* (a padded sample lies on the field's border), so that everything beyond the field has
/// no area. Nodes without area do not exist. Node (column, row) of a level covers the samples from column *
/// edge_samples(level) to (column + 1) * edge_samples(level), as far as they are within the field.
class Quadtree {
public:
    /// Computes all nodes. The field must outlive the tree and stay where it is. The options must be as their comments
    /// demand (asserted).
    explicit Quadtree(const models::heights::HeightField& field, const QuadtreeOptions& options = {});

    const models::heights::HeightField& field() const { return *field_; }

    const QuadtreeOptions& options() const { return options_; }

    int levels() const { return static_cast<int>(levels_.size()); }

    /// The edge of a node in samples: a power of two, 2 on the last level.
    int edge_samples(int level) const { return 1 << (levels() - level); }

    /// The number of nodes with an area from west to east.
    int columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }

    /// The number of nodes with an area from south to north.
    int rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }

    /// The index of a node in nodes().
    std::size_t index_of(int level, int column, int row) const {
        const Level& at = levels_[static_cast<std::size_t>(level)];
        return at.first + static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
               static_cast<std::size_t>(column);
    }

    /// All nodes, level after level from the root, row after row from the south.
    std::span<const QuadtreeNode> nodes() const { return nodes_; }

    /// d2 of a node after propagation, equation (2).
    float roughness(int level, int column, int row) const { return roughness_of(nodes_[index_of(level, column, row)]); }

    /// A height at or below every sample of the node, in metres, and never far below.
    double lowest_m(const QuadtreeNode& node) const { return base_m_ + node.lowest * step_m_; }

    /// A height at or above every sample of the node, in metres, and never far above.
    double highest_m(const QuadtreeNode& node) const { return base_m_ + node.highest * step_m_; }

private:
    struct Level {
        std::size_t first;
        int columns;
        int rows;
    };

    void measure(int level);
    void measure_last_bounds();
    void merge_child_bounds(int level, int column, int row);
    void propagate_from_children(int level);
    float max_child_roughness(int level, int column, int row) const;

    const models::heights::HeightField* field_;
    QuadtreeOptions options_;
    double base_m_;
    double step_m_;
    std::vector<Level> levels_;
    std::vector<QuadtreeNode> nodes_;
};

} // namespace octant::visuals::terrain
