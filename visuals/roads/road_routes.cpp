#include "visuals/roads/road_routes.h"

#include "sim/base/hash.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

namespace octant::visuals::roads {

namespace {

constexpr double min_block_m = 4000.0;
constexpr int max_blocks = 20; ///< a side
constexpr double max_town_slope = 0.1;
constexpr double max_town_above_m = 90.0;
constexpr double max_climb = 0.25;     ///< from one cell of a road to the next
constexpr double max_mean_cost = 9.0;  ///< of a road, over that of one on even ground
constexpr double max_detour_ratio = 2.2; ///< over the way by a road of its own
constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Neighbours and knight's moves.
constexpr std::array<glm::ivec2, 16> moves = {
    glm::ivec2(1, 0),
    {0, 1},
    {-1, 0},
    {0, -1},
    {1, 1},
    {-1, 1},
    {-1, -1},
    {1, -1},
    {2, 1},
    {1, 2},
    {-1, 2},
    {-2, 1},
    {-2, -1},
    {-1, -2},
    {1, -2},
    {2, -1}};

/// Calls `visit` with each cell that a road may go to next.
template <class Visit>
void for_each_neighbour(const RoadCostGrid& ground, std::size_t cell, const Visit& visit) {
    const glm::ivec2 at = ground.column_row(cell);
    for (const glm::ivec2& move : moves) {
        const glm::ivec2 next = at + move;
        if (next.x < 0 || next.y < 0 || next.x >= ground.columns() || next.y >= ground.rows()) {
            continue;
        }
        const std::size_t to = ground.cell(next.x, next.y);
        // A knight's move goes between two cells, of which none may be water.
        const bool is_knight = std::abs(move.x) + std::abs(move.y) == 3;
        const glm::ivec2 half = move / 2;
        const bool is_free =
            ground.is_free(to) &&
            (!is_knight || (ground.is_free(ground.cell(at.x + half.x, at.y + half.y)) &&
                            ground.is_free(ground.cell(next.x - half.x, next.y - half.y))));
        const double climb_m = std::abs(ground.height_m(to) - ground.height_m(cell));
        const double length_m = glm::distance(ground.place_m(cell), ground.place_m(to));
        if (is_free && climb_m <= max_climb * length_m) {
            visit(to);
        }
    }
}

/// From each cell the cheapest way to a town.
struct TownDistances {
    std::vector<double> cost_m;
    std::vector<std::size_t> town;   ///< place in the list of towns
    std::vector<std::size_t> predecessor; ///< the next cell on the way
};

TownDistances town_distances(const RoadCostGrid& ground, const std::vector<std::size_t>& towns) {
    const std::size_t count =
        static_cast<std::size_t>(ground.columns()) * static_cast<std::size_t>(ground.rows());
    TownDistances distances{
        std::vector<double>(count, infinite),
        std::vector<std::size_t>(count, no_cell),
        std::vector<std::size_t>(count, no_cell)};
    using QueueEntry = std::pair<double, std::size_t>;
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    for (std::size_t town = 0; town < towns.size(); ++town) {
        distances.cost_m[towns[town]] = 0.0;
        distances.town[towns[town]] = town;
        open.emplace(0.0, towns[town]);
    }
    while (!open.empty()) {
        const auto [cost_m, cell] = open.top();
        open.pop();
        if (cost_m > distances.cost_m[cell]) {
            continue;
        }
        for_each_neighbour(ground, cell, [&, from = cell, so_far_m = cost_m](std::size_t to) {
            const double through_m = so_far_m + ground.cost_m(from, to);
            if (through_m < distances.cost_m[to]) {
                distances.cost_m[to] = through_m;
                distances.town[to] = distances.town[from];
                distances.predecessor[to] = from;
                open.emplace(through_m, to);
            }
        });
    }
    return distances;
}

/// The cheapest road from one town's surroundings to another's: where it goes over from the one to
/// the other.
struct TownLink {
    double cost_m = infinite;
    std::size_t from = no_cell;
    std::size_t to = no_cell;
    std::array<std::size_t, 2> towns{};
};

/// By their cost, each pair of towns once.
std::vector<TownLink> links_between(const RoadCostGrid& ground, const TownDistances& distances) {
    std::map<std::array<std::size_t, 2>, TownLink> best;
    for (std::size_t cell = 0; cell < distances.town.size(); ++cell) {
        if (distances.town[cell] == no_cell) {
            continue;
        }
        for_each_neighbour(ground, cell, [&](std::size_t to) {
            const std::array towns{distances.town[cell], distances.town[to]};
            if (towns[0] >= towns[1]) {
                return; // the same, or met from the other side
            }
            TownLink& link = best[towns];
            const double cost_m = distances.cost_m[cell] + ground.cost_m(cell, to) + distances.cost_m[to];
            if (cost_m < link.cost_m) {
                link = {cost_m, cell, to, towns};
            }
        });
    }
    std::vector<TownLink> links;
    for (const auto& [towns, link] : best) {
        links.push_back(link);
    }
    std::ranges::stable_sort(links, {}, &TownLink::cost_m);
    return links;
}

/// The cells of a link from town to town.
Route cells_of(const TownLink& link, const TownDistances& distances) {
    Route cells;
    for (std::size_t at = link.from; at != no_cell; at = distances.predecessor[at]) {
        cells.push_back(at);
    }
    std::ranges::reverse(cells);
    for (std::size_t at = link.to; at != no_cell; at = distances.predecessor[at]) {
        cells.push_back(at);
    }
    return cells;
}

double length_m(const RoadCostGrid& ground, const Route& cells) {
    double sum_m = 0.0;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        sum_m += glm::distance(ground.place_m(cells[i - 1]), ground.place_m(cells[i]));
    }
    return sum_m;
}

/// The cheapest way by links that are built from town to town.
double shortest_detour_m(
    const std::vector<std::vector<std::pair<std::size_t, double>>>& built,
    const std::array<std::size_t, 2>& towns,
    double max_detour_m) {
    std::vector<double> cost_m(built.size(), infinite);
    using QueueEntry = std::pair<double, std::size_t>;
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    open.emplace(cost_m[towns[0]] = 0.0, towns[0]);
    while (!open.empty()) {
        const auto [so_far_m, town] = open.top();
        open.pop();
        if (town == towns[1] || so_far_m > max_detour_m) {
            return so_far_m;
        }
        for (const auto& [next, link_m] : built[town]) {
            if (so_far_m + link_m < cost_m[next]) {
                open.emplace(cost_m[next] = so_far_m + link_m, next);
            }
        }
    }
    return infinite;
}

/// Cheap links first: each that joins what is not joined or saves a long way around.
std::vector<Route>
routes_of_links(const RoadCostGrid& ground, const TownDistances& distances, std::size_t town_count) {
    std::vector<Route> routes;
    std::vector<std::vector<std::pair<std::size_t, double>>> built(town_count);
    for (const TownLink& link : links_between(ground, distances)) {
        const double max_detour_m = max_detour_ratio * link.cost_m;
        if (shortest_detour_m(built, link.towns, max_detour_m) <= max_detour_m) {
            continue;
        }
        Route cells = cells_of(link, distances);
        if (link.cost_m > max_mean_cost * length_m(ground, cells)) {
            continue;
        }
        built[link.towns[0]].emplace_back(link.towns[1], link.cost_m);
        built[link.towns[1]].emplace_back(link.towns[0], link.cost_m);
        routes.push_back(std::move(cells));
    }
    return routes;
}

/// Which cells are joined to which.
using CellGraph = std::map<std::size_t, std::set<std::size_t>>;

CellGraph graph_of(const std::vector<Route>& routes) {
    CellGraph graph;
    for (const Route& route : routes) {
        for (std::size_t i = 1; i < route.size(); ++i) {
            graph[route[i - 1]].insert(route[i]);
            graph[route[i]].insert(route[i - 1]);
        }
    }
    return graph;
}

/// Follows a road from one cell by the next to one of the `ends`, or around to where it began, and
/// forgets it.
Route extract_route(
    CellGraph& graph, const std::vector<std::size_t>& ends, std::size_t first, std::size_t next) {
    Route route{first};
    const auto go_to = [&](std::size_t to) {
        graph[route.back()].erase(to);
        graph[to].erase(route.back());
        route.push_back(to);
    };
    go_to(next);
    while (route.back() != first && !std::ranges::binary_search(ends, route.back())) {
        go_to(*graph[route.back()].begin());
    }
    return route;
}

} // namespace

