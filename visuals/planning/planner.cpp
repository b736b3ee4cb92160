#include "visuals/planning/planner.h"

#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/planning/facing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::planning {

namespace {

/// The aircraft of a scene, with room for their parts.
std::vector<PlacedAircraft>
places_for(const Scene& scene, scene::View view, std::vector<glm::dmat4>& parts) {
    std::vector<PlacedAircraft> placed;
    const auto add = [&](std::uint32_t model) {
        PlacedAircraft& aircraft = placed.emplace_back();
        aircraft.model = scene.models[model].get();
        aircraft.model_index = model;
        aircraft.near_model = aircraft.model;
        aircraft.near_index = model;
        aircraft.first_part = static_cast<std::uint32_t>(parts.size());
        std::size_t pivots = aircraft.model->polygons.pivots.size();
        const auto far = std::ranges::find(scene.far_models, model, &FarModel::model);
        if (far != scene.far_models.end()) {
            aircraft.far_model = scene.models[far->far_model].get();
            aircraft.far_index = far->far_model;
            aircraft.far_error_m = far->error_m;
            pivots = std::max(pivots, aircraft.far_model->polygons.pivots.size());
        }
        parts.resize(parts.size() + pivots + 1);
    };
    for (const std::uint32_t model : scene.aircraft) {
        add(model);
    }
    if (scene.cockpit && view == scene::View::Cockpit) {
        add(*scene.cockpit);
    }
    for (PlacedAircraft& aircraft : placed) {
        aircraft.parts = std::span(parts).subspan(
            aircraft.first_part, aircraft.model->polygons.pivots.size() + 1);
    }
    return placed;
}

refine::ViewRefinerOptions refiner_options(const scene::Settings& settings) {
    refine::ViewRefinerOptions options;
    options.error_px = settings.surface.aircraft_error_px;
    options.geomorphs = settings.ground.geomorphs;
    return options;
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
    , aspect_(static_cast<double>(settings.view.size_px.x) / settings.view.size_px.y)
    , daylight_(landscape::daylight_of(settings.air))
    , to_sun_(landscape::direction_to_sun(settings.air))
    , sky_(sky_under(daylight_))
    , shadows_(to_sun_)
    , placed_(places_for(scene, settings.view.kind, parts_))
    , smooth_(settings.shading, settings.adapt.shading, placed_)
    , steps_(plan_) {
    plan_.background = settings.air.background;
    plan_.mesh_look = settings.ground.show_mesh;
    plan_.sample_spacing_m = std::max(static_cast<float>(scene.ground->spacing_m()), 1e-3F);
    plan_light();
    plan_.lights_pixels = settings.shading.kind == scene::AircraftShading::Phong;
    for (const PlacedAircraft& aircraft : placed_) {
        refined_.push_back(
            aircraft.model->progressive
                ? std::make_unique<RefinedAircraft>(
                      aircraft.model->progressive, refiner_options(settings), settings.shading)
                : nullptr);
    }
    was_refined_.resize(placed_.size());
    make_veils();
    hulls_.resize(scene.aircraft.size());
    near_to_far_.resize(scene.aircraft.size());
}

landscape::GroundRequest
Planner::ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const {
    return {camera, aspect_, triangle_target.value_or(scene::triangle_target(settings_))};
}

void Planner::settle(const scene::Camera& camera) {
    mesher_->settle(ground_request(camera, std::nullopt));
}

void Planner::prepare(
    const scene::Camera& camera,
    std::optional<int> triangle_target,
    const landscape::Beside& beside) {
    mesher_->prepare(ground_request(camera, triangle_target), beside);
}

PlannedFrame Planner::plan(const PlanRequest& request) {
    const scene::Camera& camera = request.camera;
    PlanCounts counts;
    place_and_refine(request);
    plan_.world_to_view = world_to_view(camera);
    plan_.view_to_clip = view_to_clip(camera, aspect_);
    if (scene_.ground_texture) {
        plan_.ground_texture = landscape::texture_places(*scene_.ground_texture, camera.eye_m);
    }
    plan_.aircraft.clear();
    plan_.refined.clear();
    plan_.steps.clear();
    plan_.clips.clear();
    plan_.repaint_indices.clear();
    plan_.depth_boxes.clear();
    ground_ = {
        mesher_->triangles(ground_request(camera, request.triangle_target), counts.ground), {}, {}};
    write_parts();
    cast_shadows(camera);
    plan_haze(camera);
    plan_sky(camera);
    plan_grain(camera);
    plan_veils(request);
    plan_overlay(request);
    const SmoothChoice::Count shaded = choose_smooth(request.smooth);
    counts.may_be_smooth = shaded.polygons;
    counts.smooth_polygons = shaded.smooth;
    count_aircraft(counts);
    counts.veil_triangles = static_cast<int>(veils_.draw().indices.size() / 3);
    counts.shadow_triangles = static_cast<int>(ground_.shadow_indices.size() / 3);
    if (settings_.surface.hidden_surface == scene::HiddenSurface::DepthBuffer) {
        paint_by_depth();
    } else {
        paint_in_order(camera, counts);
    }
    steps_.paint_overlay(veils_.draw().indices.size());
    return {plan_, counts};
}

void Planner::pass_over(const PlanRequest& request) {
    place_and_refine(request);
    choose_smooth(request.smooth);
}

SmoothChoice::Count Planner::choose_smooth(const SmoothWish& wish) {
    return smooth_.choose(
        placed_,
        refined_,
        wish,
        to_sun_,
        glm::vec2(plan_.ambient.x, plan_.sunlight.x),
        plan_.smooth);
}

void Planner::write_parts() {
    plan_.parts.resize(parts_.size());
    std::ranges::transform(
        parts_, plan_.parts.begin(), [](const glm::dmat4& part) { return glm::mat4(part); });
}

void Planner::cast_shadows(const scene::Camera& camera) {
    shadows_.begin(ground_.all, plan_.shadow_vertices);
    if (settings_.surface.shadows) {
        const ShadowView view{camera.eye_m, frustum_, pixel_rad_};
        for (std::size_t i = 0; i < hulls_.size(); ++i) {
            shadows_.cast(placed_[i], hulls_[i], *mesher_, view);
        }
        shadows_.sort_pieces();
    }
    ground_.shadows = shadows_.pieces();
    ground_.shadow_indices = shadows_.indices();
}

overlay::HeadUpInputs Planner::shown_inputs(const sim::AircraftState& state) const {
    overlay::HeadUpInputs inputs{state, state.position_m.z, {}};
    if (const auto ground_m = scene_.ground->height_at(state.position_m.x, state.position_m.y)) {
        inputs.height_above_ground_m = state.position_m.z - *ground_m;
    }
    return inputs;
}

/// The veils, and what lies over the picture: dials, head-up display, words.
void Planner::plan_overlay(const PlanRequest& request) {
    const glm::ivec2& size_px = settings_.view.size_px;
    overlays_.clear();
    overlays_.add(veils_.draw());
    if (ribbon_) {
        const glm::dvec3& eye_m = request.camera.eye_m;
        marks_.begin(request.camera, size_px, request.states.front().position_m - eye_m);
        for (const FlownPath::Leg& leg : scene_.path->legs) {
            marks_.add({scene_.path->points[leg.first_point].position_m - eye_m, leg.name});
        }
        overlays_.add(marks_.finish());
    }
    if (settings_.view.kind == scene::View::Cockpit) {
        const overlay::HeadUpInputs inputs = shown_inputs(request.states.front());
        overlays_.add(instruments_.draw(scene_.dials, inputs, request.camera, size_px));
        if (settings_.view.head_up_display) {
            overlays_.add(head_up_display_.draw(inputs, request.camera, size_px));
        }
    }
    if (!request.words.empty()) {
        overlays_.add(text_.draw(request.words, size_px));
    }
    plan_.overlay = overlays_.all();
}

void Planner::count_aircraft(PlanCounts& counts) const {
    for (const PlacedAircraft& aircraft : placed_) {
        counts.aircraft_polygons += aircraft.polygon_count;
        counts.aircraft_polygons += is_refined(aircraft) ? aircraft.model->turning.polygons : 0;
    }
    counts.refine_splits = refine_splits_;
    counts.refine_collapses = refine_collapses_;
    if (!placed_.empty()) {
        counts.draw_cell = placed_.front().cell;
        counts.aircraft_level =
            static_cast<int>(placed_.front().representation) + (is_far(placed_.front()) ? 1 : 0);
    }
}

} // namespace octant::visuals::planning
