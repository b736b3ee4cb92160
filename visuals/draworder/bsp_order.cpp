// Polygons are split by planes: a BSP tree whose leaves are lists (visuals/bsp), for a whole model or for cells of eye
// space whose polygons hide one another in cycles.
#include "visuals/draworder/bsp_order.h"

#include "sim/base/bit_set.h"
#include "visuals/bsp/partial_bsp_tree.h"
#include "visuals/bsp/polygon_pieces.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/split.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;
using Polygons = std::vector<std::uint32_t>;

/// A model of one turning part alone; `polygons` are its polygons.
PolygonModel alone(const PolygonModel& model, const Polygons& polygons, std::uint32_t pivot) {
    PolygonModel part;
    part.name = model.name;
    part.vertices_m = model.vertices_m;
    part.materials = model.materials;
    part.parts = model.parts;
    part.pivots = {model.pivots[pivot]};
    for (const std::uint32_t polygon : polygons) {
        part.polygons.push_back(model.polygons[polygon]);
        part.polygons.back().first_corner = static_cast<std::uint32_t>(part.corner_vertices.size());
        const auto corners = model.corners(polygon);
        part.corner_vertices.insert(part.corner_vertices.end(), corners.begin(), corners.end());
    }
    return part;
}

/// Builds one order: order() or completed() is called once.
class BspOrderBuilder {
public:
    explicit BspOrderBuilder(PolygonModel model) : model_(std::move(model)), pieces_(model_) {}

    BspOrder order() {
        find_turning_parts();
        tree_ = bsp::partial_bsp_tree(pieces_, items());
        for (const Polygons& cycle : tree_.unsplit_cycles) { add_note(cycle); }
        const auto splits = static_cast<int>(pieces_.added());
        pieces_.write_to(model_);
        if (tree_.root >= 0) {
            write_nodes();
        } else {
            lists_.push_back(tree_.root == bsp::PartialBspTree::no_child
                                 ? Polygons{}
                                 : tree_.lists[static_cast<std::size_t>(~tree_.root)]);
        }
        return {std::move(model_), DrawOrder(std::move(nodes_), lists_), splits, std::move(notes_)};
    }

    BspOrder completed(const IncompleteOrder& incomplete) {
        find_turning_parts();
        nodes_ = incomplete.nodes;
        lists_ = incomplete.lists;
        made_at_.assign(lists_.size(), model_.polygons.size());
        for (std::uint32_t i = 0; i < pieces_.count(); ++i) {
            if (!pieces_[i].pivot) { pieces_.set_plane(i, incomplete.planes[pieces_[i].source]); }
        }
        std::vector<int> instead(lists_.size());
        for (std::size_t cell = 0; cell < instead.size(); ++cell) {
            instead[cell] = incomplete.incomplete_cells[cell].empty() ? ~static_cast<int>(cell)
                                                                      : sequence_of(incomplete.incomplete_cells[cell]);
        }
        for (std::size_t list = 0; list < lists_.size(); ++list) { add_new_pieces(lists_[list], made_at_[list]); }
        replace_cells(instead);
        const auto splits = static_cast<int>(pieces_.added());
        pieces_.write_to(model_);
        return {std::move(model_), DrawOrder(std::move(nodes_), lists_), splits, std::move(notes_)};
    }

private:
    /// The child of a node that paints sets one after the other. Sets of one polygon that follow one another become one
    /// list.
    int sequence_of(const std::vector<Polygons>& sets) {
        std::vector<Run> runs;
        for (const Polygons& set : sets) {
            const bool is_single = set.size() == 1;
            if (is_single && !runs.empty() && !runs.back().is_cycle) {
                runs.back().polygons.push_back(set.front());
            } else {
                runs.push_back({set, !is_single});
            }
        }
        return sequence_of(runs);
    }

    /// A cycle, or polygons that are painted one after the other.
    struct Run {
        Polygons polygons;
        bool is_cycle = false;
    };

    int sequence_of(std::span<const Run> runs) {
        if (runs.size() == 1) {
            const Run& run = runs.front();
            return run.is_cycle ? split(run.polygons) : add_list(run.polygons, model_.polygons.size());
        }
        const std::size_t node = nodes_.size(); // before its children
        nodes_.push_back({.plane = {}, .kind = DrawOrder::Kind::Sequence});
        const int front = sequence_of(runs.first(runs.size() / 2));
        const int back = sequence_of(runs.subspan(runs.size() / 2));
        nodes_[node].front = front;
        nodes_[node].back = back;
        return static_cast<int>(node);
    }

    /// Replaces each cell that is a child of a node by `instead`, and drops lists that no node has any more.
    void replace_cells(const std::vector<int>& instead) {
        std::vector<int> number(lists_.size(), DrawOrder::no_child);
        std::vector<Polygons> used;
        const auto settle = [&](int& child) {
            const auto list = static_cast<std::size_t>(~child);
            if (child < 0 && child != DrawOrder::no_child && list < instead.size()) { child = instead[list]; }
            if (child >= 0 || child == DrawOrder::no_child) { return; }
            int& moved = number[static_cast<std::size_t>(~child)];
            if (moved == DrawOrder::no_child) {
                moved = ~static_cast<int>(used.size());
                used.push_back(std::move(lists_[static_cast<std::size_t>(~child)]));
            }
            child = moved;
        };
        for (DrawOrder::Node& node : nodes_) {
            for (int* child : {&node.front, &node.back, &node.coplanar_front, &node.coplanar_back}) { settle(*child); }
        }
        lists_ = std::move(used);
    }

