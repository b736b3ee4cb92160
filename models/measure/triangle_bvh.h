#pragma once

#include "models/measure/plane_frame.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

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
/// Boxes and triangles are passed over in single precision, four at once, by distances less what
/// rounding can make of them; what is left is measured in double precision. Takes some 220 bytes a
/// triangle.
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
    static constexpr std::size_t lanes = 4;
    using Floats = float __attribute__((vector_size(4 * lanes)));

    /// Four boxes, in units of the mesh's size around its centre.
    struct Node {
        std::array<Floats, 3> least;
        std::array<Floats, 3> most;
        std::array<std::uint32_t, lanes> below; ///< a node, or a leaf's number with leaf_bit
    };

    /// Up to four triangles; the last one again where there are fewer.
    struct Leaf {
        PlaneFrame<Floats> frames;
        std::uint32_t first = 0; ///< of corners_m_ and triangles_
        std::uint32_t count = 0;
    };

    /// A point, and how far to look, in units of the mesh's size.
    struct Probe {
        std::array<Floats, 3> place; ///< four times the same
        double slack = 0.0;          ///< distances in single precision are wrong by less
        float reach2 = 0.0F;         ///< nothing farther is looked at

        void set_reach(double distance);
    };

    struct Builder;
    struct Search;

    Probe probe(const glm::dvec3& point_m) const;
    /// Squares of distances, in units of the mesh's size.
    static void box_distances2(Floats& distances2, const Node& node, const Probe& probe);
    static void triangle_distances2(Floats& distances2, const Leaf& leaf, const Probe& probe);
    void search_leaf(const Leaf& leaf, const glm::dvec3& point_m, Search& search) const;

    static constexpr std::uint32_t leaf_bit = 1U << 31U;
    /// More than any tree that Builder makes lets wait.
    static constexpr int most_waiting = 256;

    std::vector<Node> nodes_; ///< the first is the root; none: no triangles
    std::vector<Leaf> leaves_;
    std::vector<std::array<glm::dvec3, 3>> corners_m_;
    std::vector<std::uint32_t> triangles_; ///< which triangle has these corners
    glm::dvec3 centre_m_{0.0};
    double per_size_ = 1.0; ///< 1 / half of the longest side of the mesh's box
    double rounding_m_ = 0.0;
};

template <typename Take>
void TriangleBvh::for_each_near(const glm::dvec3& point, double within_m, const Take& take) const {
    if (nodes_.empty()) {
        return;
    }
    Probe here = probe(point);
    here.set_reach(within_m * per_size_);
    std::array<std::uint32_t, most_waiting> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    Floats distances2;
    while (count > 0) {
        const std::uint32_t next = waiting[--count];
        if ((next & leaf_bit) == 0) {
            const Node& node = nodes_[next];
            box_distances2(distances2, node, here);
            for (std::size_t i = 0; i < lanes; ++i) {
                if (distances2[i] <= here.reach2) {
                    waiting[count++] = node.below[i];
                }
            }
            continue;
        }
        const Leaf& leaf = leaves_[next & ~leaf_bit];
        triangle_distances2(distances2, leaf, here);
        for (std::size_t i = 0; i < leaf.count; ++i) {
            if (distances2[i] <= here.reach2) {
                take(triangles_[leaf.first + i]);
            }
        }
    }
}

OCTANT_INLINE void
TriangleBvh::box_distances2(Floats& distances2, const Node& node, const Probe& probe) {
    distances2 = Floats{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Floats below = node.least[axis] - probe.place[axis];
        const Floats above = probe.place[axis] - node.most[axis];
        Floats away = below > above ? below : above;
        away = away > 0.0F ? away : Floats{};
        distances2 += away * away;
    }
}

OCTANT_INLINE void
TriangleBvh::triangle_distances2(Floats& distances2, const Leaf& leaf, const Probe& probe) {
    FramePoints<Floats> found;
    find_in_frame<false>(found, probe.place, leaf.frames);
    distances2 = found.distance2;
}

} // namespace octant::models::measure
