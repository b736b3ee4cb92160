#include "visuals/planning/polygon_repaint.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::visuals::planning {

namespace {

/// Share of its distance within which a corner counts as lying on another polygon's plane.
constexpr double touching = 1e-9;

} // namespace

std::optional<int> PolygonRepaint::paint(
    std::span<const PlacedAircraft* const> aircraft,
    const OrientedBox& box,
    const GroundFrame& ground,
    std::span<const std::uint32_t> intersecting,
    double rounding_rad,
    StepWriter& steps) {
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
    std::span<const PlacedAircraft* const> aircraft,
    std::uint32_t owner,
    double rounding_rad,
    StepWriter& steps) {
    for (const scene::IndexRange& range : aircraft[owner]->ranges) {
        paint_range(aircraft, owner, range, rounding_rad, steps);
    }
}

void PolygonRepaint::paint_range(
    std::span<const PlacedAircraft* const> aircraft,
    std::uint32_t owner,
    const scene::IndexRange& range,
    double rounding_rad,
    StepWriter& steps) {
    const PlacedAircraft& own = *aircraft[owner];
    std::uint32_t run_first = range.first_index;
    std::uint32_t next = run_first;
    const auto polygons =
        own.list.subspan(range.first_polygon, static_cast<std::size_t>(range.polygons));
    for (const std::uint32_t polygon : polygons) {
        if (exceeds_limits()) {
            return;
        }
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
        if (painted_.size() == hiding) {
            continue;
        }
        steps.add(draw_of(own, run_first, next - run_first));
        run_first = next;
        for (std::size_t i = hiding; i < painted_.size(); ++i) {
            write(aircraft, painted_[i], steps);
            ++repaint_count_;
        }
    }
    if (next > run_first) {
        steps.add(draw_of(own, run_first, next - run_first));
    }
}

/// Notes the parts of what was painted before that hide part of polygon_.
void PolygonRepaint::find_occluding(
    const Plane& plane, std::uint32_t owner, std::size_t before, double rounding_rad) {
    cone_of(polygon_, rounding_rad, cone_);
    const double tolerance_m = touching * (1.0 + glm::length(middle_of(polygon_)));
    comparison_count_ += before;
    for (std::size_t i = 0; i < before; ++i) {
        const PaintedItem painted = painted_[i];
        if (painted.owner == owner) {
            continue;
        }
        const auto corners =
            std::span(corners_).subspan(painted.first_corner, painted.corner_count);
        part_.assign(corners.begin(), corners.end());
        clip_to_front(part_, plane, tolerance_m, scratch_);
        clip_to_cone(part_, cone_, scratch_);
        if (solid_angle_sr(part_) < min_solid_angle_sr) {
            continue;
        }
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
        steps.add_within(
            draw_of(*aircraft[painted.owner], painted.item, painted.index_count), part_);
    }
}

} // namespace octant::visuals::planning
