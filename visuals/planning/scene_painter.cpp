#include "visuals/planning/scene_painter.h"
#include "visuals/planning/ground_frame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace octant::visuals::planning {

// Knots are the strongly connected components of "waits for": R. Tarjan, Depth-First Search and Linear Graph
// Algorithms, SIAM Journal on Computing 1(2), 1972, section 4. Deviations: a path kept in memory stands in for the
// recursion.

void SceneOrder::arrange(std::span<const OrientedBox> boxes) {
    place_bodies(boxes);
    find_windows();
    overlap_groups_.clear();
    members_.clear();
    std::uint32_t body = 0;
    const auto add_single_bodies_until = [&](std::size_t end) {
        for (; body < end; ++body) { add_overlap_group(std::span(&body, 1), 0); }
    };
    std::size_t next = 0;
    while (next < windows_.size()) {
        auto [first, last] = windows_[next++];
        while (next < windows_.size() && windows_[next].first <= last) {
            last = std::max(last, windows_[next++].second);
        }
        add_single_bodies_until(first);
        arrange_window(first, last);
        body = last + 1;
    }
    add_single_bodies_until(bodies_.size());
}

void SceneOrder::place_bodies(std::span<const OrientedBox> boxes) {
    bodies_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        Body& body = bodies_.emplace_back();
        body.box = boxes[i];
        body.index = i;
        body.radius_m = radius_m(body.box);
        const double distance_m = glm::length(body.box.centre_m);
        body.power_m2 = distance_m * distance_m - body.radius_m * body.radius_m;
        body.around_eye = distance_m <= body.radius_m;
        if (!body.around_eye) {
            body.towards = body.box.centre_m / distance_m;
            body.sine = body.radius_m / distance_m;
            body.cosine = std::sqrt(1.0 - body.sine * body.sine);
        }
    }
    std::ranges::sort(bodies_, [](const Body& a, const Body& b) {
        return a.power_m2 != b.power_m2 ? a.power_m2 > b.power_m2 : a.index < b.index;
    });
}

/// Sweeps along x for bodies whose spheres meet, and notes the windows of the list in which a body stands before one
/// that it hides.
void SceneOrder::find_windows() {
    windows_.clear();
    by_x_.resize(bodies_.size());
    std::iota(by_x_.begin(), by_x_.end(), 0U);
    const auto min_x = [&](std::uint32_t i) { return bodies_[i].box.centre_m.x - bodies_[i].radius_m; };
    std::ranges::sort(
        by_x_, [&](std::uint32_t a, std::uint32_t b) { return min_x(a) != min_x(b) ? min_x(a) < min_x(b) : a < b; });
    for (std::size_t i = 0; i < by_x_.size(); ++i) {
        const Body& body = bodies_[by_x_[i]];
        const double max_x = body.box.centre_m.x + body.radius_m;
        for (std::size_t k = i + 1; k < by_x_.size() && min_x(by_x_[k]) <= max_x; ++k) {
            const Body& other = bodies_[by_x_[k]];
            const glm::dvec3 apart_m = other.box.centre_m - body.box.centre_m;
            const double contact_tolerance_m = body.radius_m + other.radius_m;
            if (glm::dot(apart_m, apart_m) > contact_tolerance_m * contact_tolerance_m) { continue; }
            const auto [earlier, later] = std::minmax(by_x_[i], by_x_[k]);
            if (occlusion_pair(bodies_[earlier].box, bodies_[later].box).a_occludes_b) {
                windows_.emplace_back(earlier, later);
            }
        }
    }
    std::ranges::sort(windows_);
}

/// Adds the knots of bodies first .. last, those of great power first where that leaves a choice.
void SceneOrder::arrange_window(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t count = last - first + 1;
    find_occluders(first, count);
    visited_ = 0;
    for (std::uint32_t body = 0; body < count; ++body) {
        if (visits_[body].number == 0) { visit_component(first, body); }
    }
}

