#include "visuals/planning/runway_painter.h"

#include "models/colour_vertex.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/scene/settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::visuals::planning {

namespace {

constexpr double whole_px = 0.6; ///< what looks as wide has its own colour ...
constexpr double least_px = 0.3; ///< ... and what looks narrower is not painted
constexpr int usual_triangles = 1600;
constexpr double most_share = 0.2; ///< of the triangles that are aimed at
constexpr double near_m = 700.0;   ///< up to here all that is usual is kept for it
constexpr double least_area_m2 = 1e-5;
/// A little more than two of scene::screen_step_px, by which two sides may be rounded apart.
constexpr double overlap_px = 0.01;
constexpr double most_overlap = 0.05; ///< of the distance from the eye

double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a corner of an edge moves across it in a plane, along a vector of length 1 on the map,
/// so that the eye sees it move by an angle. `across` is in the plane, `sideways` a unit vector
/// across the plane through the eye and the edge.
double moved_m(
    const glm::dvec3& corner_m,
    const glm::dvec3& across,
    const glm::dvec3& sideways,
    double angle_rad) {
    const double seen = std::abs(glm::dot(across, sideways));
    return glm::length(corner_m) * std::min(angle_rad / std::max(seen, 1e-9), most_overlap);
}

/// False only for a triangle of which nothing is in view, nor of what is painted a little beyond
/// its sides.
bool may_be_in_view(const SightPolygon& triangle, const FrameView& view) {
    return std::ranges::all_of(view.frustum, [&](const glm::dvec3& inwards) {
        return std::ranges::any_of(triangle, [&](const SightCorner& corner) {
            return glm::dot(inwards, corner.at_m) >= -view.pixel_rad * glm::length(corner.at_m);
        });
    });
}

} // namespace

RunwayPainter::RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip)
    : strip_(std::move(strip)) {
    if (strip_) {
        patches_ = nature::runway_patches(strip_->length_m, strip_->width_m, strip_->heading_rad);
        std::ranges::stable_sort(
            patches_, {}, [](const nature::RunwayPatch& patch) { return patch.least_m.x; });
    }
}

void RunwayPainter::light_by(const nature::Daylight& day) {
    light_ = day.ambient() + day.sunlight() * std::max(static_cast<float>(day.to_sun().z), 0.0F);
}

int RunwayPainter::most_triangles(const glm::dvec3& eye_m, int triangle_target) const {
    if (!strip_ || triangle_target >= scene::unlimited_triangles) {
        return strip_ ? scene::unlimited_triangles : 0;
    }
    const glm::dvec2 place_m(eye_m);
    const double distance_m =
        std::hypot(strip_->distance_m(place_m), eye_m.z - strip_->plane_m(place_m));
    const double most = std::min<double>(usual_triangles, most_share * triangle_target);
    return static_cast<int>(most * std::clamp(near_m / std::max(distance_m, 1.0), 0.1, 1.0));
}

void RunwayPainter::paint(
    const scene::TriangleDraw& triangles,
    const landscape::GroundMesher& ground,
    const FrameView& view,
    bool nearest_first,
    int most) {
    paints_.clear();
    corners_.clear();
    triangles_ = 0;
    if (!strip_) {
        return;
    }
    eye_m_ = view.camera.eye_m;
    overlap_rad_ = overlap_px * view.pixel_rad;
    choose_patches(view);
    if (seen_.empty()) {
        return;
    }
    const auto meets_strip = [this](const glm::dvec3& least_m, const glm::dvec3& most_m) {
        const glm::dvec2 half_m(0.5 * (most_m - least_m));
        const glm::dvec2 middle = strip_->on_strip(glm::dvec2(0.5 * (least_m + most_m)));
        const double along_m = glm::dot(glm::abs(strip_->along()), half_m);
        const double left_m = glm::dot(glm::abs(strip_->left()), half_m);
        return middle.x + along_m >= 0.0 && middle.x - along_m <= strip_->length_m &&
               std::abs(middle.y) - left_m <= 0.5 * strip_->width_m;
    };
    candidates_.clear();
    ground.triangles_in(meets_strip, candidates_);
    if (!nearest_first) {
        std::ranges::reverse(candidates_);
    }
    for (const std::uint32_t candidate : candidates_) {
        place_triangle(triangles, candidate, triangle_);
        if (may_be_in_view(triangle_, view)) {
            paint_triangle(candidate, most);
        }
    }
}

/// A marking that looks narrow takes the colour of the surface, and so does not go in a step.
void RunwayPainter::choose_patches(const FrameView& view) {
    seen_.clear();
    for (const nature::RunwayPatch& patch : patches_) {
        const glm::dvec2 middle_m = strip_->place(0.5 * glm::dvec2(patch.least_m + patch.most_m));
        const double distance_m =
            glm::distance(glm::dvec3(middle_m, strip_->plane_m(middle_m)), view.camera.eye_m);
        const glm::vec2 size_m = patch.most_m - patch.least_m;
        const double seen_px =
            static_cast<double>(std::min(size_m.x, size_m.y)) / (distance_m * view.pixel_rad);
        if (seen_px <= least_px) {
            continue;
        }
        const auto own =
            static_cast<float>(std::clamp((seen_px - least_px) / (whole_px - least_px), 0.0, 1.0));
        const glm::vec3 colour = patch.is_painted
                                     ? glm::mix(nature::runway_surface, nature::runway_paint, own)
                                     : nature::runway_surface;
        seen_.push_back(
            {glm::dvec2(patch.least_m),
             glm::dvec2(patch.most_m),
             models::packed_colour(colour * light_) & 0x00ffffffU,
             patch.is_painted});
    }
}

