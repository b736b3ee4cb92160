#include "visuals/planning/planner.h"

#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/nature/daylight.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/overlay/overlay.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/planning/ground_pieces.h"
#include "visuals/planning/scene_painter.h"
#include "visuals/planning/sky.h"
#include "visuals/planning/smooth_choice.h"
#include "visuals/planning/transparents.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// The overlay of one view: marks of the path's legs, dials, the head-up display and lines of text.
class FrameOverlay {
public:
    /// The scene and the settings must outlive it.
    FrameOverlay(const Scene& scene, const scene::Settings& settings) : scene_(scene), settings_(settings) {}

    /// The overlay of a frame, `transparents` first; valid until the next call. `marks_path`: legs of the first
    /// aircraft's path are named, which must be known.
    scene::OverlayDraw draw(const scene::OverlayDraw& transparents, const PlanRequest& request,
        const glm::ivec2& size_px, bool marks_path) {
        const scene::Camera& camera = request.camera;
        layers_.clear();
        layers_.add(transparents);
        if (marks_path) { layers_.add(path_marks(camera, size_px, request.states.front().position_m)); }
        if (settings_.view.kind == scene::View::Cockpit) {
            const overlay::InstrumentReadings readings = readings_of(request.states.front());
            overlay::add_instruments(layers_, canvases_, scene_.dials, readings, camera, size_px);
            if (settings_.view.head_up_display) {
                layers_.add(overlay::draw_head_up_display(canvases_[0], readings, camera, size_px));
            }
        }
        if (!request.overlay_lines.empty()) {
            layers_.add(overlay::draw_text(canvases_[0], request.overlay_lines, size_px));
        }
        return layers_.all();
    }

private:
    /// The names of the legs of the first aircraft's path, where the legs begin.
    scene::OverlayDraw path_marks(
        const scene::Camera& camera, const glm::ivec2& size_px, const glm::dvec3& aircraft_m) {
        labels_.clear();
        for (const DrawnPath::Leg& leg : scene_.path->legs) {
            labels_.push_back({scene_.path->points[leg.first_point].position_m - camera.eye_m, leg.name});
        }
        return overlay::draw_path_annotations(canvases_[0], camera, size_px, aircraft_m - camera.eye_m, labels_);
    }

    overlay::InstrumentReadings readings_of(const sim::AircraftState& state) const {
        overlay::InstrumentReadings readings{state, state.position_m.z, {}};
        if (const auto ground_m = scene_.ground->height_at(state.position_m.x, state.position_m.y)) {
            readings.height_above_ground_m = state.position_m.z - *ground_m;
        }
        return readings;
    }

    const Scene& scene_;
    const scene::Settings& settings_;
    std::array<overlay::OverlayCanvas, 2> canvases_;
    std::vector<overlay::WorldLabel> labels_;
    overlay::OverlayLayers layers_;
};

namespace {

/// The place of the detail pattern on the ground of a frame.
scene::DetailTexture ground_detail_texture(
    std::shared_ptr<const scene::LandCoverContrast> contrast, const glm::dvec3& eye_m) {
    scene::DetailTexture detail_texture;
    for (int scale = 0; scale < scene::DetailPattern::scales; ++scale) {
        const glm::dvec3 tiles = scene::detail_tile_position(eye_m, scale);
        detail_texture.at_eye[static_cast<std::size_t>(scale)] = glm::vec3(tiles - glm::floor(tiles));
    }
    detail_texture.contrast = std::move(contrast);
    return detail_texture;
}

} // namespace

/// The planner itself. plan() names the stages of a frame in their order, and the private functions follow that order.
class Planner::Impl {
public:
    Impl(const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher)
        : scene_(scene), settings_(settings), control_(settings.ground),
          mesher_(mesher ? std::move(mesher) : scene.ground->mesher(mesh_settings())),
          atmosphere_(std::in_place, scene, settings.air), fleet_(scene, settings),
          smooth_(settings.shading, settings.adapt.shading, fleet_.placed()),
          transparents_(scene, settings, atmosphere_->daylight()), overlay_(scene, settings), painter_(plan_) {
        plan_.background = settings.air.background;
        plan_.mesh_display = settings.ground.show_mesh;
        plan_.sample_spacing_m = std::max(static_cast<float>(scene.ground->spacing_m()), 1e-3F);
        plan_.lights_pixels = settings.shading.kind == scene::AircraftShading::Phong;
    }

