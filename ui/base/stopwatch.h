#pragma once

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

} // namespace octant::ui::base
