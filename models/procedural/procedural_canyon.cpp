// Source: own construction from known parts. A winding river and the network of its tributaries come from stream-power
// erosion (see drainage.cpp); the tributaries' beds rise upstream by slope = steepness / sqrt(drained area) (Flint
// 1974). Walls recede from the beds at a limited slope: the distance equation |grad u| = slope is solved by fast
// sweeping (H. Zhao, A fast sweeping method for Eikonal equations, Mathematics of Computation 74, 2005, section 2). The
// result u is the height that even rock would have; layers of hard and soft rock turn it into cliffs and benches, as in
// the Grand Canyon (order and thickness after its strata, Vishnu to Kaibab). Deviations: two rounds of sweeps instead
// of a test for convergence.

#include "models/procedural/drainage.h"
#include "models/procedural/procedural_terrain.h"
#include "models/procedural/terrain_grid.h"
#include "models/procedural/terrain_noise.h"
#include "sim/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::procedural {

// Source: see procedural_canyon.cpp.

namespace {

constexpr double network_cell_m = 100.0;
/// The margin of the grid around the rotated field.
constexpr double canyon_margin_m = 1500.0;
/// How much stronger than a Warp's own shift streams are bent.
constexpr double bend = 2.0;
constexpr double stream_area_m2 = 3.0e5;
constexpr double steepness_m = 270.0;
/// Beds above this run over the plateau.
constexpr double highest_bed_m = 2200.0;

/// Working state: the grid, its outlets (the river) and where its cells really lie.
struct Network {
    TerrainGrid ground;
    std::vector<char> is_river;
    std::vector<glm::dvec2> places; ///< of cells, in the turned frame
    std::vector<glm::dvec2> river;  ///< along the river, in the turned frame
};

RowPoints winding_river(double extent_m, std::uint64_t seed) {
    const FractalNoise course = {seed + 301, 9000.0, 2, 0.4};
    const DomainWarp meanders = {seed + 307, 3600.0, 2};
    const int steps = static_cast<int>(extent_m * 1.2 / 40.0);
    RowPoints river(static_cast<std::size_t>(steps) + 1);
    for (int i = 0; i <= steps; ++i) { river.x_m[static_cast<std::size_t>(i)] = -0.1 * extent_m + i * 40.0; }
    std::vector<double> aside(river.x_m.size());
    course.at(river.x_m, river.y_m, aside);
    for (std::size_t i = 0; i < aside.size(); ++i) { river.y_m[i] = 0.5 * extent_m + 3000.0 * aside[i]; }
    meanders.move(river.x_m, river.y_m, 2.2);
    return river;
}

Network first_network(double extent_m, std::uint64_t seed) {
    const int side = std::clamp(static_cast<int>(extent_m / network_cell_m) + 1, 65, 1025);
    Network network;
    network.ground = TerrainGrid(side, extent_m / (side - 1));
    TerrainGrid& ground = network.ground;
    network.is_river.assign(ground.values.size(), 0);
    network.places.resize(ground.values.size());
    const FractalNoise plateau = {seed + 311, 5200.0, 5, 0.55};
    const DomainWarp warp = {seed + 313, 28.0 * ground.cell_m, 4};
    parallel_for_rows(side, [&](int row) {
        RowPoints places = points_of_row(ground, row);
        const std::span<double> line = ground.row(row);
        plateau.at(places.x_m, places.y_m, line);
        warp.move(places.x_m, places.y_m, bend);
        for (int column = 0; column < side; ++column) {
            const auto i = static_cast<std::size_t>(column);
            line[i] = 400.0 + 160.0 * line[i];
            network.places[ground.index(column, row)] = {places.x_m[i], places.y_m[i]};
        }
    });
    RowPoints river = winding_river(extent_m, seed);
    for (std::size_t i = 0; i < river.x_m.size(); ++i) {
        const int column = static_cast<int>(std::floor(river.x_m[i] / ground.cell_m + 0.5));
        const int row = static_cast<int>(std::floor(river.y_m[i] / ground.cell_m + 0.5));
        if (column >= 0 && row >= 0 && column < side && row < side) {
            network.is_river[ground.index(column, row)] = 1;
            ground.values[ground.index(column, row)] = 0.0;
        }
    }
    warp.move(river.x_m, river.y_m, bend);
    for (std::size_t i = 0; i < river.x_m.size(); ++i) { network.river.emplace_back(river.x_m[i], river.y_m[i]); }
    return network;
}

/// Erodes the ground until streams have joined into a tree.
Drainage grown(Network& network, std::uint64_t seed) {
    const std::vector<double> uplift(network.ground.values.size(), 1.0);
    const StreamPower power = {12.0, 60.0};
    for (int step = 0; step < 24; ++step) {
        if (step % 6 == 0) { fill_pits(network.ground, network.is_river); }
        const auto turn = static_cast<std::uint64_t>(step / 6);
        erode(network.ground, compute_drainage(network.ground, network.is_river, seed + 331 + turn), uplift, power);
    }
    fill_pits(network.ground, network.is_river);
    return compute_drainage(network.ground, network.is_river, seed + 337);
}

/// Draws every stream cell toward the middle of its receiver and its largest donor.
void straighten(std::vector<glm::dvec2>& places, const Drainage& water) {
    std::vector<int> donor(places.size(), -1);
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        const int best = donor[receiver];
        if (receiver != i && (best < 0 || water.area_m2[static_cast<std::size_t>(best)] < water.area_m2[i])) {
            donor[receiver] = cell;
        }
    }
    for (int pass = 0; pass < 3; ++pass) {
        const std::vector<glm::dvec2> old = places;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto receiver = static_cast<std::size_t>(water.receiver[i]);
            if (receiver != i && donor[i] >= 0) {
                places[i] = 0.5 * old[i] + 0.25 * (old[receiver] + old[static_cast<std::size_t>(donor[i])]);
            }
        }
    }
}

