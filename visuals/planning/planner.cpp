#include "visuals/planning/planner.h"

#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/planning/ground_detail_texture.h"

#include <algorithm>

namespace octant::visuals::planning {

namespace {

/// Whether the ground of a scene has the fine pattern.
bool has_detail_texture(const Scene& scene, const scene::GroundSettings& settings) {
    return settings.near_detail && !scene.ground_texture && scene.ground->land_cover_contrast();
}

} // namespace

Planner::Planner(
    const Scene& scene,
    const scene::Settings& settings,
    std::unique_ptr<landscape::GroundMesher> mesher)
    : scene_(scene)
    , settings_(settings)
    , mesher_(
          mesher ? std::move(mesher)
                 : scene.ground->mesher(
                       landscape::mesh_settings(settings, scene.ground_texture != nullptr)))
    , atmosphere_(scene, settings.air)
    , fleet_(scene, settings)
    , smooth_(settings.shading, settings.adapt.shading, fleet_.placed())
    , runway_(scene.ground->runway())
    , shadows_(atmosphere_.to_sun())
    , transparents_(scene, settings, atmosphere_.daylight())
    , overlay_(scene, settings)
    , painter_(plan_) {
    runway_.set_daylight(atmosphere_.daylight());
    update_roads();
    plan_.background = settings.air.background;
    plan_.mesh_display = settings.ground.show_mesh;
    plan_.sample_spacing_m = std::max(static_cast<float>(scene.ground->spacing_m()), 1e-3F);
    plan_.lights_pixels = settings.shading.kind == scene::AircraftShading::Phong;
}

FrameView Planner::view_of(const scene::Camera& camera) const {
    return frame_view(camera, settings_.view.size_px, mesher_->earth_radius_m());
}

/// There are none where a texture has colours of its own.
void Planner::update_roads() {
    if (settings_.ground.roads && !scene_.ground_texture) {
        roads_.follow(*scene_.ground, atmosphere_.daylight());
    }
}

landscape::MeshRequest
Planner::ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const {
    const int asked = requested_triangles(triangle_target);
    const FrameView view = view_of(camera);
    const int kept =
        runway_.max_triangles(camera.eye_m, asked) + roads_.max_triangles(view, asked);
    return {
        camera,
        view.aspect,
        asked >= scene::unlimited_triangles ? asked : std::max(asked - kept, 1)};
}

int Planner::requested_triangles(std::optional<int> triangle_target) const {
    return triangle_target.value_or(scene::triangle_target(settings_));
}

void Planner::reset_detail(const scene::Camera& camera) {
    mesher_->reset_detail(ground_request(camera, std::nullopt));
}

void Planner::begin_next_mesh(
    const scene::Camera& camera,
    std::optional<int> triangle_target,
    const landscape::IdleThreadRunner& on_idle_thread) {
    mesher_->begin_next_mesh(ground_request(camera, triangle_target), on_idle_thread);
}

bool Planner::set_sun() {
    const landscape::GroundMesher* const before = mesher_.get();
    mesher_ = landscape::reuse_or_make_mesher(
        std::move(mesher_),
        *scene_.ground,
        landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    atmosphere_.set_sun();
    shadows_ = ShadowCaster(atmosphere_.to_sun());
    runway_.set_daylight(atmosphere_.daylight());
    update_roads();
    transparents_.set_daylight(atmosphere_.daylight());
    return mesher_.get() == before;
}

PlannedFrame Planner::plan(const PlanRequest& request) {
    const FrameView view = view_of(request.camera);
    PlanCounts counts;
    place_aircraft(request, view);
    begin_plan(view);
    GroundFrame ground{
        mesher_->triangles(ground_request(request.camera, request.triangle_target), counts.ground),
        {},
        {}};
    shadows_.begin(ground.all, plan_.ground_texture.has_value(), plan_.shadow_vertices);
    paint_ground(request, view, ground, counts);
    cast_shadows(view, ground);
    atmosphere_.write(view, plan_);
    transparents_.make(view, {request.states, request.articulated_parts}, fleet_, plan_);
    plan_.overlay = overlay_.draw(
        transparents_.draw(), request.camera, request.states, transparents_.has_ribbon(), request.overlay_lines);
    count(choose_smooth(request.smooth), counts);
    counts.shadow_triangles =
        static_cast<int>(ground.shadow_indices.size() / 3) - counts.painted_triangles;
    painter_.paint(
        {view, fleet_, smooth_, transparents_, ground, *mesher_},
        settings_.surface.hidden_surface,
        counts);
    return {plan_, counts};
}

void Planner::advance_without_drawing(const PlanRequest& request) {
    place_aircraft(request, view_of(request.camera));
    choose_smooth(request.smooth);
}

void Planner::place_aircraft(const PlanRequest& request, const FrameView& view) {
    fleet_.place(view, {request.states, request.articulated_parts}, transparents_.effects());
    fleet_.refine(view);
    if (request.on_refined) {
        request.on_refined();
    }
}

SmoothChoice::Count Planner::choose_smooth(const SmoothTarget& smooth_target) {
    const nature::Daylight& day = atmosphere_.daylight();
    return smooth_.choose(
        fleet_.placed(),
        fleet_.refined(),
        smooth_target,
        atmosphere_.to_sun(),
        glm::vec2(day.ambient().x, day.sunlight().x),
        plan_.smooth);
}

/// Empties the lists of the plan and writes what depends on the view and the aircraft alone.
void Planner::begin_plan(const FrameView& view) {
    plan_.aircraft.clear();
    plan_.refined.clear();
    plan_.steps.clear();
    plan_.clips.clear();
    plan_.repaint_indices.clear();
    plan_.depth_boxes.clear();
    plan_.world_to_view = world_to_view(view.camera);
    plan_.view_to_clip = view_to_clip(view.camera, view.aspect);
    plan_.parts.resize(fleet_.parts().size());
    std::ranges::transform(fleet_.parts(), plan_.parts.begin(), [](const glm::dmat4& part) {
        return glm::mat4(part);
    });
    if (scene_.ground_texture) {
        plan_.ground_texture = landscape::ground_texture_transforms(*scene_.ground_texture, view.camera.eye_m);
    }
    plan_.detail_texture.reset();
    if (has_detail_texture(scene_, settings_.ground)) {
        plan_.detail_texture = ground_detail_texture(scene_.ground->land_cover_contrast(), view.camera.eye_m);
    }
}

/// Lays roads and the runway within the triangles that are kept for them, which are those of what
/// stands on the ground.
void Planner::paint_ground(
    const PlanRequest& request,
    const FrameView& view,
    const GroundFrame& ground,
    PlanCounts& counts) {
    const int asked = requested_triangles(request.triangle_target);
    const bool is_front_to_back =
        settings_.surface.hidden_surface == scene::HiddenSurface::DepthBuffer;
    const glm::dvec3& eye_m = view.camera.eye_m;
    cutter_.begin(ground.all, view);
    runway_.paint(*mesher_, view, is_front_to_back, runway_.max_triangles(eye_m, asked), cutter_);
    roads_.paint(*mesher_, view, is_front_to_back, roads_.max_triangles(view, asked), cutter_);
    shadows_.set_decals(cutter_.decals());
    counts.painted_triangles = cutter_.triangles();
    counts.ground.triangles += counts.painted_triangles;
    counts.ground.scenery_triangles += counts.painted_triangles;
}

void Planner::cast_shadows(const FrameView& view, GroundFrame& ground) {
    if (settings_.surface.shadows) {
        const auto bounding_boxes = fleet_.bounding_boxes();
        for (std::size_t i = 0; i < bounding_boxes.size(); ++i) {
            shadows_.cast(fleet_.placed()[i], bounding_boxes[i], *mesher_, view);
        }
    }
    shadows_.sort_pieces();
    ground.shadows = shadows_.pieces();
    ground.shadow_indices = shadows_.indices();
}

void Planner::count(const SmoothChoice::Count& shaded, PlanCounts& counts) const {
    for (const PlacedAircraft& aircraft : fleet_.placed()) {
        counts.aircraft_polygons += aircraft.polygon_count;
        counts.aircraft_polygons += is_refined(aircraft) ? aircraft.model->turning.polygons : 0;
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

} // namespace octant::visuals::planning
