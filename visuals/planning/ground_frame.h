#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A convex set of points: those in front of all planes and inside a box along the world's axes. World axes with the
/// eye at the origin.
struct ConvexVolume {
    AxisAlignedBox extent;
    std::array<Plane, 14> planes{};
    int count = 0;

    void add(const Plane& plane) { planes[static_cast<std::size_t>(count++)] = plane; }
};

/// False only if the volume contains no point of the box between two corners; may be true without one.
bool may_intersect(const ConvexVolume& volume, const glm::dvec3& min_m, const glm::dvec3& max_m);

/// The volume of all lines of sight from the eye to points of a box.
ConvexVolume sight_volume_of(const OrientedBox& box);

/// A triangle of the ground that hides part of a box or intersects it.
struct GroundInFrontTriangle {
    /// Its number in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    /// Whether it intersects the box; else it is wholly in front of it.
    bool intersects = false;
};

/// Finds the triangles of the ground that hide part of a box or intersect it.
///
/// A triangle and a box that do not intersect have a separating plane, and the eye is on one side of it: on every line
/// of sight through both, the same one is nearer. Therefore one line of sight through both decides.
class GroundInFront {
public:
    /// Searches those of the mesher's last triangles() that face the eye. `eye_m`: world axes.
    void find(const OrientedBox& box, const landscape::GroundMesher& ground, const scene::TriangleDraw& triangles,
        const glm::dvec3& eye_m);

    /// The result, in the ground's painting order.
    std::span<const GroundInFrontTriangle> found() const { return found_; }

    /// The numbers of those that intersect the box.
    std::span<const std::uint32_t> intersecting() const { return intersecting_; }

private:
    enum class BoxRelation { Elsewhere, InFront, Intersects };

    BoxRelation relation_to(const OrientedBox& box, std::span<const glm::dvec3> cone);

    std::vector<std::uint32_t> candidates_;
    std::vector<GroundInFrontTriangle> found_;
    std::vector<std::uint32_t> intersecting_;
    ViewPolygon triangle_;
    ViewPolygon part_;
    ViewPolygon scratch_;
};

/// The layers of pieces on a triangle of the ground, in painting order.
enum class GroundLayer : std::uint32_t { Shadow, Surface, Marking, ShadowOnDecal };

/// The pieces of one layer, decals or shadows, on one triangle of the ground: a range of GroundFrame::piece_indices.
struct PieceRange {
    /// The number of the triangle in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    GroundLayer layer = GroundLayer::Shadow;
    /// The share of the sunlight that shadows leave; 1 for others.
    float light = 1.0F;
};

/// The ground of one frame with the decals and shadows on it.
struct GroundFrame {
    /// GroundMesher::triangles(), in painting order, whichever way they face.
    scene::TriangleDraw all;
    /// By ascending triangle, then by ascending layer, then by descending light.
    std::span<const PieceRange> pieces;
    /// Three for each triangle of a piece, numbered as FramePlan::repaint_indices are.
    std::span<const std::uint32_t> piece_indices;
};

/// The pieces on a triangle, in painting order.
std::span<const PieceRange> pieces_on(const GroundFrame& ground, std::uint32_t triangle);

/// Writes the three corners of a triangle of the ground to `placed`, world axes with the eye at the origin.
void place_triangle(const scene::TriangleDraw& ground, std::uint32_t triangle, ViewPolygon& placed);

/// The triangles of the ground that face the eye, in their order, each followed by its pieces; the indices are written
/// to `kept`. Triangles that are seen nearly edge-on are included, because a renderer's rounding of screen positions
/// may make them face the eye: without them single pixels would be holes. `pixel_rad`: the angle that a pixel covers in
/// the middle of the picture.
scene::TriangleDraw front_facing(const GroundFrame& ground, double pixel_rad, std::vector<std::uint32_t>& kept);

/// The same triangles without pieces. Those that face the eye by rounding only come last: `edge_on_indices` is set to
/// the number of their indices.
scene::TriangleDraw front_facing_first(
    const scene::TriangleDraw& draw, double pixel_rad, std::vector<std::uint32_t>& kept, std::size_t& edge_on_indices);

} // namespace octant::visuals::planning
