#pragma once

#include "models/heights/runway_strip.h"
#include "sim/aircraft_state.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/runway.h"
#include "visuals/overlay/head_up_display.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/overlay/overlay_layers.h"
#include "visuals/overlay/path_annotations.h"
#include "visuals/overlay/picture_text.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_transparents.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/scene_painter.h"
#include "visuals/planning/shadow.h"
#include "visuals/planning/sky.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/roads/road_network.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// Cuts what is painted on the ground to the ground's triangles: each piece lies in the plane of its triangle, whatever
/// the mesh, and goes a little beyond its sides, so that no gap shows between two of them. On the plan places are
/// metres east and north of the eye. Keeps its memory.
class DecalClipper {
public:
    /// A convex quadrangle on the plan, counter-clockwise.
    using Patch = std::array<glm::dvec2, 4>;

    /// The most triangles of one piece: three cuts add a corner each.
    static constexpr int max_triangles = 5;

    /// Forgets the last frame. Triangles are GroundMesher::triangles as they are before facing, and must stay until the
    /// next call.
    void begin(const scene::TriangleDraw& triangles, const FrameView& view);

    /// Takes a triangle to lay patches on.
    void set_triangle(std::uint32_t triangle);

    /// The triangle at hand: its corners on the plan, counter-clockwise.
    const std::array<glm::dvec2, 3>& corners_m() const { return corners_on_plan_m_; }

    /// False where the eye sees nothing of the triangle at hand.
    bool is_seen() const;

    /// Mean colour of its corners, display values.
    glm::vec3 colour() const;

    /// Whether the triangle at hand stands on the ground and is no part of it.
    bool is_scenery() const;

    /// Lays what of a patch lies on the triangle at hand, if anything does, so many overlaps beyond the triangle's
    /// sides.
    void add_decal(const Patch& patch, std::uint32_t colour, GroundLayer layer, double overlaps);

    /// What has been laid since begin().
    GroundDecals decals() const { return {decals_, corners_m_}; }

    int triangles() const { return triangle_count_; }

private:
    /// A convex polygon on the plan.
    struct ClippedPatch {
        std::array<glm::dvec2, max_triangles + 3> corners;
        std::size_t count = 0;
    };

    using SideFlags = std::array<bool, 3>;

    /// A side of the triangle, a unit vector outwards, and how far its ends move along that for one overlap.
    struct Side {
        glm::dvec2 from_m;
        glm::dvec2 to_m;
        glm::dvec2 out;
        double from_moved_m = 0.0;
        double to_moved_m = 0.0;
    };

    bool may_be_in_view() const;
    void place_sides();
    std::optional<SideFlags> sides_across(const ClippedPatch& patch) const;
    ClippedPatch piece_of(const ClippedPatch& patch, const SideFlags& across, double overlaps) const;
    static void cut(ClippedPatch& piece, const glm::dvec2& from, const glm::dvec2& to);

    scene::TriangleDraw triangles_;
    const FrameView* view_ = nullptr;
    double overlap_rad_ = 0.0;
    std::vector<GroundDecal> decals_;
    std::vector<glm::dvec3> corners_m_;
    int triangle_count_ = 0;
    // The triangle at hand.
    std::uint32_t number_ = 0;
    ViewPolygon triangle_;
    bool has_sides_ = false;
    Plane plane_;
    std::array<Side, 3> sides_;
    std::array<glm::dvec2, 3> corners_on_plan_m_;
};

