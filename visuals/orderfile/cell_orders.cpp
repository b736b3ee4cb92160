// Cells as files and checks see them: octants of the eye, their division into four (section IV of the 1989 paper,
// "divide the viewing directions further"), and regions by planes.
#include "visuals/orderfile/cell_orders.h"

#include "sim/base/plane.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/view_region.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace octant::visuals::orderfile {

// From polygon splits to cells: all eyes of a region walk through the tree at once; the region is divided where they
// would go different ways.

namespace {

using draworder::DrawOrder;
using draworder::ViewRegion;

/// Orders of more cells, or of more entries in all lists, stay as they are: with polygon splits.
constexpr std::size_t max_cells_of_parts = 1'000;
constexpr std::size_t max_entries_of_parts = 8'000'000;

/// The eyes of a region on their way through the tree, and what they have painted so far.
struct EyeGroup {
    ViewRegion region;
    std::size_t cuts = 0;
    std::vector<int> pending;
    std::vector<std::uint32_t> list;
};

/// Finds the cells of any order. A plane that splits polygons also divides eye space, so that the cells on both sides
/// of it are combined. Only regions with a volume become cells.
class CellExpander {
public:
    CellExpander(const models::polygons::PolygonModel& model, const DrawOrder& order) : order_(order) {
        const double radius_m = models::polygons::radius_m(model);
        if (radius_m > 0.0) { unit_m_ = radius_m; }
    }

    /// Nothing when there are too many cells.
    std::optional<std::vector<ListedCell>> cells() {
        groups_.push_back({ViewRegion::all_space(), 0, {order_.nodes().empty() ? ~0 : 0}, {}});
        while (!groups_.empty()) {
            EyeGroup group = std::move(groups_.back());
            groups_.pop_back();
            if (!walk(std::move(group))) { return std::nullopt; }
        }
        return std::move(cells_);
    }

private:
    /// Leads a group of eyes to the end of the tree; false when there are too many cells.
    bool walk(EyeGroup group) {
        while (!group.pending.empty()) {
            const int at = group.pending.back();
            group.pending.pop_back();
            if (at == DrawOrder::no_child) { continue; }
            if (at < 0) {
                const auto list = order_.polygons_of(~at);
                group.list.insert(group.list.end(), list.begin(), list.end());
                continue;
            }
            const DrawOrder::Node& node = order_.nodes()[static_cast<std::size_t>(at)];
            if (node.kind == DrawOrder::Kind::Sequence) {
                group.pending.insert(group.pending.end(), {node.back, node.front});
                continue;
            }
            if (!cross(group, node)) { return false; }
        }
        return finish(std::move(group));
    }

    /// Leads a group of eyes past a plane; eyes behind it become a group of their own if others are before it.
    bool cross(EyeGroup& group, const DrawOrder::Node& node) {
        const Plane plane{node.plane.normal, node.plane.offset_m / unit_m_};
        const Plane turned = turned_over(plane);
        const bool some_before = group.region.intersects_front_of(plane);
        const bool some_behind = group.region.intersects_front_of(turned);
        if (some_before && some_behind) {
            if (group.cuts == ViewRegion::max_planes || groups_.size() > max_cells_of_parts) { return false; }
            EyeGroup behind{*group.region.cut(turned), group.cuts + 1, group.pending, group.list};
            go(behind, node, false);
            groups_.push_back(std::move(behind));
            group.region = *group.region.cut(plane);
            ++group.cuts;
        }
        go(group, node, some_before);
        return true;
    }

    static void go(EyeGroup& group, const DrawOrder::Node& node, bool in_front) {
        group.pending.push_back(in_front ? node.front : node.back);
        if (node.kind == DrawOrder::Kind::PolygonSplit) {
            group.pending.push_back(in_front ? node.coplanar_front : node.coplanar_back);
            group.pending.push_back(in_front ? node.back : node.front);
        }
    }

