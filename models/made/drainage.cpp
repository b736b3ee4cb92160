// Source: J. Braun and S. Willett, A very efficient O(n), implicit and parallel method to solve the
// stream power equation, Geomorphology 180-181, 2013 (receivers, stack order, implicit step with
// n = 1, m = 0.5); R. Barnes, C. Lehman and D. Mulla, Priority-Flood, Computers & Geosciences 62,
// 2014 (filling of pits, algorithm 3 with its trace of slope).
// The direction of descent is that of D. Tarboton, A new method for the determination of flow
// directions and upslope areas in grid DEMs, Water Resources Research 33(2), 1997 (facets).
// Deviations: water is not shared between the two neighbours of a facet but given to one of them,
// with the chance that leads in the facet's direction on average (after Fairfield and Leymarie's
// Rho8, 1991): streams do not run along the grid. The stack order is built breadth first.
#include "models/made/drainage.h"

#include "models/made/by_rows.h"
#include "models/made/terrain_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace octant::models::made {

namespace {

struct Step {
    int dx = 0;
    int dy = 0;
};

constexpr double diagonal = 1.4142135623730951;

/// The eight neighbours in a circle; even ones share a side with the cell.
constexpr std::array<Step, 8> circle = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

bool is_inside(const TerrainGrid& grid, int column, int row) {
    return column >= 0 && row >= 0 && column < grid.side && row < grid.side;
}

/// Heights of a cell's neighbours in a circle, NaN beyond the grid.
std::array<double, 8> heights_around(const TerrainGrid& ground, int column, int row) {
    constexpr double beyond = std::numeric_limits<double>::quiet_NaN();
    const bool is_inner =
        column > 0 && row > 0 && column + 1 < ground.side && row + 1 < ground.side;
    std::array<double, 8> heights{};
    for (std::size_t n = 0; n < circle.size(); ++n) {
        const int x = column + circle[n].dx;
        const int y = row + circle[n].dy;
        heights[n] = is_inner || is_inside(ground, x, y) ? ground.at(x, y) : beyond;
    }
    return heights;
}

/// A facet is a triangle of a cell, a neighbour that shares a side with it and one at its corner.
/// Returns the slope of the steepest descent within it, a cell; NaN where one of the drops is.
double steepest_within(double to_side, double side_to_corner) {
    const double between = std::sqrt(to_side * to_side + side_to_corner * side_to_corner);
    const double by_corner = (to_side + side_to_corner) / diagonal;
    const double inner = side_to_corner >= to_side ? by_corner : between;
    return side_to_corner <= 0.0 ? to_side : inner;
}

/// Share of corner steps that leads in the direction of the steepest descent within a facet.
double corner_chance(double to_side, double side_to_corner) {
    if (side_to_corner <= 0.0) {
        return 0.0;
    }
    return side_to_corner >= to_side ? 1.0 : side_to_corner / to_side;
}

/// Facet n lies between neighbours n and n + 1 of the circle, of which one shares a side.
constexpr std::size_t side_of_facet(std::size_t n) {
    return (n + 1) % circle.size() & ~std::size_t{1};
}

constexpr std::size_t corner_of_facet(std::size_t n) {
    return n | 1U;
}

void choose_receiver(
    const TerrainGrid& ground, int column, int row, double chance, Drainage& water) {
    const std::size_t i = ground.index(column, row);
    const std::array<double, 8> around = heights_around(ground, column, row);
    std::array<double, 8> to_side{};
    std::array<double, 8> side_to_corner{};
    std::array<double, 8> slopes{};
    for (std::size_t n = 0; n < circle.size(); ++n) {
        to_side[n] = ground.values[i] - around[side_of_facet(n)];
        side_to_corner[n] = around[side_of_facet(n)] - around[corner_of_facet(n)];
        slopes[n] = steepest_within(to_side[n], side_to_corner[n]);
    }
    double steepest = 0.0;
    std::size_t facet = circle.size();
    for (std::size_t n = 0; n < circle.size(); ++n) {
        facet = slopes[n] > steepest ? n : facet;
        steepest = slopes[n] > steepest ? slopes[n] : steepest;
    }
    if (facet == circle.size()) {
        return;
    }
    const bool by_corner = chance < corner_chance(to_side[facet], side_to_corner[facet]);
    const Step step = circle[by_corner ? corner_of_facet(facet) : side_of_facet(facet)];
    water.receiver[i] = static_cast<int>(ground.index(column + step.dx, row + step.dy));
    water.length_m[i] = by_corner ? diagonal * ground.cell_m : ground.cell_m;
}

/// Fills `upstream` from `receiver`: outlets and pits first, then always the donors of what stands
/// already.
void order_upstream(Drainage& water) {
    const std::size_t count = water.receiver.size();
    std::vector<int> first_donor(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver != i) {
            ++first_donor[receiver + 1];
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        first_donor[i + 1] += first_donor[i];
    }
    std::vector<int> donors(count);
    std::vector<int> next = first_donor;
    water.upstream.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver != i) {
            donors[static_cast<std::size_t>(next[receiver]++)] = static_cast<int>(i);
        } else {
            water.upstream.push_back(static_cast<int>(i));
        }
    }
    for (std::size_t at = 0; at < water.upstream.size(); ++at) {
        const auto i = static_cast<std::size_t>(water.upstream[at]);
        for (int d = first_donor[i]; d < first_donor[i + 1]; ++d) {
            water.upstream.push_back(donors[static_cast<std::size_t>(d)]);
        }
    }
}

