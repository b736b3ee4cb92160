// Source: J. Braun and S. Willett, A very efficient O(n), implicit and parallel method to solve the stream power
// equation, Geomorphology 180-181, 2013 (receivers, stack order, implicit step with n = 1, m = 0.5); R. Barnes, C.
// Lehman and D. Mulla, Priority-Flood, Computers & Geosciences 62, 2014 (filling of pits, algorithm 3 with its trace of
// slope). The direction of descent is that of flow_direction.cpp. Deviations: the stack order is built breadth first.
// The priority queue has buckets of heights, of which only the lowest is a heap: what is pushed is never lower than
// what was popped.

#include "models/procedural/drainage.h"

#include "sim/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <vector>

namespace octant::models::procedural {

namespace {

/// From a cell to its neighbours, in the order of a grid whose rows are so many cells apart.
std::array<std::ptrdiff_t, 8> steps_around(int row_step) {
    const std::ptrdiff_t row = row_step;
    return {-row - 1, -row, -row + 1, -1, 1, row - 1, row, row + 1};
}

/// For each cell a bit for each neighbour, as in steps_around(), that drains to it.
std::vector<std::uint8_t> donors_of(const std::vector<int>& receiver, int side) {
    const auto steps = steps_around(side);
    std::vector<std::uint8_t> donors(receiver.size(), 0);
    parallel_for_rows(side, [&](int row) {
        const auto first = static_cast<std::ptrdiff_t>(row) * side;
        for (int column = 0; column < side; ++column) {
            const std::ptrdiff_t cell = first + column;
            const bool is_inner = row > 0 && column > 0 && row + 1 < side && column + 1 < side;
            unsigned bits = 0;
            for (std::size_t n = 0; n < steps.size(); ++n) {
                // Beyond an end of a row lies the end of another, which is no neighbour.
                const std::ptrdiff_t other = cell + steps[n];
                const bool is_cell = is_inner || (other >= 0 && other < std::ssize(receiver));
                bits |= is_cell && receiver[static_cast<std::size_t>(other)] == cell ? 1U << n : 0U;
            }
            donors[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(bits);
        }
    });
    return donors;
}

/// Fills `upstream` from `receiver`: outlets and pits first, then always the donors of what stands already.
void order_upstream(int side, Drainage& water) {
    const auto steps = steps_around(side);
    const std::vector<std::uint8_t> donors = donors_of(water.receiver, side);
    const std::size_t count = water.receiver.size();
    water.upstream.resize(count);
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) {
        water.upstream[end] = static_cast<int>(i);
        end += water.receiver[i] == static_cast<int>(i) ? 1U : 0U;
    }
    for (std::size_t at = 0; at < end; ++at) {
        const int cell = water.upstream[at];
        for (unsigned left = donors[static_cast<std::size_t>(cell)]; left != 0; left &= left - 1) {
            const auto n = static_cast<std::size_t>(std::countr_zero(left));
            water.upstream[end++] = cell + static_cast<int>(steps[n]);
        }
    }
}

/// The cells from which water is looked for uphill, lowest first, of equal ones the first of the grid. None is pushed
/// that would have come before the last popped.
class Front {
public:
    struct Entry {
        double height_m = 0.0;
        int cell = 0;

        bool operator>(const Entry& other) const {
            return height_m > other.height_m || (height_m == other.height_m && cell > other.cell);
        }
    };

    /// `cells`: above all numbers of cells.
    Front(double lowest_m, double highest_m, std::size_t cells)
        : lowest_m_(lowest_m), first_(cells / cells_a_bucket + 2, none), waiting_(cells) {
        const double range_m = std::max(highest_m - lowest_m, 1e-6);
        per_m_ = static_cast<double>(first_.size() - 2) / range_m;
    }

    void push(const Entry& entry) {
        const double at = std::min((entry.height_m - lowest_m_) * per_m_, last_bucket());
        const auto bucket = static_cast<std::size_t>(at);
        if (bucket <= opened_) {
            lowest_.push(entry);
            return;
        }
        waiting_[static_cast<std::size_t>(entry.cell)] = {entry.height_m, first_[bucket]};
        first_[bucket] = entry.cell;
    }