    bool finish(EyeGroup group) {
        entries_ += group.list.size();
        if (cells_.size() == max_cells_of_parts || entries_ > max_entries_of_parts) { return false; }
        ListedCell& cell = cells_.emplace_back();
        for (const Plane& plane : group.region.planes()) {
            cell.planes.push_back({plane.normal, plane.offset_m * unit_m_});
        }
        cell.list = std::move(group.list);
        return true;
    }

    const DrawOrder& order_;
    double unit_m_ = 1.0; ///< Of the regions.
    std::vector<EyeGroup> groups_;
    std::vector<ListedCell> cells_;
    std::size_t entries_ = 0;
};

/// The sine of the angle below which a direction counts as lying in a plane.
constexpr double flat = 1e-9;

Plane plane_through(const glm::dvec3& normal, const glm::dvec3& point_m) {
    return {normal, -glm::dot(normal, point_m)};
}

/// The cell of an octant path about a centre, without its list.
ListedCell cell_of_path(const std::string& path, const glm::dvec3& centre_m) {
    const auto corners = draworder::octant_triangle(path);
    ListedCell cell;
    cell.path = path;
    cell.directions.assign(corners.begin(), corners.end());
    cell.planes = planes_of_cone(corners, centre_m).value();
    return cell;
}

/// The planes of a cell that shares its path with others. All eyes of its octant at the least distance (in L1) lie in
/// one plane, which is added because it helps checks.
std::vector<Plane> planes_within_path(
    const ListedCell& cell, const draworder::OrderCell& from, const glm::dvec3& centre_m) {
    std::vector<Plane> planes = cell.planes;
    planes.insert(planes.end(), from.planes.begin(), from.planes.end());
    glm::dvec3 signs(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        signs[axis] = cell.path[static_cast<std::size_t>(axis)] == '+' ? 1.0 : -1.0;
    }
    const double diagonal = std::sqrt(3.0);
    const glm::dvec3 outward = signs / diagonal;
    planes.push_back({outward, -cell.min_m / diagonal - glm::dot(outward, centre_m)});
    return planes;
}

/// The plane through the points at the least distance along each of three directions. Whatever is farther from the
/// centre, in either metric, lies in front of it, because by the triangle inequality the distances along the directions
/// add up to at least the distance of the sum.
std::optional<Plane> min_distance_plane(const CellOrders& orders, const ListedCell& cell) {
    if (cell.min_m <= 0.0 || cell.directions.size() != 3) { return std::nullopt; }
    glm::dmat3 rows;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& direction = cell.directions[static_cast<std::size_t>(i)];
        rows[i] = direction / length_m(orders.metric, direction);
    }
    const glm::dvec3 normal = glm::inverse(glm::transpose(rows)) * glm::dvec3(1.0);
    const double length = glm::length(normal);
    return Plane{normal / length, -(cell.min_m + glm::dot(normal, orders.centre_m)) / length};
}

/// Adds the sides of the cube and of the octahedron that hold all eyes up to the greatest distance.
void append_greatest_distance(const CellOrders& orders, double max_m, std::vector<Plane>& planes) {
    const double diagonal = std::sqrt(3.0);
    const double octahedron_m = orders.metric == Metric::L1 ? max_m / diagonal : max_m;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 normal = -draworder::octant_signs(octant) / diagonal;
        planes.push_back({normal, octahedron_m - glm::dot(normal, orders.centre_m)});
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0);
            normal[axis] = sign;
            planes.push_back({normal, max_m - glm::dot(normal, orders.centre_m)});
        }
    }
}

} // namespace

double length_m(Metric metric, const glm::dvec3& vector_m) {
    const glm::dvec3 size = glm::abs(vector_m);
    return metric == Metric::L1 ? size.x + size.y + size.z : glm::length(vector_m);
}

