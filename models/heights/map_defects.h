#pragma once

#include "models/heights/map_resampling.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::heights {

/// A sample, or a cluster of samples, far above or below all samples around it.
struct Spike {
    int column = 0; ///< column of the sample with the largest difference to its surroundings
    int row = 0;
    float height_m = 0.0F;
    float above_m = 0.0F; ///< difference to the nearest height around it; negative for a pit
    int radius = 0;       ///< largest distance of its other samples, columns or rows
};

/// Finds spikes and pits while the rows of a ground are read from the south to the north. A sample counts if it exceeds
/// everything in a ring of samples around it, 1 to 8 samples away, by more than the relief that the earth's steepest
/// single peaks have over that distance: 20 m * (distance / 1 m)^0.58, which is 144 m at 30 m and 1,100 m at 1 km; by
/// three times that for rings of 5 samples and more, and by 60 % for pits. That it is beyond all samples in a ring
/// tells it from the rim of a cliff. At the map's border the ring is the part within the map; 60 % of that must have
/// heights. Samples of one sign that lie closer together than 8 samples are one spike.
class SpikeFinder {
public:
    /// The largest number of spikes in found(); further ones are only counted.
    static constexpr std::size_t max_listed_spikes = 1000;

    SpikeFinder(int columns, int rows, double spacing_m);

    /// Rows from `first_row` on, row after row, NaN without data. Rows that do not follow those taken before begin a
    /// new search.
    void take(int first_row, std::span<const float> heights_m);

    /// Sorted by row and column of the first sample of each spike.
    const std::vector<Spike>& found() const { return found_; }

    std::int64_t count() const { return count_; }

private:
    static constexpr int reach = 8;

    void add(const Spike& spike);
    float at(int column, int row) const;
    void check_row_of_samples(int row);
    void check_sample(int column, int row);

    int columns_;
    int rows_;
    std::array<float, reach + 1> relief_m_; ///< by distance in samples
    int begin_row_ = 0;                     ///< of the search
    int end_row_ = 0;                       ///< after the last row taken
    std::vector<float> band_;               ///< the last 2 * reach + 1 rows, each at its row modulo that
    std::vector<Spike> found_;
    std::int64_t count_ = 0;
};

/// A step in height where two files meet.
struct SeamStep {
    const SourcePiece* a = nullptr;
    const SourcePiece* b = nullptr;
    double rise_m = 0.0; ///< from the last sample of a to the first of b: the median along the seam
    double step_m = 0.0; ///< the same less the mean slope on both sides
    /// Columns and rows of `grid`, from one end of the seam to the other.
    std::vector<glm::dvec2> column_row = {};
    const SourceGrid* grid = nullptr;
};

/// The seams between files at which heights step. The step is measured at up to 1,024 points of a seam between the
/// outermost samples of both files, less the mean slope beside them. A seam counts if the median of it is at least 1 m,
/// 1 % of a cell and six times its standard error: rugged ground has large steps of both signs, whose median is small.
/// The grids look from one frame and are in the order in which they count where they overlap. `cell_m`: side of the
/// finest cells. Throws Error for what cannot be read.
std::vector<SeamStep> steps_at_seams(const std::vector<SourceGrid>& grids, double cell_m, const GdalSession& gdal);

} // namespace octant::models::heights
