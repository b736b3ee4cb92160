#pragma once

#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"

#include <string>

namespace octant::ui::commands {

/// Shows progress in percent, once the work has taken a second. Measures its time.
class PercentProgress {
public:
    PercentProgress(const std::string& what, bool quiet, const std::string& unit = "%")
        : progress_(what, 100, quiet, unit) {}

    void show(double share) {
        if (watch_.ms() > 1000.0) {
            progress_.show(static_cast<int>(100.0 * share));
        }
    }

    /// Ends the display; the milliseconds since the beginning.
    double finish() {
        const double ms = watch_.ms();
        progress_.finish();
        return ms;
    }

private:
    base::Stopwatch watch_;
    base::Progress progress_;
};

} // namespace octant::ui::commands
