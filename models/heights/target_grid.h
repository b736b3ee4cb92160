#pragma once

#include "models/heights/local_frame.h"
#include "models/heights/source_grid.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace octant::models::heights {

/// Where the samples of a ground lie in a frame that all its sources can be brought to.
struct TargetGrid {
    SpatialReference frame; ///< null: the sources' own, which name none
    double unit_m = 1.0;    ///< of the frame
    double west = 0.0;      ///< of column 0, in the frame's units
    double south = 0.0;
    double step = 1.0;      ///< between samples, in the frame's units
    glm::dvec2 cell_m{0.0}; ///< sides of the finest source's cells at its middle
    int columns = 0;
    int rows = 0;
    /// All samples are the sources' own, in one grid: nothing is to be resampled.
    bool is_source = false;

    CoordinateSystem system() const;
};

/// The lattice of a ground made of these grids, each of which has a map. Afterwards they look from its frame.
///
/// Where all have the same system, which is in metres or another length and true to scale within 1 %, that is the
/// frame, and the lattice has all samples of a grid whose cells are square; of oblong cells whose sides are as 1 to 2,
/// 2 to 3 and the like, too. Else the frame is a transverse Mercator projection about the middle of all, and samples
/// are as far apart as the finer sides of the finest cells, or half as far where that makes at most 4096 x 4096 of
/// them. A grid is cut to the largest upright rectangle without missing corners, unless it lies so aslant that less
/// than half of it would be left.
///
/// Throws Error with the first file's name: a system that is neither projected nor in degrees, no system where one is
/// needed, ground wider than 1,000 km or at a pole, too many samples.
TargetGrid target_grid_for(const std::filesystem::path& first, std::vector<SourceGrid>& grids);

} // namespace octant::models::heights
