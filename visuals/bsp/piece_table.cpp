#include "visuals/bsp/piece_table.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace octant::visuals::bsp {

namespace {

constexpr std::size_t lanes_a_block = PieceTable::pieces_per_block / PieceBatch::pieces;

PieceBatch empty_lanes() {
    PieceBatch lanes;
    const auto clear = [](PieceBatch::Lane& lane) {
        lane.fill(std::numeric_limits<double>::quiet_NaN());
    };
    const auto clear_all = [&](PieceBatch::Points& points) {
        clear(points.x);
        clear(points.y);
        clear(points.z);
    };
    clear_all(lanes.centres);
    clear(lanes.radii);
    std::ranges::for_each(lanes.first_corners, clear_all);
    return lanes;
}

void put(PieceBatch::Points& points, std::size_t place, const glm::dvec3& point) {
    points.x[place] = point.x;
    points.y[place] = point.y;
    points.z[place] = point.z;
}

} // namespace

PieceTable::PieceTable(
    const PolygonPieces& pieces, std::span<const std::uint32_t> items, std::size_t step) {
    const std::size_t count = (items.size() + step - 1) / step;
    lanes_.assign((count + PieceBatch::pieces - 1) / PieceBatch::pieces, empty_lanes());
    has_extra_corners_.assign((count + pieces_per_block - 1) / pieces_per_block, 0);
    extra_corners_.reserve(count);
    for (std::size_t i = 0; i < items.size(); i += step) {
        add(pieces, pieces[items[i]]);
    }
}

void PieceTable::add(const PolygonPieces& pieces, const PolygonPiece& piece) {
    PieceBatch& lanes = lanes_[count_ / PieceBatch::pieces];
    const std::size_t place = count_ % PieceBatch::pieces;
    put(lanes.centres, place, piece.middle);
    lanes.radii[place] = piece.radius + tolerance;
    const std::size_t corners = piece.corners.size();
    for (std::size_t i = 0; i < PieceBatch::corners; ++i) {
        const std::uint32_t corner = piece.corners[std::min(i, corners - 1)];
        put(lanes.first_corners[i], place, pieces.at(corner));
    }
    const std::size_t first_more = corners_.size();
    for (std::size_t i = PieceBatch::corners; i < corners; ++i) {
        corners_.push_back(pieces.at(piece.corners[i]));
    }
    extra_corners_.push_back({first_more, corners_.size()});
    has_extra_corners_[count_ / pieces_per_block] |= std::uint64_t{corners > PieceBatch::corners}
                                          << (count_ % pieces_per_block);
    ++count_;
}

std::size_t PieceTable::count_in(std::size_t block) const {
    return std::min(count_ - block * pieces_per_block, pieces_per_block);
}

PlaneSideBits PieceTable::sides_reached(std::size_t block, const Plane& plane) const {
    const auto lanes = std::span(lanes_).subspan(block * lanes_a_block);
    const PieceSideBits sides =
        sides_of(lanes.first(std::min(lanes.size(), lanes_a_block)), plane, tolerance);
    const std::uint64_t open = ~(sides.sphere_in_front | sides.sphere_behind);
    PlaneSideBits sides_reached{
        sides.sphere_in_front | (sides.corner_in_front & open),
        sides.sphere_behind | (sides.corner_behind_plane & open)};
    std::uint64_t left = open & has_extra_corners_[block] & ~(sides_reached.before & sides_reached.behind);
    for (; left != 0; left &= left - 1) {
        const auto place = static_cast<std::size_t>(std::countr_zero(left));
        const ExtraCorners& more = extra_corners_[block * pieces_per_block + place];
        for (std::size_t k = more.first; k < more.end; ++k) {
            const double height = distance_m(plane, corners_[k]);
            sides_reached.before |= std::uint64_t{height > tolerance} << place;
            sides_reached.behind |= std::uint64_t{height < -tolerance} << place;
        }
    }
    return sides_reached;
}

} // namespace octant::visuals::bsp
