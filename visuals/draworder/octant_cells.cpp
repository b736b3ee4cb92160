// Method::Cells: the octants of the 1989 paper, divided as its section IV asks, with the exact
// hiding test (hiding.h) instead of the paper's rule. octant_cells.h describes the division.
#include "visuals/draworder/octant_cells.h"

#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/octant_path.h"
#include "visuals/draworder/view_space_tree.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::draworder {

namespace {

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

/// Builds the tree of all octants. Its functions return children as DrawOrder::Node has them: node
/// numbers >= 0 or ~cell.
class CellBuilder {
public:
    CellBuilder(WorkingModel& work, double min_distance)
        : work_(work)
        , graphs_(work.faces)
        , min_distance_(min_distance) {}

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

/// Walks down a tree of planes and collects for each cell the half-spaces that it is the
/// intersection of.
void collect_fronts(
    const ViewSpaceTree& tree,
    int at,
    const std::vector<Plane>& so_far,
    std::vector<std::vector<Plane>>& fronts) {
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

int CellBuilder::by_planes(
    const ViewCell& node, const OctantTriangle& corners, const std::string& path) {
    ViewSpaceTree tree = view_space_tree(work_, node, {.plane_search = {.tries_axis_planes_first = true}});
    const int first_node = static_cast<int>(nodes().size());
    const int first_cell = static_cast<int>(cells.lists.size());
    const auto moved = [&](int child) {
        return child >= 0 ? first_node + child : ~(first_cell + ~child);
    };
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

int CellBuilder::divide(
    ViewCell node, const OctantTriangle& corners, const std::string& path, int level) {
    work_.spend(search_units(node));
    if (work_.add_new_pieces(node)) {
        node = part_of(graphs_, node, node.region);
    }
    while (const auto persistent_cycle = cycle_at_eye(graphs_, node)) {
        work_.spend(search_units(node));
        work_.resolve(*persistent_cycle);
        work_.add_new_pieces(node);
        node = part_of(graphs_, node, node.region);
    }
    if (node.cycles.edges == 0) {
        return add_cell({list_of(graphs_, node), path, cone_of(corners)});
    }
    if (level == max_levels) {
        return by_planes(node, corners, path);
    }
    const auto parts = subdivided(corners);
    std::array<int, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
        at.at(i) =
            add_node(through_origin(parts[3][(i + 1) % 3], parts[3][(i + 2) % 3], corners.at(i)));
    }
    std::array<int, 4> child{};
    for (std::size_t i = 0; i < 4; ++i) {
        work_.add_new_pieces(node);
        ViewRegion part = node.region;
        for (const Plane& plane : cone_of(parts.at(i))) {
            part = *part.cut(plane);
        }
        child.at(i) = divide(
            part_of(graphs_, node, std::move(part)),
            parts.at(i),
            path + fmt::format("/{}", i),
            level + 1);
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
        const OctantTriangle corners{
            {{signs.x, 0.0, 0.0}, {0.0, signs.y, 0.0}, {0.0, 0.0, signs.z}}};
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
    for (std::size_t i = 0; i < cells.lists.size(); ++i) {
        work_.add_new_pieces(cells.lists[i], made_at_[i]);
    }
}

} // namespace

OctantCells octant_cells(WorkingModel& work, double min_distance) {
    CellBuilder builder(work, min_distance);
    builder.build();
    return std::move(builder.cells);
}

} // namespace octant::visuals::draworder
