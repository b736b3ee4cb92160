#include "visuals/draworder/octant_cells.h"

#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/region_tree.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::draworder {

namespace {

constexpr int most_levels = 6;

using Triangle = std::array<glm::dvec3, 3>;

/// The plane through the origin and two points, with a third in front of it.
Plane through_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& in_front) {
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    return {glm::dot(normal, in_front) >= 0.0 ? normal : -normal, 0.0};
}

std::array<Triangle, 4> quarters(const Triangle& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = (a + b) / 2.0;
    const glm::dvec3 bc = (b + c) / 2.0;
    const glm::dvec3 ca = (c + a) / 2.0;
    return {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
}

/// What an octant is part of: all eyes of it that are far enough.
EyeRegion octant_region(const glm::dvec3& signs, double least_distance) {
    EyeRegion region = EyeRegion::everywhere();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = signs[axis];
        region = *region.cut({normal, 0.0});
    }
    return *region.cut({signs / std::sqrt(3.0), -least_distance / std::sqrt(3.0)});
}

class CellBuilder {
public:
    CellBuilder(RegionGraphs& graphs, double least_distance)
        : graphs_(graphs)
        , least_distance_(least_distance) {}

    void build();

    OctantCellsResult result;

private:
    int octants(int first, int axis);
    int divide(const EyeNode& node, const Triangle& corners, const std::string& path, int level);
    int cell(const EyeNode& node, const Triangle& corners, const std::string& path);
    int by_planes(const EyeNode& node, const Triangle& corners, const std::string& path);
    int add_node(const Plane& plane);

    std::vector<DrawOrder::Node>& nodes() { return result.cells.nodes; }

    RegionGraphs& graphs_;
    double least_distance_;
    std::size_t entries_ = 0;
};

int CellBuilder::add_node(const Plane& plane) {
    nodes().push_back({plane, 0, 0});
    return static_cast<int>(nodes().size() - 1);
}

/// Planes of the cone over a triangle.
std::vector<Plane> cone_of(const Triangle& corners) {
    const auto& [a, b, c] = corners;
    return {through_origin(b, c, a), through_origin(c, a, b), through_origin(a, b, c)};
}

int CellBuilder::cell(const EyeNode& node, const Triangle& corners, const std::string& path) {
    result.cells.lists.push_back(list_of(graphs_, node));
    entries_ += result.cells.lists.back().size();
    check_entries(entries_, node.graph.count());
    result.cells.paths.push_back(path);
    result.cells.cell_planes.push_back(cone_of(corners));
    return ~static_cast<int>(result.cells.lists.size() - 1);
}

int CellBuilder::by_planes(const EyeNode& node, const Triangle& corners, const std::string& path) {
    TreeResult tree = region_tree(graphs_, node, {});
    result.deadlock = std::move(tree.deadlock);
    const int first_node = static_cast<int>(nodes().size());
    const int first_cell = static_cast<int>(result.cells.lists.size());
    const auto moved = [&](int child) {
        return child >= 0 ? first_node + child : ~(first_cell + ~child);
    };
    for (const DrawOrder::Node& part : tree.tree.nodes) {
        nodes().push_back({part.plane, moved(part.front), moved(part.back)});
    }
    std::vector<std::vector<Plane>> cuts(tree.tree.lists.size());
    const auto mark = [&](auto&& self, int at, const std::vector<Plane>& so_far) -> void {
        if (at < 0) {
            cuts[static_cast<std::size_t>(~at)] = so_far;
            return;
        }
        const DrawOrder::Node& part = tree.tree.nodes[static_cast<std::size_t>(at)];
        std::vector<Plane> next = so_far;
        next.push_back(part.plane);
        self(self, part.front, next);
        next.back() = {-part.plane.normal, -part.plane.offset_m};
        self(self, part.back, next);
    };
    if (!tree.tree.nodes.empty()) {
        mark(mark, 0, cone_of(corners));
    }
    for (std::size_t i = 0; i < tree.tree.lists.size(); ++i) {
        result.cells.lists.push_back(std::move(tree.tree.lists[i]));
        result.cells.paths.push_back(path);
        result.cells.cell_planes.push_back(std::move(cuts[i]));
    }
    return first_node;
}

/// The number of the node or cell made.
int CellBuilder::divide(
    const EyeNode& node, const Triangle& corners, const std::string& path, int level) {
    if (node.cycles.edges == 0) {
        return cell(node, corners, path);
    }
    result.deadlock = ring_at_eye(graphs_, node);
    if (result.deadlock) {
        return 0;
    }
    if (level == most_levels) {
        return by_planes(node, corners, path);
    }
    const auto parts = quarters(corners);
    std::array<int, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
        at.at(i) =
            add_node(through_origin(parts[3][(i + 1) % 3], parts[3][(i + 2) % 3], corners.at(i)));
    }
    std::array<int, 4> child{};
    for (std::size_t i = 0; i < 4 && !result.deadlock; ++i) {
        EyeRegion part = node.region;
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

/// Signs are told by z, then y, then x, as octant_of() does.
int CellBuilder::octants(int first, int axis) {
    if (axis < 0) {
        const glm::dvec3 signs = octant_signs(first);
        const Triangle corners{{{signs.x, 0.0, 0.0}, {0.0, signs.y, 0.0}, {0.0, 0.0, signs.z}}};
        const EyeNode node = eye_node(graphs_, octant_region(signs, least_distance_));
        return divide(node, corners, octant_name(first), 0);
    }
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    const int at = add_node({normal, 0.0});
    const int front = octants(first, axis - 1);
    const int back = result.deadlock ? 0 : octants(first + (1 << axis), axis - 1);
    nodes()[static_cast<std::size_t>(at)].front = front;
    nodes()[static_cast<std::size_t>(at)].back = back;
    return at;
}

void CellBuilder::build() {
    octants(0, 2);
}

} // namespace

OctantCellsResult octant_cells(RegionGraphs& graphs, double least_distance) {
    CellBuilder builder(graphs, least_distance);
    builder.build();
    return std::move(builder.result);
}

} // namespace octant::visuals::draworder
