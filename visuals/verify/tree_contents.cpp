#include "visuals/verify/tree_contents.h"

#include <algorithm>

namespace octant::visuals::verify {

TreeContents::TreeContents(const Certificate& certificate)
    : by_node_(certificate.nodes.size()), by_list_(certificate.lists.size()) {
    /// A node or list, and whether all below it has been gone through.
    struct Visit {
        int child = 0;
        bool leaves = false;
    };

    std::vector<Visit> to_do{{certificate.nodes.empty() ? ~0 : 0, false}};
    while (!to_do.empty()) {
        const Visit visit = to_do.back();
        to_do.pop_back();
        if (OrderNode::is_empty(visit.child)) { continue; }
        if (visit.child < 0) {
            const auto list = static_cast<std::size_t>(~visit.child);
            const auto& polygons = certificate.lists[list].polygons;
            by_list_[list].first = entries_.size();
            entries_.insert(entries_.end(), polygons.begin(), polygons.end());
            by_list_[list].end = entries_.size();
            continue;
        }
        const auto number = static_cast<std::size_t>(visit.child);
        if (visit.leaves) {
            by_node_[number].end = entries_.size();
            continue;
        }
        by_node_[number].first = entries_.size();
        const OrderNode& node = certificate.nodes[number];
        to_do.push_back({visit.child, true});
        for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) {
            to_do.push_back({child, false});
        }
    }
}

std::vector<std::uint32_t> TreeContents::of(int child) const {
    if (OrderNode::is_empty(child)) { return {}; }
    const Range range =
        child < 0 ? by_list_[static_cast<std::size_t>(~child)] : by_node_[static_cast<std::size_t>(child)];
    std::vector<std::uint32_t> polygons(entries_.begin() + static_cast<std::ptrdiff_t>(range.first),
        entries_.begin() + static_cast<std::ptrdiff_t>(range.end));
    std::ranges::sort(polygons);
    polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
    return polygons;
}

} // namespace octant::visuals::verify
