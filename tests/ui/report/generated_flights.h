#pragma once

#include "sim/base/random_generator.h"
#include "ui/report/frame_change.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace octant::ui::report {

/// How unsteady a generated machine is.
struct Machine {
    double drift = 0.1;    ///< from round to round, as a logarithm: a random walk
    double noise = 0.04;   ///< of a frame
    double memory = 0.5;   ///< correlation of the noise from a frame to the next
    double held = 0.05;    ///< share of frames that something holds up
    double held_ms = 40.0; ///< for so long
    double flight = 0.003; ///< of a whole flight, apart from the drift
};

/// A change put into the new flights.
struct Delay {
    std::size_t stage = 1; ///< plan
    double share = 0.0;    ///< of the frame time
    std::size_t first = 0;
    std::size_t last = 1000000;
};

struct Rounds {
    std::vector<FrameTimes> before;
    std::vector<FrameTimes> after;
};

inline constexpr int first_frame = 10;

inline FrameTimes flight_of(
    RandomGenerator& dice, const Machine& machine, double speed, std::size_t frames, Delay delay) {
    FrameTimes times{first_frame, {}, {}};
    double noise = 0.0;
    const double own = machine.flight * dice.normal_deviate();
    for (std::size_t k = 0; k < frames; ++k) {
        const double usual_ms = 4.0 + 2.0 * std::sin(0.05 * static_cast<double>(k));
        noise = machine.memory * noise +
                std::sqrt(1.0 - machine.memory * machine.memory) * machine.noise * dice.normal_deviate();
        const double factor = std::exp(speed + own + noise);
        std::array<double, stage_names.size()> stage_ms{0.1, 1.0, usual_ms - 1.4, 0.2, 0.1};
        if (k >= delay.first && k <= delay.last) { stage_ms[delay.stage] += delay.share * usual_ms; }
        if (dice.next() < machine.held) { stage_ms[2] += machine.held_ms; }
        double sum_ms = 0.0;
        for (std::size_t s = 0; s < stage_ms.size(); ++s) {
            times.stage_ms[s].push_back(factor * stage_ms[s]);
            sum_ms += factor * stage_ms[s];
        }
        times.frame_ms.push_back(sum_ms);
    }
    return times;
}

inline Rounds rounds_of(RandomGenerator& dice, const Machine& machine, std::size_t count, Delay delay = {}) {
    constexpr std::size_t frames = 190;
    Rounds rounds;
    double speed = 0.0;
    for (std::size_t r = 0; r < count; ++r) {
        speed += machine.drift * dice.normal_deviate();
        rounds.before.push_back(flight_of(dice, machine, speed, frames, {}));
        rounds.after.push_back(flight_of(dice, machine, speed, frames, delay));
    }
    return rounds;
}

} // namespace octant::ui::report
