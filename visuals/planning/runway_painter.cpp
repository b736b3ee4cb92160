#include "visuals/planning/runway_painter.h"

#include "models/colour_vertex.h"
#include "visuals/scene/settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace octant::visuals::planning {

namespace {

constexpr double whole_px = 0.6; ///< what looks as wide has its own colour ...
constexpr double min_px = 0.3; ///< ... and what looks narrower is not painted
constexpr int default_triangles = 1600;
constexpr double max_share = 0.2; ///< of the triangles that are aimed at
constexpr double near_m = 700.0;   ///< up to here all that is usual is kept for it

} // namespace

RunwayPainter::RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip)
    : strip_(std::move(strip)) {
    if (strip_) {
        patches_ = nature::runway_rectangles(strip_->length_m, strip_->width_m, strip_->heading_rad);
        std::ranges::stable_sort(
            patches_, {}, [](const nature::RunwayRectangle& patch) { return patch.min_m.x; });
    }
}

void RunwayPainter::set_daylight(const nature::Daylight& day) {
    light_ = day.ambient() + day.sunlight() * std::max(static_cast<float>(day.to_sun().z), 0.0F);
}

int RunwayPainter::max_triangles(const glm::dvec3& eye_m, int triangle_target) const {
    if (!strip_ || triangle_target >= scene::unlimited_triangles) {
        return strip_ ? scene::unlimited_triangles : 0;
    }
    const glm::dvec2 position_m(eye_m);
    const double distance_m =
        std::hypot(strip_->distance_m(position_m), eye_m.z - strip_->plane_m(position_m));
    const double most = std::min<double>(default_triangles, max_share * triangle_target);
    return static_cast<int>(most * std::clamp(near_m / std::max(distance_m, 1.0), 0.1, 1.0));
}

void RunwayPainter::paint(
    const landscape::GroundMesher& ground,
    const FrameView& view,
    bool is_front_to_back,
    int most,
    DecalClipper& cutter) {
    if (!strip_) {
        return;
    }
    eye_m_ = glm::dvec2(view.camera.eye_m);
    choose_patches(view);
    if (seen_.empty()) {
        return;
    }
    const auto meets_strip = [this](const glm::dvec3& min_m, const glm::dvec3& max_m) {
        const glm::dvec2 half_m(0.5 * (max_m - min_m));
        const glm::dvec2 middle = strip_->strip_from_world(glm::dvec2(0.5 * (min_m + max_m)));
        const double along_m = glm::dot(glm::abs(strip_->along()), half_m);
        const double left_m = glm::dot(glm::abs(strip_->left()), half_m);
        return middle.x + along_m >= 0.0 && middle.x - along_m <= strip_->length_m &&
               std::abs(middle.y) - left_m <= 0.5 * strip_->width_m;
    };
    candidates_.clear();
    ground.triangles_in(meets_strip, candidates_);
    if (!is_front_to_back) {
        std::ranges::reverse(candidates_);
    }
    for (const std::uint32_t candidate : candidates_) {
        cutter.set_triangle(candidate);
        if (cutter.is_seen()) {
            paint_triangle(most, cutter);
        }
    }
}

/// A marking that looks narrow takes the colour of the surface, and so does not go in a step.
void RunwayPainter::choose_patches(const FrameView& view) {
    seen_.clear();
    for (const nature::RunwayRectangle& patch : patches_) {
        const glm::dvec2 middle_m = strip_->place(0.5 * glm::dvec2(patch.min_m + patch.max_m));
        const double distance_m =
            glm::distance(glm::dvec3(middle_m, strip_->plane_m(middle_m)), view.camera.eye_m);
        const glm::vec2 size_m = patch.max_m - patch.min_m;
        const double seen_px =
            static_cast<double>(std::min(size_m.x, size_m.y)) / (distance_m * view.pixel_rad);
        if (seen_px <= min_px) {
            continue;
        }
        const auto own =
            static_cast<float>(std::clamp((seen_px - min_px) / (whole_px - min_px), 0.0, 1.0));
        const glm::vec3 colour = patch.is_painted
                                     ? glm::mix(nature::runway_surface_colour, nature::runway_paint_colour, own)
                                     : nature::runway_surface_colour;
        seen_.push_back(
            {glm::dvec2(patch.min_m),
             glm::dvec2(patch.max_m),
             models::packed_colour(colour * light_) & 0x00ffffffU,
             patch.is_painted});
    }
}

/// A marking overlaps twice as far as the surface below it, which must not show along its ends.
void RunwayPainter::paint_triangle(int most, DecalClipper& cutter) const {
    std::array<glm::dvec2, 3> corners = cutter.corners_m();
    for (glm::dvec2& corner : corners) {
        corner = strip_->strip_from_world(corner + eye_m_);
    }
    const glm::dvec2 min_m = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 max_m = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const double first_m = min_m.x - static_cast<double>(nature::max_rectangle_length_m);
    const auto along_m = [](const VisiblePatch& patch) { return patch.min_m.x; };
    for (auto patch = std::ranges::lower_bound(seen_, first_m, {}, along_m);
         patch != seen_.end() && patch->min_m.x < max_m.x;
         ++patch) {
        const bool intersects = patch->max_m.x > min_m.x && patch->min_m.y < max_m.y &&
                           patch->max_m.y > min_m.y;
        if (intersects && (!patch->is_marking || cutter.triangles() < most)) {
            cutter.add_decal(
                plan_outline(*patch),
                patch->colour,
                patch->is_marking ? GroundLayer::Marking : GroundLayer::Surface,
                patch->is_marking ? 2.0 : 1.0);
        }
    }
}

DecalClipper::Patch RunwayPainter::plan_outline(const VisiblePatch& patch) const {
    DecalClipper::Patch corners = {
        patch.min_m,
        {patch.max_m.x, patch.min_m.y},
        patch.max_m,
        {patch.min_m.x, patch.max_m.y}};
    for (glm::dvec2& corner : corners) {
        corner = strip_->place(corner) - eye_m_;
    }
    return corners;
}

} // namespace octant::visuals::planning