    /// The next one; nothing where there is none.
    std::optional<Entry> pop() {
        while (lowest_.empty() && opened_ + 1 < first_.size()) {
            ++opened_;
            for (int cell = first_[opened_]; cell != none;) {
                const Waiting& one = waiting_[static_cast<std::size_t>(cell)];
                lowest_.push({one.height_m, cell});
                cell = one.next;
            }
        }
        if (lowest_.empty()) { return std::nullopt; }
        const Entry entry = lowest_.top();
        lowest_.pop();
        return entry;
    }

private:
    static constexpr std::size_t cells_a_bucket = 8;
    static constexpr int none = -1;

    struct Waiting {
        double height_m = 0.0;
        int next = none; ///< cell of the same bucket
    };

    double last_bucket() const { return static_cast<double>(first_.size() - 1); }

    double lowest_m_;
    double per_m_ = 0.0;
    std::size_t opened_ = 0;       ///< bucket; lowest_ has all up to it
    std::vector<int> first_;       ///< cell of each bucket
    std::vector<Waiting> waiting_; ///< by cell
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> lowest_;
};

} // namespace

void fill_pits(TerrainGrid& ground, const std::vector<char>& is_outlet) {
    // A rim of cells that are never looked at saves the question which neighbours there are.
    const int wide = ground.side + 2;
    const auto steps = steps_around(wide);
    const auto cells = static_cast<std::size_t>(wide) * static_cast<std::size_t>(wide);
    std::vector<double> height_m(cells);
    std::vector<char> reached(cells, 1);
    const auto rimmed = [&](int row) { return (static_cast<std::ptrdiff_t>(row) + 1) * wide + 1; };
    const auto [lowest, highest] = std::ranges::minmax(ground.values);
    Front front(lowest, highest, cells);
    for (int row = 0; row < ground.side; ++row) {
        const auto from = static_cast<std::ptrdiff_t>(ground.index(0, row));
        std::copy_n(ground.values.begin() + from, ground.side, height_m.begin() + rimmed(row));
        std::copy_n(is_outlet.begin() + from, ground.side, reached.begin() + rimmed(row));
        for (std::ptrdiff_t i = rimmed(row); i < rimmed(row) + ground.side; ++i) {
            if (reached[static_cast<std::size_t>(i)] != 0) {
                front.push({height_m[static_cast<std::size_t>(i)], static_cast<int>(i)});
            }
        }
    }
    const double trace_m = 1e-5 * ground.cell_m;
    while (const auto here = front.pop()) {
        for (const std::ptrdiff_t step : steps) {
            const auto i = static_cast<std::size_t>(here->cell + step);
            if (reached[i] == 0) {
                reached[i] = 1;
                height_m[i] = std::max(height_m[i], here->height_m + trace_m);
                front.push({height_m[i], static_cast<int>(i)});
            }
        }
    }
    for (int row = 0; row < ground.side; ++row) {
        std::copy_n(height_m.begin() + rimmed(row), ground.side,
            ground.values.begin() + static_cast<std::ptrdiff_t>(ground.index(0, row)));
    }
}

Drainage compute_drainage(const TerrainGrid& ground, const std::vector<char>& is_outlet, std::uint64_t seed) {
    Drainage water;
    const std::size_t count = ground.values.size();
    water.receiver.resize(count);
    water.length_m.resize(count);
    water.area_m2.assign(count, ground.cell_m * ground.cell_m);
    parallel_for_rows(ground.side, [&](int row) {
        const std::size_t first = ground.index(0, row);
        const auto side = static_cast<std::size_t>(ground.side);
        choose_receivers(ground, row, seed, {{&water.receiver[first], side}, {&water.length_m[first], side}});
        for (std::size_t i = first; i < first + side; ++i) {
            if (is_outlet[i] != 0) {
                water.receiver[i] = static_cast<int>(i);
                water.length_m[i] = ground.cell_m;
            }
        }
    });
    order_upstream(ground.side, water);
    for (std::size_t at = count; at-- > 0;) {
        const auto i = static_cast<std::size_t>(water.upstream[at]);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver != i) { water.area_m2[receiver] += water.area_m2[i]; }
    }
    return water;
}

void erode(TerrainGrid& ground, const Drainage& water, const std::vector<double>& uplift, const StreamPower& power) {
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver == i) { continue; }
        const double cut = power.step / power.steepness_m * std::sqrt(water.area_m2[i]) / water.length_m[i];
        const double raised = ground.values[i] + power.step * uplift[i];
        ground.values[i] = (raised + cut * ground.values[receiver]) / (1.0 + cut);
    }
}

} // namespace octant::models::procedural
