#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace octant {

/// Wall time since its construction or its last lap_ms().
class Stopwatch {
public:
    double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

    double s() const { return ms() / 1000.0; }

    /// Returns the milliseconds so far and restarts from zero.
    double lap_ms() {
        const auto now = Clock::now();
        const double passed = std::chrono::duration<double, std::milli>(now - start_).count();
        start_ = now;
        return passed;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Processor time of all threads of this program so far.
inline double process_cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Time since its construction in which the thread that constructed it did not run: it waited, or the processor ran
/// other threads.
class OffCpuTimer {
public:
    /// Must be called on the thread that constructed it.
    double ms() const { return std::max(wall_.ms() - (thread_ms() - start_ms_), 0.0); }

private:
    static double thread_ms() {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
    }

    Stopwatch wall_;
    double start_ms_ = thread_ms();
};

} // namespace octant
