#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_transparents.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/ground_in_front.h"
#include "visuals/planning/plan_counts.h"
#include "visuals/planning/polygon_repaint.h"
#include "visuals/planning/scene_order.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/planning/step_writer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::planning {

/// All that is in a frame, apart from the order in which it is painted.
struct FrameScene {
    const FrameView& view;
    const Fleet& fleet;
    const SmoothChoice& smooth;
    const FrameTransparents& transparents;
    const GroundFrame& ground;
    /// The mesher of `ground`, which finds its triangles again.
    const landscape::GroundMesher& mesher;
};

/// Writes the painting steps of a plan: in which order, and how, what is in a frame is drawn. It
/// also chooses which triangles of the ground the plan draws. Keeps its memory.
///
/// In painting order (HiddenSurface::Octant, BackFace): sky, ground with its shadows in place, then
/// the aircraft from far to near. Clouds come before what lies on the eye's side of them and after
/// the rest: seen from below before all ground, seen from above after it. After each knot of
/// aircraft the ground that lies before it is painted again, cut to where the knot is seen. Meshes
/// ask for depth, within their knot, and so do aircraft that meet in too many places.
///
/// By depth (HiddenSurface::DepthBuffer): from near to far, so that what is hidden is not coloured
/// first: aircraft, ground, shadows, sky. Where aircraft and ground are equally near the aircraft
/// is seen.
class ScenePainter {
public:
    /// The plan must outlive it; its lists of steps, clips and draws are empty before each frame.
    explicit ScenePainter(scene::FramePlan& plan)
        : plan_(plan)
        , steps_(plan) {}

    /// Adds what was painted again, and in knots, to the counts.
    void paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts);

private:
    void paint_by_depth(const FrameScene& frame);
    void paint_in_order(const FrameScene& frame, PlanCounts& counts);
    void paint_groups(const FrameScene& frame, bool beyond_clouds, PlanCounts& counts);
    void paint_group(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void collect_members(const FrameScene& frame, const OverlapGroup& overlap_group);
    void paint_with_effects(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_members(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_intersecting(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts);
    void paint_members_by_depth(const FrameScene& frame, const OverlapGroup& overlap_group);
    void paint_effects(const FrameScene& frame, bool after);
    void paint_dashes(const FrameScene& frame, double farther_m2, double nearer_m2);
    void paint(const FrameScene& frame, const PlacedAircraft& aircraft, scene::DepthUse depth);
    void paint_transparent(const FrameScene& frame, const PlacedAircraft& aircraft);

    scene::FramePlan& plan_;
    StepWriter steps_;
    SceneOrder order_;
    GroundInFront in_front_;
    PolygonRepaint repaint_;
    /// The boxes that have a place in the painting order: those of the aircraft, then those of the
    /// ribbon's dashes.
    std::vector<OrientedBox> boxes_;
    /// The aircraft of the knot that is painted, and its dashes, by their boxes.
    std::vector<const PlacedAircraft*> members_;
    std::vector<std::uint32_t> group_dashes_;
    std::vector<std::uint32_t> near_to_far_;
    std::vector<std::uint32_t> facing_indices_;
};

} // namespace octant::visuals::planning
