// The three ways to the orders of a model, and the choice among several results. The exact methods
// first cut polygons that pass through one another (split.cpp), then search over regions of eyes.
// As the searches are greedy, small models are searched several times with other weights or other
// centres; the result with the fewest splits, then with the fewest cells, is kept.
#include "visuals/draworder/ordered_model.h"

#include "visuals/draworder/cell_centres.h"
#include "visuals/draworder/octant_cells.h"
#include "visuals/draworder/parted_order.h"
#include "visuals/draworder/region_tree.h"
#include "visuals/draworder/split.h"
#include "visuals/draworder/working_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// In larger models the octants always meet at the origin.
constexpr std::size_t most_polygons_with_choice = 200;
/// Models with more cyclic edges get one quick search only.
constexpr std::size_t most_edges_searched_again = 2'000;

/// The searches whose results are compared.
const std::array<TreeSearch, 3> tree_searches{{{.power = 1.0}, {.power = 0.5}, {.power = 1.5}}};
const TreeSearch quick_search{.edge_planes = 300, .closer = 48, .exact = 2};

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
    // Lists are for eyes at the radius or beyond: all with |x| + |y| + |z| of sqrt(3) radii are.
    out.min_distance_m = std::sqrt(3.0) * models::polygons::radius_m(out.model);
    return out;
}

/// The cells and lists of a model, with planes in the space of its faces.
struct Orders {
    WorkingModel work;
    std::vector<DrawOrder::Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<OrderCell> cells;
};

/// Whether one result is better: fewer splits, then fewer cells.
bool fewer(const Orders& a, const Orders& b) {
    return std::pair(a.work.twins.size(), a.cells.size()) <
           std::pair(b.work.twins.size(), b.cells.size());
}

void keep_better(std::optional<Orders>& best, Orders orders) {
    if (!best || fewer(orders, *best)) {
        best = std::move(orders);
    }
}

Orders tree_orders(WorkingModel work, const EyeNode& root, const TreeSearch& search) {
    RegionTree tree = region_tree(work, root, search);
    Orders out{std::move(work), std::move(tree.nodes), std::move(tree.lists), {}};
    for (std::vector<Plane>& planes : tree.cell_planes) {
        out.cells.push_back({"", std::move(planes)});
    }
    return out;
}

Orders best_tree(const models::polygons::PolygonModel& model) {
    const WorkingModel work(model, glm::dvec3(0.0));
    RegionGraphs graphs(work.faces);
    const EyeNode root = eye_node(graphs, EyeRegion::everywhere());
    if (root.cycles.edges > most_edges_searched_again) {
        return tree_orders(work, root, quick_search);
    }
    std::optional<Orders> best;
    for (const TreeSearch& search : tree_searches) {
        keep_better(best, tree_orders(work, root, search));
    }
    return std::move(*best);
}

Orders cell_orders(WorkingModel work, double least_distance) {
    OctantCells cells = octant_cells(work, least_distance);
    Orders out{std::move(work), std::move(cells.nodes), std::move(cells.lists), {}};
    for (std::size_t i = 0; i < cells.paths.size(); ++i) {
        out.cells.push_back({std::move(cells.paths[i]), std::move(cells.cell_planes[i])});
    }
    return out;
}

Orders best_cells(const models::polygons::PolygonModel& model, double least_distance) {
    std::optional<Orders> best;
    const auto centres = cell_centres(WorkingModel(model, glm::dvec3(0.0)));
    for (const glm::dvec3& centre_m : centres) {
        if (best && model.polygons.size() > most_polygons_with_choice) {
            break;
        }
        keep_better(best, cell_orders(WorkingModel(model, centre_m), least_distance));
    }
    return std::move(*best);
}

/// Finds the orders by Cells or Tree and converts them to body axes.
OrderedModel exact(models::polygons::PolygonModel model, const OrderOptions& options) {
    const int penetrating = split_penetrating(model);
    const bool by_cells = options.method == Method::Cells;
    Orders orders = by_cells ? best_cells(model, options.min_distance_radii) : best_tree(model);
    const ModelFaces& faces = orders.work.faces;
    for (DrawOrder::Node& node : orders.nodes) {
        node.plane = faces.in_model(node.plane);
    }
    for (OrderCell& cell : orders.cells) {
        for (Plane& plane : cell.planes) {
            plane = faces.in_model(plane);
        }
    }
    return {
        .model = std::move(orders.work.model),
        .order = DrawOrder(std::move(orders.nodes), orders.lists),
        .cells = std::move(orders.cells),
        .centre_m = faces.origin_m,
        .min_distance_m = by_cells ? options.min_distance_radii * faces.unit_m : 0.0,
        .splits = penetrating + static_cast<int>(orders.work.twins.size()),
        .notes = std::move(orders.work.notes)};
}

OrderedModel by_parts(models::polygons::PolygonModel model) {
    PartedOrder parted = parted_order(std::move(model));
    return {
        .model = std::move(parted.model),
        .order = std::move(parted.order),
        .cells = {},
        .splits = parted.splits,
        .notes = std::move(parted.notes)};
}

} // namespace

OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options) {
    if (options.method == Method::Bsp) {
        return by_parts(std::move(model));
    }
    if (options.method == Method::Paper) {
        return by_paper(std::move(model), options);
    }
    return exact(std::move(model), options);
}

} // namespace octant::visuals::draworder
