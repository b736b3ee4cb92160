#pragma once

#include "sim/aircraft_state.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/cloud_layer.h"
#include "visuals/overlay/head_up_display.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/overlay/overlay_layers.h"
#include "visuals/overlay/path_marks.h"
#include "visuals/overlay/picture_text.h"
#include "visuals/planning/aircraft_effects.h"
#include "visuals/planning/aircraft_hull.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/ground_in_front.h"
#include "visuals/planning/path_ribbon.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/polygon_repaint.h"
#include "visuals/planning/refined_aircraft.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/scene_order.h"
#include "visuals/planning/shadow.h"
#include "visuals/planning/sky.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/planning/step_writer.h"
#include "visuals/planning/veils.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// What one frame drew.
struct PlanCounts {
    landscape::GroundCounts ground;
    int aircraft_polygons = 0;
    int draw_cell =
        0; ///< cell of the first aircraft's draw order in which the eye is; 0 where it has parts
    int cuts = 0;      ///< ground triangles and aircraft polygons painted again, cut by planes
    int knots = 0;     ///< groups of aircraft that meet or stand in a ring, painted by polygons
    int unordered = 0; ///< polygons that should have been painted again and were too many
    int shadow_triangles = 0;
    int veil_triangles = 0;   ///< clouds and all else that is seen through, in view
    int may_be_smooth = 0;    ///< polygons of whole models and triangles of refined meshes
    int smooth_polygons = 0;  ///< those of may_be_smooth that are lit smoothly
    int aircraft_level = 0;   ///< representation of the first aircraft, 0 = the finest
    int refine_splits = 0;    ///< vertex splits in all meshes that are refined
    int refine_collapses = 0; ///< edge collapses in all meshes that are refined
};

/// What a frame is to show, and how finely.
struct PlanRequest {
    scene::Camera camera;
    std::span<const sim::AircraftState> states; ///< those of Scene::aircraft
    /// Triangles of ground that are aimed at, at least 1; nothing = as the settings say.
    std::optional<int> triangle_target = std::nullopt;
    SmoothWish smooth = {};
    /// Called in the midst of the work, when the aircraft are placed and their meshes refined: for
    /// whoever measures. May be empty.
    std::function<void()> when_refined = nullptr;
    /// Lines written into the upper left corner of the picture.
    std::span<const std::string> words = {};
    /// Parts that do not turn by themselves.
    std::span<const TurnedPart> turned = {};
};

/// A frame that is planned.
struct PlannedFrame {
    const scene::FramePlan& plan; ///< of the planner, until it plans again
    PlanCounts counts;
};

/// Decides what is drawn in each frame of one view. Keeps memory that the plans point into, and the
/// ground's detail control from frame to frame. Several views have a planner each over one scene.
class Planner {
public:
    /// The scene and the settings must outlive the planner. `mesher` is one of the scene's ground,
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
    void settle(const scene::Camera& camera);

    /// Begins the work on the ground of the next plan() beside the caller, for the camera and the
    /// triangle target that it will be given; the last plan stays valid. May be left out: changes
    /// no plan.
    void prepare(const scene::Camera& camera, std::optional<int> triangle_target = std::nullopt);

    /// Returns when nothing is being prepared. Throws what that work threw; the plan is then made
    /// when it is asked for.
    void wait() { mesher_->wait(); }

    /// The plan of the next frame, and what it holds. No allocation once the first frames have been
    /// planned.
    PlannedFrame plan(const PlanRequest& request);