/// Cuts off what lies to the right of a line.
void RunwayPainter::cut(Piece& piece, const glm::dvec2& from, const glm::dvec2& to) {
    Piece kept;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2& a = piece.corners[i];
        const glm::dvec2& b = piece.corners[i + 1 < piece.count ? i + 1 : 0];
        const double a_side = area2(from, to, a);
        const double b_side = area2(from, to, b);
        if (a_side >= 0.0) {
            kept.corners[kept.count++] = a;
        }
        if ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0)) {
            kept.corners[kept.count++] = glm::mix(a, b, a_side / (a_side - b_side));
        }
    }
    piece = kept;
}

void RunwayPainter::paint_triangle(std::uint32_t triangle, int most) {
    plane_ = plane_of(triangle_);
    if (plane_.offset_m <= 0.0 || plane_.normal.z <= 0.0) {
        return; // the eye does not see it
    }
    place_sides();
    const std::array<glm::dvec2, 3> corners = {
        sides_[0].from_m, sides_[1].from_m, sides_[2].from_m};
    const glm::dvec2 least_m = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 most_m = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const double first_m = least_m.x - static_cast<double>(nature::longest_patch_m);
    const auto along_m = [](const Seen& patch) { return patch.least_m.x; };
    for (auto patch = std::ranges::lower_bound(seen_, first_m, {}, along_m);
         patch != seen_.end() && patch->least_m.x < most_m.x;
         ++patch) {
        const bool meets = patch->most_m.x > least_m.x && patch->least_m.y < most_m.y &&
                           patch->most_m.y > least_m.y;
        if (meets && (!patch->is_marking || triangles_ < most)) {
            paint_patch(*patch, triangle);
        }
    }
}

/// The sides of the triangle at hand, and how far each end moves outwards to overlap.
void RunwayPainter::place_sides() {
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& from_m = triangle_[i].at_m;
        const glm::dvec3& to_m = triangle_[(i + 1) % 3].at_m;
        const glm::dvec2 edge = glm::normalize(glm::dvec2(to_m - from_m));
        const glm::dvec2 out(edge.y, -edge.x);
        const glm::dvec3 across(out, -glm::dot(glm::dvec2(plane_.normal), out) / plane_.normal.z);
        const glm::dvec3 upright = glm::cross(from_m, to_m);
        const glm::dvec3 sideways = upright / std::max(glm::length(upright), 1e-9);
        sides_[i] = {
            strip_->on_strip(glm::dvec2(from_m + eye_m_)),
            strip_->on_strip(glm::dvec2(to_m + eye_m_)),
            {glm::dot(out, strip_->along()), glm::dot(out, strip_->left())},
            moved_m(from_m, across, sideways, overlap_rad_),
            moved_m(to_m, across, sideways, overlap_rad_)};
    }
}

RunwayPainter::Piece RunwayPainter::whole(const Seen& patch) {
    return {
        {patch.least_m,
         {patch.most_m.x, patch.least_m.y},
         patch.most_m,
         {patch.least_m.x, patch.most_m.y}},
        4};
}

/// How a patch lies to the triangle at hand: most do not touch it, and many lie within it.
RunwayPainter::Touch RunwayPainter::touch_of(const Piece& patch) const {
    Touch touch = Touch::Whole;
    for (const Side& side : sides_) {
        std::size_t inside = 0;
        for (std::size_t i = 0; i < patch.count; ++i) {
            inside += area2(side.from_m, side.to_m, patch.corners[i]) >= 0.0 ? 1U : 0U;
        }
        if (inside == 0) {
            return Touch::None;
        }
        touch = inside < patch.count ? Touch::Part : touch;
    }
    return touch;
}

/// A patch cut to the triangle at hand, whose sides move out by so many overlaps.
RunwayPainter::Piece RunwayPainter::piece_of(const Piece& patch, double overlaps) const {
    Piece piece = patch;
    for (const Side& side : sides_) {
        cut(piece,
            side.from_m + side.out * (side.from_moved_m * overlaps),
            side.to_m + side.out * (side.to_moved_m * overlaps));
    }
    return piece;
}

/// What of a patch lies on the triangle at hand, if anything does. A marking overlaps twice as far
/// as the surface below it, which must not show along its ends.
void RunwayPainter::paint_patch(const Seen& patch, std::uint32_t triangle) {
    const auto area_m2 = [](const Piece& piece) {
        double sum_m2 = 0.0;
        for (std::size_t i = 2; i < piece.count; ++i) {
            sum_m2 += 0.5 * area2(piece.corners[0], piece.corners[i - 1], piece.corners[i]);
        }
        return sum_m2;
    };
    const Piece all = whole(patch);
    const Touch touch = touch_of(all);
    if (touch == Touch::None ||
        area_m2(touch == Touch::Whole ? all : piece_of(all, 0.0)) <= least_area_m2) {
        return;
    }
    const Piece piece = touch == Touch::Whole ? all : piece_of(all, patch.is_marking ? 2.0 : 1.0);
    paints_.push_back(
        {triangle,
         static_cast<std::uint32_t>(corners_.size()),
         static_cast<std::uint32_t>(piece.count),
         patch.colour,
         patch.is_marking ? GroundLayer::Marking : GroundLayer::Surface});
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2 at_m = strip_->place(piece.corners[i]) - glm::dvec2(eye_m_);
        const double up_m =
            -(glm::dot(glm::dvec2(plane_.normal), at_m) + plane_.offset_m) / plane_.normal.z;
        corners_.emplace_back(at_m, up_m);
    }
    triangles_ += static_cast<int>(piece.count) - 2;
}

} // namespace octant::visuals::planning
