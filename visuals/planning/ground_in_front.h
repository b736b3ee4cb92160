#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/view_polygon.h"

#include <glm/vec3.hpp>

#include <array>
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

} // namespace octant::visuals::planning
