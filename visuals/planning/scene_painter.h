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

/// All that is in a frame, apart from the order in which it is painted.
struct FrameScene {
    const FrameView& view;
    const Fleet& fleet;
    const SmoothChoice& smooth;
    const Transparents& transparents;
    const GroundFrame& ground;
    /// The mesher of `ground`, which finds its triangles again.
    const landscape::GroundMesher& mesher;
};

/// Writes the painting steps of a plan: in which order, and how, what is in a frame is drawn. It also chooses which
/// triangles of the ground the plan draws. Keeps its memory.
///
/// In painting order (HiddenSurface::Octant, BackFace): sky, ground with its shadows in place, then the aircraft from
/// far to near. Clouds are painted after everything beyond them and before everything on the eye's side: seen from
/// below before all ground, seen from above after it. After each group of aircraft the ground that lies before it is
/// painted again, cut to where the group is seen. Meshes ask for depth, within their group, and so do aircraft that
/// meet in too many places.
///
/// By depth (HiddenSurface::DepthBuffer): from near to far, so that what is hidden is not coloured first: aircraft,
/// ground, shadows, sky. Where aircraft and ground are equally near the aircraft is seen.
class ScenePainter {
public:
    /// The plan must outlive it; its lists of steps, clips and draws are empty before each frame.
    explicit ScenePainter(scene::FramePlan& plan);
    ScenePainter(const ScenePainter&) = delete;
    ScenePainter& operator=(const ScenePainter&) = delete;
    ScenePainter(ScenePainter&&) = delete;
    ScenePainter& operator=(ScenePainter&&) = delete;
    ~ScenePainter();

    /// Adds what was painted again, and the groups of several aircraft, to the counts.
    void paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts);

private:
    class Painter;
    std::unique_ptr<Painter> painter_;
};

} // namespace octant::visuals::planning
