// Lines as strips of triangles: rows of vertices across the line whose alpha falls to 0 at its
// edges, joined by mitres, with one more row of alpha 0 beyond either end.

#include "visuals/scene/overlay_canvas.h"

#include "visuals/scene/stroke_letters.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace octant::visuals::scene {

namespace {

constexpr float least_length_px = 0.05F;
constexpr float sharpest_join = -0.6F; ///< cosine of the turn from which a line begins anew
constexpr float edge_px = 1.0F;        ///< over which the edge of a core fades
constexpr std::size_t circle_corners = 20;

std::uint32_t with_alpha(std::uint32_t colour, float share) {
    const auto alpha = static_cast<float>(colour >> 24U) * share;
    return (colour & 0x00ffffffU) | static_cast<std::uint32_t>(std::lround(alpha)) << 24U;
}

/// Narrows the part `from_share` to `to_share` of a line to that on the inner side of one edge;
/// false when nothing is left. `depth` = how far inside the line begins, `change` = over the line.
bool narrow(float depth, float change, float& from_share, float& to_share) {
    if (change == 0.0F) {
        return depth >= 0.0F;
    }
    const float share = -depth / change;
    if (change > 0.0F) {
        from_share = std::max(from_share, share);
    } else {
        to_share = std::min(to_share, share);
    }
    return from_share < to_share;
}

} // namespace

/// A line across: places as shares of a half width from the middle, and their alpha.
struct OverlayCanvas::Profile {
    struct Point {
        float at_px = 0.0F;
        std::uint32_t colour = 0;
    };

    std::array<Point, 4> points{};
    std::size_t count = 0;
    float beyond_ends_px = 0.0F; ///< where the row of alpha 0 lies
};

void OverlayCanvas::begin(const glm::mat3& to_picture, const OverlayPen& pen) {
    to_picture_ = to_picture;
    pen_ = pen;
    constexpr float far = std::numeric_limits<float>::max();
    clip_ = {glm::vec2(-far), glm::vec2(far)};
    vertices_.clear();
    shade_indices_.clear();
    core_indices_.clear();
}

void OverlayCanvas::polyline(std::span<const glm::vec2> points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        cut_line(points[i - 1], points[i]);
    }
    end_run();
}

/// The part of a line within the clip box (Liang and Barsky's parametric clipping).
void OverlayCanvas::cut_line(const glm::vec2& from, const glm::vec2& to) {
    const glm::vec2 change = to - from;
    float from_share = 0.0F;
    float to_share = 1.0F;
    const bool seen = narrow(from.x - clip_.least.x, change.x, from_share, to_share) &&
                      narrow(clip_.most.x - from.x, -change.x, from_share, to_share) &&
                      narrow(from.y - clip_.least.y, change.y, from_share, to_share) &&
                      narrow(clip_.most.y - from.y, -change.y, from_share, to_share);
    if (!seen) {
        end_run();
        return;
    }
    if (run_.empty() || from_share > 0.0F) {
        end_run();
        add_to_run(from + change * from_share);
    }
    add_to_run(to_share < 1.0F ? from + change * to_share : to);
    if (to_share < 1.0F) {
        end_run();
    }
}

void OverlayCanvas::add_to_run(const glm::vec2& at) {
    const glm::vec3 seen = to_picture_ * glm::vec3(at, 1.0F);
    const glm::vec2 at_px = glm::vec2(seen) / seen.z;
    if (run_.empty() || glm::distance(run_.back(), at_px) > least_length_px) {
        run_.push_back(at_px);
    }
}

void OverlayCanvas::end_run() {
    if (run_.size() > 1) {
        const float half_px = 0.5F * std::max(pen_.width_px, edge_px);
        const float core_px = half_px - 0.5F * edge_px;
        const float faint = std::min(pen_.width_px / edge_px, 1.0F);
        const std::uint32_t clear = with_alpha(pen_.colour, 0.0F);
        const std::uint32_t full = with_alpha(pen_.colour, faint);
        const float outer_px = half_px + 0.5F * edge_px;
        const float shade_px = half_px + pen_.shade_px;
        const std::uint32_t no_shade = with_alpha(pen_.shade, 0.0F);
        const Profile shade{
            {{{-shade_px, no_shade}, {0.0F, pen_.shade}, {shade_px, no_shade}, {}}}, 3, shade_px};
        const Profile core{
            {{{-outer_px, clear}, {-core_px, full}, {core_px, full}, {outer_px, clear}}},
            4,
            outer_px};
        stroke(shade, shade_indices_);
        stroke(core, core_indices_);
    }
    run_.clear();
}

