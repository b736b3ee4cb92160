#pragma once

#include "models/heights/height_field.h"
#include "models/heights/source_grid.h"
#include "models/heights/target_grid.h"

#include <functional>
#include <optional>
#include <vector>

namespace octant::models::heights {

/// The bilinear height of the first grid that has data at a place, given in metres east and north of the lattice's
/// centre; nothing where none has. The grids look from the lattice's frame. Throws Error (damaged file).
std::optional<double> source_height_m(
    const std::vector<SourceGrid>& grids, const TargetGrid& lattice, double x_m, double y_m, const GdalSession& gdal);

/// The height of some ground at a place as above; nothing outside.
using GroundAt = std::function<std::optional<double>(double x_m, double y_m)>;

/// How far a ground lies from its source's bilinear surfaces: at the samples of evenly spread rows of each grid and in
/// the middles of the cells north-east of them, about 500,000 places at most.
HeightDeviation deviation_from_source(
    const std::vector<SourceGrid>& grids, const TargetGrid& lattice, const GroundAt& ground, const GdalSession& gdal);

} // namespace octant::models::heights
