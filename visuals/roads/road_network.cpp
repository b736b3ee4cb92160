#include "visuals/roads/road_network.h"

#include "sim/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <span>
#include <utility>

namespace octant::visuals::roads {

namespace {

constexpr double default_cell_m = 100.0;
constexpr double max_cell_m = 600.0;
constexpr int max_cells = 512; ///< a side
constexpr int min_cells = 12;  ///< a side
constexpr double valley_radius_m = 1500.0;
constexpr int min_water_samples = 8; ///< for water, along each side of a cell, if there are samples
constexpr double water_clearance_m = 0.5;
constexpr double max_relief = 0.8; ///< of a cell that is no cliff, over its width
// What doubles the cost of a road.
constexpr double doubling_climb = 0.08;
constexpr double doubling_slope = 0.18;
constexpr double doubling_above_valley_m = 120.0;

/// How many samples lie from one cell to the next.
int stride_of(const terrain::GroundSamples& ground) {
    const int longest = std::max(ground.columns(), ground.rows()) - 1;
    const int by_width = static_cast<int>(std::ceil(default_cell_m / ground.spacing_m()));
    return std::max({by_width, (longest + max_cells - 1) / max_cells, 1});
}

/// The least of each value and those up to `reach` places before and after it.
void spread_minimum(const std::vector<double>& from, int reach, std::vector<double>& to) {
    const auto count = static_cast<int>(from.size());
    to.resize(from.size());
    for (int i = 0; i < count; ++i) {
        const auto first = from.begin() + std::max(i - reach, 0);
        const auto end = from.begin() + std::min(i + reach + 1, count);
        to[static_cast<std::size_t>(i)] = *std::min_element(first, end);
    }
}

} // namespace

RoadCostGrid::RoadCostGrid(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    const int stride = stride_of(ground);
    const glm::ivec2 cells = (glm::ivec2(ground.columns(), ground.rows()) - 1) / stride;
    cell_m_ = stride * ground.spacing_m();
    if (cell_m_ > max_cell_m || std::min(cells.x, cells.y) < min_cells) { return; }
    columns_ = cells.x;
    rows_ = cells.y;
    first_m_ = glm::dvec2(ground.sample_m(0, 0)) + 0.5 * cell_m_;
    read(ground, stride, constraints);
    find_slopes();
    find_valley_floors();
}

void RoadCostGrid::read(const terrain::GroundSamples& ground, int stride, const RoadConstraints& constraints) {
    const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    heights_m_.reserve(count);
    free_.reserve(count);
    const int step = std::max(stride / min_water_samples, 1);
    const auto samples = static_cast<std::size_t>(ground.columns());
    std::vector<float> lines_m(static_cast<std::size_t>(stride / step + 1) * samples);
    for (int row = 0; row < rows_; ++row) {
        for (int north = 0; north <= stride; north += step) {
            const auto line = static_cast<std::size_t>(north / step);
            ground.copy_row(row * stride + north, std::span(lines_m).subspan(line * samples, samples));
        }
        for (int column = 0; column < columns_; ++column) {
            const auto first = static_cast<std::size_t>(column) * static_cast<std::size_t>(stride);
            auto lowest_m = static_cast<double>(lines_m[first]);
            double highest_m = lowest_m;
            double sum_m = 0.0;
            int seen = 0;
            for (std::size_t line = 0; line < lines_m.size(); line += samples) {
                for (int east = 0; east <= stride; east += step) {
                    const auto height_m = static_cast<double>(lines_m[line + first + static_cast<std::size_t>(east)]);
                    lowest_m = std::min(lowest_m, height_m);
                    highest_m = std::max(highest_m, height_m);
                    sum_m += height_m;
                    ++seen;
                }
            }
            heights_m_.push_back(sum_m / seen);
            const bool is_dry = lowest_m > constraints.water_m + water_clearance_m;
            const bool is_blocked = constraints.is_blocked && constraints.is_blocked(place_m(free_.size()));
            const bool is_cliff = highest_m - lowest_m > max_relief * cell_m_;
            free_.push_back(is_dry && !is_cliff && !is_blocked ? 1 : 0);
        }
    }
}

void RoadCostGrid::find_slopes() {
    slopes_.reserve(heights_m_.size());
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const int west = std::max(column - 1, 0);
            const int east = std::min(column + 1, columns_ - 1);
            const int south = std::max(row - 1, 0);
            const int north = std::min(row + 1, rows_ - 1);
            const glm::dvec2 rise((heights_m_[cell(east, row)] - heights_m_[cell(west, row)]) / (east - west),
                (heights_m_[cell(column, north)] - heights_m_[cell(column, south)]) / (north - south));
            slopes_.push_back(glm::length(rise) / cell_m_);
        }
    }
}

