#pragma once

#include <array>

namespace octant::visuals::shading {

/// All constants by which the share of smooth polygons follows the frame time. "Deviations" are standard deviations of
/// the frame times about the fitted model.
struct ShadingControllerSettings {
    double target_frame_ms = 1000.0 / 60.0; ///< T: the time a frame should take, above zero.
    /// How much the variance of a grows from frame to frame, in units of the noise's variance. With 6.5e-4 about the
    /// last 40 frames decide on a.
    double level_drift = 6.5e-4;
    double slope_drift = 1e-4;      ///< The same growth for bf n0 and for (bg - bf) n0.
    double noise_weight = 0.025;    ///< The weight of one frame in the running estimate of the noise.
    double target_margin_sds = 2.6; ///< The expected frame time is aimed this many deviations below T.
    /// A margin below T of fewer than this many deviations counts as overload; 0 to target_margin_sds.
    double overload_sds = 1.9;
    /// As long as no more than this share of the polygons could still turn smooth, nothing changes.
    double dead_band = 0.04;
    /// At most this share of the polygons changes from one frame to the next.
    double max_step = 0.10;
    /// While the fit does not know well what smooth polygons cost, this share of the polygons (at least one) turns flat
    /// for half of each `probe_frames`. Where all are flat already, the share `max_step` turns smooth instead.
    double probe = 0.01;
    int probe_frames = 40;
    /// No probe is made in a model with so few polygons that a single one exceeds this share.
    double max_probe = 0.05;
    /// Flat polygons that might still save more than this share of T are not declared useless.
    double min_gain_ratio = 0.2;
    /// Three frames in a row that miss the fit by more than this, on the same side, mean that the load changed.
    double surprise_sds = 2.5;
    /// A frame that misses the fit by more than this is left out of the fit.
    double outlier_sds = 4.0;
};

/// The model of the frame time, t = a + bf f + bg g, fitted by recursive least squares. Its slopes are stored times a
/// fixed number of polygons n0, so that all three numbers are milliseconds.
struct FrameTimeModel {
    std::array<double, 3> ms{}; ///< The three numbers a, bf n0 and (bg - bf) n0.
    /// Their covariance matrix (3 x 3, by rows) in units of the noise's variance.
    std::array<double, 9> covariance{};
    double noise_ms = 0.0; ///< The standard deviation of frame times about the fit.
    int polygons = 1;      ///< n0
    int frames = 0;        ///< How many frames were seen since the start or since the load last changed.
    /// How many frames in a row missed the fit; negative when they were too short.
    int surprises = 0;
};

/// All that the controller carries from one frame to the next. It is a plain value, so that a run can be recorded and
/// replayed.
struct ShadingState {
    double target = 0.0; ///< g before a probe is taken off; not rounded.
    int smooth = 0;      ///< g, how many polygons the next frame draws smooth.
    int polygons = 1;    ///< n, how many polygons the next frame has.
    bool moving = false; ///< The target is still on its way to the best number.
    /// Flat polygons are not measurably faster than smooth ones; then all are smooth, whatever T is.
    bool has_no_gain = false;
    int probe_frame = 0; ///< The place in the cycle of probe_frames.
    FrameTimeModel fit;
};

/// What was measured of the frame that was drawn with ShadingState::smooth.
struct MeasuredFrame {
    double frame_ms = 0.0; ///< The frame time, at least 0.
    int flat = 0;          ///< f, how many polygons were flat.
    int smooth = 0;        ///< g, how many polygons were smooth.
};

/// The state before the first frame of n polygons (at least 1, asserted). All are flat, for that cannot overload the
/// machine.
ShadingState initial_shading_state(int polygons);

/// The state after a frame was measured. `polygons` (at least 1) is n of the next frame, which may differ from this
/// frame's. The settings must be within the limits that their comments state (asserted). A pure function: same
/// arguments, same result.
ShadingState update_shading(
    const ShadingState& state, const ShadingControllerSettings& control, const MeasuredFrame& frame, int polygons);

} // namespace octant::visuals::shading