    /// The mesher of the ground, for the planner that follows this one in the same view. Nothing
    /// may be planned after it.
    std::unique_ptr<landscape::GroundMesher> take_mesher() { return std::move(mesher_); }

private:
    landscape::GroundRequest
    ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const;
    void place_and_refine(const PlanRequest& request);
    void plan_haze(const scene::Camera& camera);
    void plan_sky(const scene::Camera& camera);
    void plan_veils(const PlanRequest& request);
    void plan_ribbon(const PlanRequest& request);
    void place_aircraft(const scene::Camera& camera, std::span<const sim::AircraftState> states);
    void place(PlacedAircraft& aircraft, const sim::AircraftState& state, const glm::dvec3& eye_m);
    void choose_model(PlacedAircraft& aircraft, double distance_m) const;
    void represent(PlacedAircraft& aircraft);
    void choose_ranges(PlacedAircraft& aircraft, const glm::dvec3& eye_in_body_m);
    void refine_meshes(const scene::Camera& camera);
    void cast_shadows(const scene::Camera& camera);
    void write_parts();
    void paint_by_depth();
    void paint_in_order(const scene::Camera& camera, PlanCounts& counts);
    void paint(const PlacedAircraft& aircraft, scene::DepthUse depth);
    void paint_clear(const PlacedAircraft& aircraft);
    void paint_knots(const scene::Camera& camera, bool beyond_clouds, PlanCounts& counts);
    bool is_beyond_clouds(const Knot& knot, const scene::Camera& camera) const;
    void paint_knot(const Knot& knot, const scene::Camera& camera, PlanCounts& counts);
    void paint_aircraft(const Knot& knot, PlanCounts& counts);
    void paint_members(const Knot& knot, PlanCounts& counts);
    void paint_effects(bool after);
    void paint_dashes(double farther_m2, double nearer_m2);
    void paint_members_by_depth(const Knot& knot);
    bool is_nearer(std::uint32_t a, std::uint32_t b) const;
    void plan_overlay(const PlanRequest& request);
    overlay::HeadUpInputs shown_inputs(const sim::AircraftState& state) const;
    void count_aircraft(PlanCounts& counts) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    std::unique_ptr<landscape::GroundMesher> mesher_;
    double aspect_;
    nature::Daylight daylight_;
    glm::dvec3 to_sun_;
    Sky sky_;
    std::optional<nature::CloudLayer> clouds_;
    double cloud_height_m_ = 0.0;
    Veils veils_;
    VeilRange cloud_range_; ///< of veils_
    std::optional<PathRibbon> ribbon_;
    std::vector<PathRibbon::Dash> dashes_;               ///< of this frame
    std::vector<std::uint32_t> knot_dashes_;             ///< of the knot at hand
    std::vector<AircraftEffects> effects_;               ///< of Scene::aircraft, or none
    std::vector<AircraftEffects::Ranges> effect_ranges_; ///< of effects_, of veils_
    ShadowCaster shadows_;
    SceneOrder order_;
    GroundInFront in_front_;
    PolygonRepaint repaint_;
    double pixel_rad_ = 0.0; ///< what a pixel covers in the middle of the picture
    std::array<glm::dvec3, 4> frustum_{};
    GroundFrame ground_;
    std::span<const TurnedPart> turned_; ///< of the request that is planned
    std::vector<glm::dmat4> parts_;      ///< of placed_
    std::vector<PlacedAircraft> placed_; ///< Scene::aircraft, then the cockpit
    draworder::DrawOrder::Walk walk_;
    SmoothChoice smooth_;
    std::vector<std::unique_ptr<RefinedAircraft>> refined_; ///< of placed_, null for most
    std::vector<std::uint8_t> was_refined_;                 ///< in the last frame
    int refine_splits_ = 0;
    int refine_collapses_ = 0;
    std::vector<HullBox> hulls_; ///< of Scene::aircraft
    std::vector<HullBox> boxes_; ///< hulls_, then those of dashes_
    std::vector<const PlacedAircraft*> members_;
    std::vector<std::uint32_t> near_to_far_;
    std::vector<std::uint32_t> facing_indices_;
    scene::FramePlan plan_;
    StepWriter steps_;
    overlay::InstrumentPanel instruments_;
    overlay::HeadUpDisplay head_up_display_;
    overlay::PathMarks marks_;
    overlay::PictureText text_;
    overlay::OverlayLayers overlays_;
};

} // namespace octant::visuals::planning
