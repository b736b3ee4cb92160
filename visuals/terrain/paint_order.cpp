// The painting order of a fan's triangles and quadrants, so that the ground needs no depth buffer, as the aircraft need
// none. It has no source; the quadtree paper draws with a depth buffer.
//
// In plan a line of sight lies on a ray from the eye, and the triangles of a height field do not overlap in plan. So an
// order that is back to front along every ray in plan is right, whatever the heights. All parts of a node are wedges
// around its centre. Along a ray that misses the centre the direction from the centre turns one way only, and by less
// than half a turn. Hence, of the two chains of wedges that lead from the wedge opposite the eye round to the wedge
// with the eye, a ray crosses part of one chain, in order.
#include "visuals/terrain/paint_order.h"

#include "sim/base/axes.h"

#include <algorithm>

namespace octant::visuals::terrain {

namespace {

constexpr unsigned wedges = 8;

/// When a part is painted as seen from wedge `eye`: first the opposite wedge, then its two chains one after the other,
/// then the wedge with the eye. A part over two wedges comes with the first of them, but last if one of them is the
/// eye's.
constexpr unsigned paint_rank(unsigned part, unsigned eye) {
    constexpr std::array<unsigned, wedges> turn_from_opposite = {0, 1, 2, 3, 7, 6, 5, 4};
    unsigned first = wedges;
    for (unsigned wedge = part_sides[part].from; wedge != part_sides[part].to; wedge = (wedge + 1) % wedges) {
        const unsigned turn = turn_from_opposite[(wedge + wedges - eye + 4) % wedges];
        if (turn == wedges - 1) { return turn; }
        first = std::min(first, turn);
    }
    return first;
}

/// An order with its sets of places filled in.
constexpr PartOrder with_position_sets(const std::array<std::uint8_t, fan_parts>& parts) {
    constexpr std::array<unsigned, wedges> quadrant_of_wedge = {0, 1, 1, 3, 3, 2, 2, 0};
    PartOrder order;
    order.part = parts;
    for (unsigned place = 0; place < fan_parts; ++place) {
        const unsigned part = parts[place];
        const auto bit = static_cast<std::uint16_t>(1U << place);
        for (unsigned set = 0; set < 16; ++set) {
            const auto contains = [set](unsigned k) { return (set >> k & 1U) != 0; };
            const bool half = part < first_edge_part;
            const bool child = part >= first_child_part;
            if (half ? contains(part / 2) : !child && !contains(part - first_edge_part)) {
                order.with_middles[set] |= bit;
            }
            if (!(half && contains(quadrant_of_wedge[part]))) { order.uncovered[set] |= bit; }
            if (child && contains(part - first_child_part)) { order.children[set] |= bit; }
        }
    }
    return order;
}

/// The order for an eye in a given wedge.
constexpr PartOrder order_for_wedge(unsigned eye, PaintOrder order) {
    std::array<std::uint8_t, fan_parts> parts{};
    std::size_t count = 0;
    for (unsigned turn = 0; turn < wedges; ++turn) {
        for (unsigned part = 0; part < fan_parts; ++part) {
            if (paint_rank(part, eye) == turn) { parts[count++] = static_cast<std::uint8_t>(part); }
        }
    }
    if (order == PaintOrder::FrontToBack) { std::reverse(parts.begin(), parts.end()); }
    return with_position_sets(parts);
}

constexpr std::array<PartOrder, wedges> orders_for_all_wedges(PaintOrder order) {
    std::array<PartOrder, wedges> orders;
    for (unsigned eye = 0; eye < wedges; ++eye) { orders[eye] = order_for_wedge(eye, order); }
    return orders;
}

/// The order by part number, in which places are parts.
constexpr PartOrder parts_by_number() {
    std::array<std::uint8_t, fan_parts> parts{};
    for (std::size_t part = 0; part < fan_parts; ++part) { parts[part] = static_cast<std::uint8_t>(part); }
    return with_position_sets(parts);
}

constexpr std::array<PartOrder, wedges> back_to_front = orders_for_all_wedges(PaintOrder::BackToFront);
constexpr std::array<PartOrder, wedges> front_to_back = orders_for_all_wedges(PaintOrder::FrontToBack);
constexpr PartOrder by_number = parts_by_number();

/// A part of a cut fan while it is being sorted.
struct CutPart {
    enum Side { Opposite, Left, Right, Eye };

    /// Its side of the line from the centre to the eye; wedges that contain the line have values of their own.
    Side side;
    glm::dvec2 inside; ///< A direction within the wedge.
    std::uint8_t part;
};

/// The wedge from `from` counter-clockwise to `to`, which are less than half a turn apart.
CutPart classify_cut_part(unsigned part, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& eye) {
    CutPart made{CutPart::Eye, from + to, static_cast<std::uint8_t>(part)};
    const double after_from = cross(from, eye);
    const double before_to = cross(eye, to);
    if (after_from >= 0.0 && before_to >= 0.0) {
        made.side = CutPart::Eye;
    } else if (after_from <= 0.0 && before_to <= 0.0) {
        made.side = CutPart::Opposite;
    } else {
        made.side = cross(eye, made.inside) > 0.0 ? CutPart::Left : CutPart::Right;
    }
    return made;
}

bool is_painted_before(const CutPart& a, const CutPart& b) {
    if (a.side != b.side) { return a.side < b.side; }
    const double turn = cross(b.inside, a.inside);
    return a.side == CutPart::Left ? turn > 0.0 : a.side == CutPart::Right && turn < 0.0;
}

} // namespace

const std::array<PartOrder, 8>& painting_orders(PaintOrder order) {
    return order == PaintOrder::BackToFront ? back_to_front : front_to_back;
}

unsigned parts_of(unsigned middles, unsigned covered, unsigned children) {
    return by_number.triangles(middles, covered) | by_number.children[children];
}

PartList parts_of_cut_fan(const FanSamples& samples, unsigned parts, const glm::dvec2& eye, PaintOrder order) {
    const GridSample centre = samples.at(1, 1);
    const auto direction_to = [&](const GridSample& sample) {
        return glm::dvec2(sample.column - centre.column, sample.row - centre.row);
    };
    std::array<CutPart, fan_parts> row;
    unsigned count = 0;
    for (unsigned part = 0; part < fan_parts; ++part) {
        const GridSample from = samples.ring(part_sides[part].from);
        const GridSample to = samples.ring(part_sides[part].to);
        if ((parts >> part & 1U) != 0 && has_area(centre, from, to)) {
            row[count++] = classify_cut_part(part, direction_to(from), direction_to(to), eye);
        }
    }
    // Insertion sort, because there are at most eight parts.
    for (unsigned k = 1; k < count; ++k) {
        for (unsigned j = k; j > 0 && is_painted_before(row[j], row[j - 1]); --j) { std::swap(row[j], row[j - 1]); }
    }
    PartList sorted;
    sorted.count = count;
    for (unsigned k = 0; k < count; ++k) {
        sorted.part[order == PaintOrder::BackToFront ? k : count - 1 - k] = row[k].part;
    }
    return sorted;
}

} // namespace octant::visuals::terrain
