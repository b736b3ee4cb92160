#pragma once

#include "visuals/planning/ground_frame.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Appends to the painting steps of a plan.
class StepWriter {
public:
    explicit StepWriter(scene::FramePlan& plan) : plan_(plan) {}

    /// How far a plan has been written.
    struct Checkpoint {
        std::size_t steps = 0;
        std::size_t last_count = 0; ///< of the last step, to which more may be added
        std::size_t aircraft = 0;
        std::size_t clips = 0;
        std::size_t repaint_indices = 0;
    };

    Checkpoint checkpoint() const;

    /// Takes back the aircraft, the ground and the clips that were added since.
    void roll_back(const Checkpoint& checkpoint);

    /// Depth becomes infinitely far there: what is drawn by depth from here on hides only itself.
    void clear_depth(const scene::PixelBox& box);

    /// The plan's sky; nothing where it is empty.
    void add_sky(scene::DepthUse depth = scene::DepthUse::None);

    /// The plan's ground in its order; nothing where it is empty.
    void add_ground();

    /// The plan's ground by depth, of which the last `edge_on_indices` indices belong to triangles that face away but
    /// for rounding: they only close holes along edges, elsewhere their depths mean nothing.
    void add_ground_by_depth(std::size_t edge_on_indices);

    /// All shadows, where ground has been drawn by depth.
    void add_shadows_by_depth(const GroundFrame& ground);

    /// A range of the plan's overlay, over what has been painted; nothing where it is empty.
    void add_transparent_range(std::size_t first, std::size_t count);

    /// The plan's overlay from an index on; nothing where it is empty.
    void add_overlay(std::size_t first);

    /// A whole aircraft. Consecutive ones that are drawn alike become one step.
    void add(const scene::AircraftDraw& draw, scene::DepthUse depth = scene::DepthUse::None);

    /// Transparent surfaces of an aircraft, blended by depth. Opacity: as PaintStep has it.
    void add_transparent(const scene::AircraftDraw& draw, float opacity);

    /// A mesh that was refined for this frame, by depth.
    void add(const scene::RefinedDraw& draw);

    /// Paints an aircraft's range once more where `region` is seen: a part of one of its polygons.
    void add_within(const scene::AircraftDraw& draw, const ViewPolygon& region);

    /// Paints triangles once more where they lie before a box, with their shadows, as far as they are seen in `cone`:
    /// of the box or of one inside it. They are in painting order; those that meet the box are cut to the outside of
    /// its sides. The eye is outside the box.
    void add_in_front(const GroundFrame& ground, std::span<const GroundInFrontTriangle> triangles,
        const OrientedBox& box, const ViewCone& cone);

    /// Paints one triangle once more where `region`, a part of it, is seen.
    void add_within(const GroundFrame& ground, std::uint32_t triangle, const ViewPolygon& region);

    /// Gives depth to ground that what comes next by depth may stick in: triangles that have been painted.
    void occlude_by_ground(const GroundFrame& ground, std::span<const std::uint32_t> triangles);

private:
    void add_range(scene::PaintStep::Content content, std::size_t first, std::size_t count, scene::DepthUse depth);

    /// Index of a new clip by planes through the eye, at most Clip::max_planes.
    std::uint32_t add_clip(std::span<const glm::dvec3> normals);
    void add_outside(const GroundFrame& ground, std::uint32_t triangle, const OrientedBox& box, const ViewCone& cone);
    void add_indices(const GroundFrame& ground, std::uint32_t triangle);

    /// Calls paint(clip) for each convex piece of `region` that few enough planes bound.
    template <class Paint>
    void for_each_clip(const ViewPolygon& region, const Paint& paint);

    scene::FramePlan& plan_;
    ViewPolygon piece_;
    ViewPolygon scratch_;
    std::vector<glm::dvec3> normals_;
};

} // namespace octant::visuals::planning
