#pragma once

#include "models/heights/height_field.h"
#include "models/heights/height_raster.h"
#include "models/heights/local_frame.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace octant::models::heights {

/// A file and the column and row of its south-west sample in its SourceGrid.
struct SourcePiece {
    std::filesystem::path file;
    HeightRaster raster;
    int column = 0;
    int row = 0;
};

/// Files of one coordinate system whose samples lie on one target, such as tiles that share their borders, as one
/// grid. Where files overlap, the first that has data counts. Row 0 is the south and column 0 the west of an upright
/// grid; a rotated one is a single file.
class SourceGrid {
public:
    static constexpr int largest_samples = 65536; ///< limit of width and of height

    explicit SourceGrid(SourcePiece first);

    /// Adds a piece if its samples lie on the target, in degrees also if they are off by 360. Returns whether it did.
    bool take(SourcePiece& piece);

    const std::vector<SourcePiece>& pieces() const { return pieces_; }

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    SpatialReferenceHandle system() const { return pieces_.front().raster.system.get(); }

    /// The positions of the samples in system(); nothing for a file without georeference.
    const std::optional<GridTransform>& map() const { return map_; }

    /// Whether heights are whole metres that fit 16 bits.
    bool has_integer_metres() const;

    /// Sets the frame of all further positions: a system, or the grid's own (null). Returns whether positions can be
    /// transformed between it and the grid.
    bool set_target_frame(SpatialReferenceHandle frame);

    /// Converts positions in the frame to columns and rows; NaN if that is not possible.
    void grid_from_frame(std::span<double> x, std::span<double> y) const;

    /// Converts columns and rows to positions in the frame; NaN if that is not possible.
    void frame_from_grid(std::span<double> column, std::span<double> row) const;

    /// Heights of a window, row after row from the south; NaN without data and outside the grid. Throws Error (damaged
    /// file, heights not believed).
    void read(const GridWindow& window, std::span<float> heights_m, const GdalSession& gdal) const;

private:
    std::vector<SourcePiece> pieces_;
    std::optional<GridTransform> map_;
    int columns_;
    int rows_;
    bool in_degrees_ = false;
    Transformation from_frame_;
    Transformation to_frame_;
};

/// The positions of a ground's samples, in a frame to which all its sources can be transformed.
struct TargetGrid {
    SpatialReference frame; ///< null: the sources' axes, which have no system
    double unit_m = 1.0;    ///< length of the frame's unit
    double west = 0.0;      ///< coordinate of column 0, in the frame's units
    double south = 0.0;
    double step = 1.0;      ///< between samples, in the frame's units
    glm::dvec2 cell_m{0.0}; ///< sides of the finest source's cells at its middle
    int columns = 0;
    int rows = 0;
    /// The samples are those of a single source grid: no resampling is needed.
    bool is_source = false;

    CoordinateSystem system() const;
};

/// Chooses the samples of a ground from its source grids, each of which must have a map(), and sets their frame.
///
/// Where all have the same system, which is in metres or another length and true to scale within 1 %, that is the
/// frame, and the target has all samples of a grid whose cells are square; of oblong cells whose sides are as 1 to 2,
/// 2 to 3 and the like, too. Else the frame is a transverse Mercator projection about the middle of all, and samples
/// are as far apart as the finer sides of the finest cells, or half as far where that makes at most 4096 x 4096 of
/// them. A grid is cut to the largest upright rectangle without missing corners, unless it lies so aslant that less
/// than half of it would be left.
///
/// Throws Error with the first file's name: a system that is neither projected nor in degrees, no system where one is
/// needed, ground wider than 1,000 km or at a pole, too many samples.
TargetGrid target_grid_for(const std::filesystem::path& first, std::vector<SourceGrid>& grids);

/// The bilinear height of the first grid that has data at a position, metres east and north of the target grid's
/// centre; nothing if none has. The grids must be in the target grid's frame. Throws Error (damaged file).
std::optional<double> source_height_m(
    const std::vector<SourceGrid>& grids, const TargetGrid& target, double x_m, double y_m, const GdalSession& gdal);

/// The height of a ground at a position as in source_height_m; nothing outside.
using GroundAt = std::function<std::optional<double>(double x_m, double y_m)>;

/// The vertical distance between a ground and the bilinear surfaces of its sources, measured at samples of evenly
/// spread rows of each grid and at the centres of the cells to their north-east; at most about 500,000 positions.
HeightDeviation deviation_from_source(
    const std::vector<SourceGrid>& grids, const TargetGrid& target, const GroundAt& ground, const GdalSession& gdal);

} // namespace octant::models::heights
