#pragma once

#include "visuals/scene/aircraft_hull.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::scene {

/// Aircraft that are painted as one: nearly always a single one.
struct Knot {
    HullBox box; ///< holds the boxes of all members
    std::uint32_t first = 0;
    std::uint32_t count = 0; ///< members first .. first + count - 1
};

/// Painting order of aircraft by the boxes that stand in for them. Keeps its memory.
///
/// The power of the eye with respect to a sphere is |centre|^2 - radius^2. The eyes of equal power
/// to two spheres that do not meet form a plane between them, and the sphere on the eye's side has
/// the smaller power: by descending power, no such aircraft is painted before one that it can hide,
/// without cycles. Where spheres meet and boxes do not, planes between the boxes decide instead and
/// the run of the list from one to the other is sorted anew. Boxes that meet, and rings of boxes
/// each before the next, become one knot.
class SceneOrder {
public:
    /// Boxes with the eye at the origin.
    void arrange(std::span<const HullBox> boxes);

    /// Farthest first: no knot hides any part of a later one from the eye.
    std::span<const Knot> knots() const { return knots_; }

    /// Boxes of a knot, by index, ascending.
    std::span<const std::uint32_t> members(const Knot& knot) const {
        return std::span(members_).subspan(knot.first, knot.count);
    }

private:
    struct Body {
        HullBox box;
        double radius_m = 0.0;
        double power_m2 = 0.0;
        std::uint32_t root = 0; ///< least member
    };

    bool try_to_arrange(std::span<const HullBox> boxes);
    void gather(std::span<const HullBox> boxes);
    bool compare_near_pairs();
    bool sort_window(std::uint32_t first, std::uint32_t last);
    void fill_precedences(std::uint32_t first, std::uint32_t count);
    void join_a_ring(std::uint32_t first, std::uint32_t count);
    void join(std::uint32_t root, std::uint32_t other);
    void list_members();

    std::vector<std::uint32_t> roots_; ///< of each box: the least box of its knot
    std::vector<Body> bodies_;         ///< knots to be, in painting order
    std::vector<Body> sorted_;
    std::vector<std::uint32_t> by_x_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> windows_;
    std::vector<char> precedes_; ///< [a * count + b]: a must be painted before b
    std::vector<char> placed_;
    std::vector<std::uint32_t> body_of_root_;
    std::vector<Knot> knots_;
    std::vector<std::uint32_t> members_;
};

} // namespace octant::visuals::scene
