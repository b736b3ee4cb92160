#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace octant::ui::base {

/// Wall time since it was made or last restarted.
class Stopwatch {
public:
    double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

    double s() const { return ms() / 1000.0; }

    /// Milliseconds so far; counts from zero again.
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

/// Processor time of this program so far, all threads together.
inline double process_cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Time since it was made in which the thread that made it had no processor: it waited, or others pushed it aside.
class OffCpuTimer {
public:
    /// On the thread that made it.
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

} // namespace octant::ui::base
