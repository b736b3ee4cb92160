// The searches for cells, and the selection among their results. As the searches are greedy, small models are searched
// several times with other weights or other centres; the result with the fewest splits, then with the fewest cells, is
// kept.
#include "visuals/draworder/cell_search.h"

#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/view_space_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

// OrderMethod::Cells: the octants of the 1989 paper, divided as its section IV asks, with the exact occlusion test
// instead of the paper's rule. octant_cells() describes the division.

/// The octants about the faces' origin, each divided until its cells have orders. Planes are in the faces' space.
struct OctantCells {
    std::vector<DrawOrder::Node> nodes; ///< Node 0 is the root; children come after their parents.
    std::vector<std::vector<std::uint32_t>> lists;
    /// Such as "+-+/0/3"; cells that were divided by planes share one.
    std::vector<std::string> paths;
    std::vector<std::vector<Plane>> cell_planes; ///< Without the plane of the least distance.
};

/// Octants are divided into quarters at most so often, then by planes.
constexpr int max_levels = 1;

/// The plane through the origin and two points, oriented so that a third point is in front of it.
Plane through_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& in_front) {
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    return {glm::dot(normal, in_front) >= 0.0 ? normal : -normal, 0.0};
}

/// The region of an octant's eyes from the least distance on.
ViewRegion octant_region(const glm::dvec3& signs, double min_distance) {
    ViewRegion region = ViewRegion::all_space();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = signs[axis];
        region = *region.cut({normal, 0.0});
    }
    return *region.cut({signs / std::sqrt(3.0), -min_distance / std::sqrt(3.0)});
}

/// A finished cell.
struct Cell {
    std::vector<std::uint32_t> list;
    std::string path;
    std::vector<Plane> planes;
};

/// Builds the tree of all octants. Its functions return children as DrawOrder::Node has them: node numbers >= 0 or
/// ~cell.
class CellBuilder {
public:
    CellBuilder(WorkingModel& work, double min_distance)
        : work_(work), graphs_(work.faces), min_distance_(min_distance) {}

    void build();

    OctantCells cells;

private:
    /// The subtree of the octants that differ from `first` in the signs of axes 0 to `axis`.
    int octants(int first, int axis);
    /// The subtree of a cell, which is divided as far as it needs.
    int divide(ViewCell node, const OctantTriangle& corners, const std::string& path, int level);
    int add_cell(Cell cell);
    /// The subtree of a quarter that is divided by planes.
    int by_planes(const ViewCell& node, const OctantTriangle& corners, const std::string& path);
    int add_node(const Plane& plane);

    std::vector<DrawOrder::Node>& nodes() { return cells.nodes; }

    WorkingModel& work_;
    OcclusionGraphBuilder graphs_;
    double min_distance_;
    std::size_t entries_ = 0;
    std::vector<std::size_t> made_at_; ///< For each cell the number of polygons when it was made.
};

int CellBuilder::add_node(const Plane& plane) {
    nodes().push_back({plane, 0, 0});
    return static_cast<int>(nodes().size() - 1);
}

/// The planes of the cone from the origin over a triangle.
std::vector<Plane> cone_of(const OctantTriangle& corners) {
    const auto& [a, b, c] = corners;
    return {through_origin(b, c, a), through_origin(c, a, b), through_origin(a, b, c)};
}

int CellBuilder::add_cell(Cell cell) {
    entries_ += cell.list.size();
    check_entries(entries_);
    cells.lists.push_back(std::move(cell.list));
    cells.paths.push_back(std::move(cell.path));
    cells.cell_planes.push_back(std::move(cell.planes));
    made_at_.push_back(work_.faces.faces.size());
    return ~static_cast<int>(cells.lists.size() - 1);
}

/// Walks down a tree of planes and collects for each cell the half-spaces that it is the intersection of.
void collect_fronts(
    const ViewSpaceTree& tree, int at, const std::vector<Plane>& so_far, std::vector<std::vector<Plane>>& fronts) {
    if (at < 0) {
        fronts[static_cast<std::size_t>(~at)] = so_far;
        return;
    }
    const DrawOrder::Node& node = tree.nodes[static_cast<std::size_t>(at)];
    std::vector<Plane> next = so_far;
    next.push_back(node.plane);
    collect_fronts(tree, node.front, next, fronts);
    next.back() = {-node.plane.normal, -node.plane.offset_m};
    collect_fronts(tree, node.back, next, fronts);
}

int CellBuilder::by_planes(const ViewCell& node, const OctantTriangle& corners, const std::string& path) {
    ViewSpaceTree tree = view_space_tree(work_, node, {.plane_search = {.tries_axis_planes_first = true}});
    const int first_node = static_cast<int>(nodes().size());
    const int first_cell = static_cast<int>(cells.lists.size());
    const auto moved = [&](int child) { return child >= 0 ? first_node + child : ~(first_cell + ~child); };
    for (const DrawOrder::Node& part : tree.nodes) {
        nodes().push_back({part.plane, moved(part.front), moved(part.back)});
    }
    std::vector<std::vector<Plane>> fronts(tree.lists.size());
    const int top = tree.nodes.empty() ? ~0 : 0;
    collect_fronts(tree, top, cone_of(corners), fronts);
    for (std::size_t i = 0; i < tree.lists.size(); ++i) {
        add_cell({std::move(tree.lists[i]), path, std::move(fronts[i])});
    }
    return moved(top);
}

