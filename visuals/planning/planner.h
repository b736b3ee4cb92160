#pragma once

#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <memory>
#include <optional>

namespace octant::visuals::planning {

/// The plan of a frame.
struct PlannedFrame {
    /// Owned by the planner; valid until it plans again.
    const scene::FramePlan& plan;
    PlanCounts counts;
};

/// Makes the plan of each frame of one view. Owns the memory of the plans, and the levels of detail of ground and
/// aircraft from frame to frame. Several views of one scene are a list of planners.
class Planner {
public:
    /// The scene and the settings must outlive the planner. After a change of either apply_settings() or set_sun() must
    /// be called. `mesher`: of the scene's ground; null = a new one by these settings.
    Planner(
        const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher = nullptr);
    Planner(const Planner&) = delete;
    Planner& operator=(const Planner&) = delete;
    Planner(Planner&&) noexcept;
    Planner& operator=(Planner&&) noexcept;
    ~Planner();

    /// Takes over changed settings or a changed ground of the scene. The last plan becomes invalid. The detail of the
    /// ground continues if the ground and its control are the same; else it starts again.
    void apply_settings();

    /// Takes over a change of only the sun in the settings and the colours of the scene's ground. No mesh may be in
    /// work (wait()).
    void set_sun();

    /// Chooses the first level of detail of the ground for this camera, in a new planner and after apply_settings() has
    /// reset it; else does nothing. plan() calls it, too: call it while loading, because it takes long.
    void settle_detail(const scene::Camera& camera);

    /// Begins to mesh the ground of the next plan() in the background, for its camera and its triangle target. The last
    /// plan stays valid. Optional: it does not change plans.
    void begin_next_mesh(const scene::Camera& camera, std::optional<int> triangle_target = std::nullopt,
        const IdleThreadRunner& on_idle_thread = nullptr);

    /// Waits for the work of begin_next_mesh(). Throws its exception, if any; the next plan() then makes the mesh.
    void wait();

    /// Does the first part of the next plan(), which must have the same request: places the aircraft and refines their
    /// meshes. Optional, for callers that measure its time.
    void place_aircraft(const PlanRequest& request);

    /// The plan of the next frame, and its counts. Allocates nothing after the first frames.
    PlannedFrame plan(const PlanRequest& request);

    /// The radius of the earth by which distant ground and aircraft sink in the plans; 0 = they do not.
    double earth_radius_m() const;

    /// Forgets the frames before: the next plan() depends on its request alone, as that of a new planner. For pictures
    /// that do not follow one another. Keeps all memory; takes microseconds, but for meshes that are refined in each
    /// frame, and for ground whose detail control averages over frames: these are made anew by the next plan().
    void forget_frames();

    /// Updates what the next plan() depends on, without a plan: levels of detail, far models, refined meshes and smooth
    /// polygons. The ground is left out: its detail depends on earlier frames only where earlier counts control it.
    void advance_without_drawing(const PlanRequest& request);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace octant::visuals::planning
