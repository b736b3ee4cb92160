#include "visuals/planning/frame_transparents.h"

#include "sim/aircraft_kind.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace octant::visuals::planning {

namespace {

double height_of_clouds_m(const landscape::Ground& ground, const scene::AirSettings& air) {
    constexpr double above_ground_m = 500.0;
    return air.cloud_height_m ? *air.cloud_height_m : landscape::highest_m(ground) + above_ground_m;
}

} // namespace

FrameTransparents::FrameTransparents(
    const Scene& scene, const scene::Settings& settings, const nature::Daylight& day)
    : scene_(scene) {
    if (settings.air.clouds > 0.0) {
        clouds_.emplace(settings.air.clouds);
        cloud_height_m_ = height_of_clouds_m(*scene.ground, settings.air);
        set_daylight(day);
    }
    if (settings.view.path_ribbon && scene.path) {
        ribbon_.emplace(*scene.path);
    }
    if (settings.surface.effects) {
        for (const std::uint32_t model : scene.aircraft) {
            effects_.emplace_back(scene.models[model]->polygons);
        }
    }
    effect_ranges_.resize(effects_.size());
}

void FrameTransparents::set_daylight(const nature::Daylight& day) {
    if (clouds_) {
        clouds_->set_daylight(day);
    }
}

void FrameTransparents::make(
    const FrameView& view,
    const AircraftStates& aircraft,
    const Fleet& fleet,
    const scene::FramePlan& plan) {
    transparents_.begin(plan.view_to_clip * plan.world_to_view, view.size_px, plan.haze);
    if (clouds_) {
        const auto clouds =
            clouds_->seen_from(view.camera.eye_m, cloud_height_m_, view.earth_radius_m);
        cloud_range_ = transparents_.add(clouds.vertices, clouds.indices);
    }
    add_effects(view, aircraft, fleet);
    if (ribbon_) {
        add_ribbon(view, aircraft.states.front().time_s, fleet.bounding_boxes());
    }
}

void FrameTransparents::add_effects(
    const FrameView& view, const AircraftStates& aircraft, const Fleet& fleet) {
    constexpr double min_px = 6.0; // smaller aircraft have no effects
    for (std::size_t i = 0; i < effects_.size(); ++i) {
        const OrientedBox& hull = fleet.bounding_boxes()[i];
        const double away_m = glm::length(hull.centre_m);
        const bool is_seen =
            radius_m(hull) > min_px * view.pixel_rad * away_m && in_view(hull, view);
        effect_ranges_[i] = is_seen
                                ? effects_[i].add(
                                      fleet.placed()[i].parts[0],
                                      strength_of(
                                          sim::find_aircraft_kind(scene_.model_of(i).polygons.name),
                                          aircraft.states[i]),
                                      aircraft.articulated_parts,
                                      static_cast<std::uint32_t>(i),
                                      transparents_)
                                : AircraftEffects::TransparentRanges();
    }
}

/// Adds the dashes of the ribbon. One that meets an aircraft has no place in the painting order
/// beside it and is left out.
void FrameTransparents::add_ribbon(const FrameView& view, double time_s, std::span<const OrientedBox> bounding_boxes) {
    const double radius = scene_.model_of(0).subject.radius_m;
    constexpr double half_width = 0.3; // of the aircraft's radius
    constexpr double gap = 1.8;
    const auto made = ribbon_->dashes(
        {view.camera.eye_m, view.earth_radius_m, time_s, half_width * radius, gap * radius},
        transparents_);
    dashes_.clear();
    for (const PathRibbon::Dash& dash : made) {
        if (std::ranges::none_of(
                bounding_boxes, [&](const OrientedBox& hull) { return occlusion_pair(hull, dash.box).intersect; })) {
            dashes_.push_back(dash);
        }
    }
}

} // namespace octant::visuals::planning
