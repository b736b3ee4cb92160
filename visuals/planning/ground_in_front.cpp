#include "visuals/planning/ground_in_front.h"

#include "sim/base/plane.h"
#include "visuals/planning/ground_frame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::planning {

namespace {

/// Adds the plane through the eye that leans on the box from below and runs level across the line of sight: what lies
/// under it hides nothing. None when the box reaches over the eye's place.
void add_lowest_sight_plane(ConvexVolume& volume, const OrientedBox& box) {
    const double level_m = std::hypot(box.centre_m.x, box.centre_m.y);
    if (level_m <= 0.0) { return; }
    const glm::dvec3 ahead(box.centre_m.x / level_m, box.centre_m.y / level_m, 0.0);
    double min_slope = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner_m : corners_of(box)) {
        const double along_m = glm::dot(corner_m, ahead);
        if (along_m <= 0.0) { return; }
        min_slope = std::min(min_slope, corner_m.z / along_m);
    }
    volume.add({glm::normalize(glm::dvec3(0.0, 0.0, 1.0) - ahead * min_slope), 0.0});
}

} // namespace

bool may_intersect(const ConvexVolume& volume, const glm::dvec3& min_m, const glm::dvec3& max_m) {
    if (glm::any(glm::lessThan(max_m, volume.extent.min_m)) || glm::any(glm::greaterThan(min_m, volume.extent.max_m))) {
        return false;
    }
    for (int i = 0; i < volume.count; ++i) {
        const Plane& plane = volume.planes[static_cast<std::size_t>(i)];
        const glm::dvec3 foremost_m(plane.normal.x > 0.0 ? max_m.x : min_m.x, plane.normal.y > 0.0 ? max_m.y : min_m.y,
            plane.normal.z > 0.0 ? max_m.z : min_m.z);
        if (distance_m(plane, foremost_m) < 0.0) { return false; }
    }
    return true;
}

ConvexVolume sight_volume_of(const OrientedBox& box) {
    ConvexVolume volume;
    volume.extent = world_bounds(box);
    volume.extent.min_m = glm::min(volume.extent.min_m, glm::dvec3(0.0));
    volume.extent.max_m = glm::max(volume.extent.max_m, glm::dvec3(0.0));
    add_lowest_sight_plane(volume, box);
    if (!contains_eye(box)) {
        const ViewCone cone = cone_of(box);
        for (const glm::dvec3& normal : cone.planes()) { volume.add({normal, 0.0}); }
    }
    for (int side = 0; side < 6; ++side) {
        const Plane plane = side_of(box, side);
        if (plane.offset_m <= 0.0) { // behind the box
            volume.add(turned_over(plane));
        }
    }
    return volume;
}

void GroundInFront::find(const OrientedBox& box, const landscape::GroundMesher& ground,
    const scene::TriangleDraw& triangles, const glm::dvec3& eye_m) {
    candidates_.clear();
    found_.clear();
    meeting_.clear();
    const ConvexVolume volume = sight_volume_of(box);

    struct Look {
        const ConvexVolume& volume;
        const glm::dvec3& eye_m;
    } const look{volume, eye_m};

    ground.triangles_in(
        [&look](const glm::dvec3& min_m, const glm::dvec3& max_m) {
            return may_intersect(look.volume, min_m - look.eye_m, max_m - look.eye_m);
        },
        candidates_);
    if (candidates_.empty()) { return; }
    const ViewCone cone = contains_eye(box) ? ViewCone{} : cone_of(box);
    for (const std::uint32_t candidate : candidates_) {
        place_triangle(triangles, candidate, triangle_);
        const glm::dvec3& a = triangle_[0].at_m;
        const glm::dvec3& b = triangle_[1].at_m;
        const glm::dvec3& c = triangle_[2].at_m;
        if (glm::dot(glm::cross(b - a, c - a), a) >= 0.0 ||
            !may_intersect(volume, glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c))) {
            continue;
        }
        const BoxRelation place = relation_to(box, cone.planes());
        if (place != BoxRelation::Elsewhere) { found_.push_back({candidate, place == BoxRelation::Meets}); }
        if (place == BoxRelation::Meets) { meeting_.push_back(candidate); }
    }
}

GroundInFront::BoxRelation GroundInFront::relation_to(const OrientedBox& box, std::span<const glm::dvec3> cone) {
    part_ = triangle_;
    clip_to_box(part_, box, scratch_);
    if (!part_.empty()) { return BoxRelation::Meets; }
    if (cone.empty()) {
        return BoxRelation::Elsewhere; // beyond a box that is all around the eye
    }
    part_ = triangle_;
    clip_to_cone(part_, cone, scratch_);
    if (solid_angle_sr(part_) < min_solid_angle_sr) { return BoxRelation::Elsewhere; }
    return entry_distance(box, middle_of(part_)) > 1.0 ? BoxRelation::Before : BoxRelation::Elsewhere;
}

} // namespace octant::visuals::planning