/// Lays a runway on the triangles of the ground, each of its patches on each triangle, to be painted right after it.
/// What looks narrow takes the colour of what it lies on and is left out from there on; so is what lies on triangles
/// out of view. Keeps its memory.
class RunwayPainter {
public:
    /// Null: there is no runway, and nothing is painted.
    explicit RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip);

    void set_daylight(const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at: fewer from farther off.
    int max_triangles(const glm::dvec3& eye_m, int triangle_target) const;

    /// Paints on the ground whose triangles the cutter has, the nearest first; markings only while the cutter has laid
    /// fewer than `most` triangles.
    void paint(const landscape::GroundMesher& ground, const FrameView& view, bool is_front_to_back, int most,
        DecalClipper& cutter);

private:
    /// A patch as it is seen in this frame.
    struct VisiblePatch {
        glm::dvec2 min_m;
        glm::dvec2 max_m;
        std::uint32_t colour = 0;
        bool is_marking = false;
    };

    void choose_patches(const FrameView& view);
    void paint_triangle(int most, DecalClipper& cutter) const;
    DecalClipper::Patch plan_outline(const VisiblePatch& patch) const;

    std::shared_ptr<const models::heights::RunwayStrip> strip_;
    std::vector<nature::RunwayRectangle> patches_;
    glm::vec3 light_{1.0F};
    std::vector<VisiblePatch> seen_;
    std::vector<std::uint32_t> candidates_;
    glm::dvec2 eye_m_{0.0};
};

/// Lays the roads of a ground on its triangles, to be painted right after them. Each piece of a road is shown by a
/// level of detail; what looks about as narrow as a pixel takes the colour of the ground before it is left out. Keeps
/// its memory.
class RoadPainter {
public:
    /// Paints the roads of this ground under this light from the next frame on. Loading work.
    void follow(const landscape::Ground& ground, const nature::Daylight& day);

    /// The most triangles that it takes, of so many that are aimed at: none where no road can be seen, fewer from high
    /// up.
    int max_triangles(const FrameView& view, int triangle_target) const;

    /// Paints on the ground whose triangles the cutter has, the nearest first, at most so many triangles.
    void paint(const landscape::GroundMesher& ground, const FrameView& view, bool is_front_to_back, int most,
        DecalClipper& cutter);

private:
    struct SectionLight {
        glm::dvec3 middle_m{0.0};
        double radius_m = 0.0;
        /// For each level where the light of its stretches lies in lights_.
        std::array<std::size_t, roads::level_error_m.size()> first_light{};
        std::array<bool, roads::level_error_m.size()> is_lit{};
    };

    /// A stretch as it is seen in this frame, on the plan of the cutter.
    struct VisiblePatch {
        DecalClipper::Patch patch;
        glm::dvec2 min_m;
        glm::dvec2 max_m;
        glm::vec3 colour;
        /// Share of its own colour; the rest is the ground's.
        float own = 1.0F;
    };

    /// Where the stretches of a piece lie in seen_, if they have been chosen in this frame.
    struct SectionPatches {
        std::uint64_t frame = 0;
        std::size_t first = 0;
        std::size_t end = 0;
    };

    void light(std::uint32_t number, std::size_t level);
    void choose(std::uint32_t number, const FrameView& view);
    void paint_triangle(const FrameView& view, int limit, DecalClipper& cutter);

    std::shared_ptr<const landscape::Ground> ground_;
    std::optional<nature::Daylight> day_;
    std::shared_ptr<const roads::RoadNetwork> network_;
    double lowest_m_ = 0.0;              ///< of the roads
    std::vector<SectionLight> pieces_;   ///< of the network's
    std::vector<glm::vec3> lights_;      ///< of stretches, worked out when they are first seen
    std::vector<SectionPatches> chosen_; ///< one a piece
    std::vector<VisiblePatch> seen_;
    std::vector<std::uint32_t> candidates_;
    std::vector<std::uint32_t> numbers_;
    std::uint64_t frame_ = 0;
};

/// What lies over the picture of one view: marks of the path's legs, dials, the head-up display and lines of text.
/// Keeps its memory.
class FrameOverlay {
public:
    /// The scene and the settings must outlive it.
    FrameOverlay(const Scene& scene, const scene::Settings& settings) : scene_(scene), settings_(settings) {}

    /// The overlay of a frame, `transparents` first; valid until the next call. `marks_path`: legs of the first
    /// aircraft's path are named, which must be known.
    scene::OverlayDraw draw(const scene::OverlayDraw& transparents, const scene::Camera& camera,
        std::span<const sim::AircraftState> states, bool marks_path, std::span<const std::string> overlay_lines);

private:
    scene::OverlayDraw path_marks(const scene::Camera& camera, const glm::dvec3& aircraft_m);
    overlay::InstrumentReadings shown_inputs(const sim::AircraftState& state) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    overlay::InstrumentPanel instruments_;
    overlay::HeadUpDisplay head_up_display_;
    overlay::PathAnnotations marks_;
    overlay::PictureText text_;
    overlay::OverlayLayers layers_;
};

