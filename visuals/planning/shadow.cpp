#include "visuals/planning/shadow.h"

#include "sim/base/units.h"
#include "visuals/planning/ground_frame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace octant::visuals::planning {

namespace {

constexpr double min_shadow_px = 2.0;
constexpr int max_march_steps = 200;

glm::vec4 unpacked(std::uint32_t colour) {
    return glm::vec4(static_cast<float>(colour & 255U), static_cast<float>((colour >> 8U) & 255U),
               static_cast<float>((colour >> 16U) & 255U), static_cast<float>(colour >> 24U)) /
           255.0F;
}

/// Darkened; alpha too, where it says how much light is left.
std::uint32_t shaded(const glm::vec4& colour, bool is_light) {
    const float left = is_light ? shadow_share : 1.0F;
    const auto alpha = static_cast<std::uint32_t>(255.0F * left * colour.w + 0.5F);
    return (models::packed_colour(glm::vec3(colour) * shadow_share) & 0x00ffffffU) | alpha << 24U;
}

/// What the light through a hull reaches up to `path_m` below its middle and `reach_m` beyond.
ConvexVolume shadow_volume_of(const OrientedBox& hull, const glm::dvec3& to_sun, double path_m, double reach_m) {
    const AxisAlignedBox extent = world_bounds(hull);
    const glm::dvec3 down_m = to_sun * -(path_m + reach_m);
    ConvexVolume volume;
    volume.extent = {glm::min(extent.min_m, extent.min_m + down_m), glm::max(extent.max_m, extent.max_m + down_m)};
    const LightPrism prism = prism_of(hull, to_sun);
    for (int i = 0; i < prism.count; ++i) { volume.add(prism.planes[static_cast<std::size_t>(i)]); }
    return volume;
}

double plan_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The upright plane through an edge of a polygon that lies counter-clockwise seen from above, with the polygon in
/// front of it.
Plane side_of(const glm::dvec3& from_m, const glm::dvec3& to_m) {
    const glm::dvec3 edge_m = to_m - from_m;
    const glm::dvec3 inward(-edge_m.y, edge_m.x, 0.0);
    return {inward, -glm::dot(inward, from_m)};
}

} // namespace

ShadowCaster::ShadowCaster(const glm::dvec3& to_sun)
    : to_sun_(to_sun), high_enough_(to_sun.z >= std::sin(rad_from_deg(min_sun_elevation_deg))) {}

void ShadowCaster::begin(
    const scene::TriangleDraw& triangles, bool alpha_is_visibility, std::vector<models::ColourVertex>& vertices) {
    ground_ = triangles;
    alpha_is_light_ = alpha_is_visibility;
    vertices_ = &vertices;
    vertices.clear();
    decals_ = {};
    decals_by_triangle_.clear();
    pieces_.clear();
    indices_.clear();
}

void ShadowCaster::set_decals(const GroundDecals& decals) {
    decals_ = decals;
    decals_by_triangle_.resize(decals.decals.size());
    std::iota(decals_by_triangle_.begin(), decals_by_triangle_.end(), 0U);
    std::ranges::stable_sort(
        decals_by_triangle_, {}, [&](std::uint32_t decal) { return decals_.decals[decal].triangle; });
    for (const GroundDecal& decal : decals.decals) {
        const std::size_t first = indices_.size();
        for (std::uint32_t i = 0; i < decal.count; ++i) {
            const glm::vec3 at_m(decals.corners[decal.first + i]);
            vertices_->push_back({at_m * depth_offset_factor(decal.layer), decal.colour});
        }
        add_fan(decal.count);
        add_pieces(decal.triangle, decal.layer, first);
    }
}

