#pragma once

#include "visuals/terrain/ground_tiles.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::terrain {

/// Fast access to the numbers of a level of GroundTiles by node. The numbers of a node's fan lie
/// close together.
class LevelReader {
public:
    using FourCodes = std::array<std::uint8_t, 4>;

    /// Where a node's numbers lie: its tile, and its place in it.
    struct NodeSlot {
        const std::byte* tile;
        std::size_t node;
    };

    /// The ground's memory must outlive it.
    LevelReader(const GroundTiles& ground, int level)
        : memory_(ground.memory().data())
        , corners_(ground.layout().corners())
        , at_(ground.layout().level(level))
        , validator_(&ground.validator())
        , level_(level)
        , mask_((1 << at_.tile_shift) - 1) {}

    int edge() const { return at_.edge; }

    int columns() const { return at_.columns; }

    int rows() const { return at_.rows; }

    NodeSlot slot(int column, int row) const {
        const auto tile = static_cast<std::size_t>(
            (row >> at_.tile_shift) * at_.tiles_across + (column >> at_.tile_shift));
        validator_->ensure_valid(level_, tile);
        return {
            memory_ + at_.first_tile + tile * at_.tile_bytes,
            static_cast<std::size_t>(((row & mask_) << at_.tile_shift) + (column & mask_))};
    }

    /// The error codes of the mid-points of a node's fan_edges.
    FourCodes middle_codes(int column, int row, MorphMargin morph_margin) const {
        const NodeSlot own = slot(column, row);
        const auto r = static_cast<std::size_t>(morph_margin);
        return {
            *error(own, NodePart::South, morph_margin),
            *(column + 1 == at_.columns ? codes(at_.east_errors[r]) + row
                                        : error(east_of(own, column, row), NodePart::West, morph_margin)),
            *(row + 1 == at_.rows ? codes(at_.north_errors[r]) + column
                                  : error(north_of(own, column, row), NodePart::South, morph_margin)),
            *error(own, NodePart::West, morph_margin)};
    }

    /// The error codes of the centres of the four children of one node of the level above, the
    /// first of which is at (column, row); meaningless for children that do not exist.
    FourCodes child_codes(int column, int row, MorphMargin morph_margin) const {
        const std::uint8_t* first = error(slot(column, row), NodePart::Centre, morph_margin);
        const std::uint8_t* above = first + (std::ptrdiff_t{1} << at_.tile_shift);
        return {first[0], first[1], above[0], above[1]};
    }

    std::uint8_t centre_code(int column, int row, MorphMargin morph_margin) const {
        return *error(slot(column, row), NodePart::Centre, morph_margin);
    }

    /// The stored height of the root's corner in a quadrant.
    std::int16_t corner_height(std::size_t quadrant) const { return heights(corners_)[quadrant]; }

    std::int16_t centre_height(const NodeSlot& own) const { return *height(own, NodePart::Centre); }

    /// The stored height of the mid-point of one of a node's fan_edges.
    std::int16_t middle_height(const NodeSlot& own, int column, int row, std::size_t edge) const {
        switch (edge) {
        case 0:
            return *height(own, NodePart::South);
        case 1:
            return *(
                column + 1 == at_.columns ? heights(at_.east_heights) + row
                                          : height(east_of(own, column, row), NodePart::West));
        case 2:
            return *(
                row + 1 == at_.rows ? heights(at_.north_heights) + column
                                    : height(north_of(own, column, row), NodePart::South));
        default:
            return *height(own, NodePart::West);
        }
    }

private:
    const std::uint8_t* codes(std::size_t offset) const {
        return reinterpret_cast<const std::uint8_t*>(memory_ + offset);
    }

    const std::int16_t* heights(std::size_t offset) const {
        return reinterpret_cast<const std::int16_t*>(memory_ + offset);
    }

    const std::uint8_t* error(const NodeSlot& slot, NodePart part, MorphMargin morph_margin) const {
        const std::size_t plane =
            at_.errors[static_cast<std::size_t>(morph_margin)][static_cast<std::size_t>(part)];
        return reinterpret_cast<const std::uint8_t*>(slot.tile) + plane + slot.node;
    }

    const std::int16_t* height(const NodeSlot& slot, NodePart part) const {
        const std::size_t plane = static_cast<std::size_t>(part) * at_.tile_nodes;
        return reinterpret_cast<const std::int16_t*>(slot.tile) + plane + slot.node;
    }

    NodeSlot east_of(const NodeSlot& own, int column, int row) const {
        return (column & mask_) != mask_ ? NodeSlot{own.tile, own.node + 1} : slot(column + 1, row);
    }

    NodeSlot north_of(const NodeSlot& own, int column, int row) const {
        return (row & mask_) != mask_
                   ? NodeSlot{own.tile, own.node + (std::size_t{1} << at_.tile_shift)}
                   : slot(column, row + 1);
    }

    const std::byte* memory_;
    std::size_t corners_;
    GroundLayout::Level at_;
    const TileValidator* validator_;
    int level_;
    int mask_;
};

} // namespace octant::visuals::terrain
