// The three ways to the orders of a model, and the choice among several results. The exact methods
// first cut polygons that pass through one another (split.cpp), then search over regions of eyes
// (cell_search.cpp).
#include "visuals/draworder/ordered_model.h"

#include "models/planar/planar_model.h"
#include "visuals/draworder/cell_search.h"
#include "visuals/draworder/bsp_order.h"
#include "visuals/draworder/split.h"
#include "visuals/draworder/working_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

using models::planar::PlanarModel;

/// Larger models are divided at once: their graphs alone would take seconds.
constexpr std::size_t max_polygons_searched = 2'000;

/// So much of the time that a search may take goes to the proof of what is found.
constexpr double proof_share = 0.02;
/// Of larger models: their parts are right as they are made, and a proof would not come to its end.
constexpr double proof_share_of_large = 0.002;

OrderedModel by_paper(models::polygons::PolygonModel model, const OrderOptions& options) {
    const OctantOrders orders = paper_orders(model, options.paper);
    OrderedModel out{
        .model = std::move(model), .order = DrawOrder(orders), .cells = {}, .notes = {}};
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 signs = octant_signs(octant);
        out.cells.push_back(
            {octant_name(octant),
             {{{signs.x, 0.0, 0.0}, 0.0}, {{0.0, signs.y, 0.0}, 0.0}, {{0.0, 0.0, signs.z}, 0.0}}});
    }
    out.cyclic_cells = orders.cyclic_octants;
    out.found_by = OrderSource::Paper;
    // Lists are for eyes at the radius or beyond: all with |x| + |y| + |z| of sqrt(3) radii are.
    out.min_distance_m = std::sqrt(3.0) * models::polygons::radius_m(out.model);
    return out;
}

/// Completes orders of which some cells are open by dividing polygons there.
OrderedModel completed(CellSearchResult orders, int penetrating, std::string& reason) {
    const auto found =
        std::ranges::count_if(orders.incomplete_cells, [](const auto& sets) { return sets.empty(); });
    reason = fmt::format(
        "{} of {} cells are found, the others drawn by parts: {}",
        found,
        orders.cells.size(),
        orders.incomplete_reason);
    const ModelFaces& faces = orders.work.faces;
    std::vector<Plane> planes;
    for (const Face& face : faces.faces) {
        planes.push_back(face.plane ? faces.in_model(*face.plane) : Plane());
    }
    const auto splits = static_cast<int>(orders.work.sibling_pieces.size());
    std::vector<std::string> notes = std::move(orders.work.notes);
    BspOrder parted = complete_order(
        std::move(orders.work.model),
        {std::move(orders.nodes),
         std::move(orders.lists),
         std::move(orders.incomplete_cells),
         std::move(planes)});
    for (std::string& note : parted.notes) {
        if (std::ranges::find(notes, note) == notes.end()) {
            notes.push_back(std::move(note));
        }
    }
    return {
        .model = std::move(parted.model),
        .order = std::move(parted.order),
        .cells = {},
        .splits = penetrating + splits + parted.splits,
        .notes = std::move(notes),
        .found_by = OrderSource::TreeAndSplitPolygons};
}

OrderedModel by_parts(models::polygons::PolygonModel model, BspLeaves way) {
    BspOrder parted = bsp_order(std::move(model), way);
    return {
        .model = std::move(parted.model),
        .order = std::move(parted.order),
        .cells = {},
        .splits = parted.splits,
        .notes = std::move(parted.notes),
        .found_by = way == BspLeaves::Single ? OrderSource::Bsp : OrderSource::Parts};
}

/// Tries an order; whether it may be used.
bool is_right(OrderedModel& ordered, double search_s) {
    const bool is_large = ordered.model.polygons.size() > max_polygons_searched;
    // Where no order is right for turning parts, they say nothing about the others.
    ordered.ray_test = ray_test_order(
        ordered.model,
        ordered.order,
        {.turning_parts = ordered.notes.empty(),
         .min_distance_m = ordered.min_distance_m,
         .centre_m = ordered.centre_m,
         .proof_s = search_s * (is_large ? proof_share_of_large : proof_share)});
    return ordered.ray_test.wrong == 0;
}

/// A model's order by parts, made and tried when it is first asked for.
class BspFallback {
public:
    BspFallback(const models::polygons::PolygonModel& model, double search_s)
        : model_(model)
        , search_s_(search_s) {}

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
            order_ = by_parts(model_, BspLeaves::Clusters);
            is_right_ = draworder::is_right(*order_, search_s_);
        }
    }

    const models::polygons::PolygonModel& model_;
    double search_s_;
    std::optional<OrderedModel> order_;
    bool is_right_ = false;
};

