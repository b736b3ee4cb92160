// Where to divide polygons. As in a BSP tree by polygons' own planes; across the axes, where models
// have gaps between their parts, the number of cuts is known for all planes at once by a sweep.
#include "visuals/parting/parting_plane.h"

#include "visuals/parting/piece_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace octant::visuals::parting {

namespace {

/// At most so many planes of pieces are tried.
constexpr std::size_t most_own_planes = 64;
/// Sums over more pieces than this are estimated by some of them.
constexpr std::size_t most_looked_at = 1'000;

/// A cut costs as much as halves that differ by so many pieces. Of 2, 8, 30 and 200 this one makes
/// the fewest pieces of parts of real aircraft and of made models.
constexpr double polygons_a_cut = 8.0;

/// A plane with its cost; less is better.
struct Costed {
    Plane plane;
    double cost = std::numeric_limits<double>::infinity();
};

/// The cost of a plane: its cuts, and how uneven the halves are.
double cost_of(const Parted& parted) {
    const std::size_t count = parted.before + parted.behind + parted.within + parted.cut;
    const bool useless = parted.within == 0 && (parted.before == 0 || parted.behind == 0);
    if (parted.cuts_swept || (useless && parted.cut == 0) ||
        (parted.within == 0 && parted.cut + parted.before >= count && parted.behind == 0) ||
        (parted.within == 0 && parted.cut + parted.behind >= count && parted.before == 0)) {
        return std::numeric_limits<double>::infinity();
    }
    const double uneven =
        std::abs(static_cast<double>(parted.before) - static_cast<double>(parted.behind));
    return static_cast<double>(parted.cut) * polygons_a_cut + uneven;
}

/// Some of many pieces.
class Sample {
public:
    Sample(const Pieces& pieces, std::span<const std::uint32_t> items)
        : step_(items.size() / most_looked_at + 1)
        , table_(pieces, items, step_) {
        for (std::size_t i = 0; i < items.size(); i += step_) {
            swept_.push_back(pieces[items[i]].pivot.has_value());
        }
    }

    /// How a plane parts all pieces, by these. Ends early where that costs more than `limit`.
    Parted parted_by(const Plane& plane, double limit) const {
        Parted parted;
        const auto most_cuts = static_cast<std::size_t>(
            std::min(limit / (polygons_a_cut * static_cast<double>(step_)), 1e9));
        for (std::size_t i = 0; i < table_.count() && parted.cut <= most_cuts; ++i) {
            const Reach reach = table_.reach(i, plane);
            if (reach.before && reach.behind) {
                ++parted.cut;
                parted.cuts_swept = parted.cuts_swept || swept_[i];
            } else if (reach.before) {
                ++parted.before;
            } else if (reach.behind) {
                ++parted.behind;
            } else {
                ++parted.within;
            }
        }
        parted.before *= step_;
        parted.behind *= step_;
        parted.cut *= step_;
        return parted;
    }

private:
    std::size_t step_;
    PieceTable table_;
    std::vector<bool> swept_; ///< by something that turns
};

/// The best plane of a piece.
Costed best_own(const Pieces& pieces, std::span<const std::uint32_t> items) {
    const Sample sample(pieces, items);
    Costed best;
    const std::size_t tried = std::min(items.size(), most_own_planes);
    for (std::size_t i = 0; i < tried; ++i) {
        const auto& plane = pieces[items[i * items.size() / tried]].plane;
        if (!plane) {
            continue;
        }
        const double cost = cost_of(sample.parted_by(*plane, best.cost));
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

Ends ends_along(const Pieces& pieces, std::span<const std::uint32_t> items, int axis) {
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

std::size_t count_below(const std::vector<double>& sorted, double limit) {
    return static_cast<std::size_t>(std::ranges::lower_bound(sorted, limit) - sorted.begin());
}

/// The best plane across an axis.
Costed best_across(const Pieces& pieces, std::span<const std::uint32_t> items, int axis) {
    const Ends ends = ends_along(pieces, items, axis);
    const std::size_t count = items.size();
    Costed best;
    const auto try_at = [&](double at) {
        Parted parted;
        parted.before = count - count_below(ends.low, at - tolerance);
        parted.behind = count_below(ends.high, at + tolerance);
        // What lies within the tolerance of the plane is in both counts.
        const std::size_t known = parted.before + parted.behind;
        parted.within = known > count ? known - count : 0;
        parted.before -= std::min(parted.before, parted.within);
        parted.behind -= std::min(parted.behind, parted.within);
        const std::size_t settled = parted.before + parted.behind + parted.within;
        parted.cut = count - std::min(count, settled);
        parted.cuts_swept = count_below(ends.swept_low, at - tolerance) !=
                            count_below(ends.swept_high, at + tolerance);
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
    for (std::size_t i = 0; i < count; ++i) {
        try_at(ends.low[i]);
        try_at(ends.high[i]);
    }
    return best;
}

} // namespace

std::optional<Plane> parting_plane(const Pieces& pieces, std::span<const std::uint32_t> items) {
    Costed best = best_own(pieces, items);
    for (int axis = 0; axis < 3; ++axis) {
        const Costed across = best_across(pieces, items, axis);
        if (across.cost < best.cost) {
            best = across;
        }
    }
    return std::isfinite(best.cost) ? std::optional(best.plane) : std::nullopt;
}

} // namespace octant::visuals::parting
