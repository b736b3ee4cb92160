#pragma once

#include "visuals/parting/piece_lanes.h"
#include "visuals/parting/pieces.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::parting {

/// Where up to 64 pieces reach, a bit for each (Reach).
struct ReachBits {
    std::uint64_t before = 0;
    std::uint64_t behind = 0;
};

/// Some pieces with their bounding spheres and corners side by side in memory, for questions that
/// are asked of all of them.
class PieceTable {
public:
    static constexpr std::size_t pieces_a_block = 64;

    /// Every `step`th of `items`, from the first one.
    PieceTable(const Pieces& pieces, std::span<const std::uint32_t> items, std::size_t step = 1);

    std::size_t count() const { return count_; }

    /// How many blocks of 64 pieces there are; the last one may have fewer.
    std::size_t blocks() const { return (count() + pieces_a_block - 1) / pieces_a_block; }

    /// How many pieces a block has.
    std::size_t count_in(std::size_t block) const;

    /// Pieces::reach() of the pieces of a block; the bits of those that are not there are 0.
    ReachBits reach(std::size_t block, const Plane& plane) const;

private:
    /// What lanes have no room for.
    struct MoreCorners {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void add(const Pieces& pieces, const Piece& piece);

    std::size_t count_ = 0;
    std::vector<PieceLanes> lanes_;
    std::vector<std::uint64_t> has_more_; ///< A bit a piece: more corners than lanes have room for.
    std::vector<MoreCorners> more_;       ///< One a piece.
    std::vector<glm::dvec3> corners_;
};

} // namespace octant::visuals::parting