CellOrders cell_orders(const draworder::OrderedModel& ordered) {
    CellOrders orders;
    orders.faces = ordered.model.polygons.size();
    orders.parents = ordered.model.parents;
    orders.centre_m = ordered.centre_m;
    if (ordered.cells.empty()) {
        if (auto cells = CellExpander(ordered.model, ordered.order).cells()) {
            orders.cells = std::move(*cells);
        } else {
            orders.parts = ordered.order;
        }
        return orders;
    }
    std::map<std::string, int> cells_of_path;
    for (const draworder::OrderCell& cell : ordered.cells) { ++cells_of_path[cell.path]; }
    for (std::size_t i = 0; i < ordered.cells.size(); ++i) {
        const draworder::OrderCell& from = ordered.cells[i];
        ListedCell cell;
        if (from.path.empty()) {
            cell.planes = from.planes;
        } else {
            orders.metric = Metric::L1;
            cell = cell_of_path(from.path, ordered.centre_m);
            cell.min_m = ordered.min_distance_m;
            if (cells_of_path[from.path] > 1) {
                cell.planes = planes_within_path(cell, from, ordered.centre_m);
                cell.path.clear();
                cell.directions.clear();
            }
        }
        const auto list = ordered.order.polygons_of(static_cast<int>(i));
        cell.list.assign(list.begin(), list.end());
        orders.cells.push_back(std::move(cell));
    }
    return orders;
}

std::optional<std::size_t> cell_of(const CellOrders& orders, const glm::dvec3& eye_m) {
    const double away_m = length_m(orders.metric, eye_m - orders.centre_m);
    for (std::size_t i = 0; i < orders.cells.size(); ++i) {
        const ListedCell& cell = orders.cells[i];
        const bool inside =
            std::ranges::all_of(cell.planes, [&](const Plane& plane) { return distance_m(plane, eye_m) >= 0.0; });
        if (inside && away_m >= cell.min_m && away_m <= cell.max_m) { return i; }
    }
    return std::nullopt;
}

bool in_range(const CellOrders& orders, const glm::dvec3& eye_m) {
    const double away_m = length_m(orders.metric, eye_m - orders.centre_m);
    double min_m = std::numeric_limits<double>::infinity();
    double max_m = 0.0;
    for (const ListedCell& cell : orders.cells) {
        min_m = std::min(min_m, cell.min_m);
        max_m = std::max(max_m, cell.max_m);
    }
    return away_m >= min_m && away_m <= max_m;
}

std::optional<std::vector<Plane>> planes_of_cone(std::span<const glm::dvec3> directions, const glm::dvec3& apex_m) {
    std::vector<Plane> planes;
    bool spans_space = false;
    for (const glm::dvec3& a : directions) {
        for (const glm::dvec3& b : directions) {
            const glm::dvec3 across = glm::cross(glm::normalize(a), glm::normalize(b));
            if (glm::length(across) < flat) { continue; }
            const glm::dvec3 normal = glm::normalize(across);
            bool in_front = true;
            bool some_off = false;
            for (const glm::dvec3& other : directions) {
                const double side = glm::dot(normal, glm::normalize(other));
                in_front = in_front && side >= -flat;
                some_off = some_off || std::abs(side) > flat;
            }
            spans_space = spans_space || some_off;
            const bool known = std::ranges::any_of(
                planes, [&](const Plane& plane) { return glm::distance(plane.normal, normal) < flat; });
            if (in_front && some_off && !known) { planes.push_back(plane_through(normal, apex_m)); }
        }
    }
    return spans_space ? std::optional(planes) : std::nullopt;
}

std::vector<Plane> region_of(const CellOrders& orders, const ListedCell& cell) {
    std::vector<Plane> planes = cell.planes;
    if (const auto least = min_distance_plane(orders, cell)) { planes.push_back(*least); }
    if (std::isfinite(cell.max_m)) { append_greatest_distance(orders, cell.max_m, planes); }
    return planes;
}

} // namespace octant::visuals::orderfile
