#include "ui/report/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::ui::report {

Curve::Piece Curve::joined(const Piece& a, const Piece& b) {
    if (!std::isfinite(a.least.y)) {
        return b;
    }
    if (!std::isfinite(b.least.y)) {
        return a;
    }
    return {
        b.least.y < a.least.y ? b.least : a.least,
        b.greatest.y > a.greatest.y ? b.greatest : a.greatest};
}

void Curve::add(double x, double y) {
    const Piece piece{{x, y}, {x, y}};
    if (!pieces_.empty() && in_last_ < points_a_piece_) {
        pieces_.back() = joined(pieces_.back(), piece);
        ++in_last_;
        return;
    }
    if (pieces_.size() == max_pieces) {
        for (std::size_t i = 0; 2 * i < max_pieces; ++i) {
            pieces_[i] = joined(pieces_[2 * i], pieces_[2 * i + 1]);
        }
        pieces_.resize(max_pieces / 2);
        points_a_piece_ *= 2;
    }
    pieces_.push_back(piece);
    in_last_ = 1;
}

PlotSeries Curve::series(std::size_t pieces) const {
    static_assert(max_pieces % 2 == 0);
    assert(pieces >= 1);
    PlotSeries series;
    const auto add_point = [&](const Point& point) {
        series.x.push_back(point.x);
        series.y.push_back(point.y);
    };
    const std::size_t count = std::min(pieces_.size(), pieces);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = (i + 1) * pieces_.size() / count;
        Piece piece = pieces_[i * pieces_.size() / count];
        for (std::size_t j = i * pieces_.size() / count + 1; j < end; ++j) {
            piece = joined(piece, pieces_[j]);
        }
        const bool rises = piece.least.x <= piece.greatest.x;
        add_point(rises ? piece.least : piece.greatest);
        if (piece.least.x != piece.greatest.x) {
            add_point(rises ? piece.greatest : piece.least);
        }
    }
    return series;
}

} // namespace octant::ui::report