/// Along rows, then along columns.
void RoadCostGrid::find_valley_floors() {
    const int reach = std::max(static_cast<int>(valley_radius_m / cell_m_), 1);
    valley_floors_m_ = heights_m_;
    std::vector<double> line;
    std::vector<double> least;
    const auto spread = [&](int lines, int length, const auto& cell_of) {
        for (int i = 0; i < lines; ++i) {
            line.clear();
            for (int j = 0; j < length; ++j) { line.push_back(valley_floors_m_[cell_of(i, j)]); }
            spread_minimum(line, reach, least);
            for (int j = 0; j < length; ++j) { valley_floors_m_[cell_of(i, j)] = least[static_cast<std::size_t>(j)]; }
        }
    };
    spread(rows_, columns_, [this](int row, int column) { return cell(column, row); });
    spread(columns_, rows_, [this](int column, int row) { return cell(column, row); });
}

double RoadCostGrid::cost_m(std::size_t from, std::size_t to) const {
    const auto squared = [](double share) { return share * share; };
    const double length_m = glm::distance(place_m(from), place_m(to));
    const double climb = (heights_m_[to] - heights_m_[from]) / length_m;
    const double slope = 0.5 * (slopes_[from] + slopes_[to]);
    const double above_m = 0.5 * (height_above_valley_m(from) + height_above_valley_m(to));
    return length_m * (1.0 + squared(climb / doubling_climb) + squared(slope / doubling_slope) +
                          above_m / doubling_above_valley_m);
}

