#pragma once

#include "visuals/shading/shading_controller.h"

#include <array>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

/// A made machine that draws frames in made times: t = a + bf f + bg g, with noise and now and then
/// a slow frame. All polygons flat take `flat_ms`, all smooth `smooth_ms` more.
struct SimulatedMachine {
    double fixed_ms = 3.0; ///< a
    double flat_ms = 3.0;
    double smooth_ms = 6.0;
    double noise = 0.02;      ///< standard deviation, share of a frame's time
    double slow_share = 0.01; ///< frames that take 1.6 times as long
};

/// How the share of smooth polygons followed a made machine's times.
struct ControlRun {
    SimulatedMachine machine;
    double target_frame_ms = 0.0; ///< T
    /// From the start, and after a rises and falls again: frames before the share is within 0.1 of
    /// the best one, or within 2.5 deviations of the noise, for good.
    std::array<int, 3> settled_frames{};
    std::array<double, 3> best_share{};
    double over_share = 0.0;         ///< frames longer than T
    double changes_per_second = 0.0; ///< per polygon at 60 frames a second, once settled
    bool has_no_gain = false;            ///< at the end
};

/// 600 frames each with `machine`, with 2 ms more rest and with `machine` again.
ControlRun run_control(const SimulatedMachine& machine, double target_frame_ms, int polygons);

/// The machines and budgets of the study.
std::vector<ControlRun> control_runs();

} // namespace octant::ui::studies::hybrid_shading
