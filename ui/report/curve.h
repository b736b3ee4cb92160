#pragma once

#include "ui/report/plots.h"

#include <cstddef>
#include <vector>

namespace octant::ui::report {

/// A curve over a flight in the memory of a plot: where there are more points than it keeps pieces, neighbours share
/// one, which keeps its least and its greatest value.
class Curve {
public:
    /// More pieces than a page's plot has pixels.
    static constexpr std::size_t max_pieces = 900;

    /// `x` not below that of the last point. A value that is not finite is a gap.
    void add(double x, double y);

    /// Its points in order, two a piece at the most, in at most so many pieces (>= 1).
    PlotSeries series(std::size_t buckets = max_pieces) const;

private:
    struct Point {
        double x = 0.0;
        double y = 0.0;
    };

    struct Bucket {
        Point lowest;
        Point highest;
    };

    static Bucket joined(const Bucket& a, const Bucket& b);

    std::vector<Bucket> buckets_;
    std::size_t points_per_bucket_ = 1;
    std::size_t in_last_bucket_ = 0;
};

} // namespace octant::ui::report