/// From the turned frame to the field's, with the middle of the river at the field's centre.
glm::dvec2 in_field(const glm::dvec2& place, const Network& network) {
    const glm::dvec2& middle = network.river[network.river.size() / 2];
    const double x = place.x - middle.x;
    const double y = place.y - middle.y;
    return {rotation_cos * x + rotation_sin * y, rotation_cos * y - rotation_sin * x};
}

} // namespace

std::vector<Reach> canyon_network(double field_m, std::uint64_t seed) {
    const double extent_m = upscale_factor * field_m + 2.0 * canyon_margin_m;
    Network network = first_network(extent_m, seed);
    const Drainage water = grown(network, seed);
    straighten(network.places, water);
    std::vector<Reach> reaches;
    for (std::size_t i = 1; i < network.river.size(); ++i) {
        reaches.push_back(
            {in_field(network.river[i - 1], network), in_field(network.river[i], network), 0.0, 0.0, 55.0});
    }
    std::vector<double> bed_m(network.places.size(), 0.0);
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        if (receiver == i) { continue; }
        const double area_m2 = water.area_m2[i];
        bed_m[i] = bed_m[receiver] + water.length_m[i] * steepness_m / std::sqrt(area_m2);
        if (area_m2 < stream_area_m2 || bed_m[i] > highest_bed_m) { continue; }
        reaches.push_back({in_field(network.places[i], network), in_field(network.places[receiver], network), bed_m[i],
            bed_m[receiver], std::min(40.0, 0.006 * std::sqrt(area_m2))});
    }
    return reaches;
}

