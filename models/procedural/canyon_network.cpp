// Source: see procedural_canyon.cpp.
#include "models/procedural/canyon_network.h"

#include "models/procedural/drainage.h"
#include "models/procedural/terrain_grid.h"
#include "models/procedural/terrain_noise.h"
#include "sim/base/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace octant::models::procedural {

namespace {

constexpr double cell_m = 100.0;
/// The grid reaches so far beyond the turned field.
constexpr double margin_m = 1500.0;
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
    const int side = std::clamp(static_cast<int>(extent_m / cell_m) + 1, 65, 1025);
    Network network;
    network.ground = TerrainGrid(side, extent_m / (side - 1));
    TerrainGrid& ground = network.ground;
    network.is_river.assign(ground.values.size(), 0);
    network.places.resize(ground.values.size());
    const FractalNoise plateau = {seed + 311, 5200.0, 5, 0.55};
    const DomainWarp warp = {seed + 313, 28.0 * ground.cell_m, 4};
    by_rows(side, [&](int row) {
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
    const double extent_m = upscale_factor * field_m + 2.0 * margin_m;
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

} // namespace octant::models::procedural