int CellBuilder::divide(ViewCell node, const OctantTriangle& corners, const std::string& path, int level) {
    work_.spend(search_units(node));
    if (work_.add_new_pieces(node)) { node = part_of(graphs_, node, node.region); }
    while (const auto persistent_cycle = cycle_at_eye(graphs_, node)) {
        work_.spend(search_units(node));
        work_.resolve(*persistent_cycle);
        work_.add_new_pieces(node);
        node = part_of(graphs_, node, node.region);
    }
    if (node.cycles.edges == 0) { return add_cell({list_of(graphs_, node), path, cone_of(corners)}); }
    if (level == max_levels) { return by_planes(node, corners, path); }
    const auto parts = subdivided(corners);
    std::array<int, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
        at.at(i) = add_node(through_origin(parts[3][(i + 1) % 3], parts[3][(i + 2) % 3], corners.at(i)));
    }
    std::array<int, 4> child{};
    for (std::size_t i = 0; i < 4; ++i) {
        work_.add_new_pieces(node);
        ViewRegion part = node.region;
        for (const Plane& plane : cone_of(parts.at(i))) { part = *part.cut(plane); }
        child.at(i) =
            divide(part_of(graphs_, node, std::move(part)), parts.at(i), path + fmt::format("/{}", i), level + 1);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        DrawOrder::Node& made = nodes()[static_cast<std::size_t>(at.at(i))];
        made.front = child.at(i);
        made.back = i < 2 ? at.at(i + 1) : child[3];
    }
    return at[0];
}

int CellBuilder::octants(int first, int axis) {
    if (axis < 0) {
        const glm::dvec3 signs = octant_signs(first);
        const OctantTriangle corners{{{signs.x, 0.0, 0.0}, {0.0, signs.y, 0.0}, {0.0, 0.0, signs.z}}};
        const ViewRegion region = octant_region(signs, min_distance_);
        return divide(view_cell(graphs_, region), corners, octant_name(first), 0);
    }
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    const int at = add_node({normal, 0.0});
    const int front = octants(first, axis - 1);
    const int back = octants(first + (1 << axis), axis - 1);
    nodes()[static_cast<std::size_t>(at)].front = front;
    nodes()[static_cast<std::size_t>(at)].back = back;
    return at;
}

void CellBuilder::build() {
    octants(0, 2);
    for (std::size_t i = 0; i < cells.lists.size(); ++i) { work_.add_new_pieces(cells.lists[i], made_at_[i]); }
}

/// Section IV of the 1989 paper: "divide the viewing directions further until all hidden surfaces are removed". The
/// lists are right for eyes with |x| + |y| + |z| >= min_distance from the origin.
///
/// Octant "sx sy sz" is the flat triangle A = (sx, 0, 0), B = (0, sy, 0), C = (0, 0, sz) as seen from the origin. Where
/// its graph has a cycle it is divided at the midpoints of its sides into 0
/// = (A, AB, CA), 1 = (AB, B, BC), 2 = (CA, BC, C), 3 = (BC, CA, AB). A quarter that is still
/// cyclic is divided by planes as in view_space_tree.h: cones about one centre cannot approximate a plane that misses
/// the centre, however fine they are, and each further level of them makes more cells than it saves.
///
/// Splits polygons of the model where there is no order otherwise. Throws SearchGivenUp (search_budget.h) when there
/// are more cells than can be held, or when a budget is spent.
OctantCells octant_cells(WorkingModel& work, double min_distance) {
    CellBuilder builder(work, min_distance);
    builder.build();
    return std::move(builder.cells);
}

// Where octants should meet. The 1989 paper takes the origin of the object's axes. Its coordinate planes may cut badly
// through the parts of an aircraft; shifted to run between them, they order more pairs, and fewer cells have to be
// divided.

/// At most this many planes of each model are tried.
constexpr std::size_t max_axis_planes = 3'000;

/// The number of edges that lie on cycles on either side of a plane.
std::size_t left_on_rings(const Plane& plane, const WorkingModel& work, const CyclicPart& cycles) {
    const PolygonsByPlaneSide sides = sides_of(plane, work.faces, cycles.polygons);
    const auto& [front, back] = sides.sets;
    CyclicEdgeCounter counter;
    return counter.count(cycles.inner, cycles.polygons, back, front, sides.back_facing_in_front) +
           counter.count(cycles.inner, cycles.polygons, front, back, sides.back_facing_behind);
}

