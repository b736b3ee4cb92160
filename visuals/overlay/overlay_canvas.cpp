// Lines as strips of triangles: rows of vertices across the line, joined by mitres. The alpha of a core falls to 0 at
// its edges.

#include "visuals/overlay/overlay_canvas.h"

#include "visuals/overlay/stroke_font.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace octant::visuals::overlay {

namespace {

constexpr float min_length_px = 0.05F;
constexpr float min_mitre_cosine = -0.6F;  ///< cosine of the turn from which a line begins anew
constexpr float edge_px = 1.0F;            ///< over which the edge of a core fades
constexpr float max_ridge_width_px = 2.2F; ///< letters' lines up to here fade from their middle on
constexpr std::size_t circle_corners = 20;

glm::vec2 across(const glm::vec2& along) { return {-along.y, along.x}; }

std::uint32_t with_alpha(std::uint32_t colour, float share) {
    const auto alpha = static_cast<float>(colour >> 24U) * share;
    return (colour & 0x00ffffffU) | static_cast<std::uint32_t>(std::lround(alpha)) << 24U;
}

/// Narrows the part `from_share` to `to_share` of a line to that on the inner side of one edge; false when nothing is
/// left. `depth` = how far inside the line begins, `change` = over the line.
bool narrow_interval(float depth, float change, float& from_share, float& to_share) {
    if (change == 0.0F) { return depth >= 0.0F; }
    const float share = -depth / change;
    if (change > 0.0F) {
        from_share = std::max(from_share, share);
    } else {
        to_share = std::min(to_share, share);
    }
    return from_share < to_share;
}

} // namespace

void OverlayCanvas::begin(const glm::mat3& to_picture, const OverlayPen& pen) {
    to_picture_ = to_picture;
    constexpr float far = std::numeric_limits<float>::max();
    clip_ = {glm::vec2(-far), glm::vec2(far)};
    vertices_.clear();
    areas_.clear();
    halo_.indices.clear();
    lines_.indices.clear();
    letters_.indices.clear();
    const float halo_px = 0.5F * pen.width_px + pen.halo_px;
    halo_.points = {{{-halo_px, pen.halo_colour}, {halo_px, pen.halo_colour}, {}, {}}};
    halo_.count = pen.halo_colour >> 24U != 0 ? 2 : 0;
    halo_.extension_px = halo_px;
    // Lines narrower than their edges would be are that wide and fainter.
    const std::uint32_t full = with_alpha(pen.colour, std::min(pen.width_px / edge_px, 1.0F));
    const std::uint32_t clear = with_alpha(pen.colour, 0.0F);
    const float inner_px = 0.5F * std::max(pen.width_px - edge_px, 0.0F);
    const float outer_px = inner_px + edge_px;
    lines_.points = {{{-outer_px, clear}, {-inner_px, full}, {inner_px, full}, {outer_px, clear}}};
    lines_.count = 4;
    lines_.extension_px = 0.5F * pen.width_px;
    // Most of the triangles are letters': while thin, two thirds of them do, nearly as sharp.
    letters_.points = lines_.points;
    letters_.count = lines_.count;
    letters_.extension_px = lines_.extension_px;
    if (pen.width_px <= max_ridge_width_px) {
        letters_.points = {{{-outer_px, clear}, {0.0F, full}, {outer_px, clear}, {}}};
        letters_.count = 3;
    }
    draws_text_ = false;
}

glm::vec2 OverlayCanvas::to_picture_at(const glm::vec2& at) const {
    const glm::vec3 seen = to_picture_ * glm::vec3(at, 1.0F);
    return glm::vec2(seen) / seen.z;
}

void OverlayCanvas::fill(std::span<const glm::vec2> corners, std::uint32_t colour) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (const glm::vec2& corner : corners) { vertices_.push_back({to_picture_at(corner), colour}); }
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        areas_.insert(areas_.end(), {first, first + i - 1, first + i});
    }
}

void OverlayCanvas::polyline(std::span<const glm::vec2> points) {
    for (std::size_t i = 1; i < points.size(); ++i) { clip_line(points[i - 1], points[i]); }
    end_run();
}

/// The part of a line within the clip box (Liang and Barsky's parametric clipping).
void OverlayCanvas::clip_line(const glm::vec2& from, const glm::vec2& to) {
    const glm::vec2 change = to - from;
    float from_share = 0.0F;
    float to_share = 1.0F;
    const bool seen = narrow_interval(from.x - clip_.min.x, change.x, from_share, to_share) &&
                      narrow_interval(clip_.max.x - from.x, -change.x, from_share, to_share) &&
                      narrow_interval(from.y - clip_.min.y, change.y, from_share, to_share) &&
                      narrow_interval(clip_.max.y - from.y, -change.y, from_share, to_share);
    if (!seen) {
        end_run();
        return;
    }
    if (run_.empty() || from_share > 0.0F) {
        end_run();
        add_to_run(from + change * from_share);
    }
    add_to_run(to_share < 1.0F ? from + change * to_share : to);
    if (to_share < 1.0F) { end_run(); }
}

