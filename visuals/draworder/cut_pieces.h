#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Adds to a painting list the pieces that were cut off its polygons after it was made, each behind what it was cut
/// from. As they lie in one plane, and a piece hides no more than the whole did, the list stays right. `cut_from[i]` is
/// what piece `first` + i was cut from, with a lower number; the list has numbers below `first` only.
void insert_cut_pieces(std::vector<std::uint32_t>& list, std::span<const std::uint32_t> cut_from, std::uint32_t first);

} // namespace octant::visuals::draworder
