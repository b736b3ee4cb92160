#pragma once

#include <optional>

namespace octant::visuals::terrain {

// What --terrain-lod chooses, and all constants by which the paper's method is tuned. "Paper" is E. K. Choi, B. S.
// Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect", with its equation numbers.

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

/// What decides where the ground is refined.
enum class GroundMetric {
    Printed,    ///< The paper's quadtree with Roughness::Printed.
    Midpoint,   ///< The paper's quadtree with Roughness::Midpoint.
    ScreenError ///< Longest-edge bisection by a bound of the error in pixels.
};

/// How the triangles of the paper's quadtree are held near their target.
enum class DetailControl {
    Exact,    ///< Triangles are counted before the mesh is made: TriangleBudget.
    Damped,   ///< Equation (5) where control_a is given, else ControlMethod::Tuned.
    Previous, ///< Equation (4).
    Literal,  ///< Figure 6, which holds no target.
    Fixed     ///< C stays as it is.
};

/// The value of --terrain-lod. All members but `metric` are of the paper's quadtree.
struct TerrainLod {
    /// Nothing = as ground_metric() says.
    std::optional<GroundMetric> metric;
    RoughnessPropagation propagation = RoughnessPropagation::CrackFree;
    FanKind fans = FanKind::Partial;
    DetailControl control = DetailControl::Exact;
    /// C of the first frame; 0 = the one that meets the triangle budget.
    double resolution_c = 0.0;
    /// QuadtreeDetail::roughness_weight. Nothing: 20 for midpoint, 5 for printed.
    std::optional<double> roughness_c;
    /// ControlSettings::triangles_per_resolution, the paper's a; 0 = from the ground's own gain.
    double control_a = 0.0;
    /// ControlSettings::averaged_frames, the paper's r.
    int control_r = 4;

    bool operator==(const TerrainLod&) const = default;
};

/// The metric that is chosen; without a choice ScreenError, but Midpoint where a member is set that only the paper's
/// quadtree has.
GroundMetric ground_metric(const TerrainLod& lod);

/// Whether detail can go on from frame to frame when one choice replaces the other.
bool same_detail_control(const TerrainLod& a, const TerrainLod& b);

/// How a quadtree is built.
struct QuadtreeOptions {
    Roughness roughness = Roughness::Midpoint;
    RoughnessPropagation propagation = RoughnessPropagation::CrackFree;
    /// C_min, the smallest resolution with which the tree may be meshed, at least 1.6 (below that even flat ground
    /// cracks). It sets K = 0.5 + sqrt(2.5) / (2 C_min): a smaller one makes the ancestors rougher. The paper has none.
    double min_resolution = 2.0;
};

/// How a quadtree is meshed; may change in each frame.
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
    /// Equation (4) with the a that makes g = 1, which is measured in flight by several meshes of a frame. The settings
    /// a, r and g are not used.
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
    /// that is higher (without it C would cross the same step again and again). At a standing view it is reached within
    /// 15 frames and kept, for any gain up to 5. From 0 to about 0.05; 0 is equation (5) as printed. Paper: none.
    double dead_band = 0.005;
    /// For Tuned: a frame's mesh is made again, up to max_tuned_meshes in all, while N misses the target by more than
    /// this share of it and C can still bring it nearer.
    double tuned_band = 0.0004;
    double min_resolution = 2.0;    ///< C is kept at or above it; it is the quadtree's C_min.
    double max_resolution = 1000.0; ///< C is kept at or below it.
};

inline constexpr int max_averaged_frames = 8;
inline constexpr int max_tuned_meshes = 4;

/// A number of triangles that no mesh reaches: there is no budget.
inline constexpr int unlimited_triangles = 1'000'000'000;

/// How many triangles a mesh may have. The paper has no budget; it steers by the meshes of earlier frames.
struct TriangleBudget {
    int triangles = 20000; ///< At least 1.
    /// C is kept at or below it, even if that leaves triangles unspent. At 500 the short sides of flat triangles, half
    /// a node's edge, are 1 mrad, which is 0.87 pixels of 720 lines over 45 degrees.
    double max_resolution = 500.0;
};

/// How the quadtree is built: Roughness::Midpoint unless the metric is Printed.
QuadtreeOptions quadtree_options(const TerrainLod& lod);

/// How the quadtree is meshed; C is left to the control.
QuadtreeDetail quadtree_detail(const TerrainLod& lod);

/// How C is controlled. The target is left at its default: it comes with each frame.
ControlSettings control_settings(const TerrainLod& lod);

} // namespace octant::visuals::terrain