/// False when the spheres around two boxes are seen apart, with nothing said about the boxes.
bool SceneOrder::may_overlap_on_screen(const Body& a, const Body& b) {
    return a.around_eye || b.around_eye ||
           glm::dot(a.towards, b.towards) >= a.cosine * b.cosine - a.sine * b.sine - 1e-9;
}

void SceneOrder::find_occluders(std::uint32_t first, std::uint32_t count) {
    occluders_.clear();
    for (std::uint32_t a = 0; a < count; ++a) {
        const Body& earlier = bodies_[first + a];
        for (std::uint32_t b = a + 1; b < count; ++b) {
            const Body& later = bodies_[first + b];
            if (!may_overlap_on_screen(earlier, later)) { continue; }
            const OcclusionPair pair = occlusion_pair(earlier.box, later.box);
            if (pair.a_occludes_b) { occluders_.emplace_back(a, b); }
            if (pair.b_occludes_a) { occluders_.emplace_back(b, a); }
        }
    }
    std::ranges::sort(occluders_);
    visits_.assign(count, {});
    for (std::uint32_t i = 0; i < occluders_.size(); ++i) {
        ComponentVisit& visit = visits_[occluders_[i].first];
        visit.next = visit.end == 0 ? i : visit.next;
        visit.end = i + 1;
    }
}

void SceneOrder::begin_visit(std::uint32_t body) {
    visits_[body].number = ++visited_;
    visits_[body].least = visited_;
    path_.push_back(body);
    open_.push_back(body);
}

/// Walks along what each body waits for. A body from which no lesser number is reached than its own closes a knot with
/// all that are open since.
void SceneOrder::visit_component(std::uint32_t first, std::uint32_t body) {
    path_.clear();
    open_.clear();
    begin_visit(body);
    while (!path_.empty()) {
        const std::uint32_t at = path_.back();
        ComponentVisit& visit = visits_[at];
        if (visit.next < visit.end) {
            const std::uint32_t other = occluders_[visit.next++].second;
            if (visits_[other].number == 0) {
                begin_visit(other);
            } else if (!visits_[other].is_in_group) {
                visit.least = std::min(visit.least, visits_[other].number);
            }
            continue;
        }
        path_.pop_back();
        if (!path_.empty()) {
            ComponentVisit& back = visits_[path_.back()];
            back.least = std::min(back.least, visit.least);
        }
        if (visit.least == visit.number) {
            std::size_t overlap_group = open_.size();
            do { visits_[open_[--overlap_group]].is_in_group = true; } while (open_[overlap_group] != at);
            add_overlap_group(std::span(open_).subspan(overlap_group), first);
            open_.resize(overlap_group);
        }
    }
}

/// `bodies` count from body `first`.
void SceneOrder::add_overlap_group(std::span<const std::uint32_t> bodies, std::uint32_t first) {
    OverlapGroup& overlap_group = overlap_groups_.emplace_back();
    overlap_group.first = static_cast<std::uint32_t>(members_.size());
    overlap_group.count = static_cast<std::uint32_t>(bodies.size());
    overlap_group.box = bodies_[first + bodies.front()].box;
    AxisAlignedBox extent = world_bounds(overlap_group.box);
    for (const std::uint32_t body : bodies) {
        const AxisAlignedBox own = world_bounds(bodies_[first + body].box);
        extent.min_m = glm::min(extent.min_m, own.min_m);
        extent.max_m = glm::max(extent.max_m, own.max_m);
        members_.push_back(bodies_[first + body].index);
    }
    if (overlap_group.count > 1) {
        overlap_group.box = oriented_box(extent);
        std::ranges::sort(std::span(members_).subspan(overlap_group.first));
    }
}

namespace {

/// Share of its distance within which a corner counts as lying on another polygon's plane.
constexpr double touching = 1e-9;

} // namespace

