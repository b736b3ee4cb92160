// The second part of a picture's truth: the planes of the triangles that are seen, and what each pixel says of its own.
#include "visuals/raster/truth_surfaces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace octant::visuals::raster {

using scene::SurfaceClass;
using Content = scene::PaintStep::Content;

namespace {

/// Takes 1, column and row of a picture to ways from the eye, of depth 1, world axes.
glm::dmat3 rays_of(const glm::mat4& world_to_view, const glm::mat4& view_to_clip, const glm::ivec2& size_px) {
    const glm::dmat4 clip(view_to_clip);
    const glm::dvec2 size(size_px);
    const glm::dvec2 per_px(2.0 / (size.x * clip[0][0]), -2.0 / (size.y * clip[1][1]));
    const glm::dvec2 first(
        (1.0 / size.x - 1.0 + clip[2][0]) / clip[0][0], (1.0 - 1.0 / size.y + clip[2][1]) / clip[1][1]);
    const glm::dmat3 view(glm::dvec3(first, -1.0), glm::dvec3(per_px.x, 0.0, 0.0), glm::dvec3(0.0, per_px.y, 0.0));
    return glm::inverse(glm::dmat3(glm::mat3(world_to_view))) * view;
}

/// Takes places with the eye subtracted to column * w, row * w, w.
glm::dmat3 pixels_of(const glm::mat4& world_to_view, const glm::mat4& view_to_clip, const glm::ivec2& size_px) {
    const glm::dmat4 clip(view_to_clip);
    const glm::dvec2 size(size_px);
    glm::dmat3 view_to_px(0.0); // columns: of x, y and z in view axes
    view_to_px[0][0] = 0.5 * size.x * clip[0][0];
    view_to_px[1][1] = -0.5 * size.y * clip[1][1];
    view_to_px[2][0] = 0.5 * size.x * clip[2][0] - (0.5 * size.x - 0.5);
    view_to_px[2][1] = -0.5 * size.y * clip[2][1] - (0.5 * size.y - 0.5);
    view_to_px[2][2] = -1.0;
    return view_to_px * glm::dmat3(glm::mat3(world_to_view));
}

} // namespace

void TruthSurfaces::begin(
    const scene::FramePlan& plan, const FrameDraws& draws, const glm::ivec2& size_px, bool has_flow) {
    plan_ = &plan;
    draws_ = &draws;
    rays_ = rays_of(plan.world_to_view, plan.view_to_clip, size_px);
    const glm::mat4& view = plan.world_to_view;
    ahead_ = -glm::dvec3(glm::vec3(view[0].z, view[1].z, view[2].z));
    has_flow_ = has_flow && plan.truth.previous.has_value();
    motions_.clear();
    if (!has_flow_) { return; }
    const scene::PreviousPicture& previous = *plan.truth.previous;
    previous_from_world_ = pixels_of(previous.world_to_view, previous.view_to_clip, size_px);
    previous_from_still_ = previous_from_world_ * rays_;
    assert(previous.parts.size() == plan.parts.size());
    for (std::size_t i = 0; i < plan.parts.size(); ++i) {
        const glm::dmat4 now(plan.parts[i]);
        const glm::dmat4 before(previous.parts[i]);
        Motion& motion = motions_.emplace_back();
        motion.turn = glm::dmat3(before) * glm::inverse(glm::dmat3(now));
        motion.shift_m = glm::dvec3(before[3]) - motion.turn * glm::dvec3(now[3]);
    }
}

SeenSurface TruthSurfaces::nothing() const {
    SeenSurface seen;
    if (has_flow_) { seen.to_previous = previous_from_still_; }
    return seen;
}

