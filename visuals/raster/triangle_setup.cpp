// Step 3 of a picture (renderer.cpp): triangles are clipped by the view and by planes, culled, and written as Triangle
// (triangle.h) with the edges and gradients of triangle_planes.cpp. Next: triangle_binner.cpp.
#include "visuals/raster/triangle_setup.h"

#include "visuals/raster/mesh_texture.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/triangle.h"
#include "visuals/raster/triangle_planes.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace octant::visuals::raster {

namespace {

/// Makes planes over the picture from values at the three corners of a triangle, wherever these lie, behind the eye,
/// too.
class PlaneSolver {
public:
    PlaneSolver(const std::array<ClipPosition, 3>& vertices, const Projection& projection);

    /// Of value / w.
    AttributePlane plane(const glm::dvec3& values) const;

private:
    glm::dmat3 from_values_{0.0}; ///< takes values to factors of x / w, y / w and 1
    glm::dvec2 half_px_{0.0};
};

// As OpenGL's polygon offset in visuals/gl: a shadow piece lies in the plane of ground triangles, but for the rounding
// of its corners and depths.
constexpr double towards_eye_px = TriangleExtra::on_ground_offset_px;
constexpr double towards_eye_share = 0x1p-19; ///< of the depth
// What is edge-on has depths without meaning and closes holes: it is pushed back.
constexpr double edge_on_share = 0.02;

PlaneSolver::PlaneSolver(const std::array<ClipPosition, 3>& vertices, const Projection& projection)
    : half_px_(projection.half_px) {
    glm::dmat3 rows; // of corners: glm counts columns first, so this is the transpose
    for (glm::length_t i = 0; i < 3; ++i) {
        const ClipPosition& vertex = vertices[static_cast<std::size_t>(i)];
        rows[0][i] = static_cast<double>(vertex.x);
        rows[1][i] = static_cast<double>(vertex.y);
        rows[2][i] = static_cast<double>(vertex.w);
    }
    const double determinant = glm::determinant(rows);
    if (determinant != 0.0) { from_values_ = glm::inverse(rows); }
}

AttributePlane PlaneSolver::plane(const glm::dvec3& values) const {
    const glm::dvec3 factor = from_values_ * values;
    AttributePlane plane;
    plane.per_x = factor.x / half_px_.x;
    plane.per_y = -factor.y / half_px_.y;
    plane.base = factor.z - factor.x + factor.y + 0.5 * (plane.per_x + plane.per_y);
    return plane;
}

/// Fills in a triangle's depth, from the plane of 1 / w, as the style uses it.
void set_depth(
    TriangleExtra& extra, const AttributePlane& over_w, const DrawStyle& style, const Projection& projection) {
    const auto near_m = static_cast<double>(projection.near_m);
    if (style.depth == scene::DepthUse::InfinitelyFar) {
        extra.depth = {};
        return;
    }
    extra.depth = {over_w.base * near_m, over_w.per_x * near_m, over_w.per_y * near_m};
    if (style.depth == scene::DepthUse::OnGround) {
        const double slope = std::max(std::abs(extra.depth.per_x), std::abs(extra.depth.per_y));
        extra.depth.base += towards_eye_px * slope;
        extra.depth_share = static_cast<float>(1.0 + towards_eye_share);
    } else if (style.depth == scene::DepthUse::EdgeOn) {
        extra.depth_share = static_cast<float>(1.0 - edge_on_share);
    }
}

/// Where a triangle lies in front of a plane in world axes with the eye subtracted.
ClipLine clip_line(
    const glm::vec4& plane, const AttributePlane& over_w, const scene::FramePlan& plan, const Projection& projection) {
    const glm::dvec3 normal = glm::dmat3(glm::mat3(plan.world_to_view)) * glm::dvec3(glm::vec3(plane));
    const double across = 1.0 / static_cast<double>(plan.view_to_clip[0][0]);
    const double up = 1.0 / static_cast<double>(plan.view_to_clip[1][1]);
    const auto offset = static_cast<double>(plane.w);
    ClipLine line;
    line.a = normal.x * across / static_cast<double>(projection.half_px.x);
    line.b = -normal.y * up / static_cast<double>(projection.half_px.y);
    line.c = -normal.x * across + normal.y * up - normal.z + 0.5 * (line.a + line.b);
    // The picture's middle need not lie straight ahead.
    line.c += normal.x * across * static_cast<double>(plan.view_to_clip[2][0]) +
              normal.y * up * static_cast<double>(plan.view_to_clip[2][1]);
    line.a += offset * over_w.per_x;
    line.b += offset * over_w.per_y;
    line.c += offset * over_w.base;
    return line;
}

constexpr std::int32_t per_px = ScreenVertex::per_px;

/// Levels that a straight line over the picture may be wrong by without correction.
constexpr float min_correction = 1.0F;

/// Texels a pixel above which an affine textured triangle counts as a sliver.
constexpr double texture_per_px = 8.0;

bool is_above(const ScreenVertex& a, const ScreenVertex& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// Twice the area, in 1/256 pixel squared; positive when the corners go round clockwise as seen (y down), which is how
/// back faces do.
std::int64_t doubled_area(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

} // namespace

TriangleSetup::TriangleSetup(const Projection& projection, const scene::FramePlan& plan, const SamplePattern& samples,
    std::size_t texture_levels)
    : projection_(projection), plan_(plan), samples_(samples), reach_(samples.reach * per_px / SamplePattern::unit),
      texture_levels_(texture_levels) {}

void TriangleSetup::add(const VertexOutputs& corners, const std::array<std::uint32_t, 3>& triangle,
    const FlatColour* flat, TriangleList& list) {
    const auto& vertices = corners.vertices;
    const auto [a, b, c] = triangle;
    constexpr std::uint32_t sides = left_of_view | right_of_view | above_view | below_view;
    if ((vertices[a].outcode & vertices[b].outcode & vertices[c].outcode & sides) != 0) { return; }
    const bool is_cut = ((vertices[a].outcode | vertices[b].outcode | vertices[c].outcode) & beyond_range) != 0;
    if (!is_cut && style_.culls_back_faces && doubled_area(vertices[a], vertices[b], vertices[c]) >= 0) { return; }
    flat_ = flat != nullptr && !flat->is_smooth() ? flat : nullptr;
    extra_ = Triangle::none;
    fill_ = surface_ != nullptr ? style_.fill : fill_of({&vertices[a], &vertices[b], &vertices[c]}, is_cut);
    if (flat != nullptr && flat_ == nullptr && !corners.lit.empty()) {
        fill_ = Fill::Lit;
        lit_ = {&corners.lit[a], &corners.lit[b], &corners.lit[c]};
    }
    if (surface_ != nullptr) {
        places_ = surface_->places;
        flat_haze_share_ = vertices[a].value[3];
    }
    if (!is_cut && style_.group == 0 && style_.clip_planes.empty() && style_.opacity == 1.0F) {
        if (fill_ == Fill::Gouraud) {
            add_placed(vertices[a], vertices[b], vertices[c], list);
            return;
        }
        if (fill_ == Fill::TextureInPerspective &&
            add_affine_triangle({&vertices[a], &vertices[b], &vertices[c]}, list)) {
            return;
        }
    }
    const std::array<ClipVertex, 3> three{ClipVertex{vertices[a], corners.clip[a], places_[0]},
        ClipVertex{vertices[b], corners.clip[b], places_[1]}, ClipVertex{vertices[c], corners.clip[c], places_[2]}};
    if (style_.group != 0 || fill_ != Fill::Gouraud || !style_.clip_planes.empty() || style_.opacity < 1.0F) {
        add_extra(three, list);
    }
    if (is_cut) {
        add_cut(three, list);
    } else {
        add_placed(vertices[a], vertices[b], vertices[c], list);
    }
}

/// Adds a textured triangle if its planes hold for all of it; else returns false.
bool TriangleSetup::add_affine_triangle(const std::array<const ScreenVertex*, 3>& corners, TriangleList& list) {
    const std::optional<AffineTexturedTriangle> affine = fit_affine_texture(corners, texture_levels_);
    if (!affine) { return false; }
    fill_ = Fill::Texture;
    mip_selection_ = affine->mip_selection;
    add_placed(affine->vertices[0], affine->vertices[1], affine->vertices[2], list);
    return true;
}

/// The inverse of place().
ClipPosition TriangleSetup::clip_of(const ScreenVertex& vertex) const {
    constexpr float px_per_step = 1.0F / static_cast<float>(per_px);
    const float w = 1.0F / vertex.inverse_w;
    const float right_px = static_cast<float>(vertex.x) * px_per_step + 0.5F - projection_.half_px.x;
    const float down_px = static_cast<float>(vertex.y) * px_per_step + 0.5F - projection_.half_px.y;
    return {right_px / projection_.half_px.x * w, -down_px / projection_.half_px.y * w, w};
}

void TriangleSetup::add_overlay(
    const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, TriangleList& list) {
    if (((a.outcode | b.outcode | c.outcode) & beyond_range) != 0) { return; }
    fill_ = style_.fill;
    flat_ = nullptr;
    surface_ = nullptr;
    extra_ = Triangle::none;
    if (style_.depth != scene::DepthUse::None) {
        const auto placed = [&](const ScreenVertex& corner) { return ClipVertex{corner, clip_of(corner)}; };
        add_extra(std::array{placed(a), placed(b), placed(c)}, list);
    }
    is_overlay_ = true;
    add_placed(a, b, c, list);
    is_overlay_ = false;
}

/// Whether straight lines over the picture are good enough for the levels between the corners.
Fill TriangleSetup::fill_of(const std::array<const ScreenVertex*, 3>& corners, bool is_cut) const {
    const auto [a, b, c] = corners;
    if (style_.fill != Fill::Gouraud || flat_ != nullptr) { return style_.fill; }
    if (is_cut) { return Fill::Perspective; }
    const float min_inverse_w = std::min(std::min(a->inverse_w, b->inverse_w), c->inverse_w);
    const float max_inverse_w = std::max(std::max(a->inverse_w, b->inverse_w), c->inverse_w);
    // At the middle of an edge the line is wrong by range * correction.
    const float correction = (max_inverse_w - min_inverse_w) / (2.0F * (max_inverse_w + min_inverse_w));
    if (correction * 255.0F <= min_correction) { return Fill::Gouraud; }
    float range = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        const float min = std::min(std::min(a->value[i], b->value[i]), c->value[i]);
        range = std::max(range, std::max(std::max(a->value[i], b->value[i]), c->value[i]) - min);
    }
    return correction * range > min_correction ? Fill::Perspective : Fill::Gouraud;
}

void TriangleSetup::add_extra(std::span<const ClipVertex, 3> corners, TriangleList& list) {
    const PlaneSolver solver({corners[0].clip, corners[1].clip, corners[2].clip}, projection_);
    TriangleExtra extra;
    const AttributePlane over_w = solver.plane({1.0, 1.0, 1.0});
    extra.over_w[4] = over_w;
    extra.opacity = style_.opacity;
    if (style_.group != 0) { set_depth(extra, over_w, style_, projection_); }
    if (fill_ != Fill::Gouraud && fill_ != Fill::Lit) {
        for (std::size_t i = 0; i < 4; ++i) {
            extra.over_w[i] = solver.plane({static_cast<double>(corners[0].vertex.value[i]),
                static_cast<double>(corners[1].vertex.value[i]), static_cast<double>(corners[2].vertex.value[i])});
        }
    }
    if (fill_ == Fill::MeshEdges || fill_ == Fill::Lit) {
        extra.from_edges = {
            solver.plane({1.0, 0.0, 0.0}), solver.plane({0.0, 1.0, 0.0}), solver.plane({0.0, 0.0, 1.0})};
        extra.mesh_level = mesh_level_;
        extra.lit = lit_;
    }
    for (const glm::vec4& plane : style_.clip_planes) {
        extra.cuts[static_cast<std::size_t>(extra.cut_count++)] = clip_line(plane, over_w, plan_, projection_);
    }
    extra_ = static_cast<std::uint32_t>(list.extras.size());
    list.extras.push_back(extra);
}

/// Keeps what has dot(by_clip, (x, y, w)) + offset >= 0. A cut edge is cut from its kept end, so that both triangles
/// that share it get the same corner.
void TriangleSetup::cut(const glm::dvec3& by_clip, double offset) {
    const auto inside = [&](const ClipVertex& corner) {
        return by_clip.x * static_cast<double>(corner.clip.x) + by_clip.y * static_cast<double>(corner.clip.y) +
               by_clip.z * static_cast<double>(corner.clip.w) + offset;
    };
    scratch_.clear();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const ClipVertex& from = polygon_[i];
        const ClipVertex& to = polygon_[i + 1 < polygon_.size() ? i + 1 : 0];
        const double from_inside = inside(from);
        const double to_inside = inside(to);
        if (from_inside >= 0.0) { scratch_.push_back(from); }
        if ((from_inside >= 0.0) == (to_inside >= 0.0)) { continue; }
        const bool keeps_from = from_inside >= 0.0;
        const ClipVertex& kept = keeps_from ? from : to;
        const ClipVertex& lost = keeps_from ? to : from;
        const double kept_inside = keeps_from ? from_inside : to_inside;
        const double lost_inside = keeps_from ? to_inside : from_inside;
        const double share = kept_inside / (kept_inside - lost_inside);
        const auto between = [&](float at_kept, float at_lost) {
            const auto from_value = static_cast<double>(at_kept);
            return static_cast<float>(from_value + share * (static_cast<double>(at_lost) - from_value));
        };
        ClipVertex corner;
        corner.clip.x = between(kept.clip.x, lost.clip.x);
        corner.clip.y = between(kept.clip.y, lost.clip.y);
        corner.clip.w = between(kept.clip.w, lost.clip.w);
        for (std::size_t k = 0; k < corner.vertex.value.size(); ++k) {
            corner.vertex.value[k] = between(kept.vertex.value[k], lost.vertex.value[k]);
        }
        corner.on_texture = {
            between(kept.on_texture.x, lost.on_texture.x), between(kept.on_texture.y, lost.on_texture.y)};
        scratch_.push_back(corner);
    }
    polygon_.swap(scratch_);
}