/// The light, the haze and the sky of one view.
class Atmosphere {
public:
    /// The scene and the settings must outlive it.
    Atmosphere(const Scene& scene, const scene::AirSettings& settings);

    /// Goes on under the sun of the settings, where that has become another one.
    void set_sun();

    const nature::Daylight& daylight() const { return daylight_; }

    /// The direction to the sun: a unit vector, world axes.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// Writes light, haze and sky of a frame into its plan; valid until the next frame.
    void write(const FrameView& view, scene::FramePlan& plan);

private:
    float visibility_m(double eye_height_m) const;

    const Scene& scene_;
    const scene::AirSettings& settings_;
    nature::Daylight daylight_;
    glm::dvec3 to_sun_;
    /// The haze at the ground's mean height.
    scene::Haze haze_;
    Sky sky_;
};

/// What a frame is to show, and how finely.
struct PlanRequest {
    scene::Camera camera;
    /// The states of Scene::aircraft.
    std::span<const sim::AircraftState> states;
    /// Triangles of ground that are aimed at, at least 1; nothing = as the settings say.
    std::optional<int> triangle_target = std::nullopt;
    SmoothTarget smooth = {};
    /// Called in the midst of the work, when the aircraft are placed and their meshes refined: for whoever measures.
    /// May be empty.
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

/// Decides what is drawn in each frame of one view. Keeps memory that the plans point into, and the ground's detail
/// control from frame to frame. Several views have a planner each over one scene.
class Planner {
public:
    /// The scene and the settings must outlive the planner; of the settings the visibility may change between plans.
    /// `mesher` is one of the scene's ground, from which the view's detail goes on; null = a new one by these settings.
    Planner(
        const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher = nullptr);
    Planner(const Planner&) = delete;
    Planner& operator=(const Planner&) = delete;
    Planner(Planner&&) = delete;
    Planner& operator=(Planner&&) = delete;
    ~Planner() = default;

    /// Sets the detail of the ground for the camera of the first frame. Loading work.
    void reset_detail(const scene::Camera& camera);

    /// Goes on under the sun of the settings and over the ground of the scene where these have become others: the same
    /// heights in other colours. Nothing may be prepared then. Returns false where the detail of the ground begins
    /// anew: reset_detail() again.
    bool set_sun();

    /// Begins the work on the ground of the next plan() beside the caller, for the camera and the triangle target that
    /// it will be given; the last plan stays valid. May be left out: changes no plan.
    void begin_next_mesh(const scene::Camera& camera, std::optional<int> triangle_target = std::nullopt,
        const IdleThreadRunner& on_idle_thread = nullptr);

    /// Returns when nothing is being prepared. Throws what that work threw; the plan is then made when it is asked for.
    void wait() { mesher_->wait(); }

    /// The plan of the next frame, and what it holds. No allocation once the first frames have been planned.
    PlannedFrame plan(const PlanRequest& request);

    /// Goes on as if plan() had been called, for a picture that nobody sees: levels of detail, stand-ins of far
    /// aircraft, refined meshes and smooth polygons are then what the next plan goes on from. Leaves out the ground,
    /// whose detail goes on from plan to plan only where earlier counts control it.
    void advance_without_drawing(const PlanRequest& request);

    /// The mesher of the ground, for the planner that follows this one in the same view. Nothing may be planned after
    /// it.
    std::unique_ptr<landscape::GroundMesher> take_mesher() { return std::move(mesher_); }

private:
    FrameView view_of(const scene::Camera& camera) const;
    landscape::MeshRequest ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const;
    void place_aircraft(const PlanRequest& request, const FrameView& view);
    SmoothChoice::Count choose_smooth(const SmoothTarget& smooth_target);
    void begin_plan(const FrameView& view);
    void update_roads();
    void paint_ground(const PlanRequest& request, const FrameView& view, const GroundFrame& ground, PlanCounts& counts);
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
