#include "visuals/planning/planner.h"
#include "visuals/scene/grain_pattern.h"

#include <glm/common.hpp>

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

double distance_to_edge_m(const landscape::Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

} // namespace

Sky Planner::sky_under(const nature::Daylight& day) const {
    return Sky(day, settings_.air.sky ? scene_.ground->surroundings() : nature::Backdrop());
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
    sky_ = sky_under(daylight_);
    shadows_ = ShadowCaster(to_sun_);
    plan_light();
    light_clouds();
    return mesher_.get() == before;
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

} // namespace octant::visuals::planning
