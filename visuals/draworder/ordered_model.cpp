// Finds the orders of a model by the paper or exactly. The exact method first cuts polygons that pass through one
// another (split.cpp), then divides eye space (view_space_tree.cpp). Where that search ends, or splits more polygons
// than needed, the polygons are split by planes (visuals/bsp). The result is tested before it is used
// (order_ray_test.cpp).
#include "visuals/draworder/ordered_model.h"

#include "models/planar/planar_model.h"
#include "visuals/bsp/partial_bsp_tree.h"
#include "visuals/bsp/polygon_pieces.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/split.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/view_space_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::draworder {

// The fall-back, which never fails: polygons are split by planes (a BSP tree whose leaves are lists).

namespace {

using models::polygons::PolygonModel;
using Polygons = std::vector<std::uint32_t>;

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct BspOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// A tree of view splits; some of its cells have no list yet.
struct IncompleteOrder {
    std::vector<DrawOrder::Node> nodes; ///< As DrawOrder takes them; at least one.
    std::vector<std::vector<std::uint32_t>> lists;
    /// For each cell without a list the sets of polygons that are painted one after the other; empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    /// For each polygon of the model its plane, in body axes; those of slivers are not computed from their corners.
    std::vector<Plane> planes;
};

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
            lists_.push_back(tree_.root == bsp::PartialBspTree::nothing
                                 ? Polygons{}
                                 : tree_.lists[static_cast<std::size_t>(~tree_.root)]);
        }
        return {std::move(model_), DrawOrder(std::move(nodes_), lists_), splits, std::move(notes_)};
    }

    BspOrder completed(IncompleteOrder incomplete) {
        find_turning_parts();
        nodes_ = std::move(incomplete.nodes);
        lists_ = std::move(incomplete.lists);
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
    /// The child of a node that paints sets one after the other.
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
            return run.is_cycle ? parted(run.polygons) : add_list(run.polygons, model_.polygons.size());
        }
        const std::size_t node = nodes_.size(); // before its children
        nodes_.push_back({.plane = {}, .kind = DrawOrder::Kind::Sequence});
        const int front = sequence_of(runs.first(runs.size() / 2));
        const int back = sequence_of(runs.subspan(runs.size() / 2));
        nodes_[node].front = front;
        nodes_[node].back = back;
        return static_cast<int>(node);
    }

    /// Leads from each cell to what stands in its place, and leaves out lists that are used no more.
    void replace_cells(const std::vector<int>& instead) {
        std::vector<int> number(lists_.size(), DrawOrder::nothing);
        std::vector<Polygons> used;
        const auto settle = [&](int& child) {
            const auto list = static_cast<std::size_t>(~child);
            if (child < 0 && child != DrawOrder::nothing && list < instead.size()) { child = instead[list]; }
            if (child >= 0 || child == DrawOrder::nothing) { return; }
            int& moved = number[static_cast<std::size_t>(~child)];
            if (moved == DrawOrder::nothing) {
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

    /// The child of a node that paints one set, which is divided.
    int parted(Polygons set) {
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

    /// Writes the tree with its lists in the order of a walk from back to front, so that many eyes find neighbours side
    /// by side.
    void write_nodes() {
        constexpr int nothing = bsp::PartialBspTree::nothing;
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
            if (child == nothing) {
                child = DrawOrder::nothing;
            } else if (child < 0) {
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

using models::planar::PlanarModel;

/// Larger models are divided at once: their graphs alone would take seconds.
constexpr std::size_t max_polygons_searched = 2'000;

/// So much of the time that a search may take goes to the proof of what is found.
constexpr double proof_share = 0.02;
/// Of larger models: their parts are right as they are made, and a proof would not come to its end.
constexpr double proof_share_of_large = 0.002;

OrderedModel by_paper(models::polygons::PolygonModel model) {
    const OctantOrders orders = paper_orders(model);
    OrderedModel out{.model = std::move(model), .order = DrawOrder(orders), .cells = {}, .notes = {}};
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs = octant_signs(octant);
        out.cells.push_back({octant_name(octant),
            {{{signs.x, 0.0, 0.0}, 0.0}, {{0.0, signs.y, 0.0}, 0.0}, {{0.0, 0.0, signs.z}, 0.0}}});
    }
    out.cyclic_cells = orders.cyclic_octants;
    out.found_by = OrderSource::Paper;
    // Lists are for eyes at the radius or beyond: all with |x| + |y| + |z| of sqrt(3) radii are.
    out.min_distance_m = std::sqrt(3.0) * models::polygons::radius_m(out.model);
    return out;
}

/// Completes orders of which some cells are open by splitting polygons there.
OrderedModel completed(CellSearchResult found, int penetrating, std::string& reason) {
    ViewSpaceTree& tree = found.tree;
    const auto complete = std::ranges::count_if(tree.incomplete_cells, [](const auto& sets) { return sets.empty(); });
    reason = fmt::format(
        "{} of {} cells are found, the others drawn by parts: {}", complete, tree.cells.size(), tree.incomplete_reason);
    const ModelFaces& faces = found.work.faces;
    std::vector<Plane> planes;
    for (const Face& face : faces.faces) { planes.push_back(face.plane ? faces.in_model(*face.plane) : Plane()); }
    const auto splits = static_cast<int>(found.work.sibling_pieces.size());
    std::vector<std::string> notes = std::move(found.work.notes);
    BspOrder parted =
        BspOrderBuilder(std::move(found.work.model))
            .completed({std::move(tree.nodes), std::move(tree.lists), std::move(tree.incomplete_cells), planes});
    for (std::string& note : parted.notes) {
        if (std::ranges::find(notes, note) == notes.end()) { notes.push_back(std::move(note)); }
    }
    return {.model = std::move(parted.model),
        .order = std::move(parted.order),
        .cells = {},
        .splits = penetrating + splits + parted.splits,
        .notes = std::move(notes),
        .found_by = OrderSource::TreeAndSplitPolygons};
}

/// Orders any model for every eye by splitting its polygons, without a search.
OrderedModel by_parts(models::polygons::PolygonModel model) {
    BspOrder parted = BspOrderBuilder(std::move(model)).order();
    return {.model = std::move(parted.model),
        .order = std::move(parted.order),
        .cells = {},
        .splits = parted.splits,
        .notes = std::move(parted.notes),
        .found_by = OrderSource::Parts};
}

/// Tests an order; returns whether it may be used.
bool is_right(OrderedModel& ordered, double search_s, const DrawOrder* proved_order = nullptr) {
    const bool is_large = ordered.model.polygons.size() > max_polygons_searched;
    // Where no order is right for turning parts, they say nothing about the others.
    ordered.ray_test = ray_test_order(ordered.model, ordered.order,
        {.turning_parts = ordered.notes.empty(),
            .min_distance_m = ordered.min_distance_m,
            .centre_m = ordered.centre_m,
            .proved_order = proved_order,
            .proof_s = search_s * (is_large ? proof_share_of_large : proof_share)});
    return ordered.ray_test.wrong == 0;
}

/// A model's order by splitting polygons, made and tested at its first use.
class BspFallback {
public:
    BspFallback(const models::polygons::PolygonModel& model, double search_s) : model_(model), search_s_(search_s) {}

    bool is_right() {
        make();
        return is_right_;
    }

    /// How many splits a tree may have and still be used.
    int max_splits() { return is_right() ? order_->splits : std::numeric_limits<int>::max(); }

    /// The order; nothing may be asked after it.
    OrderedModel take() {
        make();
        return std::move(*order_);
    }

private:
    void make() {
        if (!order_) {
            order_ = by_parts(model_);
            is_right_ = draworder::is_right(*order_, search_s_);
        }
    }

    const models::polygons::PolygonModel& model_;
    double search_s_;
    std::optional<OrderedModel> order_;
    bool is_right_ = false;
};

/// Finds the orders by a search over eye space, which may split no more polygons than `parts`. `reason` says why some
/// cells are drawn by parts, if they are. Throws SearchGivenUp where nothing is found.
OrderedModel searched(models::polygons::PolygonModel model, const OrderOptions& options, const OrderSearch& search,
    BspFallback& parts, std::string& reason) {
    if (model.polygons.size() > max_polygons_searched) {
        throw SearchGivenUp{fmt::format("cells are searched for up to {} polygons", max_polygons_searched)};
    }
    SearchBudget budget(options.seconds, options.progress);
    const int penetrating = split_penetrating(model, budget);
    const auto max_splits = [&] { return parts.max_splits() - penetrating; };
    CellSearchResult found =
        search.find ? search.find(model, budget, max_splits) : best_tree(model, budget, max_splits);
    const ModelFaces& faces = found.work.faces;
    ViewSpaceTree& tree = found.tree;
    for (DrawOrder::Node& node : tree.nodes) { node.plane = faces.in_model(node.plane); }
    for (OrderCell& cell : tree.cells) {
        for (Plane& plane : cell.planes) { plane = faces.in_model(plane); }
    }
    if (!tree.incomplete_reason.empty()) { return completed(std::move(found), penetrating, reason); }
    return {.model = std::move(found.work.model),
        .order = DrawOrder(std::move(tree.nodes), tree.lists),
        .cells = std::move(tree.cells),
        .centre_m = faces.origin_m,
        .min_distance_m = search.min_distance_radii * faces.unit_m,
        .splits = penetrating + static_cast<int>(found.work.sibling_pieces.size()),
        .notes = std::move(found.work.notes),
        .found_by = search.source};
}

std::string error_summary(const RayTestResult& ray_test) {
    return fmt::format("{} of {} rays were wrong", ray_test.wrong, ray_test.rays);
}

/// What a search finds, or the parts where they split fewer polygons. Returns nothing, and `reason` says why, where
/// the search finds nothing right; `reason` stays empty where the parts are better.
std::optional<OrderedModel> best_found(const models::polygons::PolygonModel& model, const OrderOptions& options,
    const OrderSearch& search, BspFallback& parts, std::string& reason) {
    std::optional<OrderedModel> found;
    try {
        found = searched(model, options, search, parts, reason);
    } catch (const SearchGivenUp& given_up) {
        reason = given_up.is_worse_than_best ? "" : given_up.reason;
        return std::nullopt;
    }
    std::optional<DrawOrder> proved_order;
    if (search.proved_order) { proved_order = search.proved_order(*found); }
    if (!is_right(*found, options.seconds, proved_order ? &*proved_order : nullptr)) {
        reason = "by cells " + error_summary(found->ray_test);
        return std::nullopt;
    }
    const bool holds_for_every_eye = found->min_distance_m == 0.0;
    if (holds_for_every_eye && found->splits > 0 && found->splits > parts.max_splits()) { found = parts.take(); }
    if (!reason.empty()) {
        found->notes.push_back(found->found_by == OrderSource::TreeAndSplitPolygons
                                   ? reason
                                   : "drawn by parts, which cut less than cells: " + reason);
    }
    return found;
}

/// Finds the orders of a planar model.
OrderedModel of_planar(
    const models::polygons::PolygonModel& model, const OrderOptions& options, const OrderSearch& search) {
    BspFallback parts(model, options.seconds);
    std::string reason;
    if (auto found = best_found(model, options, search, parts, reason)) { return std::move(*found); }
    OrderedModel parted = parts.take();
    if (parted.ray_test.wrong > 0) { parted.notes.push_back("by parts " + error_summary(parted.ray_test)); }
    if (!reason.empty()) { parted.notes.push_back("drawn by parts, not by cells: " + reason); }
    return parted;
}

std::vector<std::string> notes_of(const PlanarModel& planar) {
    std::vector<std::string> notes;
    if (planar.triangulated_polygons > 0) {
        notes.push_back(
            fmt::format("{} polygons are not planar or not convex enough to be ordered as they are: cut into "
                        "pieces",
                planar.triangulated_polygons));
    }
    if (planar.dropped_polygons > 0) {
        notes.push_back(fmt::format("{} polygons have no area: left out", planar.dropped_polygons));
    }
    return notes;
}

/// Brings an order back to the place and unit of the model as given.
OrderedModel in_model_frame(
    OrderedModel found, const PlanarModel& planar, const models::polygons::PolygonModel& given) {
    found.model = models::planar::in_model_frame(std::move(found.model), planar, given);
    found.order.convert_planes([&](const Plane& plane) { return planar.to_model_frame(plane); });
    for (OrderCell& cell : found.cells) {
        for (Plane& plane : cell.planes) { plane = planar.to_model_frame(plane); }
    }
    found.centre_m = planar.to_model_frame(found.centre_m);
    found.min_distance_m *= planar.radius_m;
    const auto notes = notes_of(planar);
    found.notes.insert(found.notes.begin(), notes.begin(), notes.end());
    return found;
}

} // namespace

OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options) {
    if (options.method == OrderMethod::Paper) { return by_paper(std::move(model)); }
    return ordered_by(std::move(model), options, {});
}

OrderedModel ordered_by(models::polygons::PolygonModel model, const OrderOptions& options, const OrderSearch& search) {
    const PlanarModel planar = models::planar::planar_model(
        model, search.keeps_axes ? models::planar::Attitude::Given : models::planar::Attitude::Own);
    OrderedModel found = of_planar(planar.model, options, search);
    if (found.ray_test.unproved > 0) {
        found.notes.push_back(fmt::format(
            "no proof is found for {} pairs of polygons; no ray at them was wrong", found.ray_test.unproved));
    }
    return in_model_frame(std::move(found), planar, model);
}

} // namespace octant::visuals::draworder
