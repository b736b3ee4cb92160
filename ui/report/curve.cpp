#include "ui/report/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::ui::report {

Curve::Bucket Curve::joined(const Bucket& a, const Bucket& b) {
    if (!std::isfinite(a.lowest.y)) { return b; }
    if (!std::isfinite(b.lowest.y)) { return a; }
    return {b.lowest.y < a.lowest.y ? b.lowest : a.lowest, b.highest.y > a.highest.y ? b.highest : a.highest};
}

void Curve::add(double x, double y) {
    const Bucket piece{{x, y}, {x, y}};
    if (!buckets_.empty() && in_last_bucket_ < points_per_bucket_) {
        buckets_.back() = joined(buckets_.back(), piece);
        ++in_last_bucket_;
        return;
    }
    if (buckets_.size() == max_pieces) {
        for (std::size_t i = 0; 2 * i < max_pieces; ++i) { buckets_[i] = joined(buckets_[2 * i], buckets_[2 * i + 1]); }
        buckets_.resize(max_pieces / 2);
        points_per_bucket_ *= 2;
    }
    buckets_.push_back(piece);
    in_last_bucket_ = 1;
}

PlotSeries Curve::series(std::size_t buckets) const {
    static_assert(max_pieces % 2 == 0);
    assert(buckets >= 1);
    PlotSeries series;
    const auto add_point = [&](const Point& point) {
        series.x.push_back(point.x);
        series.y.push_back(point.y);
    };
    const std::size_t count = std::min(buckets_.size(), buckets);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = (i + 1) * buckets_.size() / count;
        Bucket piece = buckets_[i * buckets_.size() / count];
        for (std::size_t j = i * buckets_.size() / count + 1; j < end; ++j) { piece = joined(piece, buckets_[j]); }
        const bool rises = piece.lowest.x <= piece.highest.x;
        add_point(rises ? piece.lowest : piece.highest);
        if (piece.lowest.x != piece.highest.x) { add_point(rises ? piece.highest : piece.lowest); }
    }
    return series;
}

} // namespace octant::ui::report
