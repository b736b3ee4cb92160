#pragma once

#include "sim/aircraft_state.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/planning/atmosphere.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_overlay.h"
#include "visuals/planning/frame_transparents.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/decal_clipper.h"
#include "visuals/planning/plan_counts.h"
#include "visuals/planning/road_painter.h"
#include "visuals/planning/runway_painter.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/scene_painter.h"
#include "visuals/planning/shadow.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace octant::visuals::planning {

/// What a frame is to show, and how finely.
struct PlanRequest {
    scene::Camera camera;
    /// The states of Scene::aircraft.
    std::span<const sim::AircraftState> states;
    /// Triangles of ground that are aimed at, at least 1; nothing = as the settings say.
    std::optional<int> triangle_target = std::nullopt;
    SmoothTarget smooth = {};
    /// Called in the midst of the work, when the aircraft are placed and their meshes refined: for
    /// whoever measures. May be empty.
    std::function<void()> on_refined = nullptr;
    /// Lines written into the upper left corner of the picture.
    std::span<const std::string> overlay_lines = {};
    /// Parts that do not turn by themselves.
    std::span<const ArticulatedPart> articulated_parts = {};
};

/// A frame that is planned.
struct PlannedFrame {
    /// The planner's, which stays until it plans again.
    const scene::FramePlan& plan;
    PlanCounts counts;
};

/// Decides what is drawn in each frame of one view. Keeps memory that the plans point into, and the
/// ground's detail control from frame to frame. Several views have a planner each over one scene.
class Planner {
public:
    /// The scene and the settings must outlive the planner; of the settings the visibility may
    /// change between plans. `mesher` is one of the scene's ground,
    /// from which the view's detail goes on; null = a new one by these settings.
    Planner(
        const Scene& scene,
        const scene::Settings& settings,
        std::unique_ptr<landscape::GroundMesher> mesher = nullptr);
    Planner(const Planner&) = delete;
    Planner& operator=(const Planner&) = delete;
    Planner(Planner&&) = delete;
    Planner& operator=(Planner&&) = delete;
    ~Planner() = default;

    /// Sets the detail of the ground for the camera of the first frame. Loading work.
    void reset_detail(const scene::Camera& camera);

    /// Goes on under the sun of the settings and over the ground of the scene where these have
    /// become others: the same heights in other colours. Nothing may be prepared then. Returns
    /// false where the detail of the ground begins anew: reset_detail() again.
    bool set_sun();

    /// Begins the work on the ground of the next plan() beside the caller, for the camera and the
    /// triangle target that it will be given; the last plan stays valid. May be left out: changes
    /// no plan.
    void begin_next_mesh(
        const scene::Camera& camera,
        std::optional<int> triangle_target = std::nullopt,
        const landscape::IdleThreadRunner& on_idle_thread = nullptr);

    /// Returns when nothing is being prepared. Throws what that work threw; the plan is then made
    /// when it is asked for.
    void wait() { mesher_->wait(); }

    /// The plan of the next frame, and what it holds. No allocation once the first frames have been
    /// planned.
    PlannedFrame plan(const PlanRequest& request);

    /// Goes on as if plan() had been called, for a picture that nobody sees: levels of detail,
    /// stand-ins of far aircraft, refined meshes and smooth polygons are then what the next plan
    /// goes on from. Leaves out the ground, whose detail goes on from plan to plan only where
    /// earlier counts control it.
    void advance_without_drawing(const PlanRequest& request);

    /// The mesher of the ground, for the planner that follows this one in the same view. Nothing
    /// may be planned after it.
    std::unique_ptr<landscape::GroundMesher> take_mesher() { return std::move(mesher_); }

private:
    FrameView view_of(const scene::Camera& camera) const;
    landscape::MeshRequest
    ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const;
    void place_aircraft(const PlanRequest& request, const FrameView& view);
    SmoothChoice::Count choose_smooth(const SmoothTarget& smooth_target);
    void begin_plan(const FrameView& view);
    void update_roads();
    void paint_ground(
        const PlanRequest& request,
        const FrameView& view,
        const GroundFrame& ground,
        PlanCounts& counts);
    int requested_triangles(std::optional<int> triangle_target) const;
    void cast_shadows(const FrameView& view, GroundFrame& ground);
    void count(const SmoothChoice::Count& shaded, PlanCounts& counts) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    std::unique_ptr<landscape::GroundMesher> mesher_;
    scene::FramePlan plan_;
    Atmosphere atmosphere_;
    Fleet fleet_;
    SmoothChoice smooth_;
    RunwayPainter runway_;
    RoadPainter roads_;
    DecalClipper cutter_;
    ShadowCaster shadows_;
    FrameTransparents transparents_;
    FrameOverlay overlay_;
    ScenePainter painter_;
};

} // namespace octant::visuals::planning
