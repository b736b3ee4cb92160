#pragma once

#include "visuals/planning/bounding_box.h"

#include <cstdint>
#include <memory>
#include <span>

namespace octant::visuals::planning {

/// Aircraft that are painted as one: nearly always a single one.
struct OverlapGroup {
    /// The box of a single member; else it holds the boxes of all, and may meet other groups.
    OrientedBox box;
    std::uint32_t first = 0;
    /// Its members are first to first + count - 1.
    std::uint32_t count = 0;
};

/// Painting order of aircraft by the boxes that stand in for them. Keeps its memory.
///
/// A box must wait for every other of which it can hide a part; two that meet wait for each other. Boxes that wait for
/// each other, directly or in a ring, become one group, and no others do: the groups have an order.
///
/// Nearly all of it comes from a sort. The power of the eye with respect to a sphere is
/// |centre|^2 - radius^2. The eyes of equal power to two spheres that do not meet form a plane
/// between them, and the sphere on the eye's side has the smaller power: by descending power, no such box comes before
/// one that must be painted first. Only where spheres meet, a box may come before one that it hides; the window of the
/// list from one to the other is then sorted anew by which box hides which. No ring reaches out of these windows.
class SceneOrder {
public:
    SceneOrder();
    SceneOrder(const SceneOrder&) = delete;
    SceneOrder& operator=(const SceneOrder&) = delete;
    SceneOrder(SceneOrder&&) = delete;
    SceneOrder& operator=(SceneOrder&&) = delete;
    ~SceneOrder();

    /// Boxes with the eye at the origin.
    void arrange(std::span<const OrientedBox> boxes);

    /// Farthest first: no member of a group hides any part of a member of a later one from the eye.
    std::span<const OverlapGroup> overlap_groups() const;

    /// The boxes of a group, by index, ascending.
    std::span<const std::uint32_t> members(const OverlapGroup& group) const;

private:
    class Search;
    std::unique_ptr<Search> search_;
};

} // namespace octant::visuals::planning