std::optional<int> PolygonRepaint::paint(std::span<const PlacedAircraft* const> aircraft, const OrientedBox& box,
    const GroundFrame& ground, std::span<const std::uint32_t> intersecting, double rounding_rad, StepWriter& steps) {
    painted_.clear();
    corners_.clear();
    repaint_count_ = 0;
    comparison_count_ = 0;
    ground_ = &ground;
    for (const std::uint32_t triangle : intersecting) {
        place_triangle(ground.all, triangle, part_);
        clip_to_box(part_, box, scratch_);
        record({is_ground, triangle, 0, 0, 0}, part_);
    }
    for (std::uint32_t owner = 0; owner < aircraft.size() && !exceeds_limits(); ++owner) {
        paint_aircraft(aircraft, owner, rounding_rad, steps);
    }
    return exceeds_limits() ? std::nullopt : std::optional(repaint_count_);
}

void PolygonRepaint::record(PaintedItem painted, const ViewPolygon& part) {
    painted.first_corner = corners_.size();
    painted.corner_count = part.size();
    corners_.insert(corners_.end(), part.begin(), part.end());
    painted_.push_back(painted);
}

void PolygonRepaint::paint_aircraft(
    std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner, double rounding_rad, StepWriter& steps) {
    for (const scene::IndexRange& range : aircraft[owner]->ranges) {
        paint_range(aircraft, owner, range, rounding_rad, steps);
    }
}

void PolygonRepaint::paint_range(std::span<const PlacedAircraft* const> aircraft, std::uint32_t owner,
    const scene::IndexRange& range, double rounding_rad, StepWriter& steps) {
    const PlacedAircraft& own = *aircraft[owner];
    std::uint32_t run_first = range.first_index;
    std::uint32_t next = run_first;
    const auto polygons = own.list.subspan(range.first_polygon, static_cast<std::size_t>(range.polygons));
    for (const std::uint32_t polygon : polygons) {
        if (exceeds_limits()) { return; }
        const std::uint32_t first = next;
        next += own.model->index_count_of(polygon);
        place_polygon(own, polygon, polygon_);
        const Plane plane = plane_of(polygon_);
        if (plane.offset_m <= 0.0) {
            continue; // seen from behind: not drawn
        }
        const std::size_t before = painted_.size();
        record({owner, first, next - first, 0, 0}, polygon_);
        const std::size_t hiding = painted_.size();
        find_occluding(plane, owner, before, rounding_rad);
        if (painted_.size() == hiding) { continue; }
        steps.add(draw_of(own, run_first, next - run_first));
        run_first = next;
        for (std::size_t i = hiding; i < painted_.size(); ++i) {
            write(aircraft, painted_[i], steps);
            ++repaint_count_;
        }
    }
    if (next > run_first) { steps.add(draw_of(own, run_first, next - run_first)); }
}

/// Notes the parts of what was painted before that hide part of polygon_.
void PolygonRepaint::find_occluding(const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad) {
    cone_of(polygon_, rounding_rad, cone_);
    const double tolerance_m = touching * (1.0 + glm::length(middle_of(polygon_)));
    comparison_count_ += before;
    for (std::size_t i = 0; i < before; ++i) {
        const PaintedItem painted = painted_[i];
        if (painted.owner == owner) { continue; }
        const auto corners = std::span(corners_).subspan(painted.first_corner, painted.corner_count);
        part_.assign(corners.begin(), corners.end());
        clip_to_front(part_, plane, tolerance_m, scratch_);
        clip_to_cone(part_, cone_, scratch_);
        if (solid_angle_sr(part_) < min_solid_angle_sr) { continue; }
        record(painted, part_);
    }
}

