#include "visuals/planning/planner.h"

#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/planning/facing.h"
#include "visuals/scene/grain_pattern.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::planning {

namespace {

constexpr double coarsest_grain_m = 4.0;
constexpr double least_grain_reach_m = 250.0;
constexpr double most_grain_reach_m = 2000.0;

/// At the ground's mean height. Without a sky the haze is the background all around.
scene::Haze haze_of(const scene::AirSettings& air, const nature::Daylight& day) {
    scene::Haze haze{air.background, static_cast<float>(air.visibility_m)};
    haze.falloff_per_m =
        air.haze_height_m > 0.0 ? static_cast<float>(1.0 / air.haze_height_m) : 0.0F;
    if (air.sky) {
        haze.colour = day.haze_away();
        haze.to_sun_level = glm::vec2(day.to_sun_level());
        haze.sunward = day.haze_sunward();
    }
    return haze;
}

Sky sky_of(
    const landscape::Ground& ground, const scene::AirSettings& air, const nature::Daylight& day) {
    return Sky(day, air.sky ? ground.surroundings() : nature::Backdrop());
}

double distance_to_edge_m(const landscape::Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

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

double height_of_clouds_m(const landscape::Ground& ground, const scene::AirSettings& air) {
    constexpr double above_ground_m = 500.0;
    return air.cloud_height_m ? *air.cloud_height_m : landscape::highest_m(ground) + above_ground_m;
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
    , sky_(sky_of(*scene.ground, settings.air, daylight_))
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
    if (settings.air.clouds > 0.0) {
        clouds_.emplace(settings.air.clouds);
        clouds_->light_by(daylight_);
        cloud_height_m_ = height_of_clouds_m(*scene.ground, settings.air);
    }
    if (settings.view.path_ribbon && scene.path) {
        ribbon_.emplace(*scene.path);
    }
    for (const std::uint32_t model : scene.aircraft) {
        if (settings.surface.effects) {
            effects_.emplace_back(scene.models[model]->polygons);
        }
    }
    effect_ranges_.resize(effects_.size());
    hulls_.resize(scene.aircraft.size());
    near_to_far_.resize(scene.aircraft.size());
}

void Planner::plan_light() {
    plan_.haze = haze_of(settings_.air, daylight_);
    plan_.to_sun = glm::vec3(to_sun_);
    plan_.ambient = daylight_.ambient();
    plan_.sunlight = daylight_.sunlight();
}

bool Planner::relight() {
    const landscape::GroundMesher* const before = mesher_.get();
    mesher_ = landscape::mesher_after(
        std::move(mesher_),
        *scene_.ground,
        landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    daylight_ = landscape::daylight_of(settings_.air);
    to_sun_ = landscape::direction_to_sun(settings_.air);
    sky_ = sky_of(*scene_.ground, settings_.air, daylight_);
    shadows_ = ShadowCaster(to_sun_);
    plan_light();
    return mesher_.get() == before;
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

/// The air at the eye's height over the ground's mean one.
void Planner::plan_haze(const scene::Camera& camera) {
    const scene::AirSettings& air = settings_.air;
    const double mean_m = scene_.ground->mean_height_m();
    double thinner = 1.0;
    if (air.haze_height_m > 0.0) {
        const double above_m = camera.eye_m.z - (std::isfinite(mean_m) ? mean_m : 0.0);
        thinner = std::exp(std::clamp(above_m / air.haze_height_m, -3.0, 30.0));
    }
    plan_.haze.visibility_m = static_cast<float>(air.visibility_m * thinner);
}

void Planner::plan_sky(const scene::Camera& camera) {
    if (!settings_.air.sky) {
        return;
    }
    const landscape::Ground& ground = *scene_.ground;
    plan_.sky = sky_.around(
        {camera.eye_m.z - ground.mean_height_m(),
         distance_to_edge_m(ground, camera.eye_m),
         ground.mean_colour(),
         mesher_->earth_radius_m()},
        plan_.haze,
        camera.eye_m);
}

/// Farther than the pattern's coarsest features look wider than two pixels on level ground, nobody
/// would see it.
void Planner::plan_grain(const scene::Camera& camera) {
    plan_.grain.reset();
    const landscape::Ground& ground = *scene_.ground;
    const scene::GroundSettings& settings = settings_.ground;
    if (!settings.near_detail || scene_.ground_texture || ground.spacing_m() <= 0.0 ||
        scene::ground_metric(settings) != scene::GroundMetric::ScreenError) {
        return;
    }
    using scene::GrainPattern;
    const glm::dvec3& eye_m = camera.eye_m;
    const double over_m = eye_m.z - ground.height_at(eye_m.x, eye_m.y).value_or(eye_m.z);
    const double reach_m = std::clamp(
        std::sqrt(coarsest_grain_m * std::max(over_m, 0.0) / pixel_rad_),
        least_grain_reach_m,
        most_grain_reach_m);
    const glm::dvec2 place =
        (glm::dvec2(eye_m) + glm::dvec2(GrainPattern::lean) * eye_m.z) *
        (static_cast<double>(GrainPattern::texels_per_m) / GrainPattern::texels_a_side);
    plan_.grain = scene::Grain{
        glm::vec2(place - glm::floor(place)),
        static_cast<float>(0.6 * reach_m),
        static_cast<float>(reach_m)};
}

/// What is seen through, apart from its place in the painting order.
void Planner::plan_veils(const PlanRequest& request) {
    const scene::Camera& camera = request.camera;
    veils_.begin(plan_.view_to_clip * plan_.world_to_view, settings_.view.size_px, plan_.haze);
    if (clouds_) {
        const auto clouds =
            clouds_->seen_from(camera.eye_m, cloud_height_m_, mesher_->earth_radius_m());
        cloud_range_ = veils_.add(clouds.vertices, clouds.indices);
    }
    constexpr double least_px = 6.0; ///< smaller aircraft have no effects
    for (std::size_t i = 0; i < effects_.size(); ++i) {
        const double away_m = glm::length(hulls_[i].centre_m);
        const bool is_seen = radius_m(hulls_[i]) > least_px * pixel_rad_ * away_m &&
                             scene::in_view(hulls_[i].centre_m, radius_m(hulls_[i]), frustum_);
        effect_ranges_[i] =
            is_seen ? effects_[i].add(placed_[i].parts[0], strength_of(request.states[i]), veils_)
                    : AircraftEffects::Ranges();
    }
    plan_ribbon(request);
}

void Planner::plan_ribbon(const PlanRequest& request) {
    boxes_.assign(hulls_.begin(), hulls_.end());
    if (!ribbon_) {
        return;
    }
    const double radius = scene_.model_of(0).subject.radius_m;
    constexpr double half_width = 0.3; ///< of the aircraft's radius
    constexpr double gap = 1.8;
    const auto made = ribbon_->dashes(
        {request.camera.eye_m,
         mesher_->earth_radius_m(),
         request.states.front().time_s,
         half_width * radius,
         gap * radius},
        veils_);
    // A dash that meets an aircraft has no place in the painting order beside it.
    dashes_.clear();
    for (const PathRibbon::Dash& dash : made) {
        if (std::ranges::none_of(
                hulls_, [&](const HullBox& hull) { return hiding_pair(hull, dash.box).meet; })) {
            dashes_.push_back(dash);
            boxes_.push_back(dash.box);
        }
    }
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
