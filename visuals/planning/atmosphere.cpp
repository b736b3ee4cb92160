#include "visuals/planning/atmosphere.h"

#include "visuals/landscape/ground_palette.h"

#include <algorithm>
#include <cmath>

namespace octant::visuals::planning {

namespace {

/// At the ground's mean height. Without a sky the haze is the background all around.
scene::Haze haze_of(const scene::AirSettings& air, const nature::Daylight& day) {
    scene::Haze haze{air.background, static_cast<float>(air.visibility_m)};
    haze.falloff_per_m =
        air.haze_height_m > 0.0 ? static_cast<float>(1.0 / air.haze_height_m) : 0.0F;
    if (air.sky) {
        haze.colour = day.haze_away();
        haze.horizontal_to_sun = glm::vec2(day.horizontal_to_sun());
        haze.sunward_colour = day.haze_sunward();
    }
    return haze;
}

Sky sky_of(const Scene& scene, const scene::AirSettings& air, const nature::Daylight& day) {
    return Sky(day, air.sky ? scene.ground->backdrop() : nature::Backdrop());
}

double distance_to_edge_m(const landscape::Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

} // namespace

Atmosphere::Atmosphere(const Scene& scene, const scene::AirSettings& settings)
    : scene_(scene)
    , settings_(settings)
    , daylight_(landscape::daylight_of(settings))
    , to_sun_(landscape::direction_to_sun(settings))
    , haze_(haze_of(settings, daylight_))
    , sky_(sky_of(scene, settings, daylight_)) {}

void Atmosphere::set_sun() {
    daylight_ = landscape::daylight_of(settings_);
    to_sun_ = landscape::direction_to_sun(settings_);
    haze_ = haze_of(settings_, daylight_);
    sky_ = sky_of(scene_, settings_, daylight_);
}

/// How far one sees at a height: the air is as thick as the settings say at the ground's mean one.
float Atmosphere::visibility_m(double eye_height_m) const {
    const double mean_m = scene_.ground->mean_height_m();
    double thinner = 1.0;
    if (settings_.haze_height_m > 0.0) {
        const double above_m = eye_height_m - (std::isfinite(mean_m) ? mean_m : 0.0);
        thinner = std::exp(std::clamp(above_m / settings_.haze_height_m, -3.0, 30.0));
    }
    return static_cast<float>(settings_.visibility_m * thinner);
}

void Atmosphere::write(const FrameView& view, scene::FramePlan& plan) {
    const glm::dvec3& eye_m = view.camera.eye_m;
    const landscape::Ground& ground = *scene_.ground;
    plan.to_sun = glm::vec3(to_sun_);
    plan.ambient = daylight_.ambient();
    plan.sunlight = daylight_.sunlight();
    plan.haze = haze_;
    plan.haze.visibility_m = visibility_m(eye_m.z);
    if (settings_.sky) {
        plan.sky = sky_.around(
            {eye_m.z - ground.mean_height_m(),
             distance_to_edge_m(ground, eye_m),
             ground.mean_colour(),
             view.earth_radius_m},
            plan.haze,
            eye_m);
    }
}

} // namespace octant::visuals::planning
