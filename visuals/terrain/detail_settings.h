#pragma once

namespace octant::visuals::terrain {

// Every number by which the terrain's detail is tuned, in one place. "Paper" is E. K. Choi, B. S.
// Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect", with its equation numbers.

/// What is measured as the roughness d2 of a node, equation (2): (1/d) max |dh_i|, i = 1..6, over
/// four sides and two diagonals of a node with edge length d.
enum class Roughness {
    Literal, ///< as printed: dh = height difference between the two ends of the line
    Midpoint ///< Roettger: dh = true height at the line's middle minus the mean of its ends
};

/// How a rough node makes its ancestors rough.
enum class Propagation {
    CrackFree, ///< max(own, K d2(child)) in the parent and in the two parents beyond the child's
               ///< outer edges: neighbouring leaves differ by one level at most
    Printed    ///< max(own, d2(child)) in the parent only, as printed: leaves cracks
};

/// What happens when a node splits.
enum class FanKind {
    Partial, ///< each child quadrant is switched on by its own f < 1, the others stay in the fan
    Full     ///< all four children are switched on together
};

/// Fixed when a quadtree is built.
struct QuadtreeOptions {
    Roughness roughness = Roughness::Midpoint;
    Propagation propagation = Propagation::CrackFree;
    /// C_min: smallest resolution the tree may be meshed with. Sets K = 0.5 + sqrt(2.5) / (2
    /// C_min): a smaller one roughens the ancestors more. At least 1.6 (below, even flat ground
    /// cracks). The paper has none.
    double min_resolution = 2.0;
};

/// May change from frame to frame.
struct Detail {
    /// C of equations (1) and (3): flat nodes split when nearer than C times their edge. Number of
    /// triangles grows with its square at most. Raised to C_min where below. Paper: controlled.
    double resolution = 16.0;
    /// c of equation (3): a node of roughness d2 splits up to max(c d2, 1) times farther away. 0
    /// ignores roughness. Paper: 1 best, 5 in the comparison, literal roughness. Mid-point
    /// roughness is smaller: 20 there and 5 with the literal one are where more does not lessen
    /// the error on real ground any further.
    double roughness_weight = 20.0;
    FanKind fans = FanKind::Partial; ///< the paper mentions both
};

/// Which rule takes C from one frame to the next.
enum class ControlMethod {
    Previous, ///< equation (4): C + (target - N) / a
    Damped,   ///< equation (5): weighted mean of the last r + 1 results of (4)
    Literal   ///< figure 6: C - (N - N of the frame before) / a; holds no target
};

/// How the number of triangles N is held near a target. The loop gain g = (dN/dC) / a alone
/// decides what happens at a fixed view: Previous glides for g < 1, rings for g < 2 and
/// oscillates for ever above; Damped (r = 4) settles up to g = 6.
struct ControlSettings {
    ControlMethod method = ControlMethod::Damped;
    /// N_target, triangles, above zero. Paper: not given.
    double target_triangles = 20000.0;
    /// a of equation (4), triangles per unit of C. Paper: 5000, in units it does not state. 0 or
    /// less: chosen anew each frame for the loop gain below.
    double triangles_per_resolution = 0.0;
    /// g for the automatic a = p max(N, target) / (g C), which takes N ~ C^p. Stable below 2
    /// (Previous) and 6 (Damped). Paper: none.
    double loop_gain = 1.0;
    /// p for the automatic a. Observed 1.1 to 1.9 on real ground; taken too high, the loop only
    /// gets calmer. Paper: none.
    double growth_exponent = 2.0;
    /// r of equation (5): how many earlier frames are averaged, weights r+1, ..., 2, 1 over their
    /// sum, newest first. Even, so that up and down cancel; 0 to max_remembered_frames. Paper: 4.
    int remembered_frames = 4;
    /// Of Damped: share of the target by which N may miss it without C being touched, or one step
    /// of N(C) where that is higher (without this C creeps over the same step for ever). At a
    /// standing view it is reached within 15 frames and kept, whatever the gain up to 5. 0 to about
    /// 0.05; 0: equation (5) as printed. Paper: none.
    double dead_band = 0.005;
    double min_resolution = 2.0;    ///< C is kept at or above it; that of the quadtree
    double max_resolution = 1000.0; ///< C is kept at or below it
};

inline constexpr int max_remembered_frames = 8;

/// How many triangles a mesh may have. Paper: none; it steers by the meshes of earlier frames.
struct TriangleBudget {
    int triangles = 20000; ///< at least 1
    /// C is kept at or below it, also where that leaves triangles unspent. 500: the short sides of
    /// flat triangles, half a node's edge, are 1 mrad, 0.87 pixels of 720 lines over 45 degrees.
    double max_resolution = 500.0;
};

} // namespace octant::visuals::terrain
