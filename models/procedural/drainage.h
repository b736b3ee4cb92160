#pragma once

#include "models/procedural/terrain_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::procedural {

/// The water flow on a grid of at least 3 x 3 cells; one entry a cell.
struct Drainage {
    std::vector<int> receiver;    ///< cell that a cell drains to; itself for an outlet or a pit
    std::vector<int> upstream;    ///< all cells, each receiver before its donors
    std::vector<double> length_m; ///< distance to the receiver
    std::vector<double> area_m2;  ///< area that drains through a cell, itself included
};

/// Raises each pit slightly above its spill level, which makes all ground drain to an outlet.
void fill_pits(TerrainGrid& ground, const std::vector<char>& is_outlet);

/// Routes each cell to one lower neighbour of eight in the direction of steepest descent: between the two neighbours
/// next to that direction a hash of the seed decides, in such shares that water runs in that direction on average.
Drainage compute_drainage(const TerrainGrid& ground, const std::vector<char>& is_outlet, std::uint64_t seed);

/// How fast ground rises and streams cut, one step.
struct StreamPower {
    double step = 1.0;          ///< time of one step; the ground rises by `uplift` a unit of time
    double steepness_m = 100.0; ///< slope * sqrt(drained area) of a stream in balance at uplift 1
};

/// One implicit step of dh/dt = uplift - (1 / steepness) sqrt(area) slope. Outlets stay.
void erode(TerrainGrid& ground, const Drainage& water, const std::vector<double>& uplift, const StreamPower& power);

/// The receivers of a row of cells; one entry a cell.
struct RowReceivers {
    std::span<int> receiver;    ///< cell of the grid
    std::span<double> length_m; ///< distance to it
};

/// Finds the lower neighbour to which each cell of a row drains, by the rule of compute_drainage(). A cell without a
/// lower neighbour drains to itself, at a distance of one cell.
void choose_receivers(const TerrainGrid& ground, int row, std::uint64_t seed, const RowReceivers& to);

} // namespace octant::models::procedural
