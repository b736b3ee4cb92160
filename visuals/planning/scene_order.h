#pragma once

#include "visuals/planning/bounding_box.h"

#include <cstdint>
#include <memory>
#include <span>

namespace octant::visuals::planning {

/// Boxes of aircraft that are painted as one: nearly always a single one.
struct OverlapGroup {
    /// The box of a single member; else a box around those of all members, which may intersect other groups.
    OrientedBox box;
    std::uint32_t first = 0; ///< The range of SceneOrder::members().
    std::uint32_t count = 0;
};

/// The painting order of aircraft by their bounding boxes.
///
/// A box must be painted after every box of which it can hide a part; two that intersect must each be painted after the
/// other. The groups are the strongly connected components of this relation, so they have an order.
///
/// Nearly all of it comes from a sort. The power of the eye with respect to a sphere is
/// |centre|^2 - radius^2. The eyes of equal power to two spheres that do not meet form a plane
/// between them, and the sphere on the eye's side has the smaller power: sorted by descending power, boxes of such
/// spheres are in painting order. Where spheres intersect, a box may precede one that it hides; the range of the list
/// from one to the other is then sorted again by occlusion. No cycle extends beyond these ranges.
class SceneOrder {
public:
    SceneOrder();
    SceneOrder(const SceneOrder&) = delete;
    SceneOrder& operator=(const SceneOrder&) = delete;
    SceneOrder(SceneOrder&&) = delete;
    SceneOrder& operator=(SceneOrder&&) = delete;
    ~SceneOrder();

    /// Sets the boxes, eye at the origin, and orders them.
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
