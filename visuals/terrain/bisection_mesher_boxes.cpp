// Which triangles of a mesh lie in some box, such as around an aircraft whose shadow they receive or which they may
// hide. A node's triangles and those of all nodes below it follow one another in the mesh, so that whole subtrees are
// accepted or skipped by the box around what is drawn.
#include "visuals/terrain/bisection_mesher.h"

#include <algorithm>

namespace octant::visuals::terrain {

void BisectionMesher::triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    if (has_mesh_) {
        measure_boxes();
        add_triangles_in(root_node, wanted, triangles);
    }
}

void BisectionMesher::measure_boxes() const {
    if (has_mesh_ && !has_drawn_heights_) {
        drawn_heights_.resize(nodes_.size());
        measure_drawn_heights(root_node);
        has_drawn_heights_ = true;
    }
}

/// The children of a node that are drawn; 0 for the others.
BisectionMesher::Four BisectionMesher::drawn_children(const BisectionNode& node) const {
    Four children = node.child;
    for (unsigned q = 0; q < 4; ++q) { children[q] = is_drawn(node, q) ? children[q] : 0; }
    return children;
}

/// Fills in drawn_heights_ for a node and all nodes below it.
void BisectionMesher::measure_drawn_heights(std::uint32_t node) const {
    DrawnHeights heights;
    const auto add = [&](float lowest_m, float highest_m) {
        heights.lowest_m = std::min(heights.lowest_m, lowest_m);
        heights.highest_m = std::max(heights.highest_m, highest_m);
    };
    for_each_in_range(
        triangle_ranges_[node], drawn_children(nodes_[node]),
        [&](std::uint32_t child) { return triangle_ranges_[child]; },
        [&](std::uint32_t triangle) {
            for (std::size_t k = 3 * std::size_t{triangle}; k < 3 * std::size_t{triangle} + 3; ++k) {
                const float z_m = vertices_[indices_[k]].position_m.z;
                add(z_m, z_m);
            }
        },
        [&](std::uint32_t child) {
            measure_drawn_heights(child);
            add(drawn_heights_[child].lowest_m, drawn_heights_[child].highest_m);
        });
    drawn_heights_[node] = heights;
}

void BisectionMesher::add_triangles_in(
    std::uint32_t own, const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const {
    const BisectionNode& node = nodes_[own];
    const FanSamples samples(*ground_, ground_->layout().level(node.level).edge, node.column, node.row);
    const GridSample least = samples.at(0, 0);
    const GridSample most = samples.at(2, 2);
    const glm::dvec2 half_m = ground_->half_extent_m();
    const glm::dvec2 west_south = glm::dvec2(least.column, least.row) * ground_->spacing_m() - half_m;
    const glm::dvec2 east_north = glm::dvec2(most.column, most.row) * ground_->spacing_m() - half_m;
    if (triangle_ranges_[own].first == triangle_ranges_[own].end ||
        !wanted({west_south, static_cast<double>(drawn_heights_[own].lowest_m) + view_.eye_m.z},
            {east_north, static_cast<double>(drawn_heights_[own].highest_m) + view_.eye_m.z})) {
        return;
    }
    for_each_in_range(
        triangle_ranges_[own], drawn_children(node), [&](std::uint32_t child) { return triangle_ranges_[child]; },
        [&](std::uint32_t triangle) { triangles.push_back(triangle); },
        [&](std::uint32_t child) { add_triangles_in(child, wanted, triangles); });
}

} // namespace octant::visuals::terrain