void TriangleSetup::add_cut(std::span<const ClipVertex> corners, TriangleList& list) {
    polygon_.assign(corners.begin(), corners.end());
    // A little inside the limits of place(), so that rounding leaves no corner unplaced.
    constexpr double within = 1.0 - 1e-5;
    cut({0.0, 0.0, 1.0}, -static_cast<double>(projection_.near_m) * (2.0 - within));
    const double x_max = static_cast<double>(projection_.max_over_w.x) * within;
    const double y_max = static_cast<double>(projection_.max_over_w.y) * within;
    cut({1.0, 0.0, x_max}, 0.0);
    cut({-1.0, 0.0, x_max}, 0.0);
    cut({0.0, 1.0, y_max}, 0.0);
    cut({0.0, -1.0, y_max}, 0.0);
    for (ClipVertex& corner : polygon_) {
        place(projection_, corner.clip, corner.vertex);
        assert((corner.vertex.outcode & beyond_range) == 0);
    }
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i) {
        const auto& a = polygon_[0].vertex;
        const auto& b = polygon_[i].vertex;
        const auto& c = polygon_[i + 1].vertex;
        places_ = {polygon_[0].on_texture, polygon_[i].on_texture, polygon_[i + 1].on_texture};
        if (!style_.culls_back_faces || doubled_area(a, b, c) < 0) { add_placed(a, b, c, list); }
    }
}

