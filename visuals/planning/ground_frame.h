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

/// Convex set of points: the common front of some planes and the inside of a box along the world's axes. World axes
/// with the eye at the origin.
struct ConvexVolume {
    AxisAlignedBox extent;
    std::array<Plane, 14> planes{};
    int count = 0;

    void add(const Plane& plane) { planes[static_cast<std::size_t>(count++)] = plane; }
};

/// False only when the room holds no point of the box between two corners.
bool may_intersect(const ConvexVolume& volume, const glm::dvec3& min_m, const glm::dvec3& max_m);

/// A room that holds all sight lines from the eye to points of a box.
ConvexVolume sight_volume_of(const OrientedBox& box);

/// A triangle of the ground that hides part of a box or meets it.
struct GroundInFrontTriangle {
    /// Its number in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    /// Whether it may lie before, inside and behind the box.
    bool intersects = false;
};

/// Finds the triangles of the ground that hide part of a box or meet it. Keeps its memory.
///
/// A triangle and a box that do not meet are parted by a plane, and the eye stands on one side of it: wherever the eye
/// sees both, the same one is nearer. So one sight line through both decides.
class GroundInFront {
public:
    /// Looks at those of the mesher's last triangles() that face the eye. `eye_m`: world.
    void find(const OrientedBox& box, const landscape::GroundMesher& ground, const scene::TriangleDraw& triangles,
        const glm::dvec3& eye_m);

    /// In the ground's painting order.
    std::span<const GroundInFrontTriangle> found() const { return found_; }

    /// Those of them that meet the box.
    std::span<const std::uint32_t> intersecting() const { return meeting_; }

private:
    enum class BoxRelation { Elsewhere, Before, Meets };

    BoxRelation relation_to(const OrientedBox& box, std::span<const glm::dvec3> cone);

    std::vector<std::uint32_t> candidates_;
    std::vector<GroundInFrontTriangle> found_;
    std::vector<std::uint32_t> meeting_;
    ViewPolygon triangle_;
    ViewPolygon part_;
    ViewPolygon scratch_;
};

/// What lies on a triangle of the ground, in the order in which it is painted after it.
enum class GroundLayer : std::uint32_t { Shadow, Surface, Marking, ShadowOnDecal };

/// Indices of pieces that lie on one triangle, of shadows or painted, numbered as FramePlan::repaint_indices are.
struct ShadowPieces {
    /// The number of the triangle in GroundMesher::triangles().
    std::uint32_t triangle = 0;
    /// The place of the first index among the pieces' indices.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    GroundLayer layer = GroundLayer::Shadow;
};

/// The ground of one frame before facing, with the shadows on it.
struct GroundFrame {
    /// What GroundMesher::triangles() gave, in painting order.
    scene::TriangleDraw all;
    /// What lies on triangles, by ascending triangle and then from layer to layer.
    std::span<const ShadowPieces> shadows;
    std::span<const std::uint32_t> shadow_indices;
};

/// What lies on a triangle, in painting order.
std::span<const ShadowPieces> shadows_on(const GroundFrame& ground, std::uint32_t triangle);

/// Three corners of a triangle of the ground.
void place_triangle(const scene::TriangleDraw& ground, std::uint32_t triangle, ViewPolygon& placed);

/// The triangles of the ground that face the eye, in their order, each with its shadow pieces directly behind it, as a
/// draw of the same vertices; `kept` holds its indices. Triangles seen so nearly edge-on that a renderer's rounding of
/// screen positions may turn them round are kept too: a renderer that drops them by their unrounded facing leaves holes
/// of single pixels. `pixel_rad`: angle that a pixel covers in the middle of the picture.
scene::TriangleDraw front_facing(const GroundFrame& ground, double pixel_rad, std::vector<std::uint32_t>& kept);

/// The same triangles without shadows, those that face away but for rounding at the end: `edge_on_indices` is how many
/// indices these have.
scene::TriangleDraw front_facing_first(
    const scene::TriangleDraw& draw, double pixel_rad, std::vector<std::uint32_t>& kept, std::size_t& edge_on_indices);

} // namespace octant::visuals::planning
