#pragma once

#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace octant::models::measure {

/// The point of a mesh nearest to a given one.
struct NearestOnMesh {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t triangle = none; ///< none: nothing is as near as was asked for
    glm::dvec3 point{0.0};
    glm::dvec3 weights{0.0}; ///< of the triangle's corners, in its own order
    double distance2 = std::numeric_limits<double>::infinity(); ///< square of the distance
};

/// A tree of boxes over the triangles of a mesh, for exact nearest points. Keeps copies of the
/// corners: the mesh may change or go. Constant once built: many threads may ask at once.
class TriangleBvh {
public:
    explicit TriangleBvh(const TriangleMesh& mesh);
    TriangleBvh(std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles);

    /// The nearest point of all triangles, degenerate ones too, that is at most `within_m` away;
    /// of several at the same distance the triangle of the lowest index.
    NearestOnMesh nearest(
        const glm::dvec3& point, double within_m = std::numeric_limits<double>::infinity()) const;

    /// Calls `take(triangle)` for every triangle that may be at most `within_m` from the point: all
    /// that are, and some that are a little farther, in an order of the tree's.
    template <typename Take>
    void for_each_near(const glm::dvec3& point, double within_m, const Take& take) const;

    /// Distances from points among the mesh are wrong by less than this, metres: rounding.
    double rounding_m() const { return rounding_m_; }

private:
    /// A box around triangles, rounded outwards, relative to centre_.
    struct Box {
        std::array<float, 3> least;
        std::array<float, 3> most;
        std::uint32_t first = 0; ///< triangle of leaves, else node
        std::uint32_t count = 0; ///< of a leaf's triangles; 0: a node
    };

    /// One cache line.
    struct alignas(64) Node {
        std::array<Box, 2> halves;
    };

    struct Builder;
    struct Search;

    static double box_distance2(const Box& box, const glm::dvec3& point);
    void search_leaf(const Box& leaf, const glm::dvec3& point, Search& search) const;

    /// Deeper than any tree that Builder makes.
    static constexpr int most_depth = 128;

    std::vector<Node> nodes_; ///< the first is the root; none: no triangles
    std::vector<std::array<glm::dvec3, 3>> corners_;
    std::vector<std::uint32_t> triangles_; ///< which triangle has these corners
    glm::dvec3 centre_{0.0};
    double rounding_m_ = 0.0;
};

template <typename Take>
void TriangleBvh::for_each_near(const glm::dvec3& point, double within_m, const Take& take) const {
    if (nodes_.empty()) {
        return;
    }
    const glm::dvec3 local = point - centre_;
    const double reach2 = std::min(within_m * within_m, std::numeric_limits<double>::max());
    std::array<std::uint32_t, most_depth> waiting{};
    std::size_t count = 1;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        for (const Box& box : node.halves) {
            if (!(box_distance2(box, local) <= reach2)) {
                continue;
            }
            if (box.count == 0) {
                waiting[count++] = box.first;
            }
            for (std::uint32_t i = 0; i < box.count; ++i) {
                take(triangles_[box.first + i]);
            }
        }
    }
}

inline double TriangleBvh::box_distance2(const Box& box, const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = point[static_cast<int>(axis)];
        const double below = static_cast<double>(box.least[axis]) - value;
        const double above = value - static_cast<double>(box.most[axis]);
        const double away = below > above ? below : above;
        sum += away > 0.0 ? away * away : 0.0;
    }
    return sum;
}

} // namespace octant::models::measure