void TruthSurfaces::set_plane(const std::array<glm::dvec3, 3>& corners_m, SeenSurface& seen) const {
    const auto& [a, b, c] = corners_m;
    const std::array depths_m{glm::dot(a, ahead_), glm::dot(b, ahead_), glm::dot(c, ahead_)};
    const auto near_m = static_cast<double>(plan_->view_to_clip[3][2]);
    seen.min_depth_m = std::max(std::min({depths_m[0], depths_m[1], depths_m[2]}), near_m);
    seen.max_depth_m = std::max(std::max({depths_m[0], depths_m[1], depths_m[2]}), near_m);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = glm::length(normal);
    const double offset_m = glm::dot(normal, a);
    seen.inverse_depth = normal * rays_ / offset_m;
    if (!(std::abs(offset_m) > 0.0) || !(size > 0.0)) { // seen edge-on, or no triangle
        seen.inverse_depth = glm::dvec3(2.0 / (seen.min_depth_m + seen.max_depth_m), 0.0, 0.0);
    }
    const double towards_eye = offset_m > 0.0 ? -1.0 : 1.0;
    seen.normal = size > 0.0 ? glm::vec3(normal * (towards_eye / size)) : glm::vec3(-glm::normalize(ahead_));
}

void TruthSurfaces::set_previous(const Motion& motion, SeenSurface& seen) const {
    const glm::dvec3 shift = previous_from_world_ * motion.shift_m;
    seen.to_previous = previous_from_world_ * (motion.turn * rays_) + glm::outerProduct(shift, seen.inverse_depth);
}

/// Where a place of the picture shows the layer of clouds.
glm::dvec3 TruthSurfaces::on_clouds(const glm::vec2& at_px) const {
    const glm::dvec3 way = ray(glm::dvec2(at_px) - 0.5);
    const auto height_m = static_cast<double>(plan_->truth.cloud_height_m);
    const auto radius_m = static_cast<double>(plan_->truth.water.earth_radius_m);
    // height = t way.z + t^2 (way.x^2 + way.y^2) / 2R: the nearer root ahead.
    const double bend = radius_m > 0.0 ? (way.x * way.x + way.y * way.y) / (2.0 * radius_m) : 0.0;
    const double under = way.z * way.z + 4.0 * bend * height_m;
    const double root = std::sqrt(std::max(under, 0.0));
    const double steepness = height_m < 0.0 ? way.z - root : way.z + root;
    return way * (2.0 * height_m / (steepness == 0.0 ? 1e-12 : steepness));
}

SeenSurface TruthSurfaces::surface(std::uint32_t source) const {
    const DrawSlice& slice = draws_->slices()[source >> source_index_bits];
    const std::uint32_t* const corner = &slice.indices[std::size_t{3} * (source & source_index_mask)];
    const scene::FramePlan& plan = *plan_;
    SeenSurface seen = nothing();
    std::array<glm::dvec3, 3> corners_m;
    switch (slice.content) {
    case Content::ClearDepth:
    case Content::Overlay:
        return seen;
    case Content::Sky: {
        seen.surface = scene::sky_surface(plan, corner);
        if (seen.surface == SurfaceClass::Sky) { return seen; }
        for (std::size_t k = 0; k < 3; ++k) { corners_m[k] = glm::dvec3(plan.sky.vertices[corner[k]].position_m); }
        break;
    }
    case Content::Ground:
    case Content::GroundRepaint: {
        seen.surface = scene::ground_surface(plan, corner);
        const std::size_t own = plan.ground.vertices.size();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = corner[k];
            corners_m[k] =
                glm::dvec3(at < own ? plan.ground.vertices[at].position_m : plan.shadow_vertices[at - own].position_m);
        }
        break;
    }
    case Content::Transparent:
        seen.surface = SurfaceClass::Cloud;
        for (std::size_t k = 0; k < 3; ++k) { corners_m[k] = on_clouds(plan.overlay.vertices[corner[k]].at_px); }
        break;
    case Content::Aircraft:
    case Content::Refined: {
        seen.surface = SurfaceClass::Aircraft;
        seen.object = slice.object;
        for (std::size_t k = 0; k < 3; ++k) {
            const scene::ModelVertex& vertex = slice.of_model[corner[k]];
            const glm::mat4& part = plan.parts[slice.first_part + vertex.part];
            corners_m[k] = glm::dvec3(glm::dmat4(part) * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
        }
        set_plane(corners_m, seen);
        if (has_flow_) { set_previous(motions_[slice.first_part + slice.of_model[corner[0]].part], seen); }
        return seen;
    }
    }
    set_plane(corners_m, seen);
    if (has_flow_) {
        const glm::dvec3 shift = previous_from_world_ * plan.truth.previous->eye_moved_m;
        seen.to_previous = previous_from_still_ + glm::outerProduct(shift, seen.inverse_depth);
    }
    return seen;
}

