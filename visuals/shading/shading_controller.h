#pragma once

#include <array>

namespace octant::visuals::shading {

/// Every number by which the share of smooth polygons follows the frame time. "Deviations" are
/// standard deviations of what frames differ from the fit.
struct ShadingControl {
    double share_ms = 1000.0 / 60.0; ///< T, a frame's time, above zero
    /// Variance by which a may change from frame to frame, in the noise's variance: with 6.5e-4 it
    /// is known from the last 40 frames.
    double level_drift = 6.5e-4;
    double slope_drift = 1e-4;   ///< the same for bf n0 and (bg - bf) n0
    double noise_weight = 0.025; ///< of a frame in the noise that is expected
    double aim_sds = 2.6;        ///< the expected time settles below T by so many deviations
    double overload_sds = 1.9;   ///< less room than this is too little; from 0 to aim_sds
    double dead_band = 0.04;    ///< share of the polygons by which there may be too few smooth ones
    double largest_step = 0.10; ///< share of the polygons that may change from frame to frame
    /// Share of the polygons (one at least) that turn flat for half of each `probe_frames` while
    /// the fit cannot tell well what they cost; `largest_step` turn smooth where all are flat.
    double probe = 0.01;
    int probe_frames = 40;
    /// Share of the polygons that one at least may be for that: of fewer polygons none is asked.
    double largest_probe = 0.05;
    /// Flat polygons that may gain more than this share of T are not said to gain nothing.
    double little_gain = 0.2;
    double surprise_sds = 2.5; ///< three frames in a row beyond this on one side: the load changed
    double outlier_sds = 4.0;  ///< a frame beyond this says nothing of the fit
};

/// Fit of t = a + bf f + bg g for some number of polygons n0: recursive least squares.
struct ShadingFit {
    std::array<double, 3> ms{};         ///< a; bf n0; (bg - bf) n0
    std::array<double, 9> covariance{}; ///< of `ms`, in units of the noise's variance
    double noise_ms = 0.0;              ///< standard deviation of frames about the fit
    int polygons = 1;                   ///< n0
    int frames = 0;                     ///< seen since the start or the last change of load
    int surprises = 0;                  ///< in a row, below zero for short frames
};

/// What is carried from one frame to the next: a value, so that a run can be replayed.
struct ShadingState {
    double target = 0.0; ///< g before probing
    int smooth = 0;      ///< g of the next frame
    int polygons = 1;    ///< n of the next frame
    bool moving = false; ///< the target is on its way to the best number
    /// Flat polygons are not measurably faster than smooth ones: all are smooth, whatever T.
    bool no_gain = false;
    int probe_frame = 0;
    ShadingFit fit;
};

/// What a frame drawn with ShadingState::smooth took.
struct ShadedFrame {
    double frame_ms = 0.0; ///< at least 0
    int flat = 0;          ///< f
    int smooth = 0;        ///< g
};

/// State before the first frame with n polygons (at least 1), all flat: the safe side.
ShadingState starting_shading(int polygons);

/// State after a frame; `polygons`, at least 1, is n of the next frame. Settings are as their
/// comments demand (asserted).
ShadingState next_shading(
    const ShadingState& state,
    const ShadingControl& control,
    const ShadedFrame& frame,
    int polygons);

} // namespace octant::visuals::shading