namespace {

constexpr double min_block_m = 4000.0;
constexpr int max_blocks = 20; ///< a side
constexpr double max_town_slope = 0.1;
constexpr double max_town_above_m = 90.0;
constexpr double max_climb = 0.25;       ///< from one cell of a road to the next
constexpr double max_mean_cost = 9.0;    ///< of a road, over that of one on even ground
constexpr double max_detour_ratio = 2.2; ///< over the way by a road of its own
constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Neighbours and knight's moves.
constexpr std::array<glm::ivec2, 16> moves = {glm::ivec2(1, 0), {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1},
    {1, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}};

/// Calls `visit` with each cell that a road may go to next and that is wanted.
template <class Wanted, class Visit>
void for_each_neighbour(const RoadCostGrid& ground, std::size_t cell, const Wanted& is_wanted, const Visit& visit) {
    const glm::ivec2 at = ground.column_row(cell);
    for (const glm::ivec2& move : moves) {
        const glm::ivec2 next = at + move;
        if (next.x < 0 || next.y < 0 || next.x >= ground.columns() || next.y >= ground.rows()) { continue; }
        const std::size_t to = ground.cell(next.x, next.y);
        if (!is_wanted(to)) { continue; }
        // A knight's move goes between two cells, of which none may be water.
        const bool is_knight = std::abs(move.x) + std::abs(move.y) == 3;
        const glm::ivec2 half = move / 2;
        const bool is_free =
            ground.is_free(to) && (!is_knight || (ground.is_free(ground.cell(at.x + half.x, at.y + half.y)) &&
                                                     ground.is_free(ground.cell(next.x - half.x, next.y - half.y))));
        const double climb_m = std::abs(ground.height_m(to) - ground.height_m(cell));
        const double length_m = glm::distance(ground.place_m(cell), ground.place_m(to));
        if (is_free && climb_m <= max_climb * length_m) { visit(to); }
    }
}

/// From each cell the cheapest way to a town.
struct TownDistances {
    std::vector<double> cost_m;
    std::vector<std::size_t> town;        ///< place in the list of towns
    std::vector<std::size_t> predecessor; ///< the next cell on the way
};

TownDistances town_distances(const RoadCostGrid& ground, const std::vector<std::size_t>& towns) {
    const std::size_t count = static_cast<std::size_t>(ground.columns()) * static_cast<std::size_t>(ground.rows());
    TownDistances distances{std::vector<double>(count, infinite), std::vector<std::size_t>(count, no_cell),
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
        if (cost_m > distances.cost_m[cell]) { continue; }
        // Most neighbours have been reached at a lower cost.
        for_each_neighbour(
            ground, cell, [&, so_far_m = cost_m](std::size_t to) { return so_far_m < distances.cost_m[to]; },
            [&, from = cell, so_far_m = cost_m](std::size_t to) {
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

/// The cheapest road from one town's surroundings to another's: where it goes over from the one to the other.
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
        if (distances.town[cell] == no_cell) { continue; }
        // Not the same town, nor one met from the other side.
        for_each_neighbour(
            ground, cell, [&](std::size_t to) { return distances.town[cell] < distances.town[to]; },
            [&](std::size_t to) {
                const std::array towns{distances.town[cell], distances.town[to]};
                TownLink& link = best[towns];
                const double cost_m = distances.cost_m[cell] + ground.cost_m(cell, to) + distances.cost_m[to];
                if (cost_m < link.cost_m) { link = {cost_m, cell, to, towns}; }
            });
    }
    std::vector<TownLink> links;
    for (const auto& [towns, link] : best) { links.push_back(link); }
    std::ranges::stable_sort(links, {}, &TownLink::cost_m);
    return links;
}

/// The cells of a link from town to town.
Route cells_of(const TownLink& link, const TownDistances& distances) {
    Route cells;
    for (std::size_t at = link.from; at != no_cell; at = distances.predecessor[at]) { cells.push_back(at); }
    std::ranges::reverse(cells);
    for (std::size_t at = link.to; at != no_cell; at = distances.predecessor[at]) { cells.push_back(at); }
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
double shortest_detour_m(const std::vector<std::vector<std::pair<std::size_t, double>>>& built,
    const std::array<std::size_t, 2>& towns, double max_detour_m) {
    std::vector<double> cost_m(built.size(), infinite);
    using QueueEntry = std::pair<double, std::size_t>;
    std::priority_queue<QueueEntry, std::vector<QueueEntry>, std::greater<>> open;
    open.emplace(cost_m[towns[0]] = 0.0, towns[0]);
    while (!open.empty()) {
        const auto [so_far_m, town] = open.top();
        open.pop();
        if (town == towns[1] || so_far_m > max_detour_m) { return so_far_m; }
        for (const auto& [next, link_m] : built[town]) {
            if (so_far_m + link_m < cost_m[next]) { open.emplace(cost_m[next] = so_far_m + link_m, next); }
        }
    }
    return infinite;
}

/// Cheap links first: each that joins what is not joined or saves a long way around.
std::vector<Route> routes_of_links(const RoadCostGrid& ground, const TownDistances& distances, std::size_t town_count) {
    std::vector<Route> routes;
    std::vector<std::vector<std::pair<std::size_t, double>>> built(town_count);
    for (const TownLink& link : links_between(ground, distances)) {
        const double max_detour_m = max_detour_ratio * link.cost_m;
        if (shortest_detour_m(built, link.towns, max_detour_m) <= max_detour_m) { continue; }
        Route cells = cells_of(link, distances);
        if (link.cost_m > max_mean_cost * length_m(ground, cells)) { continue; }
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

/// Follows a road from one cell by the next to one of the `ends`, or around to where it began, and forgets it.
Route extract_route(CellGraph& graph, const std::vector<std::size_t>& ends, std::size_t first, std::size_t next) {
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
    if (ground.columns() == 0) { return {}; }
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
        return ground.slope(cell) / max_town_slope + ground.height_above_valley_m(cell) / max_town_above_m + 0.3 * dice;
    };
    std::vector<std::size_t> towns;
    for (int south = 0; south < ground.rows(); south += block) {
        for (int west = 0; west < ground.columns(); west += block) {
            std::size_t best = no_cell;
            for (int row = south; row < std::min(south + block, ground.rows()); ++row) {
                for (int column = west; column < std::min(west + block, ground.columns()); ++column) {
                    const std::size_t cell = ground.cell(column, row);
                    if (is_habitable(cell) && (best == no_cell || site_penalty(cell) < site_penalty(best))) {
                        best = cell;
                    }
                }
            }
            if (best != no_cell) { towns.push_back(best); }
        }
    }
    return towns;
}

std::vector<Route> find_routes(const RoadCostGrid& ground, const std::vector<std::size_t>& towns) {
    const TownDistances distances = town_distances(ground, towns);
    CellGraph graph = graph_of(routes_of_links(ground, distances, towns.size()));
    std::vector<std::size_t> ends;
    for (const auto& [cell, joined] : graph) {
        if (joined.size() != 2) { ends.push_back(cell); }
    }
    std::vector<Route> routes;
    const auto take_all_from = [&](std::size_t cell) {
        while (!graph[cell].empty()) { routes.push_back(extract_route(graph, ends, cell, *graph[cell].begin())); }
    };
    std::ranges::for_each(ends, take_all_from);
    for (const auto& [cell, joined] : graph) { // what is left are rings
        take_all_from(cell);
    }
    return routes;
}

namespace {

constexpr std::size_t steps_per_cell = 8;
constexpr int smoothing_passes = 3;
constexpr std::size_t section_points = 32;
constexpr double max_mitre_ratio = 1.5; ///< half widths

/// Points at even distances between neighbouring places.
std::vector<glm::dvec2> resampled(std::span<const glm::dvec2> places_m, double step_m) {
    std::vector<glm::dvec2> line_m;
    for (std::size_t i = 1; i < places_m.size(); ++i) {
        const double length_m = glm::distance(places_m[i - 1], places_m[i]);
        const int steps = std::max(static_cast<int>(std::lround(length_m / step_m)), 1);
        for (int step = 0; step < steps; ++step) {
            line_m.push_back(glm::mix(places_m[i - 1], places_m[i], static_cast<double>(step) / steps));
        }
    }
    line_m.push_back(places_m.back());
    return line_m;
}

/// Each point as the mean of as many before it as after it, at most `reach`.
std::vector<glm::dvec2> smoothed(const std::vector<glm::dvec2>& line_m, std::size_t reach) {
    std::vector<glm::dvec2> smooth_m;
    smooth_m.reserve(line_m.size());
    for (std::size_t i = 0; i < line_m.size(); ++i) {
        const std::size_t around = std::min({reach, i, line_m.size() - 1 - i});
        glm::dvec2 sum_m(0.0);
        for (std::size_t j = i - around; j <= i + around; ++j) { sum_m += line_m[j]; }
        smooth_m.push_back(sum_m / static_cast<double>(2 * around + 1));
    }
    return smooth_m;
}

/// A unit vector; along x where there is none.
glm::dvec2 direction(const glm::dvec2& way_m) {
    const double length_m = glm::length(way_m);
    return length_m > 1e-9 ? way_m / length_m : glm::dvec2(1.0, 0.0);
}

/// From a point where one way ends and the next begins to the left edge of both.
glm::dvec2 left_edge_offset_m(const glm::dvec2& before, const glm::dvec2& after) {
    const glm::dvec2 along = direction(direction(before) + direction(after));
    const glm::dvec2 left(-along.y, along.x);
    const double seen = std::max(glm::dot(along, direction(after)), 1.0 / max_mitre_ratio);
    return left * (half_width_m / seen);
}

/// The points of a level; at the ends edges go on as on the whole line.
std::vector<RoadPoint> level_points(std::span<const glm::dvec2> piece_m, std::size_t number,
    const glm::dvec2& first_left_m, const glm::dvec2& last_left_m) {
    const std::vector<std::size_t> kept = simplify_line(piece_m, level_error_m[number], max_segment_length_m[number]);
    std::vector<RoadPoint> level;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2& at_m = piece_m[kept[i]];
        if (i == 0 || i + 1 == kept.size()) {
            level.push_back({at_m, i == 0 ? first_left_m : last_left_m});
        } else {
            level.push_back({at_m, left_edge_offset_m(at_m - piece_m[kept[i - 1]], piece_m[kept[i + 1]] - at_m)});
        }
    }
    return level;
}

void update_bounds(RoadSection& section) {
    section.min_m = glm::dvec2(std::numeric_limits<double>::infinity());
    section.max_m = -section.min_m;
    for (const std::vector<RoadPoint>& level : section.levels) {
        for (const RoadPoint& point : level) {
            const glm::dvec2 aside_m = glm::abs(point.to_left_edge_m);
            section.min_m = glm::min(section.min_m, point.at_m - aside_m);
            section.max_m = glm::max(section.max_m, point.at_m + aside_m);
        }
    }
}

/// The distance of a point from the segment between two others.
double distance_to_segment_m(const glm::dvec2& at_m, const glm::dvec2& from_m, const glm::dvec2& to_m) {
    const glm::dvec2 way_m = to_m - from_m;
    const double squared_m2 = std::max(glm::dot(way_m, way_m), 1e-12);
    const double share = std::clamp(glm::dot(at_m - from_m, way_m) / squared_m2, 0.0, 1.0);
    return glm::distance(at_m, from_m + share * way_m);
}

} // namespace

std::vector<glm::dvec2> smooth_centre_line(
    std::span<const glm::dvec2> places_m, double cell_m, const std::function<bool(const glm::dvec2&)>& is_free) {
    const std::vector<glm::dvec2> straight_m = resampled(places_m, cell_m / static_cast<double>(steps_per_cell));
    for (const std::size_t reach : {steps_per_cell, steps_per_cell / 2}) {
        std::vector<glm::dvec2> line_m = straight_m;
        for (int pass = 0; pass < smoothing_passes; ++pass) { line_m = smoothed(line_m, reach); }
        if (std::ranges::all_of(line_m, is_free)) { return line_m; }
    }
    std::vector<glm::dvec2> nearly_straight_m = smoothed(straight_m, 1);
    if (!std::ranges::all_of(nearly_straight_m, is_free)) { nearly_straight_m.clear(); }
    return nearly_straight_m;
}

std::vector<std::size_t> simplify_line(std::span<const glm::dvec2> line_m, double error_m, double max_gap_m) {
    std::vector<std::size_t> kept{0};
    std::vector<std::size_t> open{line_m.size() - 1}; // ends of stretches, the nearest last
    while (!open.empty()) {
        const std::size_t first = kept.back();
        const std::size_t last = open.back();
        std::size_t farthest = last;
        double max_m = error_m;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double off_m = distance_to_segment_m(line_m[i], line_m[first], line_m[last]);
            if (off_m > max_m) {
                max_m = off_m;
                farthest = i;
            }
        }
        if (farthest == last && glm::distance(line_m[first], line_m[last]) > max_gap_m) {
            farthest = (first + last + 1) / 2; // the last one where there is none between
        }
        if (farthest == last) {
            kept.push_back(last);
            open.pop_back();
        } else {
            open.push_back(farthest);
        }
    }
    return kept;
}

void append_sections(std::vector<glm::dvec2> line_m, std::vector<RoadSection>& sections) {
    const std::size_t last = line_m.size() - 1;
    const glm::dvec2 first_way = direction(line_m[1] - line_m[0]);
    const glm::dvec2 last_way = direction(line_m[last] - line_m[last - 1]);
    line_m[0] -= first_way * half_width_m;
    line_m[last] += last_way * half_width_m;
    const auto to_left_edge_m = [&](std::size_t i) {
        return left_edge_offset_m(
            i > 0 ? line_m[i] - line_m[i - 1] : first_way, i < last ? line_m[i + 1] - line_m[i] : last_way);
    };
    for (std::size_t first = 0; first < last;) {
        // No short piece is left over.
        const std::size_t end = first + 2 * section_points > last ? last : first + section_points;
        const std::span piece_m(&line_m[first], end - first + 1);
        RoadSection& section = sections.emplace_back();
        for (std::size_t level = 0; level < section.levels.size(); ++level) {
            section.levels[level] = level_points(piece_m, level, to_left_edge_m(first), to_left_edge_m(end));
        }
        update_bounds(section);
        first = end;
    }
}

namespace {

constexpr double min_square_m = 150.0;
constexpr double max_squares = 700.0; ///< a side

/// Height between samples; those of the border beyond it.
double height_at(const terrain::GroundSamples& ground, const glm::dvec2& place_m) {
    const glm::dvec2 last(ground.columns() - 2, ground.rows() - 2);
    const glm::dvec2 grid = glm::clamp(ground.grid_from_world(place_m.x, place_m.y), glm::dvec2(0.0), last);
    return models::heights::bilinear_height_at_sample(ground, grid);
}

/// Whether the middle line of a piece is nearer to a place than so much.
bool is_nearer(const RoadSection& section, const glm::dvec2& place_m, double distance_m) {
    const std::vector<RoadPoint>& line = section.levels[0];
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (distance_to_segment_m(place_m, line[i - 1].at_m, line[i].at_m) < distance_m) { return true; }
    }
    return false;
}

} // namespace

RoadNetwork::RoadNetwork(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    build(ground, constraints);
    if (!sections_.empty()) { index(); }
}

void RoadNetwork::build(const terrain::GroundSamples& ground, const RoadConstraints& constraints) {
    const RoadCostGrid cells(ground, constraints);
    const auto is_free = [&](const glm::dvec2& place_m) {
        return height_at(ground, place_m) > constraints.water_m &&
               !(constraints.is_blocked && constraints.is_blocked(place_m));
    };
    std::vector<glm::dvec2> places_m;
    for (const Route& route : find_routes(cells, find_towns(cells, constraints))) {
        places_m.clear();
        for (const std::size_t cell : route) { places_m.push_back(cells.place_m(cell)); }
        std::vector<glm::dvec2> line_m = smooth_centre_line(places_m, cells.cell_m(), is_free);
        if (!line_m.empty()) { append_sections(std::move(line_m), sections_); }
    }
}

std::size_t RoadNetwork::grid_cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_size_.x) + static_cast<std::size_t>(column);
}