void OverlayCanvas::add_to_run(const glm::vec2& at) {
    const glm::vec2 at_px = to_picture_at(at);
    if (run_.empty() || glm::distance(run_.back(), at_px) > min_length_px) { run_.push_back(at_px); }
}

void OverlayCanvas::end_run() {
    if (run_.size() > 1) {
        if (halo_.count > 0) { stroke(halo_); }
        stroke(draws_text_ ? letters_ : lines_);
    }
    run_.clear();
}

/// The run as strips, one for each part without sharp turns.
void OverlayCanvas::stroke(Strips& strips) {
    const std::size_t last = run_.size() - 1;
    const bool closed = last > 2 && glm::distance(run_.front(), run_[last]) < min_length_px;
    const auto direction = [&](std::size_t segment) { return glm::normalize(run_[segment + 1] - run_[segment]); };
    glm::vec2 before = direction(closed ? last - 1 : 0);
    for (std::size_t i = 0; i <= last; ++i) {
        const glm::vec2 after = i < last ? direction(i) : (closed ? direction(0) : before);
        const bool inside = closed || (i > 0 && i < last);
        if (inside && glm::dot(before, after) > min_mitre_cosine) {
            const glm::vec2 middle = across(before) + across(after);
            add_row(strips, run_[i], middle * (2.0F / glm::dot(middle, middle)));
            if (i > 0) { join_last_rows(strips); }
        } else {
            if (i > 0) {
                add_row(strips, run_[i] + before * strips.extension_px, across(before));
                join_last_rows(strips);
            }
            if (i < last) { add_row(strips, run_[i] - after * strips.extension_px, across(after)); }
        }
        before = after;
    }
}

void OverlayCanvas::add_row(const Strips& strips, const glm::vec2& at, const glm::vec2& side) {
    for (std::size_t i = 0; i < strips.count; ++i) {
        vertices_.push_back({at + side * strips.points[i].at_px, strips.points[i].colour});
    }
}

void OverlayCanvas::join_last_rows(Strips& strips) {
    const auto count = static_cast<std::uint32_t>(strips.count);
    const std::uint32_t here = static_cast<std::uint32_t>(vertices_.size()) - count;
    const std::uint32_t there = here - count;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        for (const std::uint32_t corner : {there + i, there + i + 1, here + i, here + i, there + i + 1, here + i + 1}) {
            strips.indices.push_back(corner);
        }
    }
}

void OverlayCanvas::box(const OverlayBox& box) {
    const glm::vec2 left_below(box.min.x, box.max.y);
    const glm::vec2 right_above(box.max.x, box.min.y);
    polyline(std::array{box.min, right_above, box.max, left_below, box.min});
}

void OverlayCanvas::circle(const glm::vec2& centre, float radius) {
    std::array<glm::vec2, circle_corners + 1> corners;
    for (std::size_t i = 0; i <= circle_corners; ++i) {
        const float angle_rad =
            2.0F * std::numbers::pi_v<float> * static_cast<float>(i % circle_corners) / circle_corners;
        corners[i] = centre + radius * glm::vec2(std::cos(angle_rad), std::sin(angle_rad));
    }
    polyline(corners);
}

void OverlayCanvas::text(const TextLayout& place, std::string_view text) {
    const float step = place.height / glyph_height;
    const glm::vec2 right = place.along * step;
    const glm::vec2 up = glm::vec2(place.along.y, -place.along.x) * step;
    const auto width = static_cast<float>(text_width(text.size()));
    const glm::vec2 corner = place.at - right * (place.alignment * width) - up * (0.5F * glyph_height);
    const glm::vec2 across = right * width;
    const glm::vec2 over = up * static_cast<float>(glyph_height);
    if (!clip_.contains(corner) || !clip_.contains(corner + across) || !clip_.contains(corner + over) ||
        !clip_.contains(corner + across + over)) {
        return;
    }
    draws_text_ = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const glm::vec2 origin = corner + right * static_cast<float>(i * glyph_advance);
        glm::vec2 last(0.0F);
        for (const GlyphPoint& point : glyph_strokes(text[i])) {
            const glm::vec2 at = origin + right * static_cast<float>(point.x) + up * static_cast<float>(point.y);
            if (point.begins_stroke) {
                end_run();
            } else {
                clip_line(last, at);
            }
            last = at;
        }
        end_run();
    }
    draws_text_ = false;
}

scene::OverlayDraw OverlayCanvas::finish() {
    std::vector<std::uint32_t>& all = areas_;
    all.insert(all.end(), halo_.indices.begin(), halo_.indices.end());
    all.insert(all.end(), lines_.indices.begin(), lines_.indices.end());
    all.insert(all.end(), letters_.indices.begin(), letters_.indices.end());
    return {vertices_, all};
}

void OverlayLayers::clear() {
    vertices_.clear();
    indices_.clear();
}

void OverlayLayers::add(const scene::OverlayDraw& draw) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), draw.vertices.begin(), draw.vertices.end());
    indices_.reserve(indices_.size() + draw.indices.size());
    for (const std::uint32_t index : draw.indices) { indices_.push_back(first + index); }
}

} // namespace octant::visuals::overlay
