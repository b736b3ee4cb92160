#pragma once

#include "visuals/bsp/polygon_pieces.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace octant::visuals::bsp {

/// How a plane parts pieces.
struct SplitCounts {
    std::size_t before = 0;  ///< Wholly before the plane.
    std::size_t behind = 0;  ///< Wholly behind it.
    std::size_t coplanar = 0;  ///< In it.
    std::size_t cut = 0;     ///< On both sides of it.
    bool cuts_swept = false; ///< What a turning polygon sweeps is on both sides: it cannot be cut.
};

/// A plane that divides pieces in two, or takes at least one of them out because it lies in it:
/// the one with few cuts and even halves among planes of pieces, at most 64 spread over them, and
/// planes across the axes at the ends of pieces. Returns nothing when every plane cuts what turns
/// or leaves all pieces together.
std::optional<Plane> splitting_plane(const PolygonPieces& pieces, std::span<const std::uint32_t> items);

} // namespace octant::visuals::bsp