/// The run as strips, one for each part without sharp turns.
void OverlayCanvas::stroke(const Profile& profile, std::vector<std::uint32_t>& indices) {
    const std::size_t last = run_.size() - 1;
    const bool closed = last > 2 && glm::distance(run_.front(), run_[last]) < least_length_px;
    const auto direction = [&](std::size_t segment) {
        return glm::normalize(run_[segment + 1] - run_[segment]);
    };
    const auto across = [](const glm::vec2& along) { return glm::vec2(-along.y, along.x); };
    const auto mitre = [&](const glm::vec2& before, const glm::vec2& after) {
        const glm::vec2 middle = across(before) + across(after);
        return middle * (2.0F / glm::dot(middle, middle));
    };
    const auto end = [&](const glm::vec2& at, const glm::vec2& outward, const glm::vec2& side) {
        add_row(profile, at + outward * profile.beyond_ends_px, side, false);
    };
    glm::vec2 before = direction(closed ? last - 1 : 0);
    for (std::size_t i = 0; i <= last; ++i) {
        const bool has_before = i > 0 || closed;
        const bool has_after = i < last || closed;
        const glm::vec2 after = i < last ? direction(i) : (closed ? direction(0) : before);
        const bool joins = has_before && has_after && glm::dot(before, after) > sharpest_join;
        if (joins) {
            add_row(profile, run_[i], mitre(before, after), true);
            if (i > 0) {
                join_last_rows(profile, indices);
            }
        } else {
            if (i > 0) {
                add_row(profile, run_[i], across(before), true);
                join_last_rows(profile, indices);
                end(run_[i], before, across(before));
                join_last_rows(profile, indices);
            }
            if (i < last) {
                end(run_[i], -after, across(after));
                add_row(profile, run_[i], across(after), true);
                join_last_rows(profile, indices);
            }
        }
        before = after;
    }
}

/// Vertices across the line, all clear unless `solid`.
void OverlayCanvas::add_row(
    const Profile& profile, const glm::vec2& at, const glm::vec2& across, bool solid) {
    for (std::size_t i = 0; i < profile.count; ++i) {
        const Profile::Point& point = profile.points[i];
        const std::uint32_t colour = solid ? point.colour : with_alpha(point.colour, 0.0F);
        vertices_.push_back({at + across * point.at_px, colour});
    }
}

void OverlayCanvas::join_last_rows(const Profile& profile, std::vector<std::uint32_t>& indices) {
    const auto count = static_cast<std::uint32_t>(profile.count);
    const std::uint32_t here = static_cast<std::uint32_t>(vertices_.size()) - count;
    const std::uint32_t there = here - count;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        for (const std::uint32_t corner :
             {there + i, there + i + 1, here + i, here + i, there + i + 1, here + i + 1}) {
            indices.push_back(corner);
        }
    }
}

void OverlayCanvas::box(const OverlayBox& box) {
    const glm::vec2 left_below(box.least.x, box.most.y);
    const glm::vec2 right_above(box.most.x, box.least.y);
    polyline(std::array{box.least, right_above, box.most, left_below, box.least});
}

void OverlayCanvas::circle(const glm::vec2& centre, float radius) {
    std::array<glm::vec2, circle_corners + 1> corners;
    for (std::size_t i = 0; i <= circle_corners; ++i) {
        const float angle_rad = 2.0F * std::numbers::pi_v<float> *
                                static_cast<float>(i % circle_corners) / circle_corners;
        corners[i] = centre + radius * glm::vec2(std::cos(angle_rad), std::sin(angle_rad));
    }
    polyline(corners);
}

void OverlayCanvas::text(const TextPlace& place, std::string_view text) {
    const float step = place.height / letter_height;
    const glm::vec2 right = place.along * step;
    const glm::vec2 up = glm::vec2(place.along.y, -place.along.x) * step;
    const auto width = static_cast<float>(text_width(text.size()));
    const glm::vec2 corner =
        place.at - right * (place.share_before * width) - up * (0.5F * letter_height);
    const glm::vec2 across = right * width;
    const glm::vec2 over = up * static_cast<float>(letter_height);
    if (!clip_.holds(corner) || !clip_.holds(corner + across) || !clip_.holds(corner + over) ||
        !clip_.holds(corner + across + over)) {
        return;
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
        const glm::vec2 origin = corner + right * static_cast<float>(i * letter_advance);
        glm::vec2 last(0.0F);
        for (const LetterPoint& point : strokes_of(text[i])) {
            const glm::vec2 at =
                origin + right * static_cast<float>(point.x) + up * static_cast<float>(point.y);
            if (point.begins_stroke) {
                end_run();
            } else {
                cut_line(last, at);
            }
            last = at;
        }
        end_run();
    }
}

OverlayDraw OverlayCanvas::finish() {
    shade_indices_.insert(shade_indices_.end(), core_indices_.begin(), core_indices_.end());
    return {vertices_, shade_indices_};
}

} // namespace octant::visuals::scene
