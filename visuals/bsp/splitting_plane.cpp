// Where to divide polygons. As in a BSP tree by polygons' own planes; across the axes, where models
// have gaps between their parts, the number of cuts is known for all planes at once by a sweep.
#include "visuals/bsp/splitting_plane.h"

#include "visuals/bsp/piece_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace octant::visuals::bsp {

namespace {

/// At most so many planes of pieces are tried.
constexpr std::size_t max_own_planes = 64;
/// Sums over more pieces than this are estimated by some of them.
constexpr std::size_t max_looked_at = 1'000;

/// A cut costs as much as halves that differ by so many pieces. Of 2, 8, 30 and 200 this one makes
/// the fewest pieces of parts of real aircraft and of made models.
constexpr double polygons_a_cut = 8.0;

/// A plane with its cost; less is better.
struct Costed {
    Plane plane;
    double cost = std::numeric_limits<double>::infinity();
};

/// The cost of a plane: its cuts, and how uneven the halves are.
double cost_of(const SplitCounts& parted) {
    const std::size_t count = parted.before + parted.behind + parted.coplanar + parted.cut;
    const bool useless = parted.coplanar == 0 && (parted.before == 0 || parted.behind == 0);
    if (parted.cuts_swept || (useless && parted.cut == 0) ||
        (parted.coplanar == 0 && parted.cut + parted.before >= count && parted.behind == 0) ||
        (parted.coplanar == 0 && parted.cut + parted.behind >= count && parted.before == 0)) {
        return std::numeric_limits<double>::infinity();
    }
    const double uneven =
        std::abs(static_cast<double>(parted.before) - static_cast<double>(parted.behind));
    return static_cast<double>(parted.cut) * polygons_a_cut + uneven;
}

/// Some of many pieces.
class Sample {
public:
    Sample(const PolygonPieces& pieces, std::span<const std::uint32_t> items)
        : step_(items.size() / max_looked_at + 1)
        , table_(pieces, items, step_)
        , swept_(table_.blocks(), 0) {
        for (std::size_t i = 0; i < table_.count(); ++i) {
            const bool is_swept = pieces[items[i * step_]].pivot.has_value();
            swept_[i / PieceTable::pieces_per_block] |= std::uint64_t{is_swept}
                                                      << (i % PieceTable::pieces_per_block);
        }
    }

    /// How a plane parts all pieces, by these. Ends early where that costs more than `limit`.
    SplitCounts split_counts(const Plane& plane, double limit) const {
        SplitCounts parted;
        const auto max_cuts = static_cast<std::size_t>(
            std::min(limit / (polygons_a_cut * static_cast<double>(step_)), 1e9));
        for (std::size_t i = 0; i < table_.blocks() && parted.cut <= max_cuts; ++i) {
            const PlaneSideBits sides_reached = table_.sides_reached(i, plane);
            const std::uint64_t cut = sides_reached.before & sides_reached.behind;
            const std::size_t known = count_of(sides_reached.before | sides_reached.behind);
            parted.cut += count_of(cut);
            parted.before += count_of(sides_reached.before & ~cut);
            parted.behind += count_of(sides_reached.behind & ~cut);
            parted.coplanar += table_.count_in(i) - known;
            parted.cuts_swept = parted.cuts_swept || (cut & swept_[i]) != 0;
        }
        parted.before *= step_;
        parted.behind *= step_;
        parted.cut *= step_;
        return parted;
    }

private:
    static std::size_t count_of(std::uint64_t bits) {
        return static_cast<std::size_t>(std::popcount(bits));
    }