void TriangleSetup::add_placed(
    const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, TriangleList& list) {
    std::array<const ScreenVertex*, 3> order{&a, &b, &c};
    if (is_above(*order[1], *order[0])) { std::swap(order[0], order[1]); }
    if (is_above(*order[2], *order[1])) {
        std::swap(order[1], order[2]);
        if (is_above(*order[1], *order[0])) { std::swap(order[0], order[1]); }
    }
    const ScreenVertex& top = *order[0];
    const ScreenVertex& middle = *order[1];
    const ScreenVertex& bottom = *order[2];
    const std::int32_t min_x = std::min(std::min(a.x, b.x), c.x);
    const std::int32_t max_x = std::max(std::max(a.x, b.x), c.x);
    const std::int32_t left = std::max(first_row_of(min_x - reach_), 0);
    const std::int32_t right = std::min((max_x + reach_) >> 8, projection_.size_px.x - 1);
    const std::int32_t first = std::max(first_row_of(top.y - reach_), 0);
    const std::int32_t last = std::min((bottom.y - 1 + reach_) >> 8, projection_.size_px.y - 1);
    const std::int64_t area = doubled_area(top, middle, bottom);
    const TopDownVertices corners{top, middle, bottom, area};
    if (left > right || first > last || area == 0 || is_between_samples(corners, samples_)) { return; }
    static constexpr Triangle blank; // copied: g++ clears a new one by a slow instruction
    Triangle& triangle = list.triangles.emplace_back(blank);
    triangle.top = top.y;
    triangle.middle = middle.y;
    triangle.bottom = bottom.y;
    triangle.left = left;
    triangle.right = right;
    triangle.first_row = first;
    triangle.last_row = last;
    // Clockwise with y down: from the top the middle corner lies to the right.
    triangle.middle_is_left = area < 0;
    triangle.extra = extra_;
    triangle.group = style_.group;
    triangle.depth = style_.depth;
    triangle.fill = fill_;
    triangle.is_cloud = style_.is_cloud;
    triangle.is_sky = style_.is_sky;
    triangle.is_under_side = style_.is_land && doubled_area(a, b, c) > 0;
    triangle.source = source_;
    triangle.has_detail_texture =
        style_.has_detail_texture && (a.value[3] > 0.0F || b.value[3] > 0.0F || c.value[3] > 0.0F);
    if (surface_ != nullptr) {
        set_edges(corners, triangle);
        add_surface({&a, &b, &c}, triangle, list);
    } else if (flat_ != nullptr) {
        set_edges(corners, triangle);
        triangle.gradients = constant_gradients(flat_->rgb);
    } else if (fill_ == Fill::TextureInPerspective || fill_ == Fill::Lit) {
        set_edges(corners, triangle);
    } else if (fill_ == Fill::Texture) {
        triangle.texture = mip_selection_;
        set_edges_and_gradients(corners, texture_per_px, triangle);
    } else {
        // With one sample every pixel that is coloured has its middle within the triangle. Soft edges of what lies over
        // the picture are as narrow as a pixel: their alpha changes fast, and is looked at only within the triangle's
        // own.
        const bool has_slivers = reach_ > 0 && !is_overlay_;
        set_edges_and_gradients(corners, has_slivers ? sliver_per_px : any_per_px, triangle);
    }
}

