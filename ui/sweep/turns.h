#pragma once

#include "sim/base/random_generator.h"

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::sweep {

/// One of two flights that are flown together.
struct TurnFlight {
    std::string name;                ///< of its program, for errors
    std::vector<std::string> words;  ///< the command line that flies and records it
    std::filesystem::path recording; ///< the folder of that recording, which has no run.json yet
    std::filesystem::path log;       ///< gets what the program prints
};

/// The shortest turn: long against the time that stopping and going on takes.
inline constexpr double min_turn_s = 0.04;

/// How long a program may take until the run.json of its flight is there.
inline constexpr std::chrono::milliseconds start_limit{60'000};

/// Flies two flights in turns and returns how many seconds each ran. Both programs are started and stopped (SIGSTOP) as
/// soon as their run.json is there; then each goes on for a turn of `turn_s` while the other is stopped, in an order
/// that `dice` draws for each pair of turns, until both have ended. The machine's speed then is the same for both,
/// whatever else it does: the ratio of their frame times varies by 0.7 % from round to round where whole flights, one
/// after the other, vary by 9 % (a virtual machine with two processors). Without `turn_s` each flies to its end, in
/// drawn order: for flights that follow the clock.
///
/// Throws Error "NAME: last line of its log" for a program that fails or writes no run.json within `limit`, and
/// StoppedBySignal when a stop signal came (base::StopSignals). The other program is then ended in order, after ten
/// seconds by SIGKILL; no program is left stopped, not even when this one is killed.
std::array<double, 2> fly_in_turns(const std::array<TurnFlight, 2>& flights, std::optional<double> turn_s,
    RandomGenerator& dice, std::chrono::milliseconds limit = start_limit);

} // namespace octant::ui::sweep
