#pragma once

#include <string>

namespace octant::ui::base {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only remembered, so that what is being written can be ended
/// in order; the second ends the program at once. Signals that were ignored before (nohup) stay so. Counts how often
/// the program went on after it was stopped (SIGSTOP, Ctrl-Z). One at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;
    StopSignals(StopSignals&&) = delete;
    StopSignals& operator=(StopSignals&&) = delete;

    /// True once one of them came, since the program began.
    static bool received();

    /// "SIGINT", "SIGTERM" or "SIGHUP"; empty where none came.
    static std::string name();

    /// How often SIGCONT came since the program began, while a StopSignals lived. Whoever compares two readings on the
    /// main thread knows whether the program was stopped between them.
    static int pauses();
};

/// Thrown by work of which a part is of no use once a stop signal came, when its files are in order: the program then
/// ends by the signal.
struct StoppedBySignal {};

/// Ends the program by the signal that came, as whoever started it expects; returns where none did.
void exit_by_received_signal();

} // namespace octant::ui::base