/// The best coordinate along each axis, in the faces' space.
glm::dvec3 best_coordinates(const WorkingModel& work, const CyclicPart& cycles) {
    glm::dvec3 best(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        std::size_t fewest = left_on_rings({normal, 0.0}, work, cycles);
        for (const Plane& plane : axis_planes(work.faces, cycles.polygons, max_axis_planes)) {
            if (plane.normal != normal) { continue; }
            const std::size_t left = left_on_rings(plane, work, cycles);
            if (left < fewest) {
                fewest = left;
                best[axis] = -plane.offset_m;
            }
        }
    }
    return best;
}

/// The centre of the bounding box, body axes.
glm::dvec3 middle_m(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(-std::numeric_limits<double>::max());
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    return (least + most) / 2.0;
}

/// Points at which the octants may meet so that few cells are needed, in body axes, metres; the origin comes first. On
/// each axis they have 0 or the coordinate whose plane leaves the fewest cyclic edges on both of its sides; the last
/// one is the centre of the bounding box. The faces of `work` must be about the origin.
std::vector<glm::dvec3> cell_centres(const WorkingModel& work) {
    OcclusionGraphBuilder graphs(work.faces);
    const ViewCell root = view_cell(graphs, ViewRegion::all_space());
    const glm::dvec3 best_m = best_coordinates(work, root.cycles) * work.faces.unit_m;
    std::vector<glm::dvec3> centres;
    const auto add = [&](const glm::dvec3& centre_m) {
        if (std::ranges::find(centres, centre_m) == centres.end()) { centres.push_back(centre_m); }
    };
    for (int mask = 0; mask < 8; ++mask) {
        glm::dvec3 centre_m(0.0);
        for (int axis = 0; axis < 3; ++axis) { centre_m[axis] = (mask >> axis) % 2 == 0 ? 0.0 : best_m[axis]; }
        add(centre_m);
    }
    add(middle_m(work.model));
    return centres;
}

/// In larger models the octants always meet at the origin.
constexpr std::size_t max_polygons_with_choice = 200;
/// Models with more cyclic edges get one quick search only.
constexpr std::size_t max_edges_searched_again = 2'000;

/// About the work of testing a pair of polygons (SearchBudget).
constexpr std::uint64_t units_of_pair = 300;

/// The searches whose results are compared; the last one only where the others split polygons.
const std::array<TreeSearch, 4> tree_searches{{{.plane_search = {.power = 1.0}, .keeps_partial_result = true},
    {.plane_search = {.power = 0.5}, .keeps_partial_result = true},
    {.plane_search = {.power = 1.5}, .keeps_partial_result = true},
    {.prefers_planes = true, .keeps_partial_result = true}}};
/// Halves first: a plane that only takes something off a large graph leaves nearly all of the work to its children.
const TreeSearch quick_search{.plane_search = {.power = 3.0, .edge_planes = 300, .coarse_candidates = 48, .exact = 2},
    .keeps_partial_result = true};

TreeCost cost_of(const CellSearchResult& orders) { return {orders.work.sibling_pieces.size(), orders.cells.size()}; }

/// Whether one result is better: whole rather than open, fewer splits, then fewer cells.
bool has_fewer_splits(const CellSearchResult& a, const CellSearchResult& b) {
    return std::pair(!a.incomplete_cells.empty(), cost_of(a)) < std::pair(!b.incomplete_cells.empty(), cost_of(b));
}

void keep_better(std::optional<CellSearchResult>& best, CellSearchResult orders) {
    if (!best || has_fewer_splits(orders, *best)) { best = std::move(orders); }
}

CellSearchResult tree_orders(WorkingModel work, const ViewCell& root, const TreeSearch& search) {
    ViewSpaceTree tree = view_space_tree(work, root, search);
    CellSearchResult out{std::move(work), std::move(tree.nodes), std::move(tree.lists), {}};
    for (std::vector<Plane>& planes : tree.cell_planes) { out.cells.push_back({"", std::move(planes)}); }
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
    const models::polygons::PolygonModel& model, SearchBudget& budget, const std::function<int()>& max_splits) {
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
        if (best && best->work.sibling_pieces.empty() && search.prefers_planes) { break; }
        search.max_splits = max_splits;
        if (best && best->incomplete_cells.empty()) { search.cost_limit = cost_of(*best); }
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
    if (!best) { throw SearchGivenUp(*beaten); }
    return std::move(*best);
}

CellSearchResult best_cells(const models::polygons::PolygonModel& model, double min_distance, SearchBudget& budget) {
    budget.spend(3 * units_of_pair * model.polygons.size() * model.polygons.size());
    std::optional<CellSearchResult> best;
    const auto centres = cell_centres(WorkingModel(model, glm::dvec3(0.0)));
    for (const glm::dvec3& centre_m : centres) {
        if (best && model.polygons.size() > max_polygons_with_choice) { break; }
        WorkingModel work(model, centre_m);
        work.budget = &budget;
        try {
            keep_better(best, cell_orders(std::move(work), min_distance));
        } catch (const SearchGivenUp&) {
            if (!best) { throw; }
        }
    }
    return std::move(*best);
}

} // namespace octant::visuals::draworder