RoadNetwork::GridRange RoadNetwork::grid_range(const glm::dvec2& min_m, const glm::dvec2& max_m) const {
    const glm::dvec2 end(grid_size_);
    const auto clamped = [&](const glm::dvec2& at_m) {
        return glm::ivec2(glm::clamp(glm::floor((at_m - first_m_) / grid_cell_m_), glm::dvec2(-1.0), end));
    };
    return {glm::max(clamped(min_m), glm::ivec2(0)), glm::min(clamped(max_m), grid_size_ - 1)};
}

/// The squares that a stretch of a piece may touch.
void RoadNetwork::add_cells(const RoadPoint& from, const RoadPoint& to, std::uint32_t number,
    std::vector<std::pair<std::uint32_t, std::uint32_t>>& places) const {
    const glm::dvec2 aside_m = glm::max(glm::abs(from.to_left_edge_m), glm::abs(to.to_left_edge_m));
    const double length_m = glm::distance(from.at_m, to.at_m);
    const int parts = std::max(static_cast<int>(std::ceil(length_m / grid_cell_m_)), 1);
    for (int part = 0; part < parts; ++part) {
        const glm::dvec2 first_m = glm::mix(from.at_m, to.at_m, static_cast<double>(part) / parts);
        const glm::dvec2 last_m = glm::mix(from.at_m, to.at_m, static_cast<double>(part + 1) / parts);
        const GridRange own = grid_range(glm::min(first_m, last_m) - aside_m, glm::max(first_m, last_m) + aside_m);
        for (int row = own.first.y; row <= own.last.y; ++row) {
            for (int column = own.first.x; column <= own.last.x; ++column) {
                places.emplace_back(static_cast<std::uint32_t>(grid_cell(column, row)), number);
            }
        }
    }
}