namespace {

constexpr double river_m = 850.0;
constexpr double wall_slope = 0.45;

struct Layer {
    double thickness_m = 0.0;
    double steepness = 1.0; ///< times the slope of even rock
};

/// Layers of rock from the river up.
constexpr std::array<Layer, 18> layers = {{
    {250.0, 1.7}, // inner gorge
    {55.0, 5.0},  // Tapeats cliff
    {40.0, 0.22}, // Tonto bench
    {90.0, 0.75}, // Muav slope
    {165.0, 5.5}, // Redwall cliff
    {12.0, 0.25}, // Supai ledges from here
    {24.0, 3.0}, {30.0, 0.65}, {46.0, 3.5}, {14.0, 0.35}, {20.0, 2.5}, {24.0, 0.7}, {36.0, 4.0},
    {80.0, 0.6},  // Hermit slope
    {110.0, 6.0}, // Coconino cliff
    {45.0, 0.7},  // Toroweap slope
    {55.0, 4.5},  // Kaibab cliff
    {35.0, 1.5},  // rim
}};

/// Height above the river of rock that would stand `even_m` above it were all layers alike. Above the layers lies the
/// plateau, nearly level.
double layered(double even_m) {
    double height_m = 0.0;
    double left_m = even_m;
    for (const Layer& layer : layers) {
        const double even_thickness_m = layer.thickness_m / layer.steepness;
        if (left_m <= even_thickness_m) { return height_m + left_m * layer.steepness; }
        left_m -= even_thickness_m;
        height_m += layer.thickness_m;
    }
    return height_m + 90.0 * left_m / (left_m + 700.0);
}

/// Ground as even rock, on a grid about the field with a margin for canyons just beyond it.
struct EvenRock {
    TerrainGrid height_m;
    TerrainGrid slope;
    double margin_m = 0.0;
};

EvenRock unlimited(double field_m, double spacing_m, std::uint64_t seed) {
    const double cell_m = 2.0 * spacing_m;
    const int margin = static_cast<int>(std::min(2400.0 / cell_m, 100.0)) + 2;
    const int side = static_cast<int>(std::ceil(field_m / cell_m)) + 1 + 2 * margin;
    EvenRock rock = {TerrainGrid(side, cell_m), TerrainGrid(side, cell_m), margin * cell_m};
    std::fill(rock.height_m.values.begin(), rock.height_m.values.end(), 1e9);
    const FractalNoise weathering = {seed + 101, 1100.0, 4, 0.6};
    parallel_for_rows(side, [&](int row) {
        RowPoints places = points_of_row(rock.slope, row);
        for (std::size_t i = 0; i < places.x_m.size(); ++i) {
            places.x_m[i] = places.x_m[i] - rock.margin_m - 0.5 * field_m;
            places.y_m[i] = places.y_m[i] - rock.margin_m - 0.5 * field_m;
        }
        const std::span<double> line = rock.slope.row(row);
        weathering.at(places.x_m, places.y_m, line);
        for (double& value : line) { value = wall_slope * std::clamp(1.0 + 1.4 * value, 0.5, 1.9); }
    });
    return rock;
}

/// Lowers the cells near a reach to its bed.
void carve(EvenRock& rock, const Reach& reach, double half_field_m) {
    TerrainGrid& ground = rock.height_m;
    const double cell_m = ground.cell_m;
    const double shift_m = rock.margin_m + half_field_m;
    const double reach_m = reach.half_width_m + 1.5 * cell_m;
    const auto cell = [&](double at_m) { return static_cast<int>(std::floor((at_m + shift_m) / cell_m)); };
    const int west = std::max(cell(std::min(reach.from.x, reach.to.x) - reach_m), 0);
    const int east = std::min(cell(std::max(reach.from.x, reach.to.x) + reach_m) + 1, ground.side - 1);
    const int south = std::max(cell(std::min(reach.from.y, reach.to.y) - reach_m), 0);
    const int north = std::min(cell(std::max(reach.from.y, reach.to.y) + reach_m) + 1, ground.side - 1);
    const glm::dvec2 along = reach.to - reach.from;
    const double length2 = std::max(along.x * along.x + along.y * along.y, 1e-9);
    for (int row = south; row <= north; ++row) {
        for (int column = west; column <= east; ++column) {
            const glm::dvec2 here(column * cell_m - shift_m, row * cell_m - shift_m);
            const glm::dvec2 off = here - reach.from;
            const double t = std::clamp((off.x * along.x + off.y * along.y) / length2, 0.0, 1.0);
            const glm::dvec2 gap = off - t * along;
            const double away_m = std::sqrt(gap.x * gap.x + gap.y * gap.y) - reach.half_width_m;
            if (away_m > 1.5 * cell_m) { continue; }
            const std::size_t i = ground.index(column, row);
            const double bed_m = reach.from_m + t * (reach.to_m - reach.from_m);
            ground.values[i] = std::min(ground.values[i], bed_m + rock.slope.values[i] * std::max(0.0, away_m));
        }
    }
}

/// The height that a slope limit allows a cell above its lower neighbours.
double limited(const TerrainGrid& ground, double rise_m, int column, int row) {
    const int last = ground.side - 1;
    const double a = std::min(ground.at(std::max(column - 1, 0), row), ground.at(std::min(column + 1, last), row));
    const double b = std::min(ground.at(column, std::max(row - 1, 0)), ground.at(column, std::min(row + 1, last)));
    const double difference = a - b;
    if (std::abs(difference) >= rise_m) { return std::min(a, b) + rise_m; }
    return 0.5 * (a + b + std::sqrt(2.0 * rise_m * rise_m - difference * difference));
}

void limit_slopes(EvenRock& rock) {
    TerrainGrid& ground = rock.height_m;
    const int side = ground.side;
    for (int sweep = 0; sweep < 8; ++sweep) {
        for (int j = 0; j < side; ++j) {
            const int row = (sweep & 2) != 0 ? side - 1 - j : j;
            for (int i = 0; i < side; ++i) {
                const int column = (sweep & 1) != 0 ? side - 1 - i : i;
                const std::size_t at = ground.index(column, row);
                const double rise_m = rock.slope.values[at] * ground.cell_m;
                ground.values[at] = std::min(ground.values[at], limited(ground, rise_m, column, row));
            }
        }
    }
}

/// Turns even rock into the ground of the field.
class Surface {
public:
    Surface(const EvenRock& rock, double half_field_m, std::uint64_t seed)
        : rock_(rock), shift_m_(rock.margin_m + half_field_m), folds_{seed + 211, 7000.0, 5, 0.42},
          gullies_{seed + 223, 700.0, 4, 0.55}, rubble_{seed + 225, 1600.0, 3, 0.5}, stones_{
                                                                                         seed + 227, 150.0, 3, 0.55} {}

