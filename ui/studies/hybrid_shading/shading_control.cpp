#include "ui/studies/hybrid_shading/shading_control.h"

#include "sim/base/random_generator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::ui::studies::hybrid_shading {

namespace shading = visuals::shading;

namespace {

constexpr int frames_per_load = 600;
constexpr int settling_frames = 30;
constexpr double frames_per_second = 60.0;
constexpr double added_fixed_ms = 2.0;
constexpr int torus_polygons = 416;

double best_share(const SimulatedMachine& machine, const shading::ShadingControllerSettings& control) {
    if (machine.smooth_ms <= 0.0) {
        return 1.0;
    }
    const double aim_ms = control.target_frame_ms * (1.0 - control.target_margin_sds * machine.noise);
    return std::clamp((aim_ms - machine.fixed_ms - machine.flat_ms) / machine.smooth_ms, 0.0, 1.0);
}

double near_share(const SimulatedMachine& machine, double target_frame_ms) {
    const double noise_ms = machine.noise * target_frame_ms;
    return machine.smooth_ms > 0.0 ? std::max(0.1, 2.5 * noise_ms / machine.smooth_ms) : 0.1;
}

double frame_ms(const SimulatedMachine& machine, double smooth_part, RandomGenerator& dice) {
    const double mean_ms = machine.fixed_ms + machine.flat_ms + machine.smooth_ms * smooth_part;
    const double slow = dice.next() < machine.slow_share ? 1.6 : 1.0;
    return mean_ms * slow * (1.0 + machine.noise * dice.normal_deviate());
}

} // namespace

ControlRun run_control(const SimulatedMachine& machine, double target_frame_ms, int polygons) {
    ControlRun run{.machine = machine, .target_frame_ms = target_frame_ms};
    shading::ShadingControllerSettings control;
    control.target_frame_ms = target_frame_ms;
    shading::ShadingState state = shading::initial_shading_state(polygons);
    RandomGenerator dice(2008);
    double changes = 0.0;
    for (std::size_t load = 0; load < run.settled_frames.size(); ++load) {
        SimulatedMachine now = machine;
        now.fixed_ms += load == 1 ? added_fixed_ms : 0.0;
        run.best_share[load] = best_share(now, control);
        for (int frame = 0; frame < frames_per_load; ++frame) {
            const double part = static_cast<double>(state.smooth) / polygons;
            if (std::abs(part - run.best_share[load]) > near_share(now, target_frame_ms)) {
                run.settled_frames[load] = frame + 1;
            }
            const double ms = frame_ms(now, part, dice);
            run.over_share += ms > target_frame_ms ? 1.0 : 0.0;
            const int before = state.smooth;
            state = update_shading(state, control, {ms, polygons - before, before}, polygons);
            changes += frame >= settling_frames ? std::abs(state.smooth - before) : 0.0;
        }
    }
    const auto loads = static_cast<double>(run.settled_frames.size());
    run.over_share /= loads * frames_per_load;
    run.changes_per_second =
        changes / polygons / (loads * (frames_per_load - settling_frames)) * frames_per_second;
    run.has_no_gain = state.has_no_gain;
    return run;
}

std::vector<ControlRun> control_runs() {
    std::vector<ControlRun> runs;
    for (const double smooth_ms : {-1.0, 0.0, 2.0, 6.0, 20.0}) {
        for (const double target_frame_ms : {7.0, 10.0, 12.0, 16.7, 33.3}) {
            runs.push_back(run_control({.smooth_ms = smooth_ms}, target_frame_ms, torus_polygons));
        }
    }
    return runs;
}

} // namespace octant::ui::studies::hybrid_shading
