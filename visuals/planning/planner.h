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

/// A frame that is planned.
struct PlannedFrame {
    /// The planner's, which stays until it plans again.
    const scene::FramePlan& plan;
    PlanCounts counts;
};

/// Decides what is drawn in each frame of one view. Keeps memory that the plans point into, and the levels of detail of
/// ground and aircraft from frame to frame. Several views of one scene are a list of planners.
class Planner {
public:
    /// The scene and the settings, of which the view is a part, must outlive the planner. Both may become others: the
    /// function below that fits must be called then. `mesher`: of the scene's ground; null = one by these settings.
    Planner(
        const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher = nullptr);
    Planner(const Planner&) = delete;
    Planner& operator=(const Planner&) = delete;
    Planner(Planner&&) noexcept;
    Planner& operator=(Planner&&) noexcept;
    ~Planner();

    /// Goes on where the settings or the ground of the scene have become others. The last plan is gone. The detail of
    /// the ground goes on where both it and its control are the same, else it begins anew.
    void apply_settings();

    /// Goes on where only the sun of the settings and the colours of the scene's ground have become others. Nothing may
    /// be prepared then. False where the detail of the ground begins anew.
    bool set_sun();

    /// Sets the detail of the ground for a camera where it begins anew, as it does in a new planner. The next plan does
    /// so where nobody has. Loading work.
    void settle_detail(const scene::Camera& camera);

    /// Sets the detail of the ground for a camera. Loading work.
    void reset_detail(const scene::Camera& camera);

    /// The mesher of the ground, for the planner that follows this one in the same view. Nothing may be planned after
    /// it.
    std::unique_ptr<landscape::GroundMesher> take_mesher();

    /// Begins the work on the ground of the next plan() beside the caller, for the camera and the triangle target that
    /// it will be given; the last plan stays valid. May be left out: changes no plan.
    void begin_next_mesh(const scene::Camera& camera, std::optional<int> triangle_target = std::nullopt,
        const IdleThreadRunner& on_idle_thread = nullptr);

    /// Returns when nothing is being prepared. Throws what that work threw; the plan is then made when it is asked for.
    void wait();

    /// Does the first part of the next plan(), which must have the same request: places the aircraft and refines their
    /// meshes. For whoever measures; may be left out.
    void place_aircraft(const PlanRequest& request);

    /// The plan of the next frame, and what it holds. No allocation once the first frames have been planned.
    PlannedFrame plan(const PlanRequest& request);

    /// Goes on as if plan() had been called, for a picture that nobody sees: levels of detail, stand-ins of far
    /// aircraft, refined meshes and smooth polygons are then what the next plan goes on from. Leaves out the ground,
    /// whose detail goes on from plan to plan only where earlier counts control it.
    void advance_without_drawing(const PlanRequest& request);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace octant::visuals::planning
