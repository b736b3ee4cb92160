// The run-time side of the 1989 paper, section III.2: "only the sign of the eye vector in the
// object's frame is computed". Three sign tests are three planes of a tree; finer cells add planes
// to it, so that octants, cells and trees are looked up by the same loop.
#include "visuals/draworder/draw_order.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// The tree of the octants: first z, then y, then x, so that cell numbers are those of the octants.
std::vector<DrawOrder::Node> octant_nodes() {
    const Plane x{{1.0, 0.0, 0.0}, 0.0};
    const Plane y{{0.0, 1.0, 0.0}, 0.0};
    const Plane z{{0.0, 0.0, 1.0}, 0.0};
    return {{z, 1, 4}, {y, 2, 3}, {x, ~0, ~1}, {x, ~2, ~3}, {y, 5, 6}, {x, ~4, ~5}, {x, ~6, ~7}};
}

} // namespace

DrawOrder::DrawOrder(const OctantOrders& orders)
    : DrawOrder(octant_nodes(), orders.lists) {}

DrawOrder::DrawOrder(std::vector<std::uint32_t> list)
    : polygons_(std::move(list))
    , cells_{{0, polygons_.size()}}
    , list_count_(1) {}

DrawOrder::DrawOrder(std::vector<Node> nodes, std::span<const std::vector<std::uint32_t>> lists)
    : nodes_(std::move(nodes)) {
    assert(nodes_.empty() ? lists.size() == 1 : lists.size() >= 2);
    for (const auto& list : lists) {
        add_cell(list);
    }
}

void DrawOrder::add_cell(std::span<const std::uint32_t> list) {
    for (const Range& known : cells_) {
        if (std::ranges::equal(std::span(polygons_).subspan(known.first, known.count), list)) {
            cells_.push_back(Range(known));
            return;
        }
    }
    cells_.push_back({polygons_.size(), list.size()});
    polygons_.insert(polygons_.end(), list.begin(), list.end());
    ++list_count_;
}

int DrawOrder::cell_of(const glm::dvec3& eye_in_body_m) const {
    int at = nodes_.empty() ? ~0 : 0;
    while (at >= 0) {
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        at = distance_m(node.plane, eye_in_body_m) >= 0.0 ? node.front : node.back;
    }
    return ~at;
}

DrawOrder::Range DrawOrder::range_of(int cell) const {
    assert(cell >= 0 && cell < cell_count());
    return cells_[static_cast<std::size_t>(cell)];
}

std::span<const std::uint32_t> DrawOrder::polygons_of(int cell) const {
    const Range range = range_of(cell);
    return polygons().subspan(range.first, range.count);
}

DrawOrder file_order(const models::polygons::PolygonModel& model) {
    std::vector<std::uint32_t> list(model.polygons.size());
    std::iota(list.begin(), list.end(), 0U);
    return DrawOrder(std::move(list));
}

} // namespace octant::visuals::draworder
