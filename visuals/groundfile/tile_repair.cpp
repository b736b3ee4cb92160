#include "visuals/groundfile/tile_repair.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace octant::visuals::groundfile {

namespace {

using terrain::NodePart;
using terrain::MorphMargin;

constexpr std::array<NodePart, 3> parts = {NodePart::Centre, NodePart::South, NodePart::West};
constexpr std::uint8_t greatest_code = 255;

struct GridIndex {
    int column = 0;
    int row = 0;

    bool operator==(const GridIndex&) const = default;
};

class TileRepair {
public:
    TileRepair(
        const TileCheck& is_intact,
        const GroundTiles& ground,
        TileId number,
        std::span<std::byte> bytes)
        : is_intact_(is_intact)
        , ground_(ground)
        , level_(number.level)
        , at_(ground.layout().level(number.level))
        , first_{
              static_cast<int>(number.tile % static_cast<std::size_t>(at_.tiles_across))
                  << at_.tile_shift,
              static_cast<int>(number.tile / static_cast<std::size_t>(at_.tiles_across))
                  << at_.tile_shift}
        , end_{std::min(first_.column + side(), at_.columns), std::min(first_.row + side(), at_.rows)}
        , bytes_(bytes) {}

    void repair() {
        std::fill(bytes_.begin(), bytes_.end(), std::byte{0});
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                for (const NodePart part : parts) {
                    write_height(part, {column, row}, height(part, {column, row}));
                }
            }
        }
        // Where both rooms share a place, the smaller errors stay.
        repair_errors(MorphMargin::Full);
        repair_errors(MorphMargin::None);
    }

