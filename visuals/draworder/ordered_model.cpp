// Finds the orders of a model by the paper or exactly. The exact method first cuts polygons that pass through one
// another (split.cpp), then divides eye space (view_space_tree.cpp). Where that search is given up (SearchGivenUp),
// polygons are split by planes (bsp_order.cpp) for the eyes of the cells without a list. Polygons are split for all
// eyes where no cell was found, where lists of cells are wrong, or where this takes fewer splits than the search made.
// The result is tested before it is used (order_ray_test.cpp).
#include "visuals/draworder/ordered_model.h"

#include "models/planar/planar_model.h"
#include "visuals/draworder/bsp_order.h"
#include "visuals/draworder/split.h"
#include "visuals/draworder/view_space_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

using models::planar::PlanarModel;

/// Polygons of larger models are split at once: their occlusion graphs alone would take seconds.
constexpr std::size_t max_polygons_searched = 2'000;

/// The lists of an order have together at most so many entries for each pair of the model's polygons: more take memory
/// that nobody expects of a small model.
constexpr double max_entries_of_a_pair = 64.0;

/// The share of the search's time that the proof of its result may take.
constexpr double proof_share = 0.02;
/// That share of larger models, whose proof would not come to its end. Their orders are right by construction.
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

/// Completes a tree of which some cells have no list by splitting polygons there.
OrderedModel completed(CellSearchResult found, int penetrating, std::string& reason) {
    ViewSpaceTree& tree = found.tree;
    const auto complete = std::ranges::count_if(tree.incomplete_cells, [](const auto& sets) { return sets.empty(); });
    reason = fmt::format("{} of {} view cells have an order, in the others polygons are split: {}", complete,
        tree.cells.size(), tree.incomplete_reason);
    const ModelFaces& faces = found.work.faces;
    IncompleteOrder incomplete{std::move(tree.nodes), std::move(tree.lists), std::move(tree.incomplete_cells), {}};
    for (const Face& face : faces.faces) {
        incomplete.planes.push_back(face.plane ? faces.in_model(*face.plane) : Plane());
    }
    const auto splits = static_cast<int>(found.work.sibling_pieces.size());
    std::vector<std::string> notes = std::move(found.work.notes);
    BspOrder split = complete_by_splitting(std::move(found.work.model), incomplete);
    for (std::string& note : split.notes) {
        if (std::ranges::find(notes, note) == notes.end()) { notes.push_back(std::move(note)); }
    }
    return {.model = std::move(split.model),
        .order = std::move(split.order),
        .splits = penetrating + splits + split.splits,
        .notes = std::move(notes),
        .found_by = OrderSource::TreeAndSplitPolygons};
}

/// Tests an order; returns whether it may be used.
bool is_right(OrderedModel& ordered, double search_s, const DrawOrder* proved_order = nullptr) {
    const bool is_large = ordered.model.polygons.size() > max_polygons_searched;
    // Up to here notes tell only of turning parts for which no order is right. Where there are any, no part with a
    // pivot is tested, because its rays may be wrong whatever the order of the other parts.
    ordered.ray_test = ray_test_order(ordered.model, ordered.order,
        {.turning_parts = ordered.notes.empty(),
            .min_distance_m = ordered.min_distance_m,
            .centre_m = ordered.centre_m,
            .proved_order = proved_order,
            .proof_s = search_s * (is_large ? proof_share_of_large : proof_share)});
    return ordered.ray_test.wrong == 0;
}

/// The order of a model by splitting polygons, made and tested at its first use.
class BspFallback {
public:
    BspFallback(const models::polygons::PolygonModel& model, double search_s) : model_(model), search_s_(search_s) {}

    /// How many splits a tree may have and still be used.
    int max_splits() {
        make();
        return is_right_ ? order_->splits : std::numeric_limits<int>::max();
    }

    bool is_usable() {
        make();
        return is_right_;
    }

