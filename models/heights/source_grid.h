#pragma once

#include "models/heights/height_raster.h"
#include "models/heights/local_frame.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace octant::models::heights {

/// A file and where its south-west sample lies on the grid it belongs to.
struct SourcePiece {
    std::filesystem::path file;
    HeightRaster raster;
    int column = 0;
    int row = 0;
};

/// Files of one coordinate system whose samples lie on one lattice, such as tiles that share their borders, as one
/// grid. Where files overlap, the first that has data counts. Row 0 is the south and column 0 the west of an upright
/// grid; a rotated one is a single file.
class SourceGrid {
public:
    static constexpr int largest_samples = 65536; ///< of width and of height

    explicit SourceGrid(SourcePiece first);

    /// Takes a piece into the grid if its samples lie on the lattice, for degrees also a turn of the globe away.
    /// Returns whether it did.
    bool take(SourcePiece& piece);

    const std::vector<SourcePiece>& pieces() const { return pieces_; }

    int columns() const { return columns_; }

    int rows() const { return rows_; }

    SpatialReferenceHandle system() const { return pieces_.front().raster.system.get(); }

    /// Where its samples lie in system(); nothing for a file without georeference.
    const std::optional<GridTransform>& map() const { return map_; }

    /// Whether heights are whole metres that fit 16 bits.
    bool has_integer_metres() const;

    /// Chooses the frame by which places are told from now on: a system, or its own (null). Returns whether it can be
    /// brought to the grid's.
    bool set_target_frame(SpatialReferenceHandle frame);

    /// Turns places in the frame into columns and rows; NaN where that cannot be.
    void grid_from_frame(std::span<double> x, std::span<double> y) const;

    /// Turns columns and rows into places in the frame; NaN where that cannot be.
    void frame_from_grid(std::span<double> column, std::span<double> row) const;

    /// Heights of a window, row after row from the south; NaN without data and outside the grid. Throws Error (damaged
    /// file, heights not believed).
    void read(const GridWindow& window, std::span<float> heights_m, const GdalSession& gdal) const;

    /// The same in whole metres, where has_integer_metres() (asserted); void_height_m without data.
    void read(const GridWindow& window, std::span<std::int16_t> heights_m, const GdalSession& gdal) const;

private:
    template <typename Height, typename ReadPiece>
    void read_pieces(
        const GridWindow& window, std::span<Height> heights, Height no_height, const ReadPiece& read_piece) const;

    std::vector<SourcePiece> pieces_;
    std::optional<GridTransform> map_;
    int columns_;
    int rows_;
    bool in_degrees_ = false;
    Transformation from_frame_;
    Transformation to_frame_;
};

} // namespace octant::models::heights