private:
    void repair_errors(MorphMargin morph_margin) {
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                code(NodePart::Centre, {column, row}, morph_margin) = centre_code({column, row}, morph_margin);
            }
        }
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                const std::uint8_t own = code_of({column, row}, morph_margin);
                const bool in_south = row == 0;
                const bool in_west = column == 0;
                code(NodePart::South, {column, row}, morph_margin) =
                    in_south ? own : std::min(own, code_of({column, row - 1}, morph_margin));
                code(NodePart::West, {column, row}, morph_margin) =
                    in_west ? own : std::min(own, code_of({column - 1, row}, morph_margin));
            }
        }
    }

    int side() const { return 1 << at_.tile_shift; }

    bool is_own(GridIndex node) const {
        return node.column >= first_.column && node.row >= first_.row &&
               node.column < end_.column && node.row < end_.row;
    }

    std::size_t index_of(GridIndex node) const {
        return static_cast<std::size_t>(
            ((node.row - first_.row) << at_.tile_shift) + node.column - first_.column);
    }

    void write_height(NodePart part, GridIndex node, std::int16_t stored) {
        reinterpret_cast<std::int16_t*>(
            bytes_.data())[static_cast<std::size_t>(part) * at_.tile_nodes + index_of(node)] =
            stored;
    }

    std::uint8_t& code(NodePart part, GridIndex node, MorphMargin morph_margin) {
        const std::size_t first =
            at_.errors[static_cast<std::size_t>(morph_margin)][static_cast<std::size_t>(part)];
        return reinterpret_cast<std::uint8_t*>(bytes_.data())[first + index_of(node)];
    }

    /// The code of a node's centre, in this tile or another of its level.
    std::uint8_t code_of(GridIndex node, MorphMargin morph_margin) {
        return is_own(node)
                   ? code(NodePart::Centre, node, morph_margin)
                   : ground_.error_code(level_, NodePart::Centre, node.column, node.row, morph_margin);
    }

    /// A centre needs the middles of the two edges of its parent that lie on its own.
    std::uint8_t centre_code(GridIndex node, MorphMargin morph_margin) const {
        if (level_ == 0) {
            return greatest_code;
        }
        const int column = node.column / 2;
        const int row = node.row / 2;
        return std::min(
            ground_.error_code(level_ - 1, NodePart::South, column, row + node.row % 2, morph_margin),
            ground_.error_code(level_ - 1, NodePart::West, column + node.column % 2, row, morph_margin));
    }

    GridIndex clamped(GridIndex sample) const {
        return {
            std::clamp(sample.column, 0, ground_.columns() - 1),
            std::clamp(sample.row, 0, ground_.rows() - 1)};
    }

    /// The height of a sample where the tile that holds it is sound.
    std::optional<double> intact_height_m(GridIndex sample) const {
        const auto steps = static_cast<unsigned>(sample.column | sample.row);
        if (steps % static_cast<unsigned>(ground_.layout().level(0).edge) != 0) {
            const int zeros = std::countr_zero(steps);
            const int level = ground_.levels() - 1 - zeros;
            const GroundLayout::Level& at = ground_.layout().level(level);
            const GridIndex node{sample.column >> (zeros + 1), sample.row >> (zeros + 1)};
            const auto tile = static_cast<std::size_t>(
                (node.row >> at.tile_shift) * at.tiles_across + (node.column >> at.tile_shift));
            const bool in_tile = node.column < at.columns && node.row < at.rows;
            if (in_tile && !is_intact_(level, tile)) {
                return std::nullopt;
            }
        }
        return static_cast<double>(ground_.height_m(sample.column, sample.row));
    }

    /// The mean of two samples where both are there and sound.
    std::optional<double> mean_m(GridIndex a, GridIndex b) const {
        const auto at_a = a == clamped(a) ? intact_height_m(a) : std::nullopt;
        const auto at_b = b == clamped(b) ? intact_height_m(b) : std::nullopt;
        return at_a && at_b ? std::optional(0.5 * (*at_a + *at_b)) : std::nullopt;
    }

    /// The ends of the edge that a node's sample halves.
    std::array<GridIndex, 2> ends_of(NodePart part, GridIndex node) const {
        const GridIndex low{node.column * at_.edge, node.row * at_.edge};
        const GridIndex high{low.column + at_.edge, low.row + at_.edge};
        if (part == NodePart::South) {
            return {low, GridIndex{high.column, low.row}};
        }
        if (part == NodePart::West) {
            return {low, GridIndex{low.column, high.row}};
        }
        return node.column % 2 == node.row % 2
                   ? std::array{low, high}
                   : std::array{GridIndex{high.column, low.row}, GridIndex{low.column, high.row}};
    }

    double coarser_m(NodePart part, GridIndex node) const {
        const auto end_m = [&](GridIndex nominal) -> std::optional<double> {
            const GridIndex end = clamped(nominal);
            return end == nominal
                       ? std::optional(static_cast<double>(ground_.height_m(end.column, end.row)))
                       : intact_height_m(end);
        };
        const auto [a, b] = ends_of(part, node);
        const auto at_a = end_m(a);
        const auto at_b = end_m(b);
        return at_a && at_b ? 0.5 * (*at_a + *at_b)
               : at_a       ? *at_a
                            : at_b.value_or(static_cast<double>(ground_.metadata().mean_m));
    }

    double height_m(NodePart part, GridIndex node) const {
        const int half = at_.edge / 2;
        const GridIndex nominal{
            node.column * at_.edge + (part == NodePart::West ? 0 : half),
            node.row * at_.edge + (part == NodePart::South ? 0 : half)};
        const GridIndex sample = clamped(nominal);
        if (sample != nominal) {
            if (const auto known_m = intact_height_m(sample)) {
                return *known_m;
            }
        }
        if (half > 1) {
            const auto across_m =
                mean_m({sample.column - 1, sample.row}, {sample.column + 1, sample.row});
            const auto along_m =
                mean_m({sample.column, sample.row - 1}, {sample.column, sample.row + 1});
            if (across_m && along_m) {
                return 0.5 * (*across_m + *along_m);
            }
            if (across_m || along_m) {
                return across_m ? *across_m : *along_m;
            }
        }
        return coarser_m(part, node);
    }

    std::int16_t height(NodePart part, GridIndex node) const {
        const GroundShape& shape = ground_.shape();
        const int shift = std::max(level_ - ground_.layout().range_level(), 0);
        const int level = level_ - shift;
        const double lowest_m =
            static_cast<double>(ground_.lowest_m(level, node.column >> shift, node.row >> shift));
        const double highest_m =
            static_cast<double>(ground_.highest_m(level, node.column >> shift, node.row >> shift));
        const double own_m = std::clamp(height_m(part, node), lowest_m, highest_m);
        return static_cast<std::int16_t>(
            std::lround((own_m - shape.height_base_m) / shape.height_unit_m));
    }

    const TileCheck& is_intact_;
    const GroundTiles& ground_;
    int level_;
    GroundLayout::Level at_;
    GridIndex first_;
    GridIndex end_;
    std::span<std::byte> bytes_;
};

} // namespace

void repair_tile(
    const TileCheck& is_intact,
    const GroundTiles& ground,
    TileId number,
    std::span<std::byte> bytes) {
    TileRepair(is_intact, ground, number, bytes).repair();
}

} // namespace octant::visuals::groundfile
