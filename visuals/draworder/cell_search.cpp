// The searches for cells, and the choice among their results. As the searches are greedy, small
// models are searched several times with other weights or other centres; the result with the fewest
// splits, then with the fewest cells, is kept.
#include "visuals/draworder/cell_search.h"

#include "visuals/draworder/cell_centres.h"
#include "visuals/draworder/eye_node.h"
#include "visuals/draworder/octant_cells.h"
#include "visuals/draworder/region_tree.h"

#include <array>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// In larger models the octants always meet at the origin.
constexpr std::size_t max_polygons_with_choice = 200;
/// Models with more cyclic edges get one quick search only.
constexpr std::size_t max_edges_searched_again = 2'000;

/// About the work of testing a pair of polygons (SearchBudget).
constexpr std::uint64_t units_of_pair = 300;

/// The searches whose results are compared; the last one only where the others split polygons.
const std::array<TreeSearch, 4> tree_searches{
    {{.forks = {.power = 1.0}, .keeps_part = true},
     {.forks = {.power = 0.5}, .keeps_part = true},
     {.forks = {.power = 1.5}, .keeps_part = true},
     {.planes_first = true, .keeps_part = true}}};
/// Halves first: a plane that only takes something off a large graph leaves nearly all of the work
/// to its children.
const TreeSearch quick_search{
    .forks = {.power = 3.0, .edge_planes = 300, .closer = 48, .exact = 2}, .keeps_part = true};

TreeCost cost_of(const FoundCells& orders) {
    return {orders.work.twins.size(), orders.cells.size()};
}

/// Whether one result is better: whole rather than open, fewer splits, then fewer cells.
bool fewer(const FoundCells& a, const FoundCells& b) {
    return std::pair(!a.open.empty(), cost_of(a)) < std::pair(!b.open.empty(), cost_of(b));
}

void keep_better(std::optional<FoundCells>& best, FoundCells orders) {
    if (!best || fewer(orders, *best)) {
        best = std::move(orders);
    }
}

FoundCells tree_orders(WorkingModel work, const EyeNode& root, const TreeSearch& search) {
    RegionTree tree = region_tree(work, root, search);
    FoundCells out{std::move(work), std::move(tree.nodes), std::move(tree.lists), {}};
    for (std::vector<Plane>& planes : tree.cell_planes) {
        out.cells.push_back({"", std::move(planes)});
    }
    if (!tree.why_open.empty()) {
        out.open = std::move(tree.open);
        out.why_open = std::move(tree.why_open);
    }
    return out;
}

FoundCells cell_orders(WorkingModel work, double min_distance) {
    OctantCells cells = octant_cells(work, min_distance);
    FoundCells out{std::move(work), std::move(cells.nodes), std::move(cells.lists), {}};
    for (std::size_t i = 0; i < cells.paths.size(); ++i) {
        out.cells.push_back({std::move(cells.paths[i]), std::move(cells.cell_planes[i])});
    }
    return out;
}

} // namespace

FoundCells best_tree(
    const models::polygons::PolygonModel& model,
    SearchBudget& budget,
    const std::function<int()>& max_splits) {
    WorkingModel work(model, glm::dvec3(0.0));
    work.budget = &budget;
    work.spend(units_of_pair * model.polygons.size() * model.polygons.size());
    RegionGraphs graphs(work.faces);
    const EyeNode root = eye_node(graphs, EyeRegion::everywhere());
    if (root.cycles.edges > max_edges_searched_again) {
        TreeSearch search = quick_search;
        search.max_splits = max_splits;
        return tree_orders(work, root, search);
    }
    std::optional<FoundCells> best;
    std::optional<SearchGivenUp> beaten;
    for (TreeSearch search : tree_searches) {
        if (best && best->work.twins.empty() && search.planes_first) {
            break;
        }
        search.max_splits = max_splits;
        if (best && best->open.empty()) {
            search.less_than = cost_of(*best);
        }
        search.keeps_part = search.keeps_part && !search.less_than && !beaten;
        try {
            keep_better(best, tree_orders(work, root, search));
        } catch (const SearchGivenUp& given_up) {
            if (given_up.is_beaten) {
                beaten = given_up;
            } else if (!best && !beaten) {
                throw;
            }
        }
    }
    if (!best) {
        throw SearchGivenUp(*beaten);
    }
    return std::move(*best);
}

FoundCells best_cells(
    const models::polygons::PolygonModel& model, double min_distance, SearchBudget& budget) {
    budget.spend(3 * units_of_pair * model.polygons.size() * model.polygons.size());
    std::optional<FoundCells> best;
    const auto centres = cell_centres(WorkingModel(model, glm::dvec3(0.0)));
    for (const glm::dvec3& centre_m : centres) {
        if (best && model.polygons.size() > max_polygons_with_choice) {
            break;
        }
        WorkingModel work(model, centre_m);
        work.budget = &budget;
        try {
            keep_better(best, cell_orders(std::move(work), min_distance));
        } catch (const SearchGivenUp&) {
            if (!best) {
                throw;
            }
        }
    }
    return std::move(*best);
}

} // namespace octant::visuals::draworder
