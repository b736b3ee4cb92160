#pragma once

#include "models/heights/height_field.h"
#include "visuals/terrain/error_codes.h"
#include "visuals/terrain/ground_layout.h"
#include "visuals/terrain/tile_validator.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace octant::visuals::terrain {

/// What is known of a ground besides its numbers.
struct GroundMetadata {
    std::string name;
    std::optional<GeoPosition> place;                        ///< Nothing for made ground.
    std::optional<models::heights::CoordinateSystem> system; ///< As HeightField::system.
    std::int64_t filled_voids = 0;                           ///< Samples without data that were filled.
    float lowest_m = 0.0F;
    float highest_m = 0.0F;
    float mean_m = 0.0F;
    /// From the files that it was imported from; nothing where it was not measured.
    std::optional<models::heights::HeightDeviation> deviation = {};
};

/// The heights of a ground and, for each sample that a mesh may leave out, the error of leaving it out: all that meshes
/// by screen-space error are made from. It reads GroundLayout memory, which may be a mapped file. World axes as in
/// HeightField: x east, y north, z up, metres, with the origin at the field's centre at datum; column 0 is west and row
/// 0 south.
///
/// The error of a sample belongs to the longest-edge bisection of the field. A sample halves the longest edge of two
/// triangles (of one at the border). Its own error is the largest vertical distance of the field's samples from those
/// two triangles. Stored is the largest of its own error and those of all samples that need it (the saturated error),
/// once with room to move and once without, so that errors never grow from a sample to one that needs it. The middle of
/// an edge needs the centres of both nodes beside the edge. The centre of a node needs the middles of two edges of its
/// parent: those two of its corners that are neither its parent's centre nor its parent's corner.
class GroundTiles {
public:
    /// `memory` is laid out as GroundLayout(shape) says (its size is asserted) and kept alive by `owner`. A tile is
    /// read after `validator` has let it; null trusts all tiles.
    GroundTiles(const GroundShape& shape, GroundMetadata metadata, std::span<const std::byte> memory,
        std::shared_ptr<const void> owner, std::shared_ptr<const TileValidator> validator = nullptr);

    const GroundShape& shape() const { return shape_; }

    const GroundMetadata& metadata() const { return metadata_; }

    const GroundLayout& layout() const { return layout_; }

    /// What lies in tiles may be read once validator() has let them.
    std::span<const std::byte> memory() const { return memory_; }

    const TileValidator& validator() const { return *validator_; }

    int levels() const { return layout_.levels(); }

    int columns() const { return shape_.columns; }

    int rows() const { return shape_.rows; }

    double spacing_m() const { return shape_.spacing_m; }

    /// The height of one of the root's corners: south-west, south-east, north-west, north-east.
    float corner_m(unsigned corner) const { return height_of(heights_at(layout_.corners())[corner]); }

    /// The height of a sample by its node. South may be asked also for row rows(level), and West also for column
    /// columns(level), each one beyond the last node.
    float height_m(int level, NodePart part, int column, int row) const {
        return height_of(stored_height(level, part, column, row));
    }

    /// The code of a sample's error by its node, as for height_m; codes() make it metres. It is 0 only where the error
    /// is 0.
    std::uint8_t error_code(
        int level, NodePart part, int column, int row, MorphMargin morph_margin = MorphMargin::Full) const {
        return *stored_error(level, part, column, row, morph_margin);
    }

    const ErrorCodes& codes() const { return codes_; }

    /// A lower bound of all samples of a node, for levels up to layout().range_level(); finer nodes have no bounds of
    /// their own.
    float lowest_m(int level, int column, int row) const { return height_of(range(level, column, row).lowest); }

    /// The upper bound, for the same levels.
    float highest_m(int level, int column, int row) const { return height_of(range(level, column, row).highest); }

    /// The height as it is stored; arguments as for height_m.
    std::int16_t stored_height(int level, NodePart part, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        if (row == at.rows) { return heights_at(at.north_heights)[column]; }
        if (column == at.columns) { return heights_at(at.east_heights)[row]; }
        const NodeOffset place = place_of(level, column, row);
        return heights_at(place.tile)[static_cast<std::size_t>(part) * at.tile_nodes + place.node];
    }

    /// The height of any sample (asserted to be one).
    float height_m(int column, int row) const;

    /// Half the extent of the field from its centre, east and north, metres.
    glm::dvec2 half_extent_m() const;

    /// The height of the ground between samples (bilinear); nothing outside the field.
    std::optional<double> height_at(double x_m, double y_m) const;

private:
    float height_of(std::int16_t stored) const {
        return static_cast<float>(base_m_ + unit_m_ * static_cast<double>(stored));
    }

    const std::int16_t* heights_at(std::size_t offset) const {
        return reinterpret_cast<const std::int16_t*>(memory_.data() + offset);
    }

    const HeightRange& range(int level, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        return reinterpret_cast<const HeightRange*>(
            memory_.data() + at.ranges)[static_cast<std::size_t>(row) * static_cast<std::size_t>(at.columns) +
                                        static_cast<std::size_t>(column)];
    }

    /// The offset of a node's tile, and the place of the node in it.
    struct NodeOffset {
        std::size_t tile;
        std::size_t node;
    };

    NodeOffset place_of(int level, int column, int row) const {
        const GroundLayout::Level& at = layout_.level(level);
        const int mask = (1 << at.tile_shift) - 1;
        const auto tile =
            static_cast<std::size_t>((row >> at.tile_shift) * at.tiles_across + (column >> at.tile_shift));
        validator_->ensure_valid(level, tile);
        return {at.first_tile + tile * at.tile_bytes,
            static_cast<std::size_t>(((row & mask) << at.tile_shift) + (column & mask))};
    }

    const std::uint8_t* stored_error(int level, NodePart part, int column, int row, MorphMargin morph_margin) const {
        const GroundLayout::Level& at = layout_.level(level);
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(memory_.data());
        if (row == at.rows) { return bytes + at.north_errors[static_cast<std::size_t>(morph_margin)] + column; }
        if (column == at.columns) { return bytes + at.east_errors[static_cast<std::size_t>(morph_margin)] + row; }
        const NodeOffset place = place_of(level, column, row);
        return bytes + place.tile + at.errors[static_cast<std::size_t>(morph_margin)][static_cast<std::size_t>(part)] +
               place.node;
    }

    GroundShape shape_;
    GroundMetadata metadata_;
    GroundLayout layout_;
    ErrorCodes codes_;
    std::span<const std::byte> memory_;
    std::shared_ptr<const void> owner_;
    std::shared_ptr<const TileValidator> validator_;
    double base_m_;
    double unit_m_;
};

} // namespace octant::visuals::terrain