/// The cells from which water is looked for uphill, lowest first, of equal ones the first of the
/// grid. A heap whose nodes have four children: half as deep as that of std::priority_queue.
class Front {
public:
    struct Entry {
        double height_m = 0.0;
        int cell = 0;

        bool is_before(const Entry& other) const {
            return height_m < other.height_m || (height_m == other.height_m && cell < other.cell);
        }
    };

    bool empty() const { return heap_.empty(); }

    void push(const Entry& entry) {
        std::size_t at = heap_.size();
        heap_.push_back(entry);
        while (at > 0 && entry.is_before(heap_[(at - 1) / children])) {
            heap_[at] = heap_[(at - 1) / children];
            at = (at - 1) / children;
        }
        heap_[at] = entry;
    }

    Entry pop() {
        const Entry lowest = heap_.front();
        const Entry last = heap_.back();
        heap_.pop_back();
        if (!heap_.empty()) {
            sink(last);
        }
        return lowest;
    }

private:
    static constexpr std::size_t children = 4;

    /// Puts an entry into the place that is free at the top.
    void sink(const Entry& entry) {
        std::size_t at = 0;
        for (std::size_t first = 1; first < heap_.size(); first = children * at + 1) {
            const std::size_t end = std::min(first + children, heap_.size());
            std::size_t lowest = first;
            for (std::size_t child = first + 1; child < end; ++child) {
                lowest = heap_[child].is_before(heap_[lowest]) ? child : lowest;
            }
            if (!heap_[lowest].is_before(entry)) {
                break;
            }
            heap_[at] = heap_[lowest];
            at = lowest;
        }
        heap_[at] = entry;
    }

    std::vector<Entry> heap_;
};

} // namespace

void fill_pits(TerrainGrid& ground, const std::vector<char>& is_outlet) {
    Front front;
    std::vector<char> reached = is_outlet;
    for (std::size_t i = 0; i < is_outlet.size(); ++i) {
        if (is_outlet[i] != 0) {
            front.push({ground.values[i], static_cast<int>(i)});
        }
    }
    const double trace_m = 1e-5 * ground.cell_m;
    while (!front.empty()) {
        const auto [height, cell] = front.pop();
        for (const Step& n : circle) {
            const int x = cell % ground.side + n.dx;
            const int y = cell / ground.side + n.dy;
            if (!is_inside(ground, x, y) || reached[ground.index(x, y)] != 0) {
                continue;
            }
            const std::size_t i = ground.index(x, y);
            reached[i] = 1;
            ground.values[i] = std::max(ground.values[i], height + trace_m);
            front.push({ground.values[i], static_cast<int>(i)});
        }
    }
}

Drainage
drained(const TerrainGrid& ground, const std::vector<char>& is_outlet, std::uint64_t seed) {
    Drainage water;
    const std::size_t count = ground.values.size();
    water.receiver.resize(count);
    water.length_m.assign(count, ground.cell_m);
    water.area_m2.assign(count, ground.cell_m * ground.cell_m);
    by_rows(ground.side, [&](int row) {
        for (int column = 0; column < ground.side; ++column) {
            const std::size_t i = ground.index(column, row);
            water.receiver[i] = static_cast<int>(i);
            if (is_outlet[i] == 0) {
                choose_receiver(ground, column, row, hashed_unit(seed, column, row), water);
            }
        }
    });
    order_upstream(water);
    for (std::size_t at = count; at-- > 0;) {
        const auto i = static_cast<std::size_t>(water.upstream[at]);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver != i) {
            water.area_m2[receiver] += water.area_m2[i];
        }
    }
    return water;
}

void erode(
    TerrainGrid& ground,
    const Drainage& water,
    const std::vector<double>& uplift,
    const StreamPower& power) {
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver == i) {
            continue;
        }
        const double cut =
            power.step / power.steepness_m * std::sqrt(water.area_m2[i]) / water.length_m[i];
        const double raised = ground.values[i] + power.step * uplift[i];
        ground.values[i] = (raised + cut * ground.values[receiver]) / (1.0 + cut);
    }
}

} // namespace octant::models::made
