// Section IV of the 1989 paper: "divide the viewing directions further until all hidden surfaces are removed", with the
// exact occlusion test in place of the paper's rule.
//
// Octant "sx sy sz" is the flat triangle A = (sx, 0, 0), B = (0, sy, 0), C = (0, 0, sz) as seen from the origin. Where
// its graph has a cycle it is divided at the midpoints of its sides into 0 = (A, AB, CA), 1 = (AB, B, BC),
// 2 = (CA, BC, C), 3 = (BC, CA, AB). A quarter that is still cyclic is divided by planes as in view_space_tree.h: cones
// about one centre cannot approximate a plane that misses the centre, however fine they are, and each further level of
// them makes more cells than it saves.
#include "visuals/orderstudy/divided_octants.h"

#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/view_space_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::visuals::orderstudy {

using namespace draworder;
using models::polygons::PolygonModel;

namespace {

/// Octants are divided into quarters at most so often, then by planes.
constexpr int max_levels = 1;

/// Planes perpendicular to a coordinate axis through the corners of the polygons `among`, each once, those of x before
/// y before z: about `most` of them, spread evenly over all that there are.
std::vector<Plane> axis_planes(const ModelFaces& model, std::span<const std::uint32_t> among, std::size_t most) {
    const auto grains = [](double value) { return std::llround(value / 1e-6); }; // nearer ones count as one
    std::set<std::tuple<long long, long long, long long>> known;
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t polygon : among) {
        for (const glm::dvec3& at : model.faces[polygon].outline) {
            if (known.emplace(grains(at.x), grains(at.y), grains(at.z)).second) { corners.push_back(at); }
        }
    }
    std::set<std::pair<int, long long>> offsets;
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < 3 * corners.size(); i += 3 * corners.size() / most + 1) {
        const auto axis = static_cast<int>(i / corners.size());
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        const double along = corners[i % corners.size()][axis];
        if (offsets.emplace(axis, grains(along)).second) { planes.push_back({normal, -along}); }
    }
    return planes;
}

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