    /// The planner that follows one under other settings.
    static std::unique_ptr<Impl> under_other_settings(std::unique_ptr<Impl> before) {
        const Scene& scene = before->scene_;
        const scene::Settings& settings = before->settings_;
        before->reuse_mesher();
        const bool settled =
            before->is_settled_ && terrain::same_detail_control(settings.ground.lod, before->control_.lod);
        std::unique_ptr<landscape::GroundMesher> mesher = std::move(before->mesher_);
        before.reset();
        auto impl = std::make_unique<Impl>(scene, settings, std::move(mesher));
        impl->is_settled_ = settled;
        return impl;
    }

    void set_sun() {
        reuse_mesher();
        atmosphere_.emplace(scene_, settings_.air);
        transparents_.set_daylight(atmosphere_->daylight());
    }

    void settle_detail(const PlanRequest& request) {
        if (!std::exchange(is_settled_, true)) {
            mesher_->reset_detail(ground_request(view_of(request), std::nullopt));
        }
    }

    double earth_radius_m() const { return mesher_->earth_radius_m(); }

    void forget_frames() {
        is_settled_ = false;
        is_placed_ = false;
        fleet_.forget_frames();
        smooth_.forget_frames();
    }

    void begin_next_mesh(
        const scene::Camera& camera, std::optional<int> triangle_target, const IdleThreadRunner& on_idle_thread) {
        mesher_->begin_next_mesh(ground_request(view_of({camera, {}}), triangle_target), on_idle_thread);
    }

    void wait() { mesher_->wait(); }

    void place_aircraft(const PlanRequest& request) {
        if (std::exchange(is_placed_, true)) { return; }
        const FrameView view = view_of(request);
        fleet_.place(view, request, transparents_.effect_bounds());
        fleet_.refine(view);
    }

    PlannedFrame plan(const PlanRequest& request) {
        settle_detail(request);
        const FrameView view = view_of(request);
        PlanCounts counts;
        place_aircraft(request);
        is_placed_ = false;
        begin_plan(view);
        const GroundFrame ground = make_ground(request, view, counts);
        atmosphere_->write(view, plan_);
        transparents_.make(view, request, fleet_, plan_);
        note_clouds(view);
        note_previous(request);
        plan_.overlay = overlay_.draw(transparents_.draw(), request, view.size_px, transparents_.has_ribbon());
        count(choose_smooth(request.smooth), counts);
        painter_.paint(
            {view, fleet_, smooth_, transparents_, ground, *mesher_}, settings_.surface.hidden_surface, counts);
        return {plan_, counts};
    }

    void advance_without_drawing(const PlanRequest& request) {
        settle_detail(request);
        place_aircraft(request);
        is_placed_ = false;
        choose_smooth(request.smooth);
    }

private:
    FrameView view_of(const PlanRequest& request) const {
        return frame_view(request.camera, request.size_px.value_or(settings_.view.size_px), mesher_->earth_radius_m());
    }

    /// Empties the lists of the plan and writes what depends on the view and the aircraft alone.
    void begin_plan(const FrameView& view) {
        plan_.aircraft.clear();
        plan_.refined.clear();
        plan_.steps.clear();
        plan_.clips.clear();
        plan_.repaint_indices.clear();
        plan_.depth_boxes.clear();
        plan_.world_to_view = world_to_view(view.camera);
        plan_.view_to_clip = view_to_clip(view.camera, view.aspect);
        plan_.parts.resize(fleet_.parts().size());
        std::ranges::transform(
            fleet_.parts(), plan_.parts.begin(), [](const glm::dmat4& part) { return glm::mat4(part); });
        plan_.detail_texture.reset();
        if (scene_.ground_texture) {
            plan_.ground_texture = landscape::ground_texture_transforms(*scene_.ground_texture, view.camera.eye_m);
        } else if (settings_.ground.near_detail && scene_.ground->land_cover_contrast()) {
            plan_.detail_texture = ground_detail_texture(scene_.ground->land_cover_contrast(), view.camera.eye_m);
        }
    }