void PolygonRepaint::write(
    std::span<const PlacedAircraft* const> aircraft, const PaintedItem& painted, StepWriter& steps) {
    const auto corners = std::span(corners_).subspan(painted.first_corner, painted.corner_count);
    part_.assign(corners.begin(), corners.end());
    if (painted.owner == is_ground) {
        steps.add_within(*ground_, painted.item, part_);
    } else {
        steps.add_within(draw_of(*aircraft[painted.owner], painted.item, painted.index_count), part_);
    }
}

namespace {

/// The share of the box's size that must lie before the eye.
constexpr double nearest = 1e-6;

} // namespace

scene::PixelBox pixel_box(const OrientedBox& box, const scene::FramePlan& plan, const glm::ivec2& size_px) {
    const glm::dmat4 world_to_clip = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    const glm::dvec2 size(size_px);
    glm::dvec2 least(std::numeric_limits<double>::max());
    glm::dvec2 most(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& corner_m : corners_of(box)) {
        const glm::dvec4 clip = world_to_clip * glm::dvec4(corner_m, 1.0);
        if (clip.w <= nearest * radius_m(box)) { return {glm::ivec2(0), size_px}; }
        const glm::dvec2 at = glm::dvec2(clip.x, -clip.y) / clip.w;
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    const auto in_pixels = [&](const glm::dvec2& at) { return (at * 0.5 + 0.5) * size; };
    const glm::dvec2 from = glm::clamp(glm::floor(in_pixels(least)), glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil(in_pixels(most)), glm::dvec2(0.0), size);
    return {glm::ivec2(from), glm::ivec2(to)};
}

namespace {

/// A little more than two rounding steps of renderers (1/256 pixel). What is painted again is cut this much too wide
/// where only that rounding could tell, so that no line of the covered thing shows along the cut.
constexpr double paint_rounding_px = 0.01;

double away_m2(const OrientedBox& box) { return glm::dot(box.centre_m, box.centre_m); }

/// Whether the middle of one box is nearer to the eye than that of another; of two that are equally far the one with
/// the lower number counts as nearer.
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

void ScenePainter::paint(const FrameScene& frame, scene::HiddenSurface hidden_surface, PlanCounts& counts) {
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
    std::ranges::sort(near_to_far_, [&](std::uint32_t a, std::uint32_t b) { return is_nearer(bounding_boxes, a, b); });
    steps_.clear_depth({glm::ivec2(0), frame.view.size_px});
    if (const PlacedAircraft* cockpit = frame.fleet.cockpit()) { paint(frame, *cockpit, scene::DepthUse::Nearest); }
    // What is refined comes apart, so that all others become one step.
    for (const bool refined : {false, true}) {
        for (const std::uint32_t i : near_to_far_) {
            if (is_refined(placed[i]) == refined && !placed[i].is_hidden) {
                paint(frame, placed[i], scene::DepthUse::Nearest);
            }
        }
    }
    std::size_t edge_on_indices = 0;
    plan_.ground = front_facing_first(frame.ground.all, frame.view.pixel_rad, facing_indices_, edge_on_indices);
    steps_.add_ground_by_depth(edge_on_indices);
    steps_.add_shadows_by_depth(frame.ground);
    steps_.add_sky(scene::DepthUse::InfinitelyFar);
    for (auto i = near_to_far_.rbegin(); i != near_to_far_.rend(); ++i) {
        if (!placed[*i].is_hidden) { paint_transparent(frame, placed[*i]); }
    }
}

void ScenePainter::paint_in_order(const FrameScene& frame, PlanCounts& counts) {
    plan_.ground = front_facing(frame.ground, frame.view.pixel_rad, facing_indices_);
    boxes_.assign(frame.fleet.bounding_boxes().begin(), frame.fleet.bounding_boxes().end());
    for (const PathRibbon::Dash& dash : frame.transparents.dashes()) { boxes_.push_back(dash.box); }
    order_.arrange(boxes_);
    steps_.add_sky();
    // The clouds lie above all ground.
    const bool from_above = is_above_clouds(frame, frame.view.camera.eye_m.z);
    if (from_above) { steps_.add_ground(); }
    if (frame.transparents.cloud_height_m()) {
        paint_groups(frame, true, counts);
        steps_.add_transparent_range(frame.transparents.clouds().first, frame.transparents.clouds().count);
    }
    if (!from_above) { steps_.add_ground(); }
    paint_groups(frame, false, counts);
    if (const PlacedAircraft* cockpit = frame.fleet.cockpit()) { paint(frame, *cockpit, scene::DepthUse::None); }
}

/// Paints the knots that lie beyond the clouds, or those that do not.
void ScenePainter::paint_groups(const FrameScene& frame, bool beyond_clouds, PlanCounts& counts) {
    for (const OverlapGroup& overlap_group : order_.overlap_groups()) {
        if (is_beyond_clouds(frame, overlap_group) == beyond_clouds) { paint_group(frame, overlap_group, counts); }
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
    if (members_.empty() && group_dashes_.empty()) { return; }
    if (!in_view(overlap_group.box, frame.view)) {
        for (const PlacedAircraft* member : members_) { steps_.add(draw_of(*member)); }
        return;
    }
    in_front_.find(overlap_group.box, frame.mesher, frame.ground.all, frame.view.camera.eye_m);
    paint_with_effects(frame, overlap_group, counts);
    if (in_front_.found().empty() || contains_eye(overlap_group.box)) { return; }
    // Not in the cone of a knot's box: between the members a farther knot may be seen before the ground. What was
    // painted earlier and is seen in a member's cone lies behind the member.
    for (const std::uint32_t member : order_.members(overlap_group)) {
        steps_.add_in_front(frame.ground, in_front_.found(), overlap_group.box, cone_of(boxes_[member]));
        counts.cuts += static_cast<int>(in_front_.found().size());
    }
}

/// The aircraft of a knot with their effects, and the dashes of a ribbon behind and before them.
void ScenePainter::paint_with_effects(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
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
            const TransparentRange& range =
                frame.transparents.dashes()[box - frame.fleet.bounding_boxes().size()].range;
            steps_.add_transparent_range(range.first, range.count);
        }
    }
}

/// Polygons as their order says, or cut where there is none; by depth where a mesh is among them.
void ScenePainter::paint_members(const FrameScene& frame, const OverlapGroup& overlap_group, PlanCounts& counts) {
    const bool has_mesh = std::ranges::any_of(members_, [](const PlacedAircraft* one) { return is_mesh(*one); });
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

/// Polygons of aircraft that meet each other or the ground: cut, or by depth where the cuts would take too long.
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
    if (!in_front_.intersecting().empty()) { steps_.occlude_by_ground(frame.ground, in_front_.intersecting()); }
    for (const PlacedAircraft* member : members_) { paint(frame, *member, scene::DepthUse::Nearest); }
    std::ranges::sort(members_, [&](const PlacedAircraft* a, const PlacedAircraft* b) {
        return is_nearer(frame.fleet.bounding_boxes(), b->number, a->number);
    });
    for (const PlacedAircraft* member : members_) { paint_transparent(frame, *member); }
}

/// Paints a whole aircraft. What was refined for this frame is always drawn by depth.
void ScenePainter::paint(const FrameScene& frame, const PlacedAircraft& aircraft, scene::DepthUse depth) {
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

/// Paints what is transparent of an aircraft that was refined for this frame: after all that it may be seen before.
void ScenePainter::paint_transparent(const FrameScene& frame, const PlacedAircraft& aircraft) {
    const scene::IndexRange& transparent = aircraft.model->transparent;
    if (is_refined(aircraft) && transparent.index_count > 0) {
        scene::AircraftDraw draw = draw_of(aircraft, transparent.first_index, transparent.index_count);
        draw.first_smooth = frame.smooth.turning_word_index();
        steps_.add_transparent(draw, aircraft.model->opacity);
    }
}

} // namespace octant::visuals::planning
