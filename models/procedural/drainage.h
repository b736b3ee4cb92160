#pragma once

#include "models/procedural/terrain_grid.h"

#include <cstdint>
#include <vector>

namespace octant::models::procedural {

/// Where water runs on a grid of at least 3 x 3 cells; one entry a cell.
struct Drainage {
    std::vector<int> receiver;    ///< cell that a cell drains to; itself for an outlet or a pit
    std::vector<int> upstream;    ///< all cells, every receiver before its donors
    std::vector<double> length_m; ///< way to the receiver
    std::vector<double> area_m2;  ///< area that drains through a cell, itself included
};

/// Raises every pit to its spill level plus a trace, so that all ground drains to an outlet.
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

} // namespace octant::models::procedural
