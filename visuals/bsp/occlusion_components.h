#pragma once

#include "visuals/bsp/polygon_pieces.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::bsp {

/// Whether one piece hides part of another for some eye anywhere. That is so exactly when it
/// reaches before the other's plane and the other reaches behind its own: let b be a point of it
/// before plane(far_one) and a one of `far_one` behind plane(occluder); an eye on the line from a
/// through b, a little beyond b, is before both planes and sees b in front of a. A body has no
/// plane, and so no side on which it cannot hide or be hidden. Pieces that turn together keep their
/// places to one another (Pieces::add_rigid).
///
/// Pieces in one plane that face alike and overlap hide one another by a rule: the later polygon of
/// the file is painted over the earlier one, as a decal.
bool occludes(const PolygonPieces& pieces, std::uint32_t occluder, std::uint32_t far_one);

/// Divides pieces into the strongly connected components of the graph of what hides what for eyes
/// anywhere (R. Tarjan, "Depth-first search and linear graph algorithms", 1972), in painting order:
/// painted one after the other they are right for every eye. Components of several pieces, which
/// hide one another in a ring, are ascending. The time grows with the square of the number of
/// items.
std::vector<std::vector<std::uint32_t>>
occlusion_components(const PolygonPieces& pieces, std::span<const std::uint32_t> items);

} // namespace octant::visuals::bsp
