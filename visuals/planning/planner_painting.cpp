#include "visuals/planning/facing.h"
#include "visuals/planning/pixel_box.h"
#include "visuals/planning/planner.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

// Writes the painting steps of a plan: in which order, and how, what has been planned is drawn.
//
// In painting order (HiddenSurface::Octant, BackFace): sky, ground with its shadows in place, then
// the aircraft from far to near. Clouds come before what lies on the eye's side of them and after
// the rest: seen from below before all ground, seen from above after it. After each knot of
// aircraft the ground that lies before it is painted again, cut to where the knot is seen. Meshes
// alone ask for depth, within their knot.
//
// By depth (HiddenSurface::DepthBuffer): from near to far, so that what is hidden is not coloured
// first: aircraft, ground, shadows, sky. Where aircraft and ground are equally near the aircraft is
// seen.

namespace octant::visuals::planning {

namespace {

/// Renderers round screen positions to 1/256 pixel. What is painted again is cut this much too wide
/// where only that rounding could tell, so that no line of the covered thing shows along the cut.
constexpr double rounding_px = 0.01;

} // namespace

/// Whether the middle of one hull is nearer to the eye than that of another; of two that are
/// equally far the one with the lower number counts as nearer.
bool Planner::is_nearer(std::uint32_t a, std::uint32_t b) const {
    const double a_m2 = glm::dot(hulls_[a].centre_m, hulls_[a].centre_m);
    const double b_m2 = glm::dot(hulls_[b].centre_m, hulls_[b].centre_m);
    return a_m2 != b_m2 ? a_m2 < b_m2 : a < b;
}

void Planner::paint_by_depth() {
    std::iota(near_to_far_.begin(), near_to_far_.end(), 0U);
    std::ranges::sort(
        near_to_far_, [&](std::uint32_t a, std::uint32_t b) { return is_nearer(a, b); });
    steps_.clear_depth({glm::ivec2(0), settings_.view.size_px});
    if (placed_.size() > hulls_.size()) {
        paint(placed_.back(), scene::DepthUse::Nearest); // the cockpit is nearer than all
    }
    // What is refined comes apart, so that all others become one step.
    for (const bool refined : {false, true}) {
        for (const std::uint32_t i : near_to_far_) {
            if (is_refined(placed_[i]) == refined && !placed_[i].is_hidden) {
                paint(placed_[i], scene::DepthUse::Nearest);
            }
        }
    }
    std::size_t edge_on_indices = 0;
    plan_.ground = facing_first(ground_.all, pixel_rad_, facing_indices_, edge_on_indices);
    steps_.paint_ground_by_depth(edge_on_indices);
    steps_.paint_shadows_by_depth(ground_);
    steps_.paint_sky(scene::DepthUse::InfinitelyFar);
    for (auto i = near_to_far_.rbegin(); i != near_to_far_.rend(); ++i) {
        if (!placed_[*i].is_hidden) {
            paint_clear(placed_[*i]);
        }
    }
}

void Planner::paint_in_order(const scene::Camera& camera, PlanCounts& counts) {
    plan_.ground = facing_the_eye(ground_, pixel_rad_, facing_indices_);
    order_.arrange(boxes_);
    steps_.paint_sky();
    // The clouds lie above all ground.
    const bool from_above = clouds_ && camera.eye_m.z > cloud_height_m_;
    if (from_above) {
        steps_.paint_ground();
    }
    if (clouds_) {
        paint_knots(camera, true, counts);
        steps_.paint_veil(cloud_range_.first, cloud_range_.count);
    }
    if (!from_above) {
        steps_.paint_ground();
    }
    paint_knots(camera, false, counts);
    if (placed_.size() > hulls_.size()) {
        paint(placed_.back(), scene::DepthUse::None); // the cockpit is nearer than all
    }
}

/// Paints a whole aircraft. What was refined for this frame is always drawn by depth.
void Planner::paint(const PlacedAircraft& aircraft, scene::DepthUse depth) {
    if (!is_refined(aircraft)) {
        steps_.paint(draw_of(aircraft), depth);
        return;
    }
    const auto i = static_cast<std::size_t>(&aircraft - placed_.data());
    scene::RefinedDraw draw = refined_[i]->draw();
    draw.first_part = aircraft.first_part;
    draw.first_smooth = smooth_.refined_word();
    draw.tints = aircraft.tints;
    steps_.paint(draw);
    if (const scene::IndexRange& turning = aircraft.model->turning; turning.index_count > 0) {
        scene::AircraftDraw beside = draw_of(aircraft, turning.first_index, turning.index_count);
        beside.first_smooth = smooth_.turning_word();
        steps_.paint(beside, scene::DepthUse::Nearest);
    }
}

/// Paints what is clear of an aircraft that was refined for this frame: after all that it may be
/// seen before.
void Planner::paint_clear(const PlacedAircraft& aircraft) {
    const scene::IndexRange& clear = aircraft.model->clear;
    if (is_refined(aircraft) && clear.index_count > 0) {
        scene::AircraftDraw draw = draw_of(aircraft, clear.first_index, clear.index_count);
        draw.first_smooth = smooth_.turning_word();
        steps_.paint_clear(draw, aircraft.model->opacity);
    }
}

/// Whether the middle of a knot's box and the eye are on different sides of the clouds.
bool Planner::is_beyond_clouds(const Knot& knot, const scene::Camera& camera) const {
    const double knot_m = camera.eye_m.z + knot.box.centre_m.z;
    return clouds_ && (knot_m > cloud_height_m_) != (camera.eye_m.z > cloud_height_m_);
}

/// Paints the knots that lie beyond the clouds, or those that do not.
void Planner::paint_knots(const scene::Camera& camera, bool beyond_clouds, PlanCounts& counts) {
    for (const Knot& knot : order_.knots()) {
        if (is_beyond_clouds(knot, camera) == beyond_clouds) {
            paint_knot(knot, camera, counts);
        }
    }
}

/// Paints a knot and again what lies before it; nothing again where it is out of view.
void Planner::paint_knot(const Knot& knot, const scene::Camera& camera, PlanCounts& counts) {
    members_.clear();
    knot_dashes_.clear();
    for (const std::uint32_t member : order_.members(knot)) {
        if (member >= hulls_.size()) {
            knot_dashes_.push_back(member);
        } else if (!placed_[member].is_hidden) {
            members_.push_back(&placed_[member]);
        }
    }
    if (members_.empty() && knot_dashes_.empty()) {
        return;
    }
    if (!scene::in_view(knot.box.centre_m, radius_m(knot.box), frustum_)) {
        for (const PlacedAircraft* member : members_) {
            steps_.paint(draw_of(*member));
        }
        return;
    }
    in_front_.find(knot.box, *mesher_, ground_.all, camera.eye_m);
    paint_aircraft(knot, counts);
    if (in_front_.found().empty() || holds_eye(knot.box)) {
        return;
    }
    // Not in the cone of a knot's box: between the members a farther knot may be seen before the
    // ground. What was painted earlier and is seen in a member's cone lies behind the member.
    for (const std::uint32_t member : order_.members(knot)) {
        steps_.paint_before(ground_, in_front_.found(), knot.box, cone_of(boxes_[member]));
        counts.cuts += static_cast<int>(in_front_.found().size());
    }
}

/// The aircraft of a knot with their effects, and the dashes of a ribbon behind and before them.
void Planner::paint_aircraft(const Knot& knot, PlanCounts& counts) {
    constexpr double endless_m2 = std::numeric_limits<double>::infinity();
    const double away_m2 = members_.empty() ? 0.0 : glm::dot(knot.box.centre_m, knot.box.centre_m);
    paint_dashes(endless_m2, away_m2);
    if (!members_.empty()) {
        paint_effects(false);
        paint_members(knot, counts);
        paint_effects(true);
    }
    paint_dashes(away_m2, -1.0);
}

/// Of the knot's aircraft, what lies behind them or before them.
void Planner::paint_effects(bool after) {
    for (const PlacedAircraft* member : members_) {
        const auto i = static_cast<std::size_t>(member - placed_.data());
        if (i < effect_ranges_.size()) {
            const VeilRange& range = after ? effect_ranges_[i].after : effect_ranges_[i].before;
            steps_.paint_veil(range.first, range.count);
        }
    }
}

/// Of the knot's dashes those whose middles lie so far off, the farthest first.
void Planner::paint_dashes(double farther_m2, double nearer_m2) {
    const auto away_m2 = [&](std::uint32_t box) {
        return glm::dot(boxes_[box].centre_m, boxes_[box].centre_m);
    };
    std::ranges::sort(knot_dashes_, [&](std::uint32_t a, std::uint32_t b) {
        return away_m2(a) != away_m2(b) ? away_m2(a) > away_m2(b) : a < b;
    });
    for (const std::uint32_t box : knot_dashes_) {
        if (away_m2(box) <= farther_m2 && away_m2(box) > nearer_m2) {
            const VeilRange& range = dashes_[box - hulls_.size()].range;
            steps_.paint_veil(range.first, range.count);
        }
    }
}

/// Polygons as their order says, or cut where there is none; by depth where a mesh is among them.
void Planner::paint_members(const Knot& knot, PlanCounts& counts) {
    const bool solid =
        std::ranges::any_of(members_, [](const PlacedAircraft* one) { return is_solid(*one); });
    const bool alone = in_front_.meeting().empty() && members_.size() == 1;
    counts.knots += alone ? 0 : 1;
    if (solid) {
        paint_members_by_depth(knot);
    } else if (alone) {
        steps_.paint(draw_of(*members_.front()));
    } else {
        counts.cuts += repaint_.paint(
            members_, knot.box, ground_, in_front_.meeting(), rounding_px * pixel_rad_, steps_);
        counts.unordered += repaint_.given_up();
    }
}

/// By a depth buffer that holds nothing else but the ground that meets them.
void Planner::paint_members_by_depth(const Knot& knot) {
    steps_.clear_depth(pixel_box(knot.box, plan_, settings_.view.size_px));
    if (!in_front_.meeting().empty()) {
        steps_.hide_by_ground(ground_, in_front_.meeting());
    }
    for (const PlacedAircraft* member : members_) {
        paint(*member, scene::DepthUse::Nearest);
    }
    const auto number = [&](const PlacedAircraft* member) {
        return static_cast<std::uint32_t>(member - placed_.data());
    };
    std::ranges::sort(members_, [&](const PlacedAircraft* a, const PlacedAircraft* b) {
        return is_nearer(number(b), number(a));
    });
    for (const PlacedAircraft* member : members_) {
        paint_clear(*member);
    }
}

} // namespace octant::visuals::planning
