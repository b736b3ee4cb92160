#pragma once

#include "visuals/bsp/piece_batch.h"
#include "visuals/bsp/polygon_pieces.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::bsp {

/// Where up to 64 pieces reach, a bit for each (Reach).
struct PlaneSideBits {
    std::uint64_t before = 0;
    std::uint64_t behind = 0;
};

/// Some pieces with their bounding spheres and corners side by side in memory, for questions that are asked of all of
/// them.
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
    std::vector<ExtraCorners> extra_corners_;      ///< One a piece.
    std::vector<glm::dvec3> corners_;
};

/// How a plane parts pieces.
struct SplitCounts {
    std::size_t before = 0;   ///< Wholly before the plane.
    std::size_t behind = 0;   ///< Wholly behind it.
    std::size_t coplanar = 0; ///< In it.
    std::size_t cut = 0;      ///< On both sides of it.
    bool cuts_swept = false;  ///< What a turning polygon sweeps is on both sides: it cannot be cut.
};

/// A plane that divides pieces in two, or takes at least one of them out because it lies in it: the one with few cuts
/// and even halves among planes of pieces, at most 64 spread over them, and planes across the axes at the ends of
/// pieces. Returns nothing when every plane cuts what turns or leaves all pieces together.
std::optional<Plane> splitting_plane(const PolygonPieces& pieces, std::span<const std::uint32_t> items);

/// A square of bits, 64 to a word.
class BitMatrix {
public:
    explicit BitMatrix(std::size_t count) : words_((count + 63) / 64), bits_(words_ * 64 * words_, 0) {}

    std::size_t words() const { return words_; }

    std::uint64_t& word(std::size_t row, std::size_t word) { return bits_[row * words_ + word]; }

    void add(std::size_t row, std::size_t column) { word(row, column / 64) |= std::uint64_t{1} << (column % 64); }

    void remove(std::size_t row, std::size_t column) { word(row, column / 64) &= ~(std::uint64_t{1} << (column % 64)); }

    /// Rows become columns, block by block.
    void transpose() {
        for (std::size_t row = 0; row < words_; ++row) {
            for (std::size_t column = 0; column <= row; ++column) {
                const Block lower = transposed_block(row, column);
                put(column, row, transposed_block(column, row), lower);
            }
        }
    }

private:
    using Block = std::array<std::uint64_t, 64>;

    /// A block of 64 rows and columns, transposed by halves, quarters and so on.
    Block transposed_block(std::size_t row, std::size_t column) {
        Block block;
        for (std::size_t i = 0; i < 64; ++i) { block[i] = word(row * 64 + i, column); }
        std::uint64_t mask = 0xffffffffU;
        for (unsigned width = 32; width != 0; width /= 2, mask ^= mask << width) {
            for (unsigned i = 0; i < 64; i = (i + width + 1) & ~width) {
                const std::uint64_t swapped = ((block[i] >> width) ^ block[i + width]) & mask;
                block[i] ^= swapped << width;
                block[i + width] ^= swapped;
            }
        }
        return block;
    }

    /// Writes two blocks that have changed places.
    void put(std::size_t row, std::size_t column, const Block& across, const Block& here) {
        for (std::size_t i = 0; i < 64; ++i) {
            word(column * 64 + i, row) = across[i];
            word(row * 64 + i, column) = here[i];
        }
    }

    std::size_t words_;
    std::vector<std::uint64_t> bits_; ///< Rows in multiples of 64.
};

/// Whether one piece hides part of another for some eye anywhere. That is so exactly when it reaches before the other's
/// plane and the other reaches behind its own: let b be a point of it before plane(far_one) and a one of `far_one`
/// behind plane(occluder); an eye on the line from a through b, a little beyond b, is before both planes and sees b in
/// front of a. A body has no plane, and so no side on which it cannot hide or be hidden. Pieces that turn together keep
/// their places to one another (Pieces::add_rigid).
///
/// Pieces in one plane that face alike and overlap hide one another by a rule: the later polygon of the file is painted
/// over the earlier one, as a decal.
bool occludes(const PolygonPieces& pieces, std::uint32_t occluder, std::uint32_t far_one);

/// Divides pieces into the strongly connected components of the graph of what hides what for eyes anywhere (R. Tarjan,
/// "Depth-first search and linear graph algorithms", 1972), in painting order: painted one after the other they are
/// right for every eye. Components of several pieces, which hide one another in a cycle, are ascending. The time grows
/// with the square of the number of items.
std::vector<std::vector<std::uint32_t>> occlusion_components(
    const PolygonPieces& pieces, std::span<const std::uint32_t> items);

/// An order for every eye by dividing the polygons themselves: a BSP tree whose leaves are lists that are right for
/// every eye, however large, and in which parts that hide one another in one direction only are painted one after the
/// other without being parted.
struct PartialBspTree {
    static constexpr int nothing = std::numeric_limits<int>::min();

    /// A child >= 0 is a later node, one < 0 is the list ~child or `nothing`.
    struct Node {
        /// Nothing: `front` is painted, then `back`. Else what is on the other side of the plane than the eye is
        /// painted first, then what lies in it and faces the eye.
        std::optional<Plane> plane; ///< In the unit of Pieces.
        int front = nothing;
        int back = nothing;
        int coplanar_front = nothing; ///< What lies in the plane and faces as it does.
        int coplanar_back = nothing;  ///< What lies in the plane and faces back.
    };

    int root = nothing;
    std::vector<Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists; ///< Pieces, first painted first.
    /// Rings of pieces that turn, or turn and meet others, and that no plane parts.
    std::vector<std::vector<std::uint32_t>> unsplit_cycles;
    int depth = 0; ///< The number of nodes on the longest path from the root.
};

/// Orders pieces, cutting them where they must be. The same pieces give the same tree.
PartialBspTree partial_bsp_tree(PolygonPieces& pieces, std::vector<std::uint32_t> items);

} // namespace octant::visuals::bsp