void RoadNetwork::index() {
    glm::dvec2 max_m = sections_.front().max_m;
    first_m_ = sections_.front().min_m;
    for (const RoadSection& section : sections_) {
        first_m_ = glm::min(first_m_, section.min_m);
        max_m = glm::max(max_m, section.max_m);
    }
    const glm::dvec2 extent_m = max_m - first_m_;
    grid_cell_m_ = std::max(min_square_m, std::max(extent_m.x, extent_m.y) / max_squares);
    grid_size_ = glm::ivec2(glm::floor(extent_m / grid_cell_m_)) + 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places; // square, piece
    for (std::uint32_t number = 0; number < sections_.size(); ++number) {
        for (const std::vector<RoadPoint>& level : sections_[number].levels) {
            for (std::size_t i = 1; i < level.size(); ++i) { add_cells(level[i - 1], level[i], number, places); }
        }
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    first_of_.assign(grid_cell(0, grid_size_.y) + 1, 0);
    for (const auto& [grid_cell, number] : places) {
        ++first_of_[grid_cell + 1];
        sections_by_cell_.push_back(number);
    }
    for (std::size_t i = 1; i < first_of_.size(); ++i) { first_of_[i] += first_of_[i - 1]; }
    const auto width = static_cast<std::size_t>(grid_size_.x) + 1;
    sums_.assign(width * (static_cast<std::size_t>(grid_size_.y) + 1), 0);
    for (int row = 0; row < grid_size_.y; ++row) {
        for (int column = 0; column < grid_size_.x; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
            const std::size_t own = grid_cell(column, row);
            sums_[at + width + 1] = sums_[at + width] + sums_[at + 1] - sums_[at] + first_of_[own + 1] - first_of_[own];
        }
    }
}

bool RoadNetwork::may_intersect(const glm::dvec2& min_m, const glm::dvec2& max_m) const {
    if (sections_.empty()) { return false; }
    const GridRange in = grid_range(min_m, max_m);
    if (in.first.x > in.last.x || in.first.y > in.last.y) { return false; }
    const auto sum = [&](int column, int row) {
        return sums_[static_cast<std::size_t>(row) * (static_cast<std::size_t>(grid_size_.x) + 1) +
                     static_cast<std::size_t>(column)];
    };
    return sum(in.last.x + 1, in.last.y + 1) + sum(in.first.x, in.first.y) !=
           sum(in.last.x + 1, in.first.y) + sum(in.first.x, in.last.y + 1);
}

void RoadNetwork::sections_in_box(
    const glm::dvec2& min_m, const glm::dvec2& max_m, std::vector<std::uint32_t>& numbers) const {
    if (sections_.empty()) { return; }
    const GridRange in = grid_range(min_m, max_m);
    for (int row = in.first.y; row <= in.last.y; ++row) {
        for (int column = in.first.x; column <= in.last.x; ++column) {
            const std::size_t own = grid_cell(column, row);
            for (std::uint32_t i = first_of_[own]; i < first_of_[own + 1]; ++i) {
                numbers.push_back(sections_by_cell_[i]);
            }
        }
    }
}

bool RoadNetwork::is_near(const glm::dvec2& place_m, double distance_m) const {
    if (sections_.empty()) { return false; }
    const GridRange in = grid_range(place_m - distance_m, place_m + distance_m);
    for (int row = in.first.y; row <= in.last.y; ++row) {
        for (int column = in.first.x; column <= in.last.x; ++column) {
            const std::size_t own = grid_cell(column, row);
            for (std::uint32_t i = first_of_[own]; i < first_of_[own + 1]; ++i) {
                if (is_nearer(sections_[sections_by_cell_[i]], place_m, distance_m)) { return true; }
            }
        }
    }
    return false;
}

} // namespace octant::visuals::roads
