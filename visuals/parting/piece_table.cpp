#include "visuals/parting/piece_table.h"

namespace octant::visuals::parting {

PieceTable::PieceTable(
    const Pieces& pieces, std::span<const std::uint32_t> items, std::size_t step) {
    balls_.reserve(items.size() / step + 1);
    for (std::size_t i = 0; i < items.size(); i += step) {
        const Piece& piece = pieces[items[i]];
        const std::size_t first = corners_.size();
        for (const std::uint32_t vertex : piece.corners) {
            corners_.push_back(pieces.at(vertex));
        }
        balls_.push_back({piece.middle, piece.radius + tolerance, first, corners_.size()});
    }
}

} // namespace octant::visuals::parting
