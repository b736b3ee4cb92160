#include "visuals/draworder/ordered_model.h"

#include "visuals/draworder/cycle_split.h"
#include "visuals/draworder/octant_cells.h"
#include "visuals/draworder/region_tree.h"
#include "visuals/draworder/split.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// Models with more pairs on rings get the first search only.
constexpr std::size_t most_edges_searched_again = 2'000;

const std::array<TreeSearch, 3> tree_searches{{
    {.power = 1.0, .exact = 16, .widths = {}},
    {.power = 0.5, .exact = 16, .widths = {}},
    {.power = 1.0, .exact = 12, .widths = {2, 2}},
}};

OrderedModel by_paper(models::PolygonModel model, const OrderOptions& options) {
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
    return out;
}

/// Orders of a model as it is, or why there are none. Planes are in the faces' space.
struct Attempt {
    std::vector<DrawOrder::Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<OrderCell> cells;
    std::optional<Deadlock> deadlock;
};

Attempt try_tree(RegionGraphs& graphs) {
    const EyeNode root = eye_node(graphs, EyeRegion::everywhere());
    std::optional<RegionTree> best;
    for (const TreeSearch& search : tree_searches) {
        TreeResult result = region_tree(graphs, root, search);
        if (result.deadlock) {
            return {.nodes = {}, .lists = {}, .cells = {}, .deadlock = std::move(result.deadlock)};
        }
        if (!best || result.tree.lists.size() < best->lists.size()) {
            best = std::move(result.tree);
        }
        if (root.cycles.edges > most_edges_searched_again) {
            break;
        }
    }
    Attempt out{
        .nodes = std::move(best->nodes),
        .lists = std::move(best->lists),
        .cells = {},
        .deadlock = std::nullopt};
    for (std::vector<Plane>& planes : best->cell_planes) {
        out.cells.push_back({"", std::move(planes)});
    }
    return out;
}

Attempt try_cells(RegionGraphs& graphs, double least_distance) {
    OctantCellsResult result = octant_cells(graphs, least_distance);
    Attempt out{
        .nodes = std::move(result.cells.nodes),
        .lists = std::move(result.cells.lists),
        .cells = {},
        .deadlock = std::move(result.deadlock)};
    for (std::size_t i = 0; i < result.cells.paths.size(); ++i) {
        out.cells.push_back(
            {std::move(result.cells.paths[i]), std::move(result.cells.cell_planes[i])});
    }
    return out;
}

/// Finds exact orders, and splits polygons while there are none.
class Orderer {
public:
    Orderer(models::PolygonModel model, const OrderOptions& options)
        : options_(options)
        , out_{
              .model = std::move(model),
              .order = DrawOrder(std::vector<std::uint32_t>{}),
              .cells = {},
              .notes = {}} {}

    OrderedModel ordered();

private:
    bool try_once(const glm::dvec3& centre_m);
    void resolve(RegionGraphs& graphs, const Deadlock& deadlock);

    const OrderOptions& options_;
    OrderedModel out_;
    std::vector<Precedence> given_up_; ///< pairs with turning polygons that no order is right for
};

bool Orderer::try_once(const glm::dvec3& centre_m) {
    ModelFaces faces = model_faces(out_.model, centre_m);
    for (const Precedence& pair : given_up_) {
        faces.ignored.add(pair.later, pair.first);
    }
    RegionGraphs graphs(faces);
    const bool cells = options_.method == Method::Cells;
    Attempt attempt = cells ? try_cells(graphs, options_.min_distance_radii) : try_tree(graphs);
    if (attempt.deadlock) {
        resolve(graphs, *attempt.deadlock);
        return false;
    }
    for (DrawOrder::Node& node : attempt.nodes) {
        node.plane = faces.in_model(node.plane);
    }
    for (OrderCell& cell : attempt.cells) {
        for (Plane& plane : cell.planes) {
            plane = faces.in_model(plane);
        }
    }
    out_.order = DrawOrder(std::move(attempt.nodes), attempt.lists);
    out_.cells = std::move(attempt.cells);
    out_.centre_m = centre_m;
    out_.min_distance_m = cells ? options_.min_distance_radii * faces.unit_m : 0.0;
    out_.notes.insert(out_.notes.end(), faces.notes.begin(), faces.notes.end());
    return true;
}

/// Splits a polygon of the ring; where only turning polygons are in the way, gives up one pair.
void Orderer::resolve(RegionGraphs& graphs, const Deadlock& deadlock) {
    if (const auto cut = best_cut(graphs, deadlock)) {
        split_polygon(out_.model, cut->polygon, models::plane_of(out_.model, cut->along));
        ++out_.splits;
        return;
    }
    const Precedence pair = weakest_pair(graphs, deadlock);
    given_up_.push_back(pair);
    const auto part_of = [&](std::uint32_t polygon) {
        return out_.model.parts[out_.model.polygons[polygon].part];
    };
    out_.notes.push_back(fmt::format(
        "{} and {} hide one another as they turn; no order is right at every angle",
        part_of(pair.first),
        part_of(pair.later)));
}

OrderedModel Orderer::ordered() {
    out_.splits = split_penetrating(out_.model);
    while (!try_once(glm::dvec3(0.0))) {
    }
    return std::move(out_);
}

} // namespace

OrderedModel ordered(models::PolygonModel model, const OrderOptions& options) {
    if (options.method == Method::Paper) {
        return by_paper(std::move(model), options);
    }
    return Orderer(std::move(model), options).ordered();
}

} // namespace octant::visuals::draworder