/// The planes of the cone from the origin over a triangle.
std::vector<Plane> cone_of(const OctantTriangle& corners) {
    const auto& [a, b, c] = corners;
    return {through_origin(b, c, a), through_origin(c, a, b), through_origin(a, b, c)};
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

/// Divides the octants about the faces' origin until each cell has an order. Its functions return children as
/// DrawOrder::Node has them: node numbers >= 0 or ~cell.
class OctantDivider {
public:
    OctantDivider(WorkingModel work, double min_distance)
        : min_distance_(min_distance), found_{std::move(work), {}}, graphs_(found_.work.faces) {}

    CellSearchResult divided() {
        octants(0, 2);
        for (std::size_t i = 0; i < found_.tree.lists.size(); ++i) {
            found_.work.add_new_pieces(found_.tree.lists[i], made_at_[i]);
        }
        return std::move(found_);
    }

private:
    /// The subtree of the octants that differ from `first` in the signs of axes 0 to `axis`.
    int octants(int first, int axis) {
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
        found_.tree.nodes[static_cast<std::size_t>(at)].front = front;
        found_.tree.nodes[static_cast<std::size_t>(at)].back = back;
        return at;
    }

    /// The subtree of a cell, which is divided as far as it needs.
    int divide(ViewCell node, const OctantTriangle& corners, const std::string& path, int level) {
        WorkingModel& work = found_.work;
        work.spend(search_units(node));
        if (work.add_new_pieces(node)) { node = part_of(graphs_, node, node.region); }
        while (const auto persistent_cycle = cycle_at_eye(graphs_, node)) {
            work.spend(search_units(node));
            work.resolve(*persistent_cycle);
            work.add_new_pieces(node);
            node = part_of(graphs_, node, node.region);
        }
        if (node.cycles.edges == 0) { return add_cell(list_of(graphs_, node), path, cone_of(corners)); }
        if (level == max_levels) { return by_planes(node, corners, path); }
        const auto parts = subdivided(corners);
        std::array<int, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            at.at(i) = add_node(through_origin(parts[3][(i + 1) % 3], parts[3][(i + 2) % 3], corners.at(i)));
        }
        std::array<int, 4> child{};
        for (std::size_t i = 0; i < 4; ++i) {
            work.add_new_pieces(node);
            ViewRegion part = node.region;
            for (const Plane& plane : cone_of(parts.at(i))) { part = *part.cut(plane); }
            child.at(i) =
                divide(part_of(graphs_, node, std::move(part)), parts.at(i), path + fmt::format("/{}", i), level + 1);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            DrawOrder::Node& made = found_.tree.nodes[static_cast<std::size_t>(at.at(i))];
            made.front = child.at(i);
            made.back = i < 2 ? at.at(i + 1) : child[3];
        }
        return at[0];
    }

    /// The subtree of a quarter that is divided by planes.
    int by_planes(const ViewCell& node, const OctantTriangle& corners, const std::string& path) {
        ViewSpaceTree tree = view_space_tree(found_.work, node, {.plane_search = {.first_planes = axis_planes}});
        const int first_node = static_cast<int>(found_.tree.nodes.size());
        const int first_cell = static_cast<int>(found_.tree.lists.size());
        const auto moved = [&](int child) { return child >= 0 ? first_node + child : ~(first_cell + ~child); };
        for (const DrawOrder::Node& part : tree.nodes) {
            found_.tree.nodes.push_back({part.plane, moved(part.front), moved(part.back)});
        }
        std::vector<std::vector<Plane>> fronts(tree.lists.size());
        const int top = tree.nodes.empty() ? ~0 : 0;
        collect_fronts(tree, top, cone_of(corners), fronts);
        for (std::size_t i = 0; i < tree.lists.size(); ++i) {
            add_cell(std::move(tree.lists[i]), path, std::move(fronts[i]));
        }
        return moved(top);
    }

    int add_node(const Plane& plane) {
        found_.tree.nodes.push_back({plane, 0, 0});
        return static_cast<int>(found_.tree.nodes.size() - 1);
    }

    int add_cell(std::vector<std::uint32_t> list, std::string path, std::vector<Plane> planes) {
        entries_ += list.size();
        check_entries(entries_);
        found_.tree.lists.push_back(std::move(list));
        found_.tree.cells.push_back({std::move(path), std::move(planes)});
        made_at_.push_back(found_.work.faces.faces.size());
        return ~static_cast<int>(found_.tree.lists.size() - 1);
    }

    double min_distance_;
    CellSearchResult found_;
    OcclusionGraphBuilder graphs_;
    std::size_t entries_ = 0;
    std::vector<std::size_t> made_at_; ///< For each cell the number of polygons when it was made.
};

// Where octants should meet. The 1989 paper takes the origin of the object's axes. Its coordinate planes may cut badly
// through the parts of an aircraft; shifted to run between them, they order more pairs, and fewer cells have to be
// divided.

/// At most this many planes of each model are tried.
constexpr std::size_t max_axis_planes = 3'000;
/// In larger models the octants always meet at the origin.
constexpr std::size_t max_polygons_with_choice = 200;
/// About the work of testing a pair of polygons (SearchBudget).
constexpr std::uint64_t units_of_pair = 300;

