#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/planning/transparents.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <memory>

namespace octant::visuals::planning {

/// The contents of a frame, without their painting order. All members must be of the same frame.
struct FrameScene {
    const FrameView& view;
    const Fleet& fleet;
    const SmoothChoice& smooth;
    const Transparents& transparents;
    const GroundFrame& ground;
    /// The mesher that made `ground`.
    const landscape::GroundMesher& mesher;
};

/// Writes the painting steps of a plan: the order of the contents of a frame and the way in which each is drawn. It
/// also chooses the triangles of the ground that the plan draws.
///
/// In painting order (HiddenSurface::Octant, BackFace): sky, ground with its shadows in place, then the aircraft from
/// far to near. Clouds are painted after everything beyond them and before everything on the eye's side: seen from
/// below before all ground, seen from above after it. After each group of aircraft the ground in front of it is painted
/// again, cut to the group's outline. Meshes use the depth buffer within their group, and so do aircraft that intersect
/// in too many places.
///
/// By depth (HiddenSurface::DepthBuffer): aircraft, ground, shadows, sky; from near to far, so that hidden pixels are
/// not coloured first. Where aircraft and ground are equally near, the aircraft is visible.
class ScenePainter {
public:
    /// The plan must outlive it; its lists of steps, clips and draws are empty before each frame.
    explicit ScenePainter(scene::FramePlan& plan);
    ScenePainter(const ScenePainter&) = delete;
    ScenePainter& operator=(const ScenePainter&) = delete;
    ScenePainter(ScenePainter&&) = delete;
    ScenePainter& operator=(ScenePainter&&) = delete;
    ~ScenePainter();

    /// Writes the steps of a frame. Sets PlanCounts::cuts, overlap_groups and unordered.
    void paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts);

private:
    class Painter;
    std::unique_ptr<Painter> painter_;
};

} // namespace octant::visuals::planning
