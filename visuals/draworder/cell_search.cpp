// The searches for cells, and the choice among their results. As the searches are greedy, small
// models are searched several times with other weights or other centres; the result with the fewest
// splits, then with the fewest cells, is kept.
#include "visuals/draworder/cell_search.h"

#include "visuals/draworder/cell_centres.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/octant_cells.h"
#include "visuals/draworder/view_space_tree.h"

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
    {{.plane_search = {.power = 1.0}, .keeps_partial_result = true},
     {.plane_search = {.power = 0.5}, .keeps_partial_result = true},
     {.plane_search = {.power = 1.5}, .keeps_partial_result = true},
     {.prefers_planes = true, .keeps_partial_result = true}}};
/// Halves first: a plane that only takes something off a large graph leaves nearly all of the work
/// to its children.
const TreeSearch quick_search{
    .plane_search = {.power = 3.0, .edge_planes = 300, .coarse_candidates = 48, .exact = 2}, .keeps_partial_result = true};

TreeCost cost_of(const CellSearchResult& orders) {
    return {orders.work.sibling_pieces.size(), orders.cells.size()};
}

/// Whether one result is better: whole rather than open, fewer splits, then fewer cells.
bool has_fewer_splits(const CellSearchResult& a, const CellSearchResult& b) {
    return std::pair(!a.incomplete_cells.empty(), cost_of(a)) < std::pair(!b.incomplete_cells.empty(), cost_of(b));
}

void keep_better(std::optional<CellSearchResult>& best, CellSearchResult orders) {
    if (!best || has_fewer_splits(orders, *best)) {
        best = std::move(orders);
    }
}

CellSearchResult tree_orders(WorkingModel work, const ViewCell& root, const TreeSearch& search) {
    ViewSpaceTree tree = view_space_tree(work, root, search);
    CellSearchResult out{std::move(work), std::move(tree.nodes), std::move(tree.lists), {}};
    for (std::vector<Plane>& planes : tree.cell_planes) {
        out.cells.push_back({"", std::move(planes)});
    }
    if (!tree.incomplete_reason.empty()) {
        out.incomplete_cells = std::move(tree.incomplete_cells);
        out.incomplete_reason = std::move(tree.incomplete_reason);
    }
    return out;
}

CellSearchResult cell_orders(WorkingModel work, double min_distance) {
    OctantCells cells = octant_cells(work, min_distance);
    CellSearchResult out{std::move(work), std::move(cells.nodes), std::move(cells.lists), {}};
    for (std::size_t i = 0; i < cells.paths.size(); ++i) {
        out.cells.push_back({std::move(cells.paths[i]), std::move(cells.cell_planes[i])});
    }
    return out;
}

} // namespace

CellSearchResult best_tree(
    const models::polygons::PolygonModel& model,
    SearchBudget& budget,
    const std::function<int()>& max_splits) {
    WorkingModel work(model, glm::dvec3(0.0));
    work.budget = &budget;
    work.spend(units_of_pair * model.polygons.size() * model.polygons.size());
    OcclusionGraphBuilder graphs(work.faces);
    const ViewCell root = view_cell(graphs, ViewRegion::all_space());
    if (root.cycles.edges > max_edges_searched_again) {
        TreeSearch search = quick_search;
        search.max_splits = max_splits;
        return tree_orders(work, root, search);
    }
    std::optional<CellSearchResult> best;
    std::optional<SearchGivenUp> beaten;
    for (TreeSearch search : tree_searches) {
        if (best && best->work.sibling_pieces.empty() && search.prefers_planes) {
            break;
        }
        search.max_splits = max_splits;
        if (best && best->incomplete_cells.empty()) {
            search.cost_limit = cost_of(*best);
        }
        search.keeps_partial_result = search.keeps_partial_result && !search.cost_limit && !beaten;
        try {
            keep_better(best, tree_orders(work, root, search));
        } catch (const SearchGivenUp& given_up) {
            if (given_up.is_worse_than_best) {
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

CellSearchResult best_cells(
    const models::polygons::PolygonModel& model, double min_distance, SearchBudget& budget) {
    budget.spend(3 * units_of_pair * model.polygons.size() * model.polygons.size());
    std::optional<CellSearchResult> best;
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