    /// `count` is the number of pieces of which the list may have some.
    int add_list(Polygons list, std::size_t count) {
        lists_.push_back(std::move(list));
        made_at_.push_back(count);
        return ~static_cast<int>(lists_.size() - 1);
    }

    /// The child of a node that paints one set of polygons that hide one another in a cycle: they are split.
    int split(Polygons set) {
        add_new_pieces(set, model_.polygons.size());
        tree_ = bsp::partial_bsp_tree(pieces_, std::move(set));
        for (const Polygons& cycle : tree_.unsplit_cycles) { add_note(cycle); }
        if (tree_.root >= 0) {
            const std::size_t first = nodes_.size();
            write_nodes();
            made_at_.resize(lists_.size(), pieces_.count());
            return static_cast<int>(first);
        }
        return add_list(std::move(tree_.lists[static_cast<std::size_t>(~tree_.root)]), pieces_.count());
    }

    /// Adds to a list the pieces that were cut since there were `count`, behind what they are cut from.
    void add_new_pieces(Polygons& list, std::size_t count) const {
        insert_cut_pieces(list, pieces_.cut_from(count), static_cast<std::uint32_t>(count));
    }

    void find_turning_parts() {
        for (std::uint32_t pivot = 0; pivot < model_.pivots.size(); ++pivot) {
            Polygons polygons;
            for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
                if (models::polygons::pivot_of(model_, i) == pivot) { polygons.push_back(i); }
            }
            if (!polygons.empty()) { add_turning_part(polygons, pivot); }
        }
    }

    void add_turning_part(const Polygons& polygons, std::uint32_t pivot) {
        const ModelFaces faces = model_faces(alone(model_, polygons, pivot), glm::dvec3(0.0));
        BitSet all(polygons.size());
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            all.add(i);
            std::vector<glm::dvec3> swept_m;
            for (const glm::dvec3& corner : faces.faces[i].outline) { swept_m.push_back(corner * faces.unit_m); }
            pieces_.set_swept_hull(polygons[i], pivot, swept_m, !faces.faces[i].plane);
        }
        for (const Precedence& pair : faces.rigid.precedences(all)) {
            pieces_.add_rigid(polygons[pair.later], polygons[pair.first]);
        }
        notes_.insert(notes_.end(), faces.notes.begin(), faces.notes.end());
    }

    /// The pieces to be ordered: all but those without area.
    Polygons items() const {
        Polygons items;
        for (std::uint32_t i = 0; i < pieces_.count(); ++i) {
            const auto& plane = pieces_[i].plane; // not a number where there is no area
            if (!plane || std::isfinite(plane->normal.x)) { items.push_back(i); }
        }
        return items;
    }

    void add_note(const Polygons& cycle) {
        for (const std::uint32_t item : cycle) {
            if (const auto pivot = pieces_[item].pivot) {
                const std::string note = fmt::format("{} meets other parts as it turns; no order is right for them",
                    model_.parts[model_.pivots[*pivot].part]);
                if (std::ranges::find(notes_, note) == notes_.end()) { notes_.push_back(note); }
            }
        }
    }

    static_assert(DrawOrder::no_child == bsp::PartialBspTree::no_child);

    /// Writes the tree with its lists in the order of a walk from back to front, so that many eyes find neighbours side
    /// by side.
    void write_nodes() {
        const std::size_t first = nodes_.size();
        const auto moved = [&](int child) { return child >= 0 ? child + static_cast<int>(first) : child; };
        for (const bsp::PartialBspTree::Node& from : tree_.nodes) {
            nodes_.push_back({from.plane ? pieces_.in_model(*from.plane) : Plane(), moved(from.front), moved(from.back),
                from.plane ? DrawOrder::Kind::PolygonSplit : DrawOrder::Kind::Sequence, from.coplanar_front,
                from.coplanar_back});
        }
        std::vector<int*> pending;
        int root = static_cast<int>(first);
        pending.push_back(&root);
        while (!pending.empty()) {
            int& child = *pending.back();
            pending.pop_back();
            if (child == DrawOrder::no_child) { continue; }
            if (child < 0) {
                lists_.push_back(std::move(tree_.lists[static_cast<std::size_t>(~child)]));
                child = ~static_cast<int>(lists_.size() - 1);
            } else {
                DrawOrder::Node& node = nodes_[static_cast<std::size_t>(child)];
                if (node.kind == DrawOrder::Kind::Sequence) {
                    pending.insert(pending.end(), {&node.back, &node.front});
                } else {
                    pending.insert(pending.end(), {&node.front, &node.coplanar_front, &node.coplanar_back, &node.back});
                }
            }
        }
    }

    PolygonModel model_;
    bsp::PolygonPieces pieces_;
    bsp::PartialBspTree tree_;
    std::vector<DrawOrder::Node> nodes_;
    std::vector<Polygons> lists_;
    std::vector<std::size_t> made_at_; ///< For each list how many pieces there were.
    std::vector<std::string> notes_;
};

} // namespace

BspOrder order_by_splitting(PolygonModel model) { return BspOrderBuilder(std::move(model)).order(); }

BspOrder complete_by_splitting(PolygonModel model, const IncompleteOrder& incomplete) {
    return BspOrderBuilder(std::move(model)).completed(incomplete);
}

} // namespace octant::visuals::draworder
