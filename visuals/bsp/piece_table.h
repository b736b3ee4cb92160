#pragma once

#include "visuals/bsp/piece_batch.h"
#include "visuals/bsp/polygon_pieces.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::bsp {

/// Where up to 64 pieces reach, a bit for each (Reach).
struct PlaneSideBits {
    std::uint64_t before = 0;
    std::uint64_t behind = 0;
};

/// Some pieces with their bounding spheres and corners side by side in memory, for questions that
/// are asked of all of them.
class PieceTable {
public:
    static constexpr std::size_t pieces_per_block = 64;

    /// Every `step`th of `items`, from the first one.
    PieceTable(const PolygonPieces& pieces, std::span<const std::uint32_t> items, std::size_t step = 1);

    std::size_t count() const { return count_; }

    /// How many blocks of 64 pieces there are; the last one may have fewer.
    std::size_t blocks() const { return (count() + pieces_per_block - 1) / pieces_per_block; }

    /// How many pieces a block has.
    std::size_t count_in(std::size_t block) const;

    /// Pieces::sides_reached() of the pieces of a block; the bits of those that are not there are 0.
    PlaneSideBits sides_reached(std::size_t block, const Plane& plane) const;

private:
    /// What lanes have no room for.
    struct ExtraCorners {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void add(const PolygonPieces& pieces, const PolygonPiece& piece);

    std::size_t count_ = 0;
    std::vector<PieceBatch> lanes_;
    std::vector<std::uint64_t> has_extra_corners_; ///< A bit a piece: more corners than lanes have room for.
    std::vector<ExtraCorners> extra_corners_;       ///< One a piece.
    std::vector<glm::dvec3> corners_;
};

} // namespace octant::visuals::bsp