/// The number of edges that lie on cycles on either side of a plane.
std::size_t left_on_cycles(const Plane& plane, const WorkingModel& work, const CyclicPart& cycles) {
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
        std::size_t fewest = left_on_cycles({normal, 0.0}, work, cycles);
        for (const Plane& plane : axis_planes(work.faces, cycles.polygons, max_axis_planes)) {
            if (plane.normal != normal) { continue; }
            const std::size_t left = left_on_cycles(plane, work, cycles);
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

/// The division with the fewest splits, then the fewest cells, of those about several centres. Throws SearchGivenUp
/// when none finds anything.
CellSearchResult best_division(const PolygonModel& model, double min_distance, SearchBudget& budget) {
    budget.spend(3 * units_of_pair * model.polygons.size() * model.polygons.size());
    std::optional<CellSearchResult> best;
    for (const glm::dvec3& centre_m : cell_centres(WorkingModel(model, glm::dvec3(0.0)))) {
        if (best && model.polygons.size() > max_polygons_with_choice) { break; }
        WorkingModel work(model, centre_m);
        work.budget = &budget;
        try {
            CellSearchResult found = OctantDivider(std::move(work), min_distance).divided();
            if (!best || found.cost() < best->cost()) { best = std::move(found); }
        } catch (const SearchGivenUp&) {
            if (!best) { throw; }
        }
    }
    return std::move(*best);
}

// The lists hold from a distance on. The nearer eyes lie in an octahedron: in each octant behind one of its sides.

constexpr int axes = 3;

class MinDistanceAdder {
public:
    MinDistanceAdder(const DrawOrder& order, const glm::dvec3& centre_m, double distance_m)
        : order_(order), centre_m_(centre_m), distance_m_(distance_m) {}

    DrawOrder limited() {
        copy(0, glm::dvec3(0.0), 0);
        std::vector<std::vector<std::uint32_t>> lists;
        for (int cell = 0; cell < order_.cell_count(); ++cell) {
            const auto list = order_.polygons_of(cell);
            lists.emplace_back(list.begin(), list.end());
        }
        return {std::move(nodes_), lists};
    }

private:
    /// Copies a child; `signs` are those of the octant, as far as the view splits above determine them.
    int copy(int child, const glm::dvec3& signs, int above) {
        if (above == axes) {
            const int made = add({plane_of(signs), 0, DrawOrder::no_child});
            at(made).front = copy(child, signs, above + 1);
            return made;
        }
        if (child < 0) { return child; }
        const DrawOrder::Node node = order_.nodes()[static_cast<std::size_t>(child)];
        assert(node.kind == DrawOrder::Kind::ViewSplit);
        const bool is_octant = above < axes;
        const glm::dvec3 front = is_octant ? signs + node.plane.normal : signs;
        const glm::dvec3 back = is_octant ? signs - node.plane.normal : signs;
        const int made = add(node);
        at(made).front = copy(node.front, front, above + 1);
        at(made).back = copy(node.back, back, above + 1);
        return made;
    }

    /// The octahedron's side in an octant, its front outside.
    Plane plane_of(const glm::dvec3& signs) const {
        const glm::dvec3 normal = signs / std::sqrt(3.0);
        return {normal, -glm::dot(normal, centre_m_) - distance_m_ / std::sqrt(3.0)};
    }

    int add(const DrawOrder::Node& node) {
        nodes_.push_back(node);
        return static_cast<int>(nodes_.size() - 1);
    }

    DrawOrder::Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }

    const DrawOrder& order_;
    glm::dvec3 centre_m_;
    double distance_m_;
    std::vector<DrawOrder::Node> nodes_;
};

} // namespace

DrawOrder with_min_distance(const DrawOrder& order, const glm::dvec3& centre_m, double distance_m) {
    return MinDistanceAdder(order, centre_m, distance_m).limited();
}

OrderedModel ordered_by_cells(PolygonModel model, const OrderOptions& options, double min_distance_radii) {
    OrderSearch search;
    search.find = [&](const PolygonModel& planar, SearchBudget& budget, const std::function<int()>&) {
        return best_division(planar, min_distance_radii, budget);
    };
    search.source = OrderSource::Cells;
    search.keeps_axes = true;
    search.min_distance_radii = min_distance_radii;
    search.proved_order = [](const OrderedModel& found) {
        return with_min_distance(found.order, found.centre_m, found.min_distance_m);
    };
    return ordered_by(std::move(model), options, search);
}

OrderedModel ordered_by_splitting(PolygonModel model, const OrderOptions& options) {
    OrderSearch none;
    none.find = [](const PolygonModel&, SearchBudget&, const std::function<int()>&) -> CellSearchResult {
        throw SearchGivenUp{"", true};
    };
    return ordered_by(std::move(model), options, none);
}

} // namespace octant::visuals::orderstudy
