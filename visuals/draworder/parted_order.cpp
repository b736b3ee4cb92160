// The way to an order that never fails: polygons are divided by planes (a BSP tree of clusters).
#include "visuals/draworder/parted_order.h"

#include "visuals/draworder/model_faces.h"
#include "visuals/draworder/precedence.h"
#include "visuals/draworder/turning_parts.h"
#include "visuals/parting/parting_tree.h"
#include "visuals/parting/pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
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

/// Builds one order.
class PartedBuilding {
public:
    PartedBuilding(PolygonModel model, Parting way)
        : model_(std::move(model))
        , pieces_(model_)
        , way_(way) {}

    PartedOrder order() {
        find_turning_parts();
        tree_ = parting::parting_tree(pieces_, items(), way_ == Parting::Clusters);
        for (const Polygons& ring : tree_.unparted) {
            add_note(ring);
        }
        const auto splits = static_cast<int>(pieces_.added());
        pieces_.write_to(model_);
        if (tree_.root >= 0) {
            write_nodes();
        } else {
            lists_.push_back(
                tree_.root == parting::PartingTree::nothing
                    ? Polygons{}
                    : tree_.lists[static_cast<std::size_t>(~tree_.root)]);
        }
        return {std::move(model_), DrawOrder(std::move(nodes_), lists_), splits, std::move(notes_)};
    }

private:
    void find_turning_parts() {
        for (std::uint32_t pivot = 0; pivot < model_.pivots.size(); ++pivot) {
            Polygons polygons;
            for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
                if (models::polygons::pivot_of(model_, i) == pivot) {
                    polygons.push_back(i);
                }
            }
            if (!polygons.empty()) {
                add_turning_part(polygons, pivot);
            }
        }
    }

    void add_turning_part(const Polygons& polygons, std::uint32_t pivot) {
        const ModelFaces faces = model_faces(alone(model_, polygons, pivot), glm::dvec3(0.0));
        PolygonSet all(polygons.size());
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            all.add(i);
            std::vector<glm::dvec3> swept_m;
            for (const glm::dvec3& corner : faces.faces[i].outline) {
                swept_m.push_back(corner * faces.unit_m);
            }
            pieces_.make_swept(polygons[i], pivot, swept_m, !faces.faces[i].plane);
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
            if (!plane || std::isfinite(plane->normal.x)) {
                items.push_back(i);
            }
        }
        return items;
    }

    void add_note(const Polygons& ring) {
        for (const std::uint32_t item : ring) {
            if (const auto pivot = pieces_[item].pivot) {
                const std::string note = fmt::format(
                    "{} meets other parts as it turns; no order is right for them",
                    model_.parts[model_.pivots[*pivot].part]);
                if (std::ranges::find(notes_, note) == notes_.end()) {
                    notes_.push_back(note);
                }
            }
        }
    }

    /// Writes the tree with its lists in the order of a walk from back to front, so that many eyes
    /// find neighbours side by side.
    void write_nodes() {
        constexpr int nothing = parting::PartingTree::nothing;
        nodes_.resize(tree_.nodes.size());
        std::vector<int*> to_do;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const auto& from = tree_.nodes[i];
            nodes_[i] = {
                from.plane ? pieces_.in_model(*from.plane) : Plane(),
                from.front,
                from.back,
                from.plane ? DrawOrder::Kind::Parting : DrawOrder::Kind::Sequence,
                from.along,
                from.against};
        }
        int root = 0;
        to_do.push_back(&root);
        while (!to_do.empty()) {
            int& child = *to_do.back();
            to_do.pop_back();
            if (child == nothing) {
                child = DrawOrder::nothing;
            } else if (child < 0) {
                lists_.push_back(std::move(tree_.lists[static_cast<std::size_t>(~child)]));
                child = ~static_cast<int>(lists_.size() - 1);
            } else {
                DrawOrder::Node& node = nodes_[static_cast<std::size_t>(child)];
                if (node.kind == DrawOrder::Kind::Sequence) {
                    to_do.insert(to_do.end(), {&node.back, &node.front});
                } else {
                    to_do.insert(
                        to_do.end(), {&node.front, &node.along, &node.against, &node.back});
                }
            }
        }
    }

    PolygonModel model_;
    parting::Pieces pieces_;
    Parting way_;
    parting::PartingTree tree_;
    std::vector<DrawOrder::Node> nodes_;
    std::vector<Polygons> lists_;
    std::vector<std::string> notes_;
};

} // namespace

PartedOrder parted_order(PolygonModel model, Parting way) {
    return PartedBuilding(std::move(model), way).order();
}

} // namespace octant::visuals::draworder
