// Nobody has to trust the walk: visuals/verify checks the certificate written from it and shares no code with it.
#include "visuals/draworder/proof_walk.h"

#include "visuals/draworder/occlusion_graph.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using separation::DecidingPolygon;
using separation::LocalModel;
using separation::LocalPolygon;
using separation::SeparatingPlaneProof;
using Polygons = std::vector<std::uint32_t>;

/// One walk.
class ProofWalker {
public:
    ProofWalker(const ProofInput& input, ProofVisitor& visitor)
        : model_(input.model), order_(input.order), axes_(input.axes), local_(input.local),
          mark_(input.model.polygons.size(), 0), sink_(visitor) {}

    void walk() {
        Polygons all;
        for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) { all.push_back(i); }
        to_do_.push_back({order_.nodes().empty() ? ~0 : 0, {}, std::move(all), false});
        while (!to_do_.empty()) {
            const Task task = std::move(to_do_.back());
            to_do_.pop_back();
            look_at(task);
        }
    }

private:
    /// A part of the tree, the region planes of its eyes, and the polygons that must be painted there if they face such
    /// an eye.
    struct Task {
        int child = 0;
        std::vector<Plane> region_planes; ///< In the unit of local_.
        Polygons expected;
        bool in_plane = false;
    };

    /// A child of a view split, or the first view split: statements about all eyes in front of its region planes are
    /// reported for this child.
    struct Level {
        int child = 0;
        std::size_t region_plane_count = 0;
        std::vector<BitSet> proved; ///< By the later polygon: the earlier ones of the pairs that are proved.
    };

    void look_at(const Task& task) {
        task.child < 0 ? check_list(task) : check_node(task);
        sink_.end_part(task.expected.size());
    }

    void check_list(const Task& task) {
        const auto list = order_.polygons_of(~task.child);
        find_missing_polygons(task, {list.begin(), list.end()});
        if (task.in_plane) { return; }
        if (!levels_.empty()) {
            check_unproved_pairs(task, list);
            return;
        }
        for (std::size_t later = 1; later < list.size(); ++later) {
            const Polygons unproved_pairs = check_row(task.child, list.first(later), list[later]);
            for (const std::uint32_t earlier : unproved_pairs) {
                find_proof(task.child, task.region_planes, earlier, list[later]);
            }
        }
    }

    /// Reports the pairs of a list below view splits that no plane of a polygon and no region plane decides.
    void check_unproved_pairs(const Task& task, std::span<const std::uint32_t> list) {
        BitSet painted(model_.polygons.size());
        for (const std::uint32_t later : list) {
            BitSet unproved = painted;
            unproved.remove(levels_.back().proved[later]);
            for_each_bit(unproved.words(),
                [&](std::size_t earlier) { find_proof_for_eyes(task, static_cast<std::uint32_t>(earlier), later); });
            painted.add(later);
        }
    }

    /// Reports a proof at the level where it serves the most eyes.
    void find_proof_for_eyes(const Task& task, std::uint32_t earlier, std::uint32_t later) {
        SeparatingPlaneProof plane_proof = find_separating_plane(local_, task.region_planes, earlier, later);
        auto& region_planes = plane_proof.factors.region_planes;
        std::size_t level = levels_.size() - 1;
        if (plane_proof.kind != SeparatingPlaneProof::Kind::None) {
            while (level > 0 && region_planes[levels_[level].region_plane_count - 1] == 0.0) { --level; }
            region_planes.resize(levels_[level].region_plane_count);
        }
        sink_.add_plane_proof(levels_[level].child, plane_proof, earlier, later);
        for (; level < levels_.size(); ++level) { levels_[level].proved[later].add(earlier); }
    }

    void check_node(const Task& task) {
        const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(task.child)];
        if (node.kind == DrawOrder::Kind::ViewSplit) {
            check_view_split(task, node);
            return;
        }
        const std::array<int, 4> children{node.front, node.back, node.coplanar_front, node.coplanar_back};
        std::array<Polygons, 4> parts;
        Polygons all;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = contents(children[i]);
            all.insert(all.end(), parts[i].begin(), parts[i].end());
        }
        find_missing_polygons(task, all);
        if (node.kind == DrawOrder::Kind::PolygonSplit) { find_unproved_pairs(task.child, parts, wall_of(node)); }
        for (const std::uint32_t later : parts[1]) {
            if (node.kind == DrawOrder::Kind::Sequence && !parts[0].empty()) {
                for (const std::uint32_t earlier : check_row(task.child, parts[0], later)) {
                    find_proof(task.child, task.region_planes, earlier, later);
                }
            }
        }
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (children[i] != DrawOrder::no_child) {
                to_do_.push_back({children[i], task.region_planes, std::move(parts[i]), i >= 2});
            }
        }
    }

    /// The plane of a node, in the unit of local_.
    Plane wall_of(const DrawOrder::Node& node) const {
        return local_.from_file({axes_.file_from_body(node.plane.normal), node.plane.offset_m});
    }

    /// Statements that hold for all eyes are reported at the first view split of a path, for all lists below it.
    void check_view_split(const Task& task, const DrawOrder::Node& node) {
        const bool is_first = levels_.empty();
        if (is_first) {
            const BitSet none(model_.polygons.size());
            levels_.push_back({task.child, task.region_planes.size(), {model_.polygons.size(), none}});
            const Polygons below = contents(task.child);
            for (const std::uint32_t later : below) { check_row(task.child, below, later); }
        }
        const Plane wall = wall_of(node);
        const Task seen = without_hidden(task);
        check_side(seen, node.front, wall);
        check_side(seen, node.back, {-wall.normal, -wall.offset_m});
        if (is_first) { levels_.pop_back(); }
    }

    /// A task without the polygons that nothing below it paints and that face away from all of its eyes, which is
    /// reported: it serves all lists below.
    Task without_hidden(const Task& task) {
        Task seen{task.child, task.region_planes, {}, task.in_plane};
        const Polygons painted = contents(task.child); // ascending
        for (const std::uint32_t polygon : task.expected) {
            const bool is_painted = std::ranges::binary_search(painted, polygon);
            const auto factors =
                is_painted ? std::nullopt : find_back_facing_proof(local_, task.region_planes, polygon);
            if (factors) {
                sink_.add_back_facing(task.child, polygon, *factors);
            } else {
                seen.expected.push_back(polygon);
            }
        }
        return seen;
    }

    void check_side(const Task& task, int child, const Plane& wall) {
        if (child == DrawOrder::no_child) {
            return; // nothing is painted for these eyes, and nothing is stated for them
        }
        Task side{child, task.region_planes, task.expected, false};
        side.region_planes.push_back(wall);
        Level level{child, side.region_planes.size(), levels_.back().proved};
        BitSet behind(model_.polygons.size());
        Polygons before;
        for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
            if (is_behind(local_, i, wall, true)) { behind.add(i); }
            if (is_before(local_, i, wall, true)) { before.push_back(i); }
        }
        for (const std::uint32_t later : before) {
            if (!local_.polygons[later].axis) {
                level.proved[later].add(behind);
                continue;
            }
            for (std::uint32_t earlier = 0; earlier < model_.polygons.size(); ++earlier) {
                // Polygons that turn together see the plane turn.
                if (behind.has(earlier) && local_.polygons[earlier].axis != local_.polygons[later].axis) {
                    level.proved[later].add(earlier);
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
        std::vector<int> pending{child};
        while (!pending.empty()) {
            const int next = pending.back();
            pending.pop_back();
            if (next == DrawOrder::no_child) { continue; }
            if (next < 0) {
                const auto list = order_.polygons_of(~next);
                found.insert(found.end(), list.begin(), list.end());
                continue;
            }
            const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(next)];
            pending.insert(pending.end(), {node.front, node.back, node.coplanar_front, node.coplanar_back});
        }
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    /// Reports why expected polygons need not be painted.
    void find_missing_polygons(const Task& task, const Polygons& painted) {
        for (const std::uint32_t polygon : painted) { mark_[polygon] = 1; }
        for (const std::uint32_t polygon : task.expected) {
            if (mark_[polygon] != 0) { continue; }
            if (const auto factors = find_back_facing_proof(local_, task.region_planes, polygon)) {
                sink_.add_back_facing(task.child, polygon, *factors);
            } else {
                sink_.add_unproved(task.child, polygon);
            }
        }
        for (const std::uint32_t polygon : painted) { mark_[polygon] = 0; }
    }

    /// Reports which pairs the plane of one polygon decides; returns the earlier polygons of the others.
    Polygons check_row(int child, std::span<const std::uint32_t> earlier, std::uint32_t later) {
        sink_.begin_pairs(child, later, earlier.size());
        Polygons unproved_pairs;
        DecidingPolygon last = DecidingPolygon::Neither;
        for (const std::uint32_t polygon : earlier) {
            const DecidingPolygon by =
                polygon == later ? DecidingPolygon::Neither : deciding_polygon(local_, polygon, later, last);
            if (by == DecidingPolygon::Neither) {
                unproved_pairs.push_back(polygon);
            } else if (!levels_.empty()) {
                levels_.back().proved[later].add(polygon);
            }
            sink_.add_pair(by);
            last = by;
        }
        sink_.end_pairs();
        return unproved_pairs;
    }

    void find_proof(int child, std::span<const Plane> region_planes, std::uint32_t earlier, std::uint32_t later) {
        sink_.add_plane_proof(child, find_separating_plane(local_, region_planes, earlier, later), earlier, later);
    }

    /// Reports the polygons that are not on the side where a polygon split needs them.
    void find_unproved_pairs(int child, const std::array<Polygons, 4>& parts, const Plane& plane) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            for (const std::uint32_t polygon : parts[i]) {
                const bool before = is_before(local_, polygon, plane, true);
                const bool behind = is_behind(local_, polygon, plane, true);
                const bool good = i == 0   ? before
                                  : i == 1 ? behind
                                           : before && behind && faces(parts, i, polygon, plane);
                if (!good) { sink_.add_unproved(child, polygon); }
            }
        }
    }

    /// Whether a polygon in the plane of a polygon split is seen from the side for which it is painted.
    bool faces(
        const std::array<Polygons, 4>& parts, std::size_t part, std::uint32_t polygon, const Plane& plane) const {
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
    std::vector<Level> levels_; ///< Of the view splits above the current part.
    ProofVisitor& sink_;
};

} // namespace

void visit_proof(const ProofInput& input, ProofVisitor& visitor) { ProofWalker(input, visitor).walk(); }

} // namespace octant::visuals::draworder
