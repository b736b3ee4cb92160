#include "visuals/planning/scene_painter.h"

#include "visuals/planning/front_facing.h"
#include "visuals/planning/pixel_box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace octant::visuals::planning {

namespace {

/// A little more than two of scene::screen_step_px. What is painted again is cut this much too wide
/// where only that rounding could tell, so that no line of the covered thing shows along the cut.
constexpr double paint_rounding_px = 0.01;

double away_m2(const OrientedBox& box) {
    return glm::dot(box.centre_m, box.centre_m);
}

/// Whether the middle of one box is nearer to the eye than that of another; of two that are equally
/// far the one with the lower number counts as nearer.
bool is_nearer(std::span<const OrientedBox> boxes, std::uint32_t a, std::uint32_t b) {
    const double a_m2 = away_m2(boxes[a]);
    const double b_m2 = away_m2(boxes[b]);
    return a_m2 != b_m2 ? a_m2 < b_m2 : a < b;
}

bool is_above_clouds(const FrameScene& frame, double height_m) {
    const auto clouds_m = frame.transparents.cloud_height_m();
    return clouds_m && height_m > *clouds_m;
}

/// Whether the middle of a knot's box and the eye are on different sides of the clouds.
bool is_beyond_clouds(const FrameScene& frame, const OverlapGroup& overlap_group) {
    const double eye_m = frame.view.camera.eye_m.z;
    return is_above_clouds(frame, eye_m + overlap_group.box.centre_m.z) != is_above_clouds(frame, eye_m);
}

} // namespace

void ScenePainter::paint(
    const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts) {
    if (hidden_surface == scene::HiddenSurface::DepthBuffer) {
        paint_by_depth(frame);
    } else {
        paint_in_order(frame, counts);
    }
    steps_.add_overlay(frame.transparents.draw().indices.size());
}

void ScenePainter::paint_by_depth(const FrameScene& frame) {
    const auto placed = frame.fleet.placed();
    const auto bounding_boxes = frame.fleet.bounding_boxes();
    near_to_far_.resize(bounding_boxes.size());
    std::iota(near_to_far_.begin(), near_to_far_.end(), 0U);
    std::ranges::sort(
        near_to_far_, [&](std::uint32_t a, std::uint32_t b) { return is_nearer(bounding_boxes, a, b); });
    steps_.clear_depth({glm::ivec2(0), frame.view.size_px});
    if (const PlacedAircraft* cockpit = frame.fleet.cockpit()) {
        paint(frame, *cockpit, scene::DepthUse::Nearest);
    }
    // What is refined comes apart, so that all others become one step.
    for (const bool refined : {false, true}) {
        for (const std::uint32_t i : near_to_far_) {
            if (is_refined(placed[i]) == refined && !placed[i].is_hidden) {
                paint(frame, placed[i], scene::DepthUse::Nearest);
            }
        }
    }
    std::size_t edge_on_indices = 0;
    plan_.ground =
        front_facing_first(frame.ground.all, frame.view.pixel_rad, facing_indices_, edge_on_indices);
    steps_.add_ground_by_depth(edge_on_indices);
    steps_.add_shadows_by_depth(frame.ground);
    steps_.add_sky(scene::DepthUse::InfinitelyFar);
    for (auto i = near_to_far_.rbegin(); i != near_to_far_.rend(); ++i) {
        if (!placed[*i].is_hidden) {
            paint_transparent(frame, placed[*i]);
        }
    }
}

void ScenePainter::paint_in_order(const FrameScene& frame, PlanCounts& counts) {
    plan_.ground = front_facing(frame.ground, frame.view.pixel_rad, facing_indices_);
    boxes_.assign(frame.fleet.bounding_boxes().begin(), frame.fleet.bounding_boxes().end());
    for (const PathRibbon::Dash& dash : frame.transparents.dashes()) {
        boxes_.push_back(dash.box);
    }
    order_.arrange(boxes_);
    steps_.add_sky();
    // The clouds lie above all ground.
    const bool from_above = is_above_clouds(frame, frame.view.camera.eye_m.z);
    if (from_above) {
        steps_.add_ground();
    }
    if (frame.transparents.cloud_height_m()) {
        paint_groups(frame, true, counts);
        steps_.add_transparent_range(frame.transparents.clouds().first, frame.transparents.clouds().count);
    }
    if (!from_above) {
        steps_.add_ground();
    }
    paint_groups(frame, false, counts);
    if (const PlacedAircraft* cockpit = frame.fleet.cockpit()) {
        paint(frame, *cockpit, scene::DepthUse::None);
    }
}