std::vector<std::size_t> find_towns(const RoadCostGrid& ground, const RoadConstraints& constraints) {
    if (ground.columns() == 0) {
        return {};
    }
    const double extent_m = ground.cell_m() * std::max(ground.columns(), ground.rows());
    const double block_m = std::max(min_block_m, extent_m / max_blocks);
    const int block = std::max(static_cast<int>(block_m / ground.cell_m()), 2);
    const auto is_habitable = [&](std::size_t cell) {
        return ground.is_free(cell) && ground.slope(cell) <= max_town_slope &&
               ground.height_above_valley_m(cell) <= max_town_above_m &&
               ground.height_m(cell) <= constraints.water_m + constraints.max_town_height_m;
    };
    const auto site_penalty = [&](std::size_t cell) {
        const double dice = scrambled(static_cast<std::uint32_t>(cell)) * 0x1p-32;
        return ground.slope(cell) / max_town_slope +
               ground.height_above_valley_m(cell) / max_town_above_m + 0.3 * dice;
    };
    std::vector<std::size_t> towns;
    for (int south = 0; south < ground.rows(); south += block) {
        for (int west = 0; west < ground.columns(); west += block) {
            std::size_t best = no_cell;
            for (int row = south; row < std::min(south + block, ground.rows()); ++row) {
                for (int column = west; column < std::min(west + block, ground.columns());
                     ++column) {
                    const std::size_t cell = ground.cell(column, row);
                    if (is_habitable(cell) && (best == no_cell || site_penalty(cell) < site_penalty(best))) {
                        best = cell;
                    }
                }
            }
            if (best != no_cell) {
                towns.push_back(best);
            }
        }
    }
    return towns;
}

std::vector<Route> find_routes(const RoadCostGrid& ground, const std::vector<std::size_t>& towns) {
    const TownDistances distances = town_distances(ground, towns);
    CellGraph graph = graph_of(routes_of_links(ground, distances, towns.size()));
    std::vector<std::size_t> ends;
    for (const auto& [cell, joined] : graph) {
        if (joined.size() != 2) {
            ends.push_back(cell);
        }
    }
    std::vector<Route> routes;
    const auto take_all_from = [&](std::size_t cell) {
        while (!graph[cell].empty()) {
            routes.push_back(extract_route(graph, ends, cell, *graph[cell].begin()));
        }
    };
    std::ranges::for_each(ends, take_all_from);
    for (const auto& [cell, joined] : graph) { // what is left are rings
        take_all_from(cell);
    }
    return routes;
}

} // namespace octant::visuals::roads
