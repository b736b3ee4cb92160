// The walk need not be trusted: visuals/verify checks what is written of it, with none of its code.
#include "visuals/draworder/proof_walk.h"

#include "visuals/separation/pair_bits.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using separation::Decider;
using separation::LocalModel;
using separation::LocalPolygon;
using separation::PairBits;
using separation::PolygonBits;
using separation::Witness;
using Polygons = std::vector<std::uint32_t>;

/// One walk.
class Walking {
public:
    Walking(const OrderToProve& asked, ProofSink& sink)
        : model_(asked.model)
        , order_(asked.order)
        , axes_(asked.axes)
        , local_(asked.local)
        , mark_(asked.model.polygons.size(), 0)
        , sink_(sink) {}

    void walk() {
        Polygons all;
        for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
            all.push_back(i);
        }
        to_do_.push_back({order_.nodes().empty() ? ~0 : 0, {}, std::move(all), false});
        while (!to_do_.empty()) {
            const Task task = std::move(to_do_.back());
            to_do_.pop_back();
            look_at(task);
        }
    }

private:
    /// A part of the tree, the walls of its eyes, and the polygons that have to be painted there if
    /// they face such an eye.
    struct Task {
        int child = 0;
        std::vector<Plane> walls; ///< In the unit of local_.
        Polygons expected;
        bool in_plane = false;
    };

    /// A child of a choice, or the first choice: a place for claims about the eyes before its walls
    /// and all that is known for them.
    struct Level {
        int child = 0;
        std::size_t walls = 0;
        PairBits known;
    };

    void look_at(const Task& task) {
        task.child < 0 ? look_at_list(task) : look_at_node(task);
        sink_.end_part(task.expected.size());
    }

    void look_at_list(const Task& task) {
        const auto list = order_.polygons_of(~task.child);
        look_for_missing(task, {list.begin(), list.end()});
        if (task.in_plane) {
            return;
        }
        if (!levels_.empty()) {
            look_at_open_pairs(task, list);
            return;
        }
        for (std::size_t later = 1; later < list.size(); ++later) {
            const Polygons open = look_at_row(task.child, list.first(later), list[later]);
            for (const std::uint32_t earlier : open) {
                seek_witness(task.child, task.walls, earlier, list[later]);
            }
        }
    }

    /// Of a list below choices the pairs that no plane of a polygon and no wall decides.
    void look_at_open_pairs(const Task& task, std::span<const std::uint32_t> list) {
        PolygonBits painted = levels_.back().known.none();
        for (const std::uint32_t later : list) {
            Polygons open;
            levels_.back().known.for_each_open(
                painted, later, [&](std::uint32_t earlier) { open.push_back(earlier); });
            for (const std::uint32_t earlier : open) {
                seek_for_eyes(task, earlier, later);
            }
            separation::add(painted, later);
        }
    }

    /// Tells of a witness where it serves the most eyes.
    void seek_for_eyes(const Task& task, std::uint32_t earlier, std::uint32_t later) {
        Witness witness = witness_of(local_, task.walls, earlier, later);
        auto& walls = witness.factors.walls;
        std::size_t level = levels_.size() - 1;
        if (witness.kind != Witness::Kind::None) {
            while (level > 0 && walls[levels_[level].walls - 1] == 0.0) {
                --level;
            }
            walls.resize(levels_[level].walls);
        }
        sink_.add_witness(levels_[level].child, witness, earlier, later);
        for (; level < levels_.size(); ++level) {
            levels_[level].known.add(earlier, later);
        }
    }

    void look_at_node(const Task& task) {
        const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(task.child)];
        if (node.kind == DrawOrder::Kind::Choice) {
            look_at_choice(task, node);
            return;
        }
        const std::array<int, 4> children{node.front, node.back, node.along, node.against};
        std::array<Polygons, 4> parts;
        Polygons all;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = contents(children[i]);
            all.insert(all.end(), parts[i].begin(), parts[i].end());
        }
        look_for_missing(task, all);
        if (node.kind == DrawOrder::Kind::Parting) {
            look_for_doubts(task.child, parts, wall_of(node));
        }
        for (const std::uint32_t later : parts[1]) {
            if (node.kind == DrawOrder::Kind::Sequence && !parts[0].empty()) {
                for (const std::uint32_t earlier : look_at_row(task.child, parts[0], later)) {
                    seek_witness(task.child, task.walls, earlier, later);
                }
            }
        }
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (children[i] != DrawOrder::nothing) {
                to_do_.push_back({children[i], task.walls, std::move(parts[i]), i >= 2});
            }
        }
    }

    /// The plane of a node, in the unit of local_.
    Plane wall_of(const DrawOrder::Node& node) const {
        return local_.from_file({axes_.file_from_body(node.plane.normal), node.plane.offset_m});
    }

    /// What holds for all eyes is told at the first choice of a path, for all lists below it.
    void look_at_choice(const Task& task, const DrawOrder::Node& node) {
        const bool is_first = levels_.empty();
        if (is_first) {
            levels_.push_back({task.child, task.walls.size(), PairBits(model_.polygons.size())});
            const Polygons below = contents(task.child);
            for (const std::uint32_t later : below) {
                look_at_row(task.child, below, later);
            }
        }
        const Plane wall = wall_of(node);
        look_at_side(task, node.front, wall);
        look_at_side(task, node.back, {-wall.normal, -wall.offset_m});
        if (is_first) {
            levels_.pop_back();
        }
    }

    void look_at_side(const Task& task, int child, const Plane& wall) {
        if (child == DrawOrder::nothing) {
            return; // nothing is painted for these eyes, and nothing is claimed for them
        }
        Task side{child, task.walls, task.expected, false};
        side.walls.push_back(wall);
        Level level{child, side.walls.size(), levels_.back().known};
        PolygonBits behind = level.known.none();
        Polygons before;
        for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
            if (is_behind(local_, i, wall, true)) {
                separation::add(behind, i);
            }
            if (is_before(local_, i, wall, true)) {
                before.push_back(i);
            }
        }
        for (const std::uint32_t later : before) {
            if (!local_.polygons[later].axis) {
                level.known.add(behind, later);
                continue;
            }
            for (std::uint32_t earlier = 0; earlier < model_.polygons.size(); ++earlier) {
                // Polygons that turn together see the wall turn.
                if (separation::has(behind, earlier) &&
                    local_.polygons[earlier].axis != local_.polygons[later].axis) {
                    level.known.add(earlier, later);
                }
            }
        }
        levels_.push_back(std::move(level));
        look_at(side);
        levels_.pop_back();
    }

    /// The polygons that are painted below a child, ascending.
    Polygons contents(int child) const {
        Polygons found;
        std::vector<int> to_do{child};
        while (!to_do.empty()) {
            const int next = to_do.back();
            to_do.pop_back();
            if (next == DrawOrder::nothing) {
                continue;
            }
            if (next < 0) {
                const auto list = order_.polygons_of(~next);
                found.insert(found.end(), list.begin(), list.end());
                continue;
            }
            const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(next)];
            to_do.insert(to_do.end(), {node.front, node.back, node.along, node.against});
        }
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    /// Tells why polygons that are expected need not be painted.
    void look_for_missing(const Task& task, const Polygons& painted) {
        for (const std::uint32_t polygon : painted) {
            mark_[polygon] = 1;
        }
        for (const std::uint32_t polygon : task.expected) {
            if (mark_[polygon] != 0) {
                continue;
            }
            if (const auto factors = factors_away(local_, task.walls, polygon)) {
                sink_.add_away(task.child, polygon, *factors);
            } else {
                sink_.add_doubt(task.child, polygon);
            }
        }
        for (const std::uint32_t polygon : painted) {
            mark_[polygon] = 0;
        }
    }

    /// Tells which pairs the plane of one polygon decides; returns the earlier polygons of the
    /// others.
    Polygons look_at_row(int child, std::span<const std::uint32_t> earlier, std::uint32_t later) {
        sink_.begin_pairs(child, later, earlier.size());
        Polygons open;
        Decider last = Decider::Neither;
        for (const std::uint32_t polygon : earlier) {
            const Decider by =
                polygon == later ? Decider::Neither : decider(local_, polygon, later, last);
            if (by == Decider::Neither) {
                open.push_back(polygon);
            } else if (!levels_.empty()) {
                levels_.back().known.add(polygon, later);
            }
            sink_.add_pair(by);
            last = by;
        }
        sink_.end_pairs();
        return open;
    }

    void seek_witness(
        int child, std::span<const Plane> walls, std::uint32_t earlier, std::uint32_t later) {
        sink_.add_witness(child, witness_of(local_, walls, earlier, later), earlier, later);
    }

    /// Tells which polygons are not where a parting needs them.
    void look_for_doubts(int child, const std::array<Polygons, 4>& parts, const Plane& plane) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            for (const std::uint32_t polygon : parts[i]) {
                const bool before = is_before(local_, polygon, plane, true);
                const bool behind = is_behind(local_, polygon, plane, true);
                const bool good = i == 0   ? before
                                  : i == 1 ? behind
                                           : before && behind && faces(parts, i, polygon, plane);
                if (!good) {
                    sink_.add_doubt(child, polygon);
                }
            }
        }
    }

    /// Whether a polygon in the plane of a parting is seen from the side it is painted for.
    bool faces(
        const std::array<Polygons, 4>& parts,
        std::size_t part,
        std::uint32_t polygon,
        const Plane& plane) const {
        const LocalPolygon& local = local_.polygons[polygon];
        const double facing = glm::dot(local.plane.normal, plane.normal);
        return std::ranges::binary_search(parts[part == 2 ? 3 : 2], polygon) ||
               (local.keeps_plane && (part == 2 ? facing > 0.0 : facing < 0.0));
    }

    const models::polygons::PolygonModel& model_;
    const DrawOrder& order_;
    const models::polygons::FileAxes& axes_;
    const LocalModel& local_;
    std::vector<char> mark_; ///< One for each polygon; all are 0 between uses.
    std::vector<Task> to_do_;
    std::vector<Level> levels_; ///< Of the choices above the part at hand.
    ProofSink& sink_;
};

} // namespace

void walk_proof(const OrderToProve& asked, ProofSink& sink) {
    Walking(asked, sink).walk();
}

} // namespace octant::visuals::draworder