/// Paints the knots that lie beyond the clouds, or those that do not.
void ScenePainter::paint_groups(const FrameScene& frame, bool beyond_clouds, PlanCounts& counts) {
    for (const OverlapGroup& overlap_group : order_.overlap_groups()) {
        if (is_beyond_clouds(frame, overlap_group) == beyond_clouds) {
            paint_group(frame, overlap_group, counts);
        }
    }
}

void ScenePainter::collect_members(const FrameScene& frame, const OverlapGroup& overlap_group) {
    members_.clear();
    group_dashes_.clear();
    for (const std::uint32_t member : order_.members(overlap_group)) {
        if (member >= frame.fleet.bounding_boxes().size()) {
            group_dashes_.push_back(member);
        } else if (!frame.fleet.placed()[member].is_hidden) {
            members_.push_back(&frame.fleet.placed()[member]);
        }
    }
}

/// Paints a knot and again what lies before it; nothing again where it is out of view.
void ScenePainter::paint_group(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
    collect_members(frame, overlap_group);
    if (members_.empty() && group_dashes_.empty()) {
        return;
    }
    if (!in_view(overlap_group.box, frame.view)) {
        for (const PlacedAircraft* member : members_) {
            steps_.add(draw_of(*member));
        }
        return;
    }
    in_front_.find(overlap_group.box, frame.mesher, frame.ground.all, frame.view.camera.eye_m);
    paint_with_effects(frame, overlap_group, counts);
    if (in_front_.found().empty() || contains_eye(overlap_group.box)) {
        return;
    }
    // Not in the cone of a knot's box: between the members a farther knot may be seen before the
    // ground. What was painted earlier and is seen in a member's cone lies behind the member.
    for (const std::uint32_t member : order_.members(overlap_group)) {
        steps_.add_in_front(frame.ground, in_front_.found(), overlap_group.box, cone_of(boxes_[member]));
        counts.cuts += static_cast<int>(in_front_.found().size());
    }
}

/// The aircraft of a knot with their effects, and the dashes of a ribbon behind and before them.
void ScenePainter::paint_with_effects(
    const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
    constexpr double infinite_distance_m2 = std::numeric_limits<double>::infinity();
    const double group_distance_m2 = members_.empty() ? 0.0 : away_m2(overlap_group.box);
    paint_dashes(frame, infinite_distance_m2, group_distance_m2);
    if (!members_.empty()) {
        paint_effects(frame, false);
        paint_members(frame, overlap_group, counts);
        paint_effects(frame, true);
    }
    paint_dashes(frame, group_distance_m2, -1.0);
}

/// Of the knot's aircraft, what lies behind them or before them.
void ScenePainter::paint_effects(const FrameScene& frame, bool after) {
    for (const PlacedAircraft* member : members_) {
        const AircraftEffects::TransparentRanges ranges = frame.transparents.effects_of(member->number);
        const TransparentRange& range = after ? ranges.after : ranges.before;
        steps_.add_transparent_range(range.first, range.count);
    }
}

/// Of the knot's dashes those whose middles lie so far off, the farthest first.
void ScenePainter::paint_dashes(const FrameScene& frame, double farther_m2, double nearer_m2) {
    std::ranges::sort(group_dashes_, [&](std::uint32_t a, std::uint32_t b) {
        const double a_m2 = away_m2(boxes_[a]);
        const double b_m2 = away_m2(boxes_[b]);
        return a_m2 != b_m2 ? a_m2 > b_m2 : a < b;
    });
    for (const std::uint32_t box : group_dashes_) {
        if (away_m2(boxes_[box]) <= farther_m2 && away_m2(boxes_[box]) > nearer_m2) {
            const TransparentRange& range = frame.transparents.dashes()[box - frame.fleet.bounding_boxes().size()].range;
            steps_.add_transparent_range(range.first, range.count);
        }
    }
}

