#pragma once

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

/// A triangle in the coordinates of its own plane: corner a is the origin and corner b lies on the x axis. In single
/// precision; `Number` is float, or a vector of floats for several triangles side by side.
template <typename Number>
struct PlaneFrame {
    std::array<Number, 3> origin;
    std::array<Number, 3> x_axis;
    std::array<Number, 3> y_axis;
    std::array<Number, 3> normal;
    Number bx, cx, cy;
    Number per_ab2, per_bc2, per_ca2; ///< 1 / length^2 of each edge; 0 for an edge without length.
};

/// The frame of a triangle. One without height gets any plane through its longest edges, and one without length any
/// plane at all. Corners are displaced by the rounding to float and by at most 1e-8 of an edge.
PlaneFrame<float> plane_frame(const std::array<glm::dvec3, 3>& corners);

inline std::array<float, 3> narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Results go out by reference: vectors as return values would depend on the processor's ABI.
#define OCTANT_INLINE [[gnu::always_inline]] inline

/// Sets `value` to the smaller one, lane by lane.
template <typename F>
OCTANT_INLINE void set_to_min(F& value, const F& other) {
    value = other < value ? other : value;
}

/// Clamps to 0..1, lane by lane.
template <typename F>
OCTANT_INLINE void clamp_unit(F& value) {
    value = value > 0.0F ? value : F{};
    value = value < 1.0F ? value : F{} + 1.0F;
}

/// Computes the normals of frames and 1 / length^2 of their edges from the rest.
template <typename F>
OCTANT_INLINE void finish_frame(PlaneFrame<F>& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = (axis + 1) % 3;
        const std::size_t last = (axis + 2) % 3;
        t.normal[axis] = t.x_axis[next] * t.y_axis[last] - t.x_axis[last] * t.y_axis[next];
    }
    const auto inverse = [](F& value, const F& length2) { value = length2 > 1e-30F ? 1.0F / length2 : F{}; };
    const F ex = t.cx - t.bx;
    inverse(t.per_ab2, t.bx * t.bx);
    inverse(t.per_bc2, ex * ex + t.cy * t.cy);
    inverse(t.per_ca2, t.cx * t.cx + t.cy * t.cy);
}

/// The vectors from the nearest point of the triangle's edges to a point, both in the plane of the triangle.
template <typename F>
struct EdgeFeet {
    F away_x, away_y, away2;
};

/// Finds the nearest point on the edges for a point (x, y) of the plane. away_x and away_y are filled only
/// `with_place`.
template <bool with_place, typename F, typename Number>
OCTANT_INLINE void nearest_on_edges(EdgeFeet<F>& feet, const F& x, const F& y, const PlaneFrame<Number>& t) {
    const F qx = x - t.bx;
    const Number ex = t.cx - t.bx;
    F ab = x * (t.bx * t.per_ab2);
    F bc = (qx * ex + y * t.cy) * t.per_bc2;
    F ca = (x * t.cx + y * t.cy) * t.per_ca2;
    clamp_unit(ab);
    clamp_unit(bc);
    clamp_unit(ca);
    const F ab_x = x - ab * t.bx;
    const F bc_x = qx - bc * ex;
    const F bc_y = y - bc * t.cy;
    const F ca_x = x - ca * t.cx;
    const F ca_y = y - ca * t.cy;
    const F ab2 = ab_x * ab_x + y * y;
    const F bc2 = bc_x * bc_x + bc_y * bc_y;
    const F ca2 = ca_x * ca_x + ca_y * ca_y;
    feet.away2 = ab2;
    set_to_min(feet.away2, bc2);
    if constexpr (with_place) {
        const auto is_bc = bc2 < ab2;
        const auto is_ca = ca2 < feet.away2;
        feet.away_x = is_bc ? bc_x : ab_x;
        feet.away_y = is_bc ? bc_y : y;
        feet.away_x = is_ca ? ca_x : feet.away_x;
        feet.away_y = is_ca ? ca_y : feet.away_y;
    }
    set_to_min(feet.away2, ca2);
}

/// A point in the coordinates of a triangle's plane, and its distance from the triangle.
template <typename F>
struct FramePoints {
    F x, y, distance2;
    /// Where the foot of the perpendicular lies inside the triangle, away_x and away_y are 0.
    EdgeFeet<F> feet;
};

/// Transforms a point into the frame of a triangle and finds its squared distance from the triangle.
template <bool with_place, typename F, typename Number>
OCTANT_INLINE void find_in_frame(FramePoints<F>& found, const std::array<F, 3>& place, const PlaneFrame<Number>& t) {
    const F dx = place[0] - t.origin[0];
    const F dy = place[1] - t.origin[1];
    const F dz = place[2] - t.origin[2];
    found.x = dx * t.x_axis[0] + dy * t.x_axis[1] + dz * t.x_axis[2];
    found.y = dx * t.y_axis[0] + dy * t.y_axis[1] + dz * t.y_axis[2];
    const F h = dx * t.normal[0] + dy * t.normal[1] + dz * t.normal[2];
    nearest_on_edges<with_place>(found.feet, found.x, found.y, t);
    F inside = found.y;
    set_to_min(inside, F((t.cx - t.bx) * found.y - t.cy * (found.x - t.bx)));
    set_to_min(inside, F(t.cy * found.x - t.cx * found.y));
    const auto is_inside = inside >= 0.0F;
    found.distance2 = (is_inside ? F{} : found.feet.away2) + h * h;
    if constexpr (with_place) {
        found.feet.away_x = is_inside ? F{} : found.feet.away_x;
        found.feet.away_y = is_inside ? F{} : found.feet.away_y;
    }
}

/// The point of a triangle that is nearest to a given one.
struct NearestOnTriangle {
    glm::dvec3 point{0.0};
    glm::dvec3 weights{0.0}; ///< Barycentric: those of the corners, none negative, with the sum 1.
    double distance2 = 0.0;  ///< The square of the distance.
};

/// The point of the triangle a, b, c, edges and corners included, that is nearest to `point`. Edge vectors relative to
/// `point` keep it accurate far from the origin and on triangles without area or length. The result lies on the
/// triangle; its distance is below the true one by no more than rounding.
NearestOnTriangle nearest_on_triangle(
    const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

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
        std::array<Floats, 3> min;
        std::array<Floats, 3> max;
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
        const Floats below = node.min[axis] - probe.place[axis];
        const Floats above = probe.place[axis] - node.max[axis];
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
        return nearest_on_triangle(point, at[a], at[b], at[c]).distance2;
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
