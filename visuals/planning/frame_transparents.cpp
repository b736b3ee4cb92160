#include "visuals/planning/frame_transparents.h"

#include "sim/aircraft_kind.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::planning {

namespace {

constexpr std::size_t max_dashes = 80;
/// Where that are not too many dashes.
constexpr double dash_s = 1.0;
constexpr double box_margin_m = 0.2;
constexpr double farthest_m = 40000.0;
/// Amber and cyan.
constexpr std::array<std::uint32_t, 2> leg_colours{0x001e8cffU, 0x00e6d232U};
constexpr std::uint32_t flown_alpha = 0xd0U;
constexpr std::uint32_t coming_alpha = 0x68U;

/// The smallest box along a dash's chord that holds its corners.
OrientedBox box_around(std::span<const models::ColourVertex> corners, const glm::dvec3& chord) {
    OrientedBox box;
    const double length_m = glm::length(chord);
    const glm::dvec3 along = length_m > 1e-6 ? chord / length_m : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 level(-along.y, along.x, 0.0);
    const glm::dvec3 side = glm::length(level) > 1e-6 ? glm::normalize(level) : glm::dvec3(0.0, 1.0, 0.0);
    box.axes = glm::dmat3(along, side, glm::cross(along, side));
    glm::dvec3 least(1e300);
    glm::dvec3 most(-1e300);
    for (const models::ColourVertex& corner : corners) {
        const glm::dvec3 at = glm::transpose(box.axes) * glm::dvec3(corner.position_m);
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    box.centre_m = box.axes * (0.5 * (least + most));
    box.half_m = 0.5 * (most - least) + box_margin_m;
    return box;
}

} // namespace

PathRibbon::PathRibbon(const DrawnPath& path) : path_(path) {
    const auto usual = static_cast<std::size_t>(std::lround(dash_s / path.step_s));
    points_per_dash_ = std::max({usual, path.points.size() / max_dashes, std::size_t{2}});
}

std::span<const PathRibbon::Dash> PathRibbon::dashes(const RibbonView& view, TransparentGeometry& transparents) {
    dashes_.clear();
    if (path_.points.size() < 2) { return dashes_; }
    const std::size_t last = path_.points.size() - 1;
    for (std::size_t first = 0; first < last; first += points_per_dash_) {
        // The last tenth is the gap to the next dash.
        const std::size_t gap = std::max<std::size_t>(points_per_dash_ / 10, 1);
        add_dash(first, std::min(first + points_per_dash_ - gap, last), view, transparents);
    }
    return dashes_;
}

PathRibbon::AircraftPoint PathRibbon::aircraft_point(double time_s) const {
    const double fractional_point = (time_s - path_.first_s) / path_.step_s;
    const auto last = static_cast<double>(path_.points.size() - 1);
    const double at = std::clamp(fractional_point, 0.0, last);
    const auto point = static_cast<std::size_t>(at);
    const std::size_t next = std::min(point + 1, path_.points.size() - 1);
    return {fractional_point, point,
        glm::mix(path_.points[point].position_m, path_.points[next].position_m, at - static_cast<double>(point))};
}

/// The dash of points first .. last, but for what is beside the aircraft: two pieces where that is in its middle.
void PathRibbon::add_dash(
    std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents) {
    const AircraftPoint aircraft = aircraft_point(view.time_s);
    const auto close = [&](std::size_t point) {
        return glm::distance(path_.points[point].position_m, aircraft.place_m) < view.gap_m;
    };
    const bool holds_aircraft = aircraft.point >= first && aircraft.point < last;
    std::size_t until = holds_aircraft ? aircraft.point : last;
    std::size_t from = holds_aircraft ? aircraft.point + 1 : first;
    while (until > first && close(until)) { --until; }
    while (from < last && close(from)) { ++from; }
    if (holds_aircraft) {
        add_ribbon_section(first, until, view, transparents);
        add_ribbon_section(from, last, view, transparents);
    } else {
        add_ribbon_section(from, until, view, transparents);
    }
}

void PathRibbon::add_ribbon_section(
    std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents) {
    const auto away_m = [&](std::size_t point) { return glm::distance(path_.points[point].position_m, view.eye_m); };
    if (first >= last || std::min(away_m(first), away_m(last)) > farthest_m) { return; }
    const double fractional_point = aircraft_point(view.time_s).fractional_point;
    const auto next_leg = std::ranges::upper_bound(path_.legs, first, {}, &DrawnPath::Leg::first_point);
    const auto leg = static_cast<std::size_t>(next_leg - path_.legs.begin());
    vertices_.clear();
    indices_.clear();
    for (std::size_t i = first; i <= last; ++i) {
        const DrawnPath::Point& point = path_.points[i];
        const bool flown = static_cast<double>(i) <= fractional_point;
        const std::uint32_t colour = leg_colours[leg % leg_colours.size()] | (flown ? flown_alpha : coming_alpha)
                                                                                 << 24U;
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 at_m = point.position_m + side * view.half_width_m * point.right - view.eye_m;
            if (view.earth_radius_m > 0.0) {
                at_m.z -= (at_m.x * at_m.x + at_m.y * at_m.y) / (2.0 * view.earth_radius_m);
            }
            vertices_.push_back({glm::vec3(at_m), colour});
        }
        if (i > first) {
            const auto a = static_cast<std::uint32_t>(vertices_.size() - 4);
            indices_.insert(indices_.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
        }
    }
    const glm::dvec3 chord = path_.points[last].position_m - path_.points[first].position_m;
    const TransparentRange range = transparents.add(vertices_, indices_);
    if (range.count > 0) { dashes_.push_back({box_around(vertices_, chord), range}); }
}

namespace {

double height_of_clouds_m(const landscape::Ground& ground, const scene::AirSettings& air) {
    constexpr double above_ground_m = 500.0;
    return air.cloud_height_m ? *air.cloud_height_m : landscape::highest_m(ground) + above_ground_m;
}

} // namespace

FrameTransparents::FrameTransparents(const Scene& scene, const scene::Settings& settings, const nature::Daylight& day)
    : scene_(scene) {
    if (settings.air.clouds > 0.0) {
        clouds_.emplace(settings.air.clouds);
        cloud_height_m_ = height_of_clouds_m(*scene.ground, settings.air);
        set_daylight(day);
    }
    if (settings.view.path_ribbon && scene.path) { ribbon_.emplace(*scene.path); }
    if (settings.surface.effects) {
        for (const std::uint32_t model : scene.aircraft) { effects_.emplace_back(scene.models[model]->polygons); }
    }
    effect_ranges_.resize(effects_.size());
}

void FrameTransparents::set_daylight(const nature::Daylight& day) {
    if (clouds_) { clouds_->set_daylight(day); }
}

void FrameTransparents::make(
    const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan) {
    transparents_.begin(plan.view_to_clip * plan.world_to_view, view.size_px, plan.haze);
    if (clouds_) {
        const auto clouds = clouds_->seen_from(view.camera.eye_m, cloud_height_m_, view.earth_radius_m);
        cloud_range_ = transparents_.add(clouds.vertices, clouds.indices);
    }
    add_effects(view, request, fleet);
    if (ribbon_) { add_ribbon(view, request.states.front().time_s, fleet.bounding_boxes()); }
}

void FrameTransparents::add_effects(const FrameView& view, const PlanRequest& request, const Fleet& fleet) {
    constexpr double min_px = 6.0; // smaller aircraft have no effects
    for (std::size_t i = 0; i < effects_.size(); ++i) {
        const OrientedBox& hull = fleet.bounding_boxes()[i];
        const double away_m = glm::length(hull.centre_m);
        const bool is_seen = radius_m(hull) > min_px * view.pixel_rad * away_m && in_view(hull, view);
        effect_ranges_[i] =
            is_seen ? effects_[i].add(fleet.placed()[i].parts[0],
                          strength_of(sim::find_aircraft_kind(scene_.model_of(i).polygons.name), request.states[i]),
                          request.articulated_parts, static_cast<std::uint32_t>(i), transparents_)
                    : AircraftEffects::TransparentRanges();
    }
}

/// Adds the dashes of the ribbon. One that meets an aircraft has no place in the painting order beside it and is left
/// out.
void FrameTransparents::add_ribbon(const FrameView& view, double time_s, std::span<const OrientedBox> bounding_boxes) {
    const double radius = scene_.model_of(0).subject.radius_m;
    constexpr double half_width = 0.3; // of the aircraft's radius
    constexpr double gap = 1.8;
    const auto made = ribbon_->dashes(
        {view.camera.eye_m, view.earth_radius_m, time_s, half_width * radius, gap * radius}, transparents_);
    dashes_.clear();
    for (const PathRibbon::Dash& dash : made) {
        if (std::ranges::none_of(
                bounding_boxes, [&](const OrientedBox& hull) { return occlusion_pair(hull, dash.box).intersect; })) {
            dashes_.push_back(dash);
        }
    }
}

} // namespace octant::visuals::planning
