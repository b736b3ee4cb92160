// The run-time side of the 1989 paper, section III.2: "only the sign of the eye vector in the object's frame is
// computed". Three sign tests are three planes of a tree; finer cells add planes to it, so that octants, cells and
// trees are looked up by the same loop.
#include "visuals/draworder/draw_order.h"

#include "sim/base/hash.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

/// The tree of the octants: first z, then y, then x, so that cell numbers are those of the octants.
std::vector<DrawOrder::Node> octant_nodes() {
    const Plane x{{1.0, 0.0, 0.0}, 0.0};
    const Plane y{{0.0, 1.0, 0.0}, 0.0};
    const Plane z{{0.0, 0.0, 1.0}, 0.0};
    return {{z, 1, 4}, {y, 2, 3}, {x, ~0, ~1}, {x, ~2, ~3}, {y, 5, 6}, {x, ~4, ~5}, {x, ~6, ~7}};
}

bool is_in_front(const DrawOrder::Node& node, const glm::dvec3& eye_m) { return distance_m(node.plane, eye_m) >= 0.0; }

} // namespace

DrawOrder::DrawOrder(const OctantOrders& orders) : DrawOrder(octant_nodes(), orders.lists) {}

DrawOrder::DrawOrder(std::vector<std::uint32_t> list)
    : polygons_(std::move(list)), cells_{{0, polygons_.size()}}, list_count_(1) {}

DrawOrder::DrawOrder(std::vector<Node> nodes, std::span<const std::vector<std::uint32_t>> lists)
    : nodes_(std::move(nodes)) {
    assert(!nodes_.empty() || lists.size() == 1);
    add_cells(lists);
    has_one_cell_per_eye_ = std::ranges::all_of(nodes_, [](const Node& node) { return node.kind == Kind::ViewSplit; });
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        for ([[maybe_unused]] const int child : {nodes_[i].front, nodes_[i].back}) {
            assert(child == no_child || child > static_cast<int>(i) || child < 0);
            assert(child == no_child || child >= 0 || ~child < cell_count());
        }
    }
}

void DrawOrder::add_cells(std::span<const std::vector<std::uint32_t>> lists) {
    std::unordered_multimap<std::uint64_t, Range> known;
    for (const std::vector<std::uint32_t>& list : lists) {
        Hash hash;
        hash.add(std::as_bytes(std::span(list)));
        const auto [begin, end] = known.equal_range(hash.value());
        const auto same = std::find_if(begin, end, [&](const auto& entry) {
            return std::ranges::equal(std::span(polygons_).subspan(entry.second.first, entry.second.count), list);
        });
        if (same != end) {
            cells_.push_back(same->second);
            continue;
        }
        cells_.push_back({polygons_.size(), list.size()});
        polygons_.insert(polygons_.end(), list.begin(), list.end());
        known.emplace(hash.value(), cells_.back());
        ++list_count_;
    }
}

int DrawOrder::cell_of(const glm::dvec3& eye_in_body_m) const {
    assert(has_one_cell_per_eye_);
    int at = nodes_.empty() ? ~0 : 0;
    while (at >= 0) {
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        at = is_in_front(node, eye_in_body_m) ? node.front : node.back;
    }
    return ~at;
}

std::span<const DrawOrder::Range> DrawOrder::ranges_of(const glm::dvec3& eye_in_body_m, Walk& walk) const {
    walk.ranges.clear();
    walk.pending.assign(1, nodes_.empty() ? ~0 : 0);
    const auto paint = [&](const Range& range) {
        if (range.count == 0) { return; }
        if (!walk.ranges.empty() && walk.ranges.back().first + walk.ranges.back().count == range.first) {
            walk.ranges.back().count += range.count;
            return;
        }
        walk.ranges.push_back(range);
    };
    while (!walk.pending.empty()) {
        const int at = walk.pending.back();
        walk.pending.pop_back();
        if (at == no_child) { continue; }
        if (at < 0) {
            paint(cells_[static_cast<std::size_t>(~at)]);
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (node.kind == Kind::Sequence) {
            walk.pending.insert(walk.pending.end(), {node.back, node.front});
            continue;
        }
        const bool in_front = is_in_front(node, eye_in_body_m);
        walk.pending.push_back(in_front ? node.front : node.back);
        if (node.kind == Kind::PolygonSplit) {
            walk.pending.push_back(in_front ? node.coplanar_front : node.coplanar_back);
            walk.pending.push_back(in_front ? node.back : node.front);
        }
    }
    return walk.ranges;
}

void DrawOrder::append_painted(const glm::dvec3& eye_in_body_m, Walk& walk, std::vector<std::uint32_t>& painted) const {
    for (const Range& range : ranges_of(eye_in_body_m, walk)) {
        const auto list = polygons().subspan(range.first, range.count);
        painted.insert(painted.end(), list.begin(), list.end());
    }
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
