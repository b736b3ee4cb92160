#pragma once

#include "models/measure/plane_frame.h"
#include "models/triangle_mesh.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::measure {

/// The point of a triangle that is nearest to a given one.
struct NearestOnTriangle {
    glm::dvec3 point{0.0};
    glm::dvec3 weights{0.0}; ///< Barycentric: those of the corners, none negative, with the sum 1.
    double distance2 = 0.0;  ///< The square of the distance.
};

namespace detail {

/// Replaces `found` by the nearest point of the segment from corner i to corner j if that is nearer to the origin. The
/// nearest point of a segment without length is its first end.
inline void update_from_edge(const std::array<glm::dvec3, 3>& corners, int i, int j, NearestOnTriangle& found) {
    const glm::dvec3& start = corners[static_cast<std::size_t>(i)];
    const glm::dvec3& end = corners[static_cast<std::size_t>(j)];
    const glm::dvec3 edge = end - start;
    const double length2 = glm::dot(edge, edge);
    const double along = length2 > 0.0 ? std::clamp(-glm::dot(start, edge) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 point = along < 1.0 ? start + along * edge : end;
    const double distance2 = glm::dot(point, point);
    if (distance2 < found.distance2) {
        found = {point, glm::dvec3(0.0), distance2};
        found.weights[i] = 1.0 - along;
        found.weights[j] = along;
    }
}

/// Whether a corner is the point of its triangle nearest to the origin: both edges at it lead away from the origin.
inline bool is_at_corner(const glm::dvec3& corner, const glm::dvec3& to_one, const glm::dvec3& to_other) {
    return glm::dot(corner, to_one) >= 0.0 && glm::dot(corner, to_other) >= 0.0;
}

/// The point of a triangle's plane that is nearest to the origin, as barycentric weights.
struct NearestInPlane {
    glm::dvec3 weights{-1.0};
    bool uncertain = true; ///< The triangle is nearly a line, and the weights may be wrong.
};

/// The nearest point in the plane of a triangle whose longest edge `base` runs from corner 0 to corner 1. It is found
/// along that edge and along the height over it, which keeps its accuracy for thin triangles. The weights are in the
/// order of the corners.
inline NearestInPlane nearest_over_base(
    const glm::dvec3& from, const glm::dvec3& base, const glm::dvec3& side, double base2) {
    const double foot = glm::dot(side, base) / base2;
    const glm::dvec3 height = side - foot * base;
    const double height2 = glm::dot(height, height);
    if (!(height2 > 0.0)) { return {}; }
    const double along = -glm::dot(from, base) / base2;
    const double up = -glm::dot(from + along * base, height) / height2;
    const double end = along - up * foot;
    return {{1.0 - up - end, end, up}, height2 < 1e-12 * base2};
}

/// The nearest point in a triangle's plane: calls nearest_over_base with the longest edge as the base.
inline NearestInPlane nearest_in_plane(
    const std::array<glm::dvec3, 3>& corners, const glm::dvec3& ab, const glm::dvec3& bc, const glm::dvec3& ca) {
    const double ab2 = glm::dot(ab, ab);
    const double bc2 = glm::dot(bc, bc);
    const double ca2 = glm::dot(ca, ca);
    if (ca2 > std::max(ab2, bc2)) {
        const NearestInPlane found = nearest_over_base(corners[2], ca, -bc, ca2);
        return {{found.weights.y, found.weights.z, found.weights.x}, found.uncertain};
    }
    if (bc2 > ab2) {
        const NearestInPlane found = nearest_over_base(corners[1], bc, -ab, bc2);
        return {{found.weights.z, found.weights.x, found.weights.y}, found.uncertain};
    }
    return ab2 > 0.0 ? nearest_over_base(corners[0], ab, -ca, ab2) : NearestInPlane{};
}

/// nearest_on_triangle for the origin.
inline NearestOnTriangle nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 bc = c - b;
    const glm::dvec3 ca = a - c;
    const NearestInPlane plane = nearest_in_plane(corners, ab, bc, ca);
    const glm::dvec3& weights = plane.weights;
    NearestOnTriangle found{a, {1.0, 0.0, 0.0}, glm::dot(a, a)};
    if (weights.x > 0.0 && weights.y > 0.0 && weights.z > 0.0) {
        const glm::dvec3 point = weights.x * a + weights.y * b + weights.z * c;
        const NearestOnTriangle inside{point, weights, glm::dot(point, point)};
        if (!plane.uncertain) { return inside; }
        found = inside.distance2 < found.distance2 ? inside : found;
    }
    if (is_at_corner(a, ab, -ca)) { return {a, {1.0, 0.0, 0.0}, glm::dot(a, a)}; }
    if (is_at_corner(b, bc, -ab)) { return {b, {0.0, 1.0, 0.0}, glm::dot(b, b)}; }
    if (is_at_corner(c, ca, -bc)) { return {c, {0.0, 0.0, 1.0}, glm::dot(c, c)}; }
    if (plane.uncertain || !(weights.z > 0.0)) { update_from_edge(corners, 0, 1, found); }
    if (plane.uncertain || !(weights.x > 0.0)) { update_from_edge(corners, 1, 2, found); }
    if (plane.uncertain || !(weights.y > 0.0)) { update_from_edge(corners, 2, 0, found); }
    return found;
}

} // namespace detail

