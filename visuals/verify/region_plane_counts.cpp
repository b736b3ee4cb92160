#include "visuals/verify/region_plane_counts.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <limits>

namespace octant::visuals::verify {

namespace {

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

void require_some(const Certificate& certificate, bool some, const char* what) {
    if (!some) {
        throw_error_in(certificate.path, fmt::format("expected {}, got none", what));
    }
}

class RegionPlaneCounter {
public:
    explicit RegionPlaneCounter(const Certificate& certificate)
        : certificate_(certificate)
        , counts_{
              std::vector<std::size_t>(certificate.nodes.size(), unseen),
              std::vector<std::size_t>(certificate.lists.size(), unseen)} {}

    RegionPlaneCounts count() {
        (counts_.by_node.empty() ? counts_.by_list : counts_.by_node).front() = 0;
        for (std::size_t i = 0; i < certificate_.nodes.size(); ++i) {
            const OrderNode& node = certificate_.nodes[i];
            require_reached(counts_.by_node[i], "node", i, node.line);
            const std::size_t more = node.kind == OrderNode::Kind::ViewSplit ? 1 : 0;
            for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) {
                reach(child, counts_.by_node[i] + more, node.line);
            }
        }
        for (std::size_t i = 0; i < certificate_.lists.size(); ++i) {
            require_reached(counts_.by_list[i], "list", i, certificate_.lists[i].line);
        }
        return counts_;
    }

private:
    void require_reached(std::size_t region_planes, const char* what, std::size_t number, int line) const {
        if (region_planes == unseen) {
            throw_error_at(
                certificate_.path,
                line,
                fmt::format(
                    "expected {} {} to be the child of an earlier node, got none", what, number));
        }
    }

    void reach(int child, std::size_t region_planes, int line) {
        if (OrderNode::is_empty(child)) {
            return;
        }
        auto& all = child < 0 ? counts_.by_list : counts_.by_node;
        const auto number = static_cast<std::size_t>(child < 0 ? ~child : child);
        if (number >= all.size() || all[number] != unseen) {
            throw_error_at(
                certificate_.path,
                line,
                fmt::format(
                    "expected children that are there, each of one node, got {} {}",
                    child < 0 ? "list" : "node",
                    number));
        }
        all[number] = region_planes;
    }

    const Certificate& certificate_;
    RegionPlaneCounts counts_;
};

} // namespace

RegionPlaneCounts count_region_planes(const Certificate& certificate) {
    require_some(certificate, certificate.tolerance > 0.0, "a tolerance");
    require_some(certificate, !certificate.polygons.empty(), "at least one polygon");
    require_some(certificate, !certificate.lists.empty(), "at least one list");
    return RegionPlaneCounter(certificate).count();
}

} // namespace octant::visuals::verify