    std::size_t step_;
    PieceTable table_;
    std::vector<std::uint64_t> swept_; ///< A bit a piece: by something that turns.
};

/// The best plane of a piece.
Costed best_own(const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    const Sample sample(pieces, items);
    Costed best;
    const std::size_t tried = std::min(items.size(), max_own_planes);
    for (std::size_t i = 0; i < tried; ++i) {
        const auto& plane = pieces[items[i * items.size() / tried]].plane;
        if (!plane) {
            continue;
        }
        const double cost = cost_of(sample.split_counts(*plane, best.cost));
        if (cost < best.cost) {
            best = {*plane, cost};
        }
    }
    return best;
}

/// Where pieces begin and end along an axis, ascending.
struct Ends {
    std::vector<double> low;
    std::vector<double> high;
    std::vector<double> swept_low;
    std::vector<double> swept_high;
};

Ends ends_along(const PolygonPieces& pieces, std::span<const std::uint32_t> items, int axis) {
    Ends ends;
    for (const std::uint32_t item : items) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const std::uint32_t vertex : pieces[item].corners) {
            low = std::min(low, pieces.at(vertex)[axis]);
            high = std::max(high, pieces.at(vertex)[axis]);
        }
        ends.low.push_back(low);
        ends.high.push_back(high);
        if (pieces[item].pivot) {
            ends.swept_low.push_back(low);
            ends.swept_high.push_back(high);
        }
    }
    for (auto* values : {&ends.low, &ends.high, &ends.swept_low, &ends.swept_high}) {
        std::ranges::sort(*values);
    }
    return ends;
}

/// How many of some sorted values lie below limits that are asked for in ascending order.
class CountBelow {
public:
    explicit CountBelow(const std::vector<double>& sorted)
        : sorted_(sorted) {}

    std::size_t operator()(double limit) {
        while (below_ < sorted_.size() && sorted_[below_] < limit) {
            ++below_;
        }
        return below_;
    }

private:
    const std::vector<double>& sorted_;
    std::size_t below_ = 0;
};

/// How planes across an axis part all pieces, from the lowest plane on.
class Sweep {
public:
    explicit Sweep(const Ends& ends)
        : count_(ends.low.size())
        , lowlink_(ends.low)
        , high_(ends.high)
        , swept_low_(ends.swept_low)
        , swept_high_(ends.swept_high) {}

    SplitCounts split_at(double at) {
        SplitCounts parted;
        parted.before = count_ - lowlink_(at - tolerance);
        parted.behind = high_(at + tolerance);
        // What lies within the tolerance of the plane is in both counts.
        const std::size_t known = parted.before + parted.behind;
        parted.coplanar = known > count_ ? known - count_ : 0;
        parted.before -= std::min(parted.before, parted.coplanar);
        parted.behind -= std::min(parted.behind, parted.coplanar);
        const std::size_t settled = parted.before + parted.behind + parted.coplanar;
        parted.cut = count_ - std::min(count_, settled);
        parted.cuts_swept = swept_low_(at - tolerance) != swept_high_(at + tolerance);
        return parted;
    }

private:
    std::size_t count_;
    CountBelow lowlink_;
    CountBelow high_;
    CountBelow swept_low_;
    CountBelow swept_high_;
};

/// The best plane across an axis.
Costed best_across(const PolygonPieces& pieces, std::span<const std::uint32_t> items, int axis) {
    const Ends ends = ends_along(pieces, items, axis);
    Sweep at_low(ends);
    Sweep at_high(ends);
    Costed best;
    const auto try_at = [&](double at, Sweep& sweep) {
        const SplitCounts parted = sweep.split_at(at);
        if (parted.before == 0 || parted.behind == 0) {
            return;
        }
        const double cost = cost_of(parted);
        if (cost < best.cost) {
            glm::dvec3 normal(0.0);
            normal[axis] = 1.0;
            best = {{normal, -at}, cost};
        }
    };
    for (std::size_t i = 0; i < items.size(); ++i) {
        try_at(ends.low[i], at_low);
        try_at(ends.high[i], at_high);
    }
    return best;
}

} // namespace

std::optional<Plane> splitting_plane(const PolygonPieces& pieces, std::span<const std::uint32_t> items) {
    Costed best = best_own(pieces, items);
    for (int axis = 0; axis < 3; ++axis) {
        const Costed across = best_across(pieces, items, axis);
        if (across.cost < best.cost) {
            best = across;
        }
    }
    return std::isfinite(best.cost) ? std::optional(best.plane) : std::nullopt;
}

} // namespace octant::visuals::bsp
