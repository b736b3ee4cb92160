#include "visuals/verify/wall_counts.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <limits>

namespace octant::visuals::verify {

namespace {

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

void expect_some(const Certificate& certificate, bool some, const char* what) {
    if (!some) {
        error_in(certificate.path, fmt::format("expected {}, got none", what));
    }
}

class Counting {
public:
    explicit Counting(const Certificate& certificate)
        : certificate_(certificate)
        , counts_{
              std::vector<std::size_t>(certificate.nodes.size(), unseen),
              std::vector<std::size_t>(certificate.lists.size(), unseen)} {}

    WallCounts count() {
        (counts_.of_nodes.empty() ? counts_.of_lists : counts_.of_nodes).front() = 0;
        for (std::size_t i = 0; i < certificate_.nodes.size(); ++i) {
            const Node& node = certificate_.nodes[i];
            expect_reached(counts_.of_nodes[i], "node", i, node.line);
            const std::size_t more = node.kind == Node::Kind::Choice ? 1 : 0;
            for (const int child : {node.front, node.back, node.along, node.against}) {
                reach(child, counts_.of_nodes[i] + more, node.line);
            }
        }
        for (std::size_t i = 0; i < certificate_.lists.size(); ++i) {
            expect_reached(counts_.of_lists[i], "list", i, certificate_.lists[i].line);
        }
        return counts_;
    }

private:
    void expect_reached(std::size_t walls, const char* what, std::size_t number, int line) const {
        if (walls == unseen) {
            error_at(
                certificate_.path,
                line,
                fmt::format(
                    "expected {} {} to be the child of an earlier node, got none", what, number));
        }
    }

    void reach(int child, std::size_t walls, int line) {
        if (Node::is_empty(child)) {
            return;
        }
        auto& all = child < 0 ? counts_.of_lists : counts_.of_nodes;
        const auto number = static_cast<std::size_t>(child < 0 ? ~child : child);
        if (number >= all.size() || all[number] != unseen) {
            error_at(
                certificate_.path,
                line,
                fmt::format(
                    "expected children that are there, each of one node, got {} {}",
                    child < 0 ? "list" : "node",
                    number));
        }
        all[number] = walls;
    }

    const Certificate& certificate_;
    WallCounts counts_;
};

} // namespace

WallCounts count_walls(const Certificate& certificate) {
    expect_some(certificate, certificate.tolerance > 0.0, "a tolerance");
    expect_some(certificate, !certificate.polygons.empty(), "at least one polygon");
    expect_some(certificate, !certificate.lists.empty(), "at least one list");
    return Counting(certificate).count();
}

} // namespace octant::visuals::verify
