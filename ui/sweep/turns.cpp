#include "ui/sweep/turns.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/stop_signals.h"
#include "ui/report/child_program.h"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace octant::ui::sweep {

namespace {

using Clock = std::chrono::steady_clock;

/// The program of a flight. Its owner never leaves it stopped or running.
class FlyingProgram {
public:
    explicit FlyingProgram(const TurnFlight& flight) : flight_(flight) {}

    ~FlyingProgram() { end(); }

    FlyingProgram(const FlyingProgram&) = delete;
    FlyingProgram& operator=(const FlyingProgram&) = delete;
    FlyingProgram(FlyingProgram&&) = delete;
    FlyingProgram& operator=(FlyingProgram&&) = delete;

    /// Starts the program and waits for the run.json of its flight.
    void start(std::chrono::milliseconds limit) {
        program_ = report::ChildProgram::start_bound(flight_.words, flight_.log);
        if (!program_) {
            throw Error(fmt::format("{}: expected a program that can be started, got none", flight_.name));
        }
        program_->end_input();
        constexpr auto look_every = std::chrono::milliseconds(2);
        const Clock::time_point until = Clock::now() + limit;
        while (!path_exists(flight_.recording / "run.json")) {
            const bool has_ended = has_landed();
            if (has_ended || Clock::now() > until) {
                throw Error(fmt::format("{}: expected a program that writes {} when its flight begins, got one that {}",
                    flight_.name, (flight_.recording / "run.json").string(),
                    has_ended ? "ended without it" : "did not"));
            }
            wait_for(look_every);
        }
    }

    void stop() {
        program_->signal_group(SIGSTOP);
        is_stopped_ = true;
    }

    /// Lets the program go on for this long, or until it ends.
    void go_on(Clock::duration duration) {
        constexpr Clock::duration look_every = std::chrono::milliseconds(5);
        const Clock::time_point start = Clock::now();
        if (std::exchange(is_stopped_, false)) { program_->signal_group(SIGCONT); } // the program counts its pauses
        Clock::duration left = duration;
        while (left > Clock::duration::zero() && !has_landed()) {
            wait_for(std::min(left, look_every));
            left = duration - (Clock::now() - start);
        }
        ran_s_ += std::chrono::duration<double>(Clock::now() - start).count();
    }

    /// Whether the program has ended. Throws Error if it failed.
    bool has_landed() {
        if (program_ && !program_->is_running()) {
            const report::ProgramResult result = program_->finish();
            program_.reset();
            has_landed_ = true;
            if (!result.succeeded) { throw Error(fmt::format("{}: {}", flight_.name, result.last_error_line)); }
        }
        return has_landed_;
    }

    double ran_s() const { return ran_s_; }

private:
    static void wait_for(Clock::duration duration) {
        std::this_thread::sleep_for(duration);
        if (base::StopSignals::received()) { throw base::StoppedBySignal(); }
    }

    void end() {
        constexpr auto limit = std::chrono::seconds(10);
        constexpr auto look_every = std::chrono::milliseconds(5);
        if (!program_) { return; }
        program_->signal_group(SIGCONT);
        program_->signal_group(SIGTERM);
        const Clock::time_point until = Clock::now() + limit;
        while (program_->is_running() && Clock::now() < until) { std::this_thread::sleep_for(look_every); }
        program_->signal_group(SIGKILL);
    }

    const TurnFlight& flight_;
    std::optional<report::ChildProgram> program_;
    bool is_stopped_ = false;
    bool has_landed_ = false;
    double ran_s_ = 0.0;
};

} // namespace

std::array<double, 2> fly_in_turns(const std::array<TurnFlight, 2>& flights, std::optional<double> turn_s,
    RandomGenerator& dice, std::chrono::milliseconds limit) {
    std::array<FlyingProgram, 2> programs{FlyingProgram(flights[0]), FlyingProgram(flights[1])};
    const auto in_drawn_order = [&](const auto& act) {
        const std::size_t first = dice.next() < 0.5 ? 0 : 1;
        act(programs[first], programs[1 - first]);
        act(programs[1 - first], programs[first]);
    };
    in_drawn_order([&](FlyingProgram& program, const FlyingProgram& /*other*/) {
        program.start(limit);
        if (turn_s) {
            program.stop();
        } else {
            program.go_on(Clock::duration::max());
        }
    });
    const Clock::duration turn =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(turn_s.value_or(min_turn_s)));
    while (!programs[0].has_landed() || !programs[1].has_landed()) {
        in_drawn_order([&](FlyingProgram& program, FlyingProgram& other) {
            if (program.has_landed()) { return; }
            program.go_on(turn);
            if (!program.has_landed() && !other.has_landed()) { program.stop(); }
        });
    }
    return {programs[0].ran_s(), programs[1].ran_s()};
}

} // namespace octant::ui::sweep
