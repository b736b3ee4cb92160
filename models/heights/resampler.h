#pragma once

#include "models/heights/source_grid.h"
#include "models/heights/target_grid.h"

#include <span>
#include <vector>

namespace octant::models::heights {

/// Heights of grids at the samples of another lattice: bilinear between each grid's samples, the
/// first grid that has data there counts. A source sample that is higher than all eight around it
/// keeps its height at the nearest sample of the lattice, so that summits do not sink.
class Resampler {
public:
    /// The grids look from the lattice's frame. Both must outlive the resampler.
    Resampler(const std::vector<SourceGrid>& grids, const TargetGrid& lattice)
        : grids_(grids)
        , lattice_(lattice) {}

    /// Rows from `first_row` on, as many as fill the span; NaN without data. Throws Error.
    void read(int first_row, std::span<float> heights_m, const GdalSession& gdal);

private:
    /// Columns and rows of the lattice that are read at a time.
    struct Block {
        int first_column = 0;
        int columns = 0;
        int first_row = 0;
        int rows = 0;
    };

    void locate_samples(const SourceGrid& grid, const Block& block);
    GridWindow window_of(const SourceGrid& grid) const;
    void sample(const Block& block, const GridWindow& window);
    float surface_m(const GridWindow& window, double column, double row) const;
    float summit_m(const GridWindow& window, double column, double row) const;

    const std::vector<SourceGrid>& grids_;
    const TargetGrid& lattice_;
    std::vector<double> x_; ///< for each sample of a block its column in the grid; NaN outside
    std::vector<double> y_;
    std::vector<float> source_m_;
    std::vector<float> block_m_;
    glm::dvec2 half_step_{0.0}; ///< of the lattice, in cells of the grid
};

} // namespace octant::models::heights