void ShadowCaster::cast(const PlacedAircraft& aircraft, const OrientedBox& hull, const landscape::GroundMesher& ground,
    const FrameView& view) {
    if (!high_enough_ || ground_.indices.empty()) { return; }
    const double path_m = light_path_m(hull, ground.ground(), view.camera.eye_m);
    if (path_m < 0.0) { return; }
    const glm::dvec3 position_m = hull.centre_m - to_sun_ * path_m;
    const AxisAlignedBox& extent = aircraft.model->hull;
    const double size_m = 0.5 * glm::distance(extent.min_m, extent.max_m);
    // On a slope that falls away from the sun a shadow is longer than on the level.
    const double reach_m = 2.0 * size_m / to_sun_.z;
    if (2.0 * size_m < min_shadow_px * view.pixel_rad * glm::length(position_m) ||
        !scene::in_view(position_m, reach_m, view.frustum)) {
        return;
    }
    const ConvexVolume volume = shadow_volume_of(hull, to_sun_, path_m, reach_m);

    struct Look {
        const ConvexVolume& volume;
        const glm::dvec3& eye_m;
    } const look{volume, view.camera.eye_m};

    candidates_.clear();
    ground.triangles_in(
        [&look](const glm::dvec3& min_m, const glm::dvec3& max_m) {
            return may_intersect(look.volume, min_m - look.eye_m, max_m - look.eye_m);
        },
        candidates_);
    collect_faces(aircraft);
    for (const std::uint32_t candidate : candidates_) {
        place_triangle(ground_, candidate, triangle_);
        const glm::dvec3& a = triangle_[0].at_m;
        const glm::dvec3& b = triangle_[1].at_m;
        const glm::dvec3& c = triangle_[2].at_m;
        if (may_intersect(volume, glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c))) { cast_on(candidate); }
    }
}

/// Length of the light's way from the middle of the hull to the ground; negative when it meets none or the middle lies
/// under it.
double ShadowCaster::light_path_m(
    const OrientedBox& hull, const landscape::Ground& ground, const glm::dvec3& eye_m) const {
    const glm::dvec3 from_m = hull.centre_m + eye_m;
    const auto height_over_ground_m = [&](double path_m) -> std::optional<double> {
        const glm::dvec3 at_m = from_m - to_sun_ * path_m;
        const std::optional<double> ground_m = ground.height_at(at_m.x, at_m.y);
        return ground_m ? std::optional<double>(at_m.z - *ground_m) : std::nullopt;
    };
    const double min_step_m = radius_m(hull);
    double above_m = 0.0;
    double path_m = 0.0;
    for (int step = 0; step < max_march_steps; ++step) {
        const std::optional<double> height_m = height_over_ground_m(path_m);
        if (!height_m || (step == 0 && *height_m < 0.0)) { return -1.0; }
        if (*height_m <= 0.0) {
            for (int halving = 0; halving < 20; ++halving) {
                const double middle_m = 0.5 * (above_m + path_m);
                (height_over_ground_m(middle_m).value_or(0.0) > 0.0 ? above_m : path_m) = middle_m;
            }
            return path_m;
        }
        above_m = path_m;
        path_m += std::max(min_step_m, 0.25 * *height_m / to_sun_.z);
    }
    return -1.0;
}

/// The polygons that face the sun, where they are.
void ShadowCaster::collect_faces(const PlacedAircraft& aircraft) {
    faces_.clear();
    face_corners_.clear();
    const auto count = static_cast<std::uint32_t>(aircraft.model->polygons.polygons.size());
    for (std::uint32_t polygon = 0; polygon < count; ++polygon) {
        place_polygon(aircraft, polygon, part_);
        const Plane plane = plane_of(part_);
        if (glm::dot(plane.normal, to_sun_) > 0.0) {
            faces_.push_back({plane, face_corners_.size(), part_.size()});
            face_corners_.insert(face_corners_.end(), part_.begin(), part_.end());
        }
    }
}

void ShadowCaster::cast_on(std::uint32_t triangle) {
    const Plane plane = plane_of(triangle_);
    const double slope = glm::dot(plane.normal, to_sun_);
    if (slope <= 0.01 || plane.offset_m <= 0.0 || plane.normal.z <= 0.0) {
        return; // the sun does not reach it or the eye does not see it
    }
    std::array<Plane, 3> sides;
    for (std::size_t i = 0; i < 3; ++i) { sides[i] = side_of(triangle_[i].at_m, triangle_[(i + 1) % 3].at_m); }
    shadow_parts_.clear();
    shadow_ends_.clear();
    const std::size_t first = indices_.size();
    for (const Face& face : faces_) {
        const auto corners = std::span(face_corners_).subspan(face.first, face.count);
        part_.assign(corners.begin(), corners.end());
        clip_to_front(part_, plane, 0.0, scratch_);
        for (ViewVertex& corner : part_) { corner.at_m -= to_sun_ * (distance_m(plane, corner.at_m) / slope); }
        const std::size_t before = shadow_parts_.size();
        shadow_parts_.insert(shadow_parts_.end(), part_.begin(), part_.end());
        for (std::size_t i = 0; i < 3 && !part_.empty(); ++i) { clip_to_front(part_, sides[i], 0.0, scratch_); }
        if (part_.size() >= 3) {
            add_piece(triangle);
            shadow_ends_.push_back(shadow_parts_.size());
        } else {
            shadow_parts_.resize(before);
        }
    }
    add_pieces(triangle, GroundLayer::Shadow, first);
    if (!decals_.decals.empty() && !shadow_ends_.empty()) { add_on_decals(triangle); }
}