/// Finds the orders by Cells or Tree; a tree only while it splits no more than `parts`. `reason` says
/// why some cells are drawn by parts, if they are.
OrderedModel exact(
    models::polygons::PolygonModel model,
    const OrderOptions& options,
    BspFallback& parts,
    std::string& reason) {
    SearchBudget budget(options.seconds, options.progress);
    const int penetrating = split_penetrating(model, budget);
    const bool by_cells = options.method == OrderMethod::Cells;
    const auto max_splits = [&] { return parts.max_splits() - penetrating; };
    CellSearchResult orders = by_cells ? best_cells(model, options.min_distance_radii, budget)
                                 : best_tree(model, budget, max_splits);
    const ModelFaces& faces = orders.work.faces;
    for (DrawOrder::Node& node : orders.nodes) {
        node.plane = faces.in_model(node.plane);
    }
    for (OrderCell& cell : orders.cells) {
        for (Plane& plane : cell.planes) {
            plane = faces.in_model(plane);
        }
    }
    if (!orders.incomplete_cells.empty()) {
        return completed(std::move(orders), penetrating, reason);
    }
    return {
        .model = std::move(orders.work.model),
        .order = DrawOrder(std::move(orders.nodes), orders.lists),
        .cells = std::move(orders.cells),
        .centre_m = faces.origin_m,
        .min_distance_m = by_cells ? options.min_distance_radii * faces.unit_m : 0.0,
        .splits = penetrating + static_cast<int>(orders.work.sibling_pieces.size()),
        .notes = std::move(orders.work.notes),
        .found_by = by_cells ? OrderSource::Cells : OrderSource::Tree};
}

/// The orders of the method asked for; nothing where the search for cells is given up without any.
/// `reason` says why then, and why some are not found; it stays empty where `parts` cut less.
std::optional<OrderedModel> searched(
    const models::polygons::PolygonModel& model,
    const OrderOptions& options,
    BspFallback& parts,
    std::string& reason) {
    if (model.polygons.size() > max_polygons_searched) {
        reason = fmt::format("cells are searched for up to {} polygons", max_polygons_searched);
        return std::nullopt;
    }
    try {
        return exact(model, options, parts, reason);
    } catch (const SearchGivenUp& given_up) {
        reason = given_up.is_worse_than_best ? "" : given_up.reason;
        return std::nullopt;
    }
}

/// What is to be told of a trial that saw nothing wrong.
void add_note(OrderedModel& ordered) {
    if (ordered.ray_test.unproved > 0) {
        ordered.notes.push_back(fmt::format(
            "no proof is found for {} pairs of polygons; no ray at them was wrong",
            ordered.ray_test.unproved));
    }
}

std::string error_summary(const RayTestResult& ray_test) {
    return fmt::format("{} of {} rays were wrong", ray_test.wrong, ray_test.rays);
}

/// What was found by cells or, where that had to split polygons more often, by parts.
OrderedModel with_fewer_splits(OrderedModel found, BspFallback& parts) {
    const bool by_tree = found.found_by == OrderSource::Tree || found.found_by == OrderSource::TreeAndSplitPolygons;
    const bool by_parts = by_tree && found.splits > 0 && found.splits > parts.max_splits();
    return by_parts ? parts.take() : std::move(found);
}

/// Finds the orders of a planar model by any method but that of the paper.
OrderedModel of_planar(models::polygons::PolygonModel model, const OrderOptions& options) {
    BspFallback parts(model, options.seconds);
    std::string reason;
    if (options.method != OrderMethod::Bsp) {
        if (auto found = searched(model, options, parts, reason)) {
            if (is_right(*found, options.seconds)) {
                OrderedModel best = with_fewer_splits(std::move(*found), parts);
                if (!reason.empty()) {
                    best.notes.push_back(
                        best.found_by == OrderSource::TreeAndSplitPolygons
                            ? reason
                            : "drawn by parts, which cut less than cells: " + reason);
                }
                return best;
            }
            reason = "by cells " + error_summary(found->ray_test);
        }
    }
    const bool by_parts_right = parts.is_right();
    OrderedModel parted = parts.take();
    if (!by_parts_right) {
        const std::string instead = error_summary(parted.ray_test);
        OrderedModel single = by_parts(std::move(model), BspLeaves::Single);
        single.notes.push_back("drawn by a BSP tree: by parts " + instead);
        if (!is_right(single, options.seconds)) {
            single.notes.push_back("by the BSP tree " + error_summary(single.ray_test));
        }
        parted = std::move(single);
    }
    if (!reason.empty()) {
        parted.notes.push_back("drawn by parts, not by cells: " + reason);
    }
    return parted;
}

std::vector<std::string> notes_of(const PlanarModel& planar) {
    std::vector<std::string> notes;
    if (planar.triangulated_polygons > 0) {
        notes.push_back(fmt::format(
            "{} polygons are not planar or not convex enough to be ordered as they are: cut into "
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
        for (Plane& plane : cell.planes) {
            plane = planar.to_model_frame(plane);
        }
    }
    found.centre_m = planar.to_model_frame(found.centre_m);
    found.min_distance_m *= planar.radius_m;
    const auto notes = notes_of(planar);
    found.notes.insert(found.notes.begin(), notes.begin(), notes.end());
    return found;
}

} // namespace

OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options) {
    if (options.method == OrderMethod::Paper) {
        return by_paper(std::move(model), options);
    }
    using models::planar::Attitude; // octants are those of the model's own file
    const PlanarModel planar = models::planar::planar_model(
        model, options.method == OrderMethod::Cells ? Attitude::Given : Attitude::Own);
    OrderedModel found = of_planar(planar.model, options);
    add_note(found);
    return in_model_frame(std::move(found), planar, model);
}

} // namespace octant::visuals::draworder
