#include "visuals/draworder/draw_order.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace octant::visuals::draworder {

DrawOrder::DrawOrder(const OctantOrders& orders) {
    for (const auto& list : orders.lists) {
        add_cell(list);
    }
}

DrawOrder::DrawOrder(std::vector<std::uint32_t> list)
    : polygons_(std::move(list))
    , cells_{{0, polygons_.size()}} {}

void DrawOrder::add_cell(std::span<const std::uint32_t> list) {
    for (const Range& known : cells_) {
        if (std::ranges::equal(std::span(polygons_).subspan(known.first, known.count), list)) {
            cells_.push_back(Range(known));
            return;
        }
    }
    cells_.push_back({polygons_.size(), list.size()});
    polygons_.insert(polygons_.end(), list.begin(), list.end());
}

int DrawOrder::cell_of(const glm::dvec3& eye_in_body_m) const {
    return cell_count() == 1 ? 0 : octant_of(eye_in_body_m);
}

DrawOrder::Range DrawOrder::range_of(int cell) const {
    assert(cell >= 0 && cell < cell_count());
    return cells_[static_cast<std::size_t>(cell)];
}

std::span<const std::uint32_t> DrawOrder::polygons_of(int cell) const {
    const Range range = range_of(cell);
    return polygons().subspan(range.first, range.count);
}

DrawOrder file_order(const models::PolygonModel& model) {
    std::vector<std::uint32_t> list(model.polygons.size());
    std::iota(list.begin(), list.end(), 0U);
    return DrawOrder(std::move(list));
}

} // namespace octant::visuals::draworder
