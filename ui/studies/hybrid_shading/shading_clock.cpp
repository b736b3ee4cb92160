#include "ui/studies/hybrid_shading/shading_clock.h"

#include "sim/base/dice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace octant::ui::studies::hybrid_shading {

namespace shading = visuals::shading;

namespace {

constexpr int frames_of_load = 600;
constexpr int settling_frames = 30;
constexpr double frames_per_second = 60.0;
constexpr double more_rest_ms = 2.0;
constexpr int torus_polygons = 416;

double best_share(const MadeMachine& machine, const shading::ShadingControl& control) {
    if (machine.smooth_ms <= 0.0) {
        return 1.0;
    }
    const double aim_ms = control.share_ms * (1.0 - control.aim_sds * machine.noise);
    return std::clamp((aim_ms - machine.rest_ms - machine.flat_ms) / machine.smooth_ms, 0.0, 1.0);
}

double near_share(const MadeMachine& machine, double share_ms) {
    const double noise_ms = machine.noise * share_ms;
    return machine.smooth_ms > 0.0 ? std::max(0.1, 2.5 * noise_ms / machine.smooth_ms) : 0.1;
}

double frame_ms(const MadeMachine& machine, double smooth_part, Dice& dice) {
    const double mean_ms = machine.rest_ms + machine.flat_ms + machine.smooth_ms * smooth_part;
    const double slow = dice.next() < machine.slow_share ? 1.6 : 1.0;
    return mean_ms * slow * (1.0 + machine.noise * dice.bell());
}

} // namespace

ControlRun run_control(const MadeMachine& machine, double share_ms, int polygons) {
    ControlRun run{.machine = machine, .share_ms = share_ms};
    shading::ShadingControl control;
    control.share_ms = share_ms;
    shading::ShadingState state = shading::starting_shading(polygons);
    Dice dice(2008);
    double changes = 0.0;
    for (std::size_t load = 0; load < run.settled_frames.size(); ++load) {
        MadeMachine now = machine;
        now.rest_ms += load == 1 ? more_rest_ms : 0.0;
        run.best_share[load] = best_share(now, control);
        for (int frame = 0; frame < frames_of_load; ++frame) {
            const double part = static_cast<double>(state.smooth) / polygons;
            if (std::abs(part - run.best_share[load]) > near_share(now, share_ms)) {
                run.settled_frames[load] = frame + 1;
            }
            const double ms = frame_ms(now, part, dice);
            run.over_share += ms > share_ms ? 1.0 : 0.0;
            const int before = state.smooth;
            state = next_shading(state, control, {ms, polygons - before, before}, polygons);
            changes += frame >= settling_frames ? std::abs(state.smooth - before) : 0.0;
        }
    }
    const auto loads = static_cast<double>(run.settled_frames.size());
    run.over_share /= loads * frames_of_load;
    run.changes_per_second =
        changes / polygons / (loads * (frames_of_load - settling_frames)) * frames_per_second;
    run.no_gain = state.no_gain;
    return run;
}

std::vector<ControlRun> control_runs() {
    std::vector<ControlRun> runs;
    for (const double smooth_ms : {-1.0, 0.0, 2.0, 6.0, 20.0}) {
        for (const double share_ms : {7.0, 10.0, 12.0, 16.7, 33.3}) {
            runs.push_back(run_control({.smooth_ms = smooth_ms}, share_ms, torus_polygons));
        }
    }
    return runs;
}

} // namespace octant::ui::studies::hybrid_shading
