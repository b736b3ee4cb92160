#include "visuals/planning/planner.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::visuals::planning {

namespace {

double height_of_clouds_m(const landscape::Ground& ground, const scene::AirSettings& air) {
    constexpr double above_ground_m = 500.0;
    return air.cloud_height_m ? *air.cloud_height_m : landscape::highest_m(ground) + above_ground_m;
}

} // namespace

void Planner::make_veils() {
    if (settings_.air.clouds > 0.0) {
        clouds_.emplace(settings_.air.clouds);
        cloud_height_m_ = height_of_clouds_m(*scene_.ground, settings_.air);
        light_clouds();
    }
    if (settings_.view.path_ribbon && scene_.path) {
        ribbon_.emplace(*scene_.path);
    }
    if (settings_.surface.effects) {
        for (const std::uint32_t model : scene_.aircraft) {
            effects_.emplace_back(scene_.models[model]->polygons);
        }
    }
    effect_ranges_.resize(effects_.size());
}

void Planner::light_clouds() {
    if (clouds_) {
        clouds_->light_by(daylight_);
    }
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
        effect_ranges_[i] = is_seen ? effects_[i].add(
                                          placed_[i].parts[0],
                                          strength_of(request.states[i]),
                                          turned_,
                                          static_cast<std::uint32_t>(i),
                                          veils_)
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

} // namespace octant::visuals::planning