/// Polygons as their order says, or cut where there is none; by depth where a mesh is among them.
void ScenePainter::paint_members(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
    const bool has_mesh =
        std::ranges::any_of(members_, [](const PlacedAircraft* one) { return is_mesh(*one); });
    const bool alone = in_front_.intersecting().empty() && members_.size() == 1;
    counts.overlap_groups += alone ? 0 : 1;
    if (has_mesh) {
        paint_members_by_depth(frame, overlap_group);
    } else if (alone) {
        steps_.add(draw_of(*members_.front()));
    } else {
        paint_intersecting(frame, overlap_group, counts);
    }
}

/// Polygons of aircraft that meet each other or the ground: cut, or by depth where the cuts would
/// take too long.
void ScenePainter::paint_intersecting(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
    const StepWriter::Checkpoint before = steps_.checkpoint();
    const double rounding_rad = paint_rounding_px * frame.view.pixel_rad;
    const auto cuts =
        repaint_.paint(members_, overlap_group.box, frame.ground, in_front_.intersecting(), rounding_rad, steps_);
    if (cuts) {
        counts.cuts += *cuts;
        return;
    }
    steps_.roll_back(before);
    counts.unordered += static_cast<int>(members_.size());
    paint_members_by_depth(frame, overlap_group);
}

/// By a depth buffer that holds nothing else but the ground that meets them.
void ScenePainter::paint_members_by_depth(const FrameScene& frame, const OverlapGroup& overlap_group) {
    steps_.clear_depth(pixel_box(overlap_group.box, plan_, frame.view.size_px));
    if (!in_front_.intersecting().empty()) {
        steps_.occlude_by_ground(frame.ground, in_front_.intersecting());
    }
    for (const PlacedAircraft* member : members_) {
        paint(frame, *member, scene::DepthUse::Nearest);
    }
    std::ranges::sort(members_, [&](const PlacedAircraft* a, const PlacedAircraft* b) {
        return is_nearer(frame.fleet.bounding_boxes(), b->number, a->number);
    });
    for (const PlacedAircraft* member : members_) {
        paint_transparent(frame, *member);
    }
}

/// Paints a whole aircraft. What was refined for this frame is always drawn by depth.
void ScenePainter::paint(
    const FrameScene& frame, const PlacedAircraft& aircraft, scene::DepthUse depth) {
    if (!is_refined(aircraft)) {
        steps_.add(draw_of(aircraft), depth);
        return;
    }
    scene::RefinedDraw draw = frame.fleet.refined()[aircraft.number]->draw();
    draw.first_part = aircraft.first_part;
    draw.first_smooth = frame.smooth.refined_word_index();
    draw.tints = aircraft.tints;
    steps_.add(draw);
    if (const scene::IndexRange& turning = aircraft.model->turning; turning.index_count > 0) {
        scene::AircraftDraw turning_draw = draw_of(aircraft, turning.first_index, turning.index_count);
        turning_draw.first_smooth = frame.smooth.turning_word_index();
        steps_.add(turning_draw, scene::DepthUse::Nearest);
    }
}

/// Paints what is transparent of an aircraft that was refined for this frame: after all that it may
/// be seen before.
void ScenePainter::paint_transparent(const FrameScene& frame, const PlacedAircraft& aircraft) {
    const scene::IndexRange& transparent = aircraft.model->transparent;
    if (is_refined(aircraft) && transparent.index_count > 0) {
        scene::AircraftDraw draw =
            draw_of(aircraft, transparent.first_index, transparent.index_count);
        draw.first_smooth = frame.smooth.turning_word_index();
        steps_.add_transparent(draw, aircraft.model->opacity);
    }
}

} // namespace octant::visuals::planning
