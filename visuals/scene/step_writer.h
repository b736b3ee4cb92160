#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground_frame.h"
#include "visuals/scene/ground_in_front.h"
#include "visuals/scene/sight.h"

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// Appends to the painting steps of a plan. Consecutive aircraft that are not cut become one step.
class StepWriter {
public:
    explicit StepWriter(FramePlan& plan)
        : plan_(plan) {}

    void paint(const AircraftDraw& draw);

    /// Paints an aircraft's range once more where `region` is seen: a part of one of its polygons.
    void paint_within(const AircraftDraw& draw, const SightPolygon& region);

    /// Paints triangles once more where they lie before a box, with their shadows, as far as they
    /// are seen in `cone`: of the box or of one inside it. They are in painting order; those that
    /// meet the box are cut to the outside of its sides. The eye is outside the box.
    void paint_before(
        const GroundFrame& ground,
        std::span<const NearTriangle> triangles,
        const HullBox& box,
        const SightCone& cone);

    /// Paints one triangle once more where `region`, a part of it, is seen.
    void
    paint_within(const GroundFrame& ground, std::uint32_t triangle, const SightPolygon& region);

    /// What is painted solid from here on hides only itself and the ground given beside it.
    void begin_solids(const PixelBox& box);

    /// Ground that solids may stick in: triangles that have been painted.
    void hide_by_ground(const GroundFrame& ground, std::span<const std::uint32_t> triangles);

    void paint_solid(const AircraftDraw& draw);
    void paint_solid(const RefinedDraw& draw);

private:
    /// Index of a new clip by planes through the eye, at most Clip::most_planes.
    std::uint32_t add_clip(std::span<const glm::dvec3> normals);
    void paint_outside(
        const GroundFrame& ground,
        std::uint32_t triangle,
        const HullBox& box,
        const SightCone& cone);
    void add_indices(const GroundFrame& ground, std::uint32_t triangle);

    /// Calls paint(clip) for each convex piece of `region` that few enough planes bound.
    template <class Paint>
    void for_each_clip(const SightPolygon& region, const Paint& paint);

    FramePlan& plan_;
    SightPolygon piece_;
    SightPolygon scratch_;
    std::vector<glm::dvec3> normals_;
};

} // namespace octant::visuals::scene
