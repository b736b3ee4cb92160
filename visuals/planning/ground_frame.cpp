#include "visuals/planning/ground_frame.h"

#include "sim/base/plane.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    intersecting_.clear();
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
        if (place != BoxRelation::Elsewhere) { found_.push_back({candidate, place == BoxRelation::Intersects}); }
        if (place == BoxRelation::Intersects) { intersecting_.push_back(candidate); }
    }
}

GroundInFront::BoxRelation GroundInFront::relation_to(const OrientedBox& box, std::span<const glm::dvec3> cone) {
    part_ = triangle_;
    clip_to_box(part_, box, scratch_);
    if (!part_.empty()) { return BoxRelation::Intersects; }
    if (cone.empty()) {
        return BoxRelation::Elsewhere; // beyond a box that is all around the eye
    }
    part_ = triangle_;
    clip_to_cone(part_, cone, scratch_);
    if (solid_angle_sr(part_) < min_solid_angle_sr) { return BoxRelation::Elsewhere; }
    return entry_distance(box, middle_of(part_)) > 1.0 ? BoxRelation::InFront : BoxRelation::Elsewhere;
}

std::span<const PieceRange> pieces_on(const GroundFrame& ground, std::uint32_t triangle) {
    const auto first = std::ranges::lower_bound(ground.pieces, triangle, {}, &PieceRange::triangle);
    const auto last = std::ranges::upper_bound(ground.pieces, triangle, {}, &PieceRange::triangle);
    return {first, last};
}

void place_triangle(const scene::TriangleDraw& ground, std::uint32_t triangle, ViewPolygon& placed) {
    placed.resize(3);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t vertex = ground.indices[std::size_t{3} * triangle + corner];
        placed[corner] = {glm::dvec3(ground.vertices[vertex].position_m), false};
    }
}

namespace {

/// Renderers round screen positions to 1/256 pixel. Twice that bounds the error of both ends of an edge.
constexpr float rounding_px = 2.0F / 256.0F;

float sum_of_parts(const glm::vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Corners relative to the eye. The triple product is the triangle's doubled area on the screen times distance cubed
/// times the pixel's angle squared; rounding moves that area by at most rounding_px times the outline. Sums of parts
/// bound lengths from above without a square root.
enum class Facing { Towards, AwayWithinTolerance, Away };

Facing facing_of(const scene::TriangleDraw& draw, const std::uint32_t* corners, float pixel_rad) {
    const glm::vec3& a = draw.vertices[corners[0]].position_m;
    const glm::vec3& b = draw.vertices[corners[1]].position_m;
    const glm::vec3& c = draw.vertices[corners[2]].position_m;
    const glm::vec3 ab = b - a;
    const glm::vec3 ac = c - a;
    const float edges_m = sum_of_parts(ab) + sum_of_parts(ac);
    const float distance_m = sum_of_parts(a) + edges_m;
    const float doubt = rounding_px * pixel_rad * 2.0F * edges_m * distance_m * distance_m;
    const float away = glm::dot(glm::cross(ab, ac), a);
    return away > doubt ? Facing::Away : away > 0.0F ? Facing::AwayWithinTolerance : Facing::Towards;
}

/// Copies the triangles first .. last - 1 that face the eye to the beginning of `kept`, which must have room for all of
/// them. Returns the number of indices copied.
std::size_t remove_back_faces(const scene::TriangleDraw& draw, std::size_t first, std::size_t last, float pixel_rad,
    std::span<std::uint32_t> kept) {
    std::size_t count = 0;
    for (std::size_t i = 3 * first; i < 3 * last; i += 3) {
        const std::uint32_t* corner = &draw.indices[i];
        const bool away = facing_of(draw, corner, pixel_rad) == Facing::Away;
        // Written in any case and counted when it stays: no branch to guess.
        kept[count] = corner[0];
        kept[count + 1] = corner[1];
        kept[count + 2] = corner[2];
        count += away ? 0 : 3;
    }
    return count;
}

} // namespace

scene::TriangleDraw front_facing(const GroundFrame& ground, double pixel_rad, std::vector<std::uint32_t>& kept) {
    const scene::TriangleDraw& draw = ground.all;
    const auto pixel = static_cast<float>(pixel_rad);
    kept.resize(draw.indices.size() + ground.piece_indices.size());
    std::size_t count = 0;
    std::size_t next = 0;
    const auto keep_until = [&](std::size_t last) {
        count += remove_back_faces(draw, next, last, pixel, std::span(kept).subspan(count));
        next = last;
    };
    for (const PieceRange& shadow : ground.pieces) {
        keep_until(std::max<std::size_t>(next, std::size_t{shadow.triangle} + 1));
        std::ranges::copy(ground.piece_indices.subspan(shadow.first, shadow.count),
            kept.begin() + static_cast<std::ptrdiff_t>(count));
        count += shadow.count;
    }
    keep_until(draw.indices.size() / 3);
    kept.resize(count);
    return {draw.vertices, kept, draw.standing};
}

scene::TriangleDraw front_facing_first(
    const scene::TriangleDraw& draw, double pixel_rad, std::vector<std::uint32_t>& kept, std::size_t& edge_on_indices) {
    kept.resize(draw.indices.size());
    std::size_t count = 0;
    std::size_t back = kept.size();
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const std::uint32_t* corner = &draw.indices[i];
        const Facing facing = facing_of(draw, corner, static_cast<float>(pixel_rad));
        if (facing == Facing::Away) { continue; }
        std::size_t& place = facing == Facing::Towards ? count : back;
        place -= facing == Facing::Towards ? 0 : 3;
        std::copy_n(corner, 3, kept.begin() + static_cast<std::ptrdiff_t>(place));
        place += facing == Facing::Towards ? 3 : 0;
    }
    edge_on_indices = kept.size() - back;
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(count), kept.begin() + static_cast<std::ptrdiff_t>(back));
    return {draw.vertices, kept, draw.standing};
}

} // namespace octant::visuals::planning