    int requested_triangles(std::optional<int> triangle_target) const {
        return triangle_target.value_or(scene::triangle_target(settings_));
    }

    /// The mesh of the ground gets the requested triangles less those of decorations that lie on it.
    landscape::MeshRequest ground_request(const FrameView& view, std::optional<int> triangle_target) const {
        const int asked = requested_triangles(triangle_target);
        int lying = 0;
        for (const auto& decoration : mesher_->decorations()) {
            lying += decoration->max_patch_triangles(view.camera.eye_m, view.pixel_rad, asked);
        }
        return {view.camera, view.aspect, asked >= terrain::unlimited_triangles ? asked : std::max(asked - lying, 1),
            view.size_px.y};
    }

    scene::WaterSurface water_of(const FrameView& view) const {
        const std::optional<double> level_m = scene_.ground->water_level_m();
        if (!level_m) { return {}; }
        return {static_cast<float>(*level_m - view.camera.eye_m.z), static_cast<float>(view.earth_radius_m)};
    }

    /// Writes what the flow is counted from.
    void note_previous(const PlanRequest& request) {
        std::optional<scene::PreviousPicture>& previous = plan_.truth.previous;
        if (!request.previous) {
            previous.reset();
            return;
        }
        PlanRequest before{request.previous->camera, request.previous->states};
        before.size_px = request.size_px;
        const FrameView view = view_of(before);
        if (!previous) { previous.emplace(); }
        previous->world_to_view = world_to_view(view.camera);
        previous->view_to_clip = view_to_clip(view.camera, view.aspect);
        previous->eye_moved_m = request.camera.eye_m - view.camera.eye_m;
        previous->parts.resize(plan_.parts.size());
        fleet_.place_before(view, *request.previous, previous->parts);
    }

    void note_clouds(const FrameView& view) {
        const TransparentRange clouds = transparents_.clouds();
        plan_.truth.first_cloud_index = static_cast<std::uint32_t>(clouds.first);
        plan_.truth.cloud_index_count = static_cast<std::uint32_t>(clouds.count);
        plan_.truth.cloud_height_m =
            static_cast<float>(transparents_.cloud_height_m().value_or(0.0) - view.camera.eye_m.z);
    }

    /// Meshes the ground, lays decorations on it within the rest of the requested triangles, and casts shadows.
    GroundFrame make_ground(const PlanRequest& request, const FrameView& view, PlanCounts& counts) {
        const scene::TriangleDraw triangles =
            mesher_->triangles(ground_request(view, request.triangle_target), counts.ground);
        const bool is_front_to_back = settings_.surface.hidden_surface == scene::HiddenSurface::DepthBuffer;
        plan_.truth.water = water_of(view);
        pieces_.begin(
            {view, *mesher_, triangles, is_front_to_back, plan_.ground_texture.has_value(), plan_.truth.water},
            plan_.shadow_vertices, plan_.truth.piece_surfaces);
        const int asked = requested_triangles(request.triangle_target);
        for (const auto& decoration : mesher_->decorations()) {
            const int max_triangles = decoration->max_patch_triangles(view.camera.eye_m, view.pixel_rad, asked);
            pieces_.lay(*decoration, asked >= terrain::unlimited_triangles ? asked : max_triangles);
        }
        const auto bounding_boxes = fleet_.bounding_boxes();
        for (std::size_t i = 0; settings_.surface.shadows && i < bounding_boxes.size(); ++i) {
            pieces_.cast(
                fleet_.placed()[i], bounding_boxes[i], atmosphere_->to_sun(), settings_.surface.aircraft_error_px);
        }
        const GroundFrame ground = pieces_.finish();
        counts.painted_triangles = pieces_.decal_triangles();
        counts.ground.triangles += counts.painted_triangles;
        counts.ground.scenery_triangles += counts.painted_triangles;
        counts.shadow_triangles = static_cast<int>(ground.piece_indices.size() / 3) - counts.painted_triangles;
        return ground;
    }

