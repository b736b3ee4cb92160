#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// Indices of one triangle's shadow pieces, in FramePlan::shadow_indices' numbering.
struct ShadowPieces {
    std::uint32_t triangle = 0; ///< number in Ground::triangles
    std::uint32_t first = 0;    ///< place of the first index among the pieces' indices
    std::uint32_t count = 0;

    bool operator<(const ShadowPieces& other) const {
        return triangle != other.triangle ? triangle < other.triangle : first < other.first;
    }
};

/// The ground of one frame before facing, with the shadows on it.
struct GroundFrame {
    TriangleDraw all;                      ///< Ground::triangles, in painting order
    std::span<const ShadowPieces> shadows; ///< ascending
    std::span<const std::uint32_t> shadow_indices;
};

/// The shadow pieces on a triangle.
std::span<const ShadowPieces> shadows_on(const GroundFrame& ground, std::uint32_t triangle);

/// Three corners of a triangle of the ground.
void place_triangle(const TriangleDraw& ground, std::uint32_t triangle, SightPolygon& placed);

/// Appends to the painting steps of a plan. Consecutive aircraft that are not cut become one step.
class StepWriter {
public:
    explicit StepWriter(FramePlan& plan)
        : plan_(plan) {}

    void paint(const AircraftDraw& draw);

    /// Paints an aircraft's range once more where `region` is seen: a part of one of its polygons.
    void paint_within(const AircraftDraw& draw, const SightPolygon& region);

    /// Paints triangles once more inside a cone, with their shadows.
    void paint_within(
        const GroundFrame& ground,
        std::span<const std::uint32_t> triangles,
        std::span<const glm::dvec3> cone);

    /// Paints one triangle once more where `region`, a part of it, is seen.
    void
    paint_within(const GroundFrame& ground, std::uint32_t triangle, const SightPolygon& region);

private:
    /// Index of a new clip; at most Clip::most_planes normals.
    std::uint32_t add_clip(std::span<const glm::dvec3> normals);
    void add_indices(const GroundFrame& ground, std::uint32_t triangle);

    /// Calls paint(clip) for each convex piece of `region` that few enough planes bound.
    template <class Paint>
    void for_each_clip(const SightPolygon& region, const Paint& paint);

    FramePlan& plan_;
    SightPolygon piece_;
    std::vector<glm::dvec3> normals_;
};

} // namespace octant::visuals::scene