std::uint32_t TruthSurfaces::key(std::uint32_t source) const {
    const DrawSlice& slice = draws_->slices()[source >> source_index_bits];
    const std::uint32_t* const corner = &slice.indices[std::size_t{3} * (source & source_index_mask)];
    const auto key_of = [](SurfaceClass surface, std::uint32_t object) {
        return static_cast<std::uint32_t>(surface) | object << 8U;
    };
    switch (slice.content) {
    case Content::Sky:
        return key_of(scene::sky_surface(*plan_, corner), 0);
    case Content::Ground:
    case Content::GroundRepaint:
        return key_of(scene::ground_surface(*plan_, corner), 0);
    case Content::Transparent:
        return key_of(SurfaceClass::Cloud, 0);
    case Content::Aircraft:
    case Content::Refined:
        return key_of(SurfaceClass::Aircraft, slice.object);
    default:
        return 0;
    }
}

void TruthSurfaces::write(const SeenSurface& seen, const glm::dvec2& at_px, std::size_t first, std::size_t count,
    const scene::TruthArrays& to) const {
    if (to.class_id != nullptr) { std::fill_n(to.class_id + first, count, static_cast<std::uint8_t>(seen.surface)); }
    if (to.object_id != nullptr) { std::fill_n(to.object_id + first, count, seen.object); }
    if (to.normal != nullptr) { std::fill_n(reinterpret_cast<glm::vec3*>(to.normal) + first, count, seen.normal); }
    if (to.depth_m != nullptr) {
        if (seen.surface == SurfaceClass::Sky) {
            std::fill_n(to.depth_m + first, count, std::numeric_limits<float>::infinity());
        } else {
            const double base = seen.inverse_depth.x + seen.inverse_depth.z * at_px.y;
            for (std::size_t i = 0; i < count; ++i) {
                const double inverse = base + seen.inverse_depth.y * (at_px.x + static_cast<double>(i));
                const double depth_m = inverse > 0.0 ? 1.0 / inverse : seen.max_depth_m;
                to.depth_m[first + i] =
                    static_cast<float>(std::min(std::max(depth_m, seen.min_depth_m), seen.max_depth_m));
            }
        }
    }
    if (to.flow_px == nullptr && to.previous_px == nullptr) { return; }
    const glm::dvec3 base = seen.to_previous[0] + seen.to_previous[2] * at_px.y;
    for (std::size_t i = 0; i < count; ++i) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        const double column = at_px.x + static_cast<double>(i);
        const glm::dvec3 there = base + seen.to_previous[1] * column;
        const double inverse_w = there.z > 0.0 ? 1.0 / there.z : nan;
        const double x = there.x * inverse_w;
        const double y = there.y * inverse_w;
        if (to.flow_px != nullptr) {
            to.flow_px[2 * (first + i)] = static_cast<float>(column - x);
            to.flow_px[2 * (first + i) + 1] = static_cast<float>(at_px.y - y);
        }
        if (to.previous_px != nullptr) {
            to.previous_px[2 * (first + i)] = static_cast<float>(x);
            to.previous_px[2 * (first + i) + 1] = static_cast<float>(y);
        }
    }
}

void TruthSurfaces::write_unknown(std::size_t pixel, const scene::TruthArrays& to) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    if (to.class_id != nullptr) { to.class_id[pixel] = static_cast<std::uint8_t>(SurfaceClass::Sky); }
    if (to.object_id != nullptr) { to.object_id[pixel] = 0; }
    if (to.depth_m != nullptr) { to.depth_m[pixel] = std::numeric_limits<float>::infinity(); }
    if (to.normal != nullptr) { std::fill_n(to.normal + 3 * pixel, 3, 0.0F); }
    if (to.flow_px != nullptr) { std::fill_n(to.flow_px + 2 * pixel, 2, nan); }
    if (to.previous_px != nullptr) { std::fill_n(to.previous_px + 2 * pixel, 2, nan); }
    if (to.coverage != nullptr) { to.coverage[pixel] = 0.0F; }
}

} // namespace octant::visuals::raster