    SmoothChoice::Count choose_smooth(const SmoothTarget& smooth_target) {
        const nature::Daylight& day = atmosphere_->daylight();
        return smooth_.choose(fleet_.placed(), fleet_.refined(), smooth_target, atmosphere_->to_sun(),
            glm::vec2(day.ambient().x, day.sunlight().x), plan_.smooth);
    }

    void count(const SmoothChoice::Count& shaded, PlanCounts& counts) const {
        for (const PlacedAircraft& aircraft : fleet_.placed()) {
            counts.aircraft_polygons += aircraft.polygon_count;
            if (!is_refined(aircraft)) { continue; }
            counts.aircraft_polygons += aircraft.model->turning.polygons;
            for (std::size_t i = 0; i < aircraft.model->discs.size(); ++i) {
                const bool has_blades = aircraft.disc_strengths[i] < 1.0F;
                counts.aircraft_polygons += has_blades ? aircraft.model->discs[i].blades.polygons : 0;
            }
        }
        if (!fleet_.placed().empty()) {
            const PlacedAircraft& first = fleet_.placed().front();
            counts.draw_cell = first.cell;
            counts.aircraft_level = static_cast<int>(first.representation) + (is_far(first) ? 1 : 0);
        }
        counts.refine_splits = fleet_.splits();
        counts.refine_collapses = fleet_.collapses();
        counts.smoothable_polygons = shaded.polygons;
        counts.smooth_polygons = shaded.smooth;
        counts.transparent_triangles = static_cast<int>(transparents_.draw().indices.size() / 3);
    }

    landscape::MeshSettings mesh_settings() const {
        return landscape::mesh_settings(settings_, scene_.ground_texture != nullptr);
    }

    void reuse_mesher() {
        const landscape::GroundMesher* const before = mesher_.get();
        mesher_ = landscape::reuse_or_make_mesher(std::move(mesher_), *scene_.ground, mesh_settings());
        is_settled_ = is_settled_ && mesher_.get() == before;
    }

    const Scene& scene_;
    const scene::Settings& settings_;
    scene::GroundSettings control_; ///< The settings whose detail control the mesher has.
    std::unique_ptr<landscape::GroundMesher> mesher_;
    bool is_settled_ = false; ///< The detail of the ground has been set for a camera.
    bool is_placed_ = false;  ///< The aircraft have been placed for the next plan.
    scene::FramePlan plan_;
    std::optional<Atmosphere> atmosphere_;
    Fleet fleet_;
    SmoothChoice smooth_;
    GroundPieces pieces_;
    Transparents transparents_;
    FrameOverlay overlay_;
    ScenePainter painter_;
};

Planner::Planner(const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher)
    : impl_(std::make_unique<Impl>(scene, settings, std::move(mesher))) {}

Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;
Planner::~Planner() = default;

void Planner::apply_settings() { impl_ = Impl::under_other_settings(std::move(impl_)); }

void Planner::set_sun() { impl_->set_sun(); }

void Planner::settle_detail(const scene::Camera& camera) { impl_->settle_detail({camera, {}}); }

void Planner::begin_next_mesh(
    const scene::Camera& camera, std::optional<int> triangle_target, const IdleThreadRunner& on_idle_thread) {
    impl_->begin_next_mesh(camera, triangle_target, on_idle_thread);
}

void Planner::wait() { impl_->wait(); }

void Planner::place_aircraft(const PlanRequest& request) { impl_->place_aircraft(request); }

PlannedFrame Planner::plan(const PlanRequest& request) { return impl_->plan(request); }

double Planner::earth_radius_m() const { return impl_->earth_radius_m(); }

void Planner::forget_frames() { impl_->forget_frames(); }

void Planner::advance_without_drawing(const PlanRequest& request) { impl_->advance_without_drawing(request); }

} // namespace octant::visuals::planning