    /// The order; to be called last.
    OrderedModel take() {
        make();
        return std::move(*order_);
    }

private:
    void make() {
        if (order_) { return; }
        BspOrder split = order_by_splitting(model_);
        order_ = OrderedModel{.model = std::move(split.model),
            .order = std::move(split.order),
            .splits = split.splits,
            .notes = std::move(split.notes),
            .found_by = OrderSource::Parts};
        is_right_ = is_right(*order_, search_s_);
    }

    const models::polygons::PolygonModel& model_;
    double search_s_;
    std::optional<OrderedModel> order_;
    bool is_right_ = false;
};

/// Finds the orders by a search over eye space, which may split no more polygons than the fallback does. `reason` says
/// why polygons are split in some cells, if they are. Throws SearchGivenUp where nothing is found.
OrderedModel searched(models::polygons::PolygonModel model, const OrderOptions& options, const OrderSearch& search,
    BspFallback& fallback, std::string& reason) {
    if (model.polygons.size() > max_polygons_searched) {
        throw SearchGivenUp{fmt::format("cells are searched for up to {} polygons", max_polygons_searched)};
    }
    SearchBudget budget(options.seconds, options.progress);
    const int penetrating = split_penetrating(model, budget);
    const auto max_splits = [&] { return fallback.max_splits() - penetrating; };
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

std::string wrong_rays_text(const RayTestResult& ray_test) {
    return fmt::format("{} of {} test rays show a wrong polygon", ray_test.wrong, ray_test.rays);
}

/// What a search finds, or the fallback where it splits fewer polygons. Returns nothing, and `reason` says why, where
/// the search finds no right order; `reason` is empty then where the fallback is known to be better.
std::optional<OrderedModel> best_found(const models::polygons::PolygonModel& model, const OrderOptions& options,
    const OrderSearch& search, BspFallback& fallback, std::string& reason) {
    std::optional<OrderedModel> found;
    try {
        found = searched(model, options, search, fallback, reason);
    } catch (const SearchGivenUp& given_up) {
        reason = given_up.is_worse_than_best ? "" : given_up.reason;
        return std::nullopt;
    }
    std::optional<DrawOrder> proved_order;
    if (search.proved_order) { proved_order = search.proved_order(*found); }
    if (!is_right(*found, options.seconds, proved_order ? &*proved_order : nullptr)) {
        reason = "with the view cells found " + wrong_rays_text(found->ray_test);
        return std::nullopt;
    }
    const bool holds_for_every_eye = found->min_distance_m == 0.0;
    const auto polygons = static_cast<double>(model.polygons.size());
    const double max_entries = 0.5 * polygons * (polygons - 1.0) * max_entries_of_a_pair;
    const int lists = found->order.list_count();
    if (holds_for_every_eye && static_cast<double>(found->order.polygons().size()) > max_entries &&
        fallback.is_usable()) {
        found = fallback.take();
        found->notes.push_back(
            fmt::format("polygons are split by planes, because view cells would take {} lists", lists));
        return found;
    }
    if (holds_for_every_eye && found->splits > 0 && found->splits > fallback.max_splits()) { found = fallback.take(); }
    if (!reason.empty()) {
        found->notes.push_back(
            found->found_by == OrderSource::TreeAndSplitPolygons
                ? reason
                : "polygons are split by planes, which takes fewer splits than view cells: " + reason);
    }
    return found;
}

/// Finds the orders of a planar model.
OrderedModel of_planar(
    const models::polygons::PolygonModel& model, const OrderOptions& options, const OrderSearch& search) {
    BspFallback fallback(model, options.seconds);
    std::string reason;
    if (auto found = best_found(model, options, search, fallback, reason)) { return std::move(*found); }
    OrderedModel split = fallback.take();
    if (split.ray_test.wrong > 0) { split.notes.push_back(wrong_rays_text(split.ray_test)); }
    if (!reason.empty()) { split.notes.push_back("no view cells are used, polygons are split by planes: " + reason); }
    return split;
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

namespace {

bool is_clear(const models::polygons::PolygonModel& model, std::size_t polygon) {
    return models::is_transparent(model.materials[model.polygons[polygon].material]);
}

/// Appends a polygon of `from` to a model that has the same vertices from `first_vertex` on.
void append_polygon(const models::polygons::PolygonModel& from, std::size_t polygon, std::uint32_t first_vertex,
    models::polygons::PolygonModel& to) {
    to.polygons.push_back(from.polygons[polygon]);
    to.polygons.back().first_corner = static_cast<std::uint32_t>(to.corner_vertices.size());
    for (const std::uint32_t vertex : from.corners(polygon)) { to.corner_vertices.push_back(first_vertex + vertex); }
}

/// A model with all but its polygons.
models::polygons::PolygonModel without_polygons(const models::polygons::PolygonModel& model) {
    models::polygons::PolygonModel empty;
    empty.name = model.name;
    empty.vertices_m = model.vertices_m;
    empty.materials = model.materials;
    empty.parts = model.parts;
    empty.pivots = model.pivots;
    return empty;
}

} // namespace

bool has_transparent_polygons(const models::polygons::PolygonModel& model) {
    return std::ranges::any_of(
        model.polygons, [&](const auto& polygon) { return models::is_transparent(model.materials[polygon.material]); });
}

OrderedModel opaque_first(const models::polygons::PolygonModel& model,
    const std::function<OrderedModel(models::polygons::PolygonModel)>& order_of) {
    models::polygons::PolygonModel clear = without_polygons(model);
    std::vector<std::uint32_t> whole_of_clear; // polygons of `model`
    models::polygons::PolygonModel joined = without_polygons(model);
    std::vector<std::vector<std::uint32_t>> lists(1);
    for (const std::uint32_t polygon : models::polygons::distinct_polygons(model)) {
        if (is_clear(model, polygon)) {
            append_polygon(model, polygon, 0, clear);
            whole_of_clear.push_back(polygon);
            continue;
        }
        lists.front().push_back(static_cast<std::uint32_t>(joined.polygons.size()));
        append_polygon(model, polygon, 0, joined);
        joined.parents.push_back(model.parent_of(polygon));
    }
    OrderedModel sorted = order_of(std::move(clear));
    const auto first_polygon = static_cast<std::uint32_t>(joined.polygons.size());
    const auto first_vertex = static_cast<std::uint32_t>(joined.vertices_m.size());
    joined.vertices_m.insert(joined.vertices_m.end(), sorted.model.vertices_m.begin(), sorted.model.vertices_m.end());
    for (std::size_t i = 0; i < sorted.model.polygons.size(); ++i) {
        append_polygon(sorted.model, i, first_vertex, joined);
        joined.parents.push_back(model.parent_of(whole_of_clear[sorted.model.parent_of(i)]));
    }
    for (int cell = 0; cell < sorted.order.cell_count(); ++cell) {
        std::vector<std::uint32_t>& list = lists.emplace_back();
        for (const std::uint32_t polygon : sorted.order.polygons_of(cell)) { list.push_back(first_polygon + polygon); }
    }
    const auto moved = [](int child) {
        return child == DrawOrder::no_child ? child : child < 0 ? child - 1 : child + 1;
    };
    const auto nodes = sorted.order.nodes();
    std::vector<DrawOrder::Node> all{
        {.plane = {}, .front = ~0, .back = nodes.empty() ? ~1 : 1, .kind = DrawOrder::Kind::Sequence}};
    for (DrawOrder::Node node : nodes) {
        for (int* child : {&node.front, &node.back, &node.coplanar_front, &node.coplanar_back}) {
            *child = moved(*child);
        }
        all.push_back(node);
    }
    return {.model = std::move(joined),
        .order = DrawOrder(std::move(all), lists),
        .cells = {},
        .splits = sorted.splits,
        .notes = std::move(sorted.notes)};
}

} // namespace octant::visuals::draworder
