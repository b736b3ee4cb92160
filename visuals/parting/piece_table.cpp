#include "visuals/parting/piece_table.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace octant::visuals::parting {

namespace {

constexpr std::size_t lanes_a_block = PieceTable::pieces_a_block / PieceLanes::pieces;

PieceLanes empty_lanes() {
    PieceLanes lanes;
    const auto clear = [](PieceLanes::Lane& lane) {
        lane.fill(std::numeric_limits<double>::quiet_NaN());
    };
    const auto clear_all = [&](PieceLanes::Points& points) {
        clear(points.x);
        clear(points.y);
        clear(points.z);
    };
    clear_all(lanes.middles);
    clear(lanes.radii);
    std::ranges::for_each(lanes.first_corners, clear_all);
    return lanes;
}

void put(PieceLanes::Points& points, std::size_t place, const glm::dvec3& point) {
    points.x[place] = point.x;
    points.y[place] = point.y;
    points.z[place] = point.z;
}

} // namespace

PieceTable::PieceTable(
    const Pieces& pieces, std::span<const std::uint32_t> items, std::size_t step) {
    const std::size_t count = (items.size() + step - 1) / step;
    lanes_.assign((count + PieceLanes::pieces - 1) / PieceLanes::pieces, empty_lanes());
    has_more_.assign((count + pieces_a_block - 1) / pieces_a_block, 0);
    more_.reserve(count);
    for (std::size_t i = 0; i < items.size(); i += step) {
        add(pieces, pieces[items[i]]);
    }
}

void PieceTable::add(const Pieces& pieces, const Piece& piece) {
    PieceLanes& lanes = lanes_[count_ / PieceLanes::pieces];
    const std::size_t place = count_ % PieceLanes::pieces;
    put(lanes.middles, place, piece.middle);
    lanes.radii[place] = piece.radius + tolerance;
    const std::size_t corners = piece.corners.size();
    for (std::size_t i = 0; i < PieceLanes::corners; ++i) {
        const std::uint32_t corner = piece.corners[std::min(i, corners - 1)];
        put(lanes.first_corners[i], place, pieces.at(corner));
    }
    const std::size_t first_more = corners_.size();
    for (std::size_t i = PieceLanes::corners; i < corners; ++i) {
        corners_.push_back(pieces.at(piece.corners[i]));
    }
    more_.push_back({first_more, corners_.size()});
    has_more_[count_ / pieces_a_block] |= std::uint64_t{corners > PieceLanes::corners}
                                          << (count_ % pieces_a_block);
    ++count_;
}

std::size_t PieceTable::count_in(std::size_t block) const {
    return std::min(count_ - block * pieces_a_block, pieces_a_block);
}

ReachBits PieceTable::reach(std::size_t block, const Plane& plane) const {
    const auto lanes = std::span(lanes_).subspan(block * lanes_a_block);
    const PieceSides sides =
        sides_of(lanes.first(std::min(lanes.size(), lanes_a_block)), plane, tolerance);
    const std::uint64_t open = ~(sides.ball_before | sides.ball_behind);
    ReachBits reach{
        sides.ball_before | (sides.corner_before & open),
        sides.ball_behind | (sides.corner_behind & open)};
    std::uint64_t left = open & has_more_[block] & ~(reach.before & reach.behind);
    for (; left != 0; left &= left - 1) {
        const auto place = static_cast<std::size_t>(std::countr_zero(left));
        const MoreCorners& more = more_[block * pieces_a_block + place];
        for (std::size_t k = more.first; k < more.end; ++k) {
            const double height = distance_m(plane, corners_[k]);
            reach.before |= std::uint64_t{height > tolerance} << place;
            reach.behind |= std::uint64_t{height < -tolerance} << place;
        }
    }
    return reach;
}

} // namespace octant::visuals::parting