/// The point of the triangle a, b, c, which includes its edges and corners, that is nearest to `point`. Computed with
/// edge vectors and relative to `point`, so that neither a far origin nor triangles without area or length spoil it.
/// The found point lies on the triangle, so that the distance is never below the true one by more than rounding.
inline NearestOnTriangle nearest_on_triangle(
    const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    NearestOnTriangle found = detail::nearest_to_origin({a - point, b - point, c - point});
    found.point += point;
    return found;
}

/// The point of a mesh that is nearest to a given one.
struct NearestOnMesh {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// The index of its triangle; none = nothing is as near as was asked for.
    std::uint32_t triangle = none;
    glm::dvec3 point{0.0};
    /// The barycentric weights of the triangle's corners, in its own order.
    glm::dvec3 weights{0.0};
    double distance2 = std::numeric_limits<double>::infinity(); ///< The square of the distance.
};

/// A bounding volume hierarchy over the triangles of a mesh, for exact nearest points. It copies the corners, so that
/// the mesh may change or go. It is constant once built, and many threads may ask at the same time.
///
/// Boxes and triangles are first compared in single precision, four at a time, by lower bounds of their distances: what
/// the rounding can be at most is subtracted. Only what passes is measured in double precision. It takes some 100 bytes
/// a triangle.
class TriangleBvh {
public:
    explicit TriangleBvh(const TriangleMesh& mesh);
    TriangleBvh(std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles);

    /// The nearest point of all triangles, degenerate ones included, that is at most `within_m` away. Of several
    /// triangles at the same distance it is the one with the lowest index.
    NearestOnMesh nearest(const glm::dvec3& point, double within_m = std::numeric_limits<double>::infinity()) const;

    /// Calls `take(triangle)` for every triangle that may be at most `within_m` away from the point: for all that are,
    /// and for some that are a little farther, in the order of the tree.
    template <typename Take>
    void for_each_near(const glm::dvec3& point, double within_m, const Take& take) const;

    /// The number of triangles.
    std::size_t size() const { return triangles_.size(); }

    /// Distances from points within the mesh's bounding box are wrong by less than this, metres, because of rounding.
    double rounding_m() const { return rounding_m_; }

private:
    static constexpr std::size_t lanes = 4; ///< A leaf holds at most so many triangles.
    using Floats = float __attribute__((vector_size(4 * lanes)));

    /// Four bounding boxes in the tree's units: the mesh's centre is the origin and half of its longest side is 1.
    struct Node {
        std::array<Floats, 3> least;
        std::array<Floats, 3> most;
        /// For each box the number of a node, or with leaf_bit that of a leaf.
        std::array<std::uint32_t, lanes> below;
    };

    /// Up to four triangles, as PlaneFrame has them but for what follows from the rest; where there are fewer, the last
    /// one is repeated.
    struct Leaf {
        std::array<Floats, 3> origin;
        std::array<Floats, 3> x_axis;
        std::array<Floats, 3> y_axis;
        Floats bx, cx, cy;
    };

    /// A point to search from, and how far to look, in the tree's units.
    struct Probe {
        std::array<Floats, 3> place; ///< Its coordinates, each four times.
        double slack = 0.0;          ///< Distances in single precision are wrong by less than this.
        float reach2 = 0.0F;         ///< The square of the distance beyond which nothing is looked at.

        void set_reach(double distance);
    };

    struct Builder;
    struct Search;

    void take_corners(std::span<const glm::dvec3> vertices_m, std::span<const Triangle> triangles);
    Probe probe(const glm::dvec3& point_m) const;
    /// The squared distances of four boxes from the probe, in the tree's units.
    static void box_distances2(Floats& distances2, const Node& node, const Probe& probe);
    /// The squared distances of a leaf's triangles from the probe, in the tree's units.
    static void triangle_distances2(Floats& distances2, const Leaf& leaf, const Probe& probe);
    /// Measures those triangles of a leaf in double precision that may be nearer than what was found.
    void search_leaf(std::uint32_t leaf, const glm::dvec3& point_m, Search& search) const;

    static constexpr std::uint32_t leaf_bit = 1U << 31U;
    /// No tree that Builder makes needs a deeper stack of waiting nodes.
    static constexpr int max_waiting = 256;

