#pragma once

#include "ui/base/stopwatch.h"

#include <algorithm>
#include <ctime>

namespace octant::ui::base {

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
