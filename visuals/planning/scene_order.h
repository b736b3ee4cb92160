#pragma once

#include "visuals/planning/bounding_box.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// Aircraft that are painted as one: nearly always a single one.
struct OverlapGroup {
    /// The box of a single member; else it holds the boxes of all, and may meet other knots.
    OrientedBox box;
    std::uint32_t first = 0;
    /// Its members are first to first + count - 1.
    std::uint32_t count = 0;
};

/// Painting order of aircraft by the boxes that stand in for them. Keeps its memory.
///
/// A box must wait for every other of which it can hide a part; two that meet wait for each other.
/// Boxes that wait for each other, directly or in a ring, become one knot, and no others do: what
/// is left has an order.
///
/// Nearly all of it comes from a sort. The power of the eye with respect to a sphere is
/// |centre|^2 - radius^2. The eyes of equal power to two spheres that do not meet form a plane
/// between them, and the sphere on the eye's side has the smaller power: by descending power, no
/// such box comes before one that must be painted first. Only where spheres meet, a box may come
/// before one that it hides; the window of the list from one to the other is then sorted anew by
/// which box hides which. No ring reaches out of these windows.
class SceneOrder {
public:
    /// Boxes with the eye at the origin.
    void arrange(std::span<const OrientedBox> boxes);

    /// Farthest first: no member of a knot hides any part of a member of a later one from the eye.
    std::span<const OverlapGroup> overlap_groups() const { return overlap_groups_; }

    /// Boxes of a knot, by index, ascending.
    std::span<const std::uint32_t> members(const OverlapGroup& overlap_group) const {
        return std::span(members_).subspan(overlap_group.first, overlap_group.count);
    }

private:
    struct Body {
        OrientedBox box;
        double radius_m = 0.0;
        double power_m2 = 0.0;
        /// A unit vector.
        glm::dvec3 towards{0.0};
        /// Of half the angle over which the sphere is seen.
        double sine = 0.0;
        double cosine = 0.0;
        /// Whether the sphere holds the eye.
        bool around_eye = false;
        /// The index of the box.
        std::uint32_t index = 0;
    };

    /// Where the search for rings has come with a body of a window.
    struct ComponentVisit {
        /// In order of first visits, from 1; 0 = not yet seen.
        std::uint32_t number = 0;
        /// The least number known to be reached from here.
        std::uint32_t least = 0;
        /// A place in occluders_.
        std::uint32_t next = 0;
        std::uint32_t end = 0;
        bool is_in_group = false;
    };

    static bool may_overlap_on_screen(const Body& a, const Body& b);

    void place_bodies(std::span<const OrientedBox> boxes);
    void find_windows();
    void arrange_window(std::uint32_t first, std::uint32_t last);
    void find_occluders(std::uint32_t first, std::uint32_t count);
    void visit_component(std::uint32_t first, std::uint32_t body);
    void begin_visit(std::uint32_t body);
    void add_overlap_group(std::span<const std::uint32_t> bodies, std::uint32_t first);

    /// By descending power.
    std::vector<Body> bodies_;
    std::vector<std::uint32_t> by_x_;
    /// The first and the last body of each.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> windows_;
    /// A body, and one that it waits for.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> occluders_;
    std::vector<ComponentVisit> visits_;
    /// Bodies of which each waits for the next.
    std::vector<std::uint32_t> path_;
    /// Bodies that were seen and are not yet in a knot, by number.
    std::vector<std::uint32_t> open_;
    std::uint32_t visited_ = 0;
    std::vector<OverlapGroup> overlap_groups_;
    std::vector<std::uint32_t> members_;
};

} // namespace octant::visuals::planning