/// Gives a triangle the planes of its texture.
void TriangleSetup::add_surface(
    const std::array<const ScreenVertex*, 3>& corners, Triangle& triangle, TriangleList& list) const {
    constexpr float max_place = 1e6F; // beyond it nothing is left of single precision
    SurfaceCorners values;
    const glm::vec2 least = glm::min(glm::min(places_[0], places_[1]), places_[2]);
    // Pictures repeat, with their mirror image in between: a whole number of pairs is left out.
    const auto pairs_of = [&](float from, models::TextureWrap wrap) {
        return wrap == models::TextureWrap::Clamp ? 0.0F : 2.0F * std::floor(0.5F * from);
    };
    const models::SurfaceTexture& texture = surface_->texture->texture;
    const glm::vec2 left_out(pairs_of(least.x, texture.wrap_u), pairs_of(least.y, texture.wrap_v));
    for (std::size_t k = 0; k < 3; ++k) {
        const ScreenVertex& corner = *corners[k];
        const auto sane = [](float place) { return std::abs(place) <= max_place ? place : 0.0F; };
        const bool is_flat = flat_ != nullptr;
        const auto level = [&](std::size_t i) { return is_flat ? flat_->rgb[i] : corner.value[i]; };
        values[k] = {1.0F, sane(places_[k].x - left_out.x), sane(places_[k].y - left_out.y),
            is_flat ? flat_haze_share_ : corner.value[3], level(0), level(1), level(2), 0.0F};
    }
    triangle.surface = static_cast<std::uint32_t>(list.surfaces.size());
    SurfacePlanes& planes = list.surfaces.emplace_back();
    planes.first_px = {triangle.left, triangle.first_row};
    planes.texture = surface_->texture;
    planes.haze = surface_->haze;
    set_surface_planes(corners, values, planes);
}

} // namespace octant::visuals::raster