    /// Heights at places from the field's centre, as many.
    void heights(const RowPoints& at, std::span<float> heights_m) const {
        std::vector<double> gully(heights_m.size());
        std::vector<double> rubble(heights_m.size());
        std::vector<double> fold(heights_m.size());
        std::vector<double> stones(heights_m.size());
        gullies_.at(at.x_m, at.y_m, gully);
        rubble_.at(at.x_m, at.y_m, rubble);
        folds_.at(at.x_m, at.y_m, fold);
        stones_.at(at.x_m, at.y_m, stones);
        for (std::size_t i = 0; i < heights_m.size(); ++i) {
            const double even_m = std::max(0.0, rock_.height_m.smooth_at(at.x_m[i] + shift_m_, at.y_m[i] + shift_m_));
            const double away = smooth_step(0.0, 220.0, even_m);
            const double rough_m = std::max(0.0, even_m + away * 75.0 * gully[i]);
            const double covered = away * smooth_step(0.0, 0.45, rubble[i]);
            const double top = smooth_step(900.0, 1500.0, even_m);
            heights_m[i] =
                static_cast<float>(river_m + (1.0 - covered) * layered(rough_m) + covered * blurred(rough_m) +
                                   (away * 30.0 + top * 60.0) * fold[i] + (0.3 + away) * 4.0 * stones[i]);
        }
    }

private:
    /// Layers under rubble: no ledge is left, only the great steps.
    static double blurred(double even_m) {
        constexpr double reach_m = 32.0;
        return 0.25 * layered(std::max(0.0, even_m - reach_m)) + 0.5 * layered(even_m) +
               0.25 * layered(even_m + reach_m);
    }

    const EvenRock& rock_;
    double shift_m_;
    FractalNoise folds_;
    FractalNoise gullies_;
    FractalNoise rubble_;
    FractalNoise stones_;
};

} // namespace

heights::HeightField procedural_canyon(const ProceduralTerrainOptions& options) {
    assert(options.size >= 2 && options.size <= 20000);
    assert(options.spacing_m > 0.0 && std::isfinite(options.spacing_m));
    const std::uint64_t seed = options.seed * 1000003U + 7;
    const double field_m = (options.size - 1) * options.spacing_m;
    const double half_m = 0.5 * field_m;
    EvenRock rock = unlimited(field_m, options.spacing_m, seed);
    for (const Reach& reach : canyon_network(field_m, seed)) { carve(rock, reach, half_m); }
    limit_slopes(rock);
    const Surface surface(rock, half_m, seed);
    const auto size = static_cast<std::size_t>(options.size);
    std::vector<float> heights_m(size * size);
    parallel_for_rows(options.size, [&](int row) {
        RowPoints places(size);
        for (int column = 0; column < options.size; ++column) {
            const auto i = static_cast<std::size_t>(column);
            places.x_m[i] = column * options.spacing_m - half_m;
            places.y_m[i] = row * options.spacing_m - half_m;
        }
        surface.heights(places, {&heights_m[static_cast<std::size_t>(row) * size], size});
    });
    heights::HeightField field(options.size, options.size, options.spacing_m, std::move(heights_m));
    field.name = "canyon";
    return field;
}

} // namespace octant::models::procedural