    std::vector<Node> nodes_; ///< The first one is the root; there are none without triangles.
    std::vector<Leaf> leaves_;
    /// For each leaf the index of its first triangle in triangles_, and at the end their number.
    std::vector<std::uint32_t> firsts_;
    std::vector<std::uint32_t> triangles_; ///< The triangles' indices in the mesh, by leaves.
    std::vector<Triangle> corners_;        ///< The same triangles' corners in vertices_m_.
    std::vector<glm::dvec3> vertices_m_;
    glm::dvec3 centre_m_{0.0};
    double per_size_ = 1.0; ///< 1 / half of the longest side of the mesh's bounding box.
    double rounding_m_ = 0.0;
};

/// Depth first with a stack; a node's order does not matter, because all that is near is taken.
template <typename Take>
void TriangleBvh::for_each_near(const glm::dvec3& point, double within_m, const Take& take) const {
    if (nodes_.empty()) { return; }
    Probe here = probe(point);
    here.set_reach(within_m * per_size_);
    std::array<std::uint32_t, max_waiting> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    Floats distances2;
    while (count > 0) {
        const std::uint32_t next = waiting[--count];
        if ((next & leaf_bit) == 0) {
            const Node& node = nodes_[next];
            box_distances2(distances2, node, here);
            for (std::size_t i = 0; i < lanes; ++i) {
                if (distances2[i] <= here.reach2) { waiting[count++] = node.below[i]; }
            }
            continue;
        }
        const std::uint32_t leaf = next & ~leaf_bit;
        triangle_distances2(distances2, leaves_[leaf], here);
        for (std::uint32_t i = firsts_[leaf]; i < firsts_[leaf + 1]; ++i) {
            if (distances2[i - firsts_[leaf]] <= here.reach2) { take(triangles_[i]); }
        }
    }
}

OCTANT_INLINE void TriangleBvh::box_distances2(Floats& distances2, const Node& node, const Probe& probe) {
    distances2 = Floats{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Floats below = node.least[axis] - probe.place[axis];
        const Floats above = probe.place[axis] - node.most[axis];
        Floats away = below > above ? below : above;
        away = away > 0.0F ? away : Floats{};
        distances2 += away * away;
    }
}

OCTANT_INLINE void TriangleBvh::triangle_distances2(Floats& distances2, const Leaf& leaf, const Probe& probe) {
    PlaneFrame<Floats> frames;
    frames.origin = leaf.origin;
    frames.x_axis = leaf.x_axis;
    frames.y_axis = leaf.y_axis;
    frames.bx = leaf.bx;
    frames.cx = leaf.cx;
    frames.cy = leaf.cy;
    finish_frame(frames);
    FramePoints<Floats> found;
    find_in_frame<false>(found, probe.place, frames);
    distances2 = found.distance2;
}

/// A mesh to which distances are measured, with a tree over its triangles. The mesh must outlive this.
class TargetSurface {
public:
    /// `bvh` is a tree over the mesh's triangles (asserted by their number); null = one is built.
    explicit TargetSurface(const TriangleMesh& mesh, std::shared_ptr<const TriangleBvh> bvh = nullptr)
        : mesh_(&mesh), bvh_(bvh ? std::move(bvh) : std::make_shared<const TriangleBvh>(mesh)) {
        assert(bvh_->size() == mesh.triangles.size());
    }

    const TriangleMesh& mesh() const { return *mesh_; }

    const TriangleBvh& bvh() const { return *bvh_; }

    /// The square of the distance from a point to one triangle.
    double distance2_to(std::uint32_t triangle, const glm::dvec3& point) const {
        const auto& [a, b, c] = mesh_->triangles[triangle];
        const auto& at = mesh_->vertices_m;
        return detail::nearest_to_origin({at[a] - point, at[b] - point, at[c] - point}).distance2;
    }

    double longest_edge_m(std::uint32_t triangle) const {
        const auto& [a, b, c] = mesh_->triangles[triangle];
        const auto& at = mesh_->vertices_m;
        return std::max({glm::distance(at[a], at[b]), glm::distance(at[b], at[c]), glm::distance(at[c], at[a])});
    }

    /// The nearest point of the mesh. `guess` is a triangle that may be near, or none; a good guess makes the search
    /// faster but never changes what is found.
    NearestOnMesh nearest(const glm::dvec3& point, std::uint32_t guess) const {
        if (guess == NearestOnMesh::none) { return bvh_->nearest(point); }
        constexpr double margin = 1.0 + 1e-12; // Makes up for the rounding of the square root.
        return bvh_->nearest(point, std::sqrt(distance2_to(guess, point)) * margin);
    }

private:
    const TriangleMesh* mesh_;
    std::shared_ptr<const TriangleBvh> bvh_;
};

} // namespace octant::models::measure