/// What indices_ holds from one on, unless that is nothing.
void ShadowCaster::add_pieces(std::uint32_t triangle, GroundLayer layer, std::size_t first) {
    if (indices_.size() > first) {
        pieces_.push_back(
            {triangle, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(indices_.size() - first), layer});
    }
}

/// The last vertices as a fan.
void ShadowCaster::add_fan(std::size_t corners) {
    const auto all = static_cast<std::uint32_t>(ground_.vertices.size() + vertices_->size());
    const std::uint32_t base = all - static_cast<std::uint32_t>(corners);
    for (std::uint32_t i = 2; i < corners; ++i) { indices_.insert(indices_.end(), {base, base + i - 1, base + i}); }
}

/// part_ as a fan with the triangle's colours, darkened.
void ShadowCaster::add_piece(std::uint32_t triangle) {
    const std::uint32_t* corner = &ground_.indices[std::size_t{3} * triangle];
    const glm::dvec3& a = triangle_[0].at_m;
    const glm::dvec3& b = triangle_[1].at_m;
    const glm::dvec3& c = triangle_[2].at_m;
    const double whole = plan_area(a, b, c);
    for (const ViewVertex& at : part_) {
        const double share_a = plan_area(at.at_m, b, c) / whole;
        const double share_b = plan_area(a, at.at_m, c) / whole;
        const glm::vec4 colour =
            unpacked(ground_.vertices[corner[0]].colour) * static_cast<float>(share_a) +
            unpacked(ground_.vertices[corner[1]].colour) * static_cast<float>(share_b) +
            unpacked(ground_.vertices[corner[2]].colour) * static_cast<float>(1.0 - share_a - share_b);
        vertices_->push_back({glm::vec3(at.at_m), shaded(colour, alpha_is_light_)});
    }
    add_fan(part_.size());
}

/// The shadows on a triangle once more, cut to what is painted on it and darker than that.
void ShadowCaster::add_on_decals(std::uint32_t triangle) {
    const auto triangle_of = [&](std::uint32_t decal) { return decals_.decals[decal].triangle; };
    auto own = std::ranges::lower_bound(decals_by_triangle_, triangle, {}, triangle_of);
    const std::size_t first = indices_.size();
    for (; own != decals_by_triangle_.end() && triangle_of(*own) == triangle; ++own) {
        const GroundDecal& decal = decals_.decals[*own];
        const auto corners = decals_.corners.subspan(decal.first, decal.count);
        std::size_t begin = 0;
        for (const std::size_t end : shadow_ends_) {
            part_.assign(shadow_parts_.begin() + static_cast<std::ptrdiff_t>(begin),
                shadow_parts_.begin() + static_cast<std::ptrdiff_t>(end));
            begin = end;
            for (std::size_t i = 0; i < corners.size() && !part_.empty(); ++i) {
                const glm::dvec3& next_m = corners[i + 1 < corners.size() ? i + 1 : 0];
                clip_to_front(part_, side_of(corners[i], next_m), 0.0, scratch_);
            }
            for (const ViewVertex& at : part_) {
                vertices_->push_back({glm::vec3(at.at_m) * depth_offset_factor(GroundLayer::ShadowOnDecal),
                    shaded(unpacked(decal.colour), false)});
            }
            add_fan(part_.size());
        }
    }
    add_pieces(triangle, GroundLayer::ShadowOnDecal, first);
}

void ShadowCaster::sort_pieces() {
    std::ranges::sort(
        pieces_, {}, [](const ShadowPieces& piece) { return std::tuple(piece.triangle, piece.layer, piece.first); });
}

} // namespace octant::visuals::planning
