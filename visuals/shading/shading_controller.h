#pragma once

#include <array>

namespace octant::visuals::shading {

/// Every number by which the share of smooth polygons follows the frame time.
struct ShadingControl {
    double share_ms = 1000.0 / 60.0; ///< T, a frame's time, above zero
    double forgetting = 0.985;       ///< a frame's weight against the next one's
    double margin_sds = 2.0;    ///< expected time stays below T by so many deviations of the noise
    double dead_band = 0.04;    ///< share of the polygons by which the best number may be off
    double largest_step = 0.10; ///< share of the polygons that may change from frame to frame
    /// Share of the polygons (one at least) that are flat for half of each `probe_frames`, so that
    /// frames with other numbers are seen and the fit can tell smooth from flat.
    double probe = 0.01;
    int probe_frames = 80;
};

/// Fit of t = a + bf f + bg g, carried as (a, bf, bg - bf): recursive least squares.
struct ShadingFit {
    std::array<double, 3> ms{0.0, 0.0, 0.0}; ///< a; all polygons flat; all smooth instead
    std::array<double, 9> covariance{};      ///< of `ms` in units of the noise's variance
    double noise_ms = 0.0;                   ///< deviation of frames from the fit
    int frames = 0;                          ///< seen
    int surprises = 0; ///< frames in a row far above (positive) or below the fit
};

/// What is carried from one frame to the next: a value, so that a run can be replayed.
struct ShadingState {
    double target = 0.0;  ///< g before probing
    int smooth = 0;       ///< g of the next frame
    int polygons = 0;     ///< n
    bool no_gain = false; ///< flat polygons are not measurably faster: all are smooth
    ShadingFit fit;
    int probe_frame = 0;
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
