#include "visuals/planning/road_painter.h"

#include "models/colour_vertex.h"
#include "visuals/scene/settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace octant::visuals::planning {

namespace {

constexpr glm::vec3 asphalt(0.44F, 0.43F, 0.41F); ///< display values under a light of 1
constexpr double road_px = 1.2;                   ///< what looks as wide has its own colour ...
constexpr double min_road_px = 0.6;             ///< ... and what looks narrower is not painted
constexpr double level_error_px = 0.25;
constexpr double farthest_road_m = 40000.0; ///< roads beyond it are never painted
constexpr int max_road_triangles = 1200;
constexpr double max_road_share = 0.06; ///< of the triangles that are aimed at
constexpr std::span<const roads::RoadSection> no_pieces;

/// A unit vector upwards from the ground.
glm::vec3 normal_of(const landscape::Ground& ground, const glm::dvec2& at_m) {
    const double step_m = ground.spacing_m();
    const double own_m = ground.height_at(at_m.x, at_m.y).value_or(0.0);
    const auto height_m = [&](double x_m, double y_m) {
        return ground.height_at(x_m, y_m).value_or(own_m);
    };
    return glm::vec3(glm::normalize(glm::dvec3(
        height_m(at_m.x - step_m, at_m.y) - height_m(at_m.x + step_m, at_m.y),
        height_m(at_m.x, at_m.y - step_m) - height_m(at_m.x, at_m.y + step_m),
        2.0 * step_m)));
}

glm::vec3
light_at(const landscape::Ground& ground, const nature::Daylight& day, const glm::dvec2& at_m) {
    const nature::LightVisibility left = ground.light_visibility(at_m.x, at_m.y);
    const float towards =
        std::max(glm::dot(normal_of(ground, at_m), glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() * left.sky + day.sunlight() * (towards * left.sun);
}

/// The stretch of a road from one point to the next, on the plan around the eye.
DecalClipper::Patch
patch_of(const roads::RoadPoint& from, const roads::RoadPoint& to, const glm::dvec2& eye_m) {
    const glm::dvec2 from_m = from.at_m - eye_m;
    const glm::dvec2 to_m = to.at_m - eye_m;
    return {from_m - from.to_left_edge_m, to_m - to.to_left_edge_m, to_m + to.to_left_edge_m, from_m + from.to_left_edge_m};
}

/// From farther off a road looks too narrow.
double max_distance_of(const FrameView& view) {
    return std::min(2.0 * roads::half_width_m / (min_road_px * view.pixel_rad), farthest_road_m);
}

/// The coarsest level that looks right from so far.
std::size_t level_from(double distance_m, double pixel_rad) {
    const double allowed_m = level_error_px * distance_m * pixel_rad;
    std::size_t level = 0;
    while (level + 1 < roads::level_error_m.size() &&
           roads::level_error_m[level + 1] <= allowed_m) {
        ++level;
    }
    return level;
}

} // namespace

void RoadPainter::follow(const landscape::Ground& ground, const nature::Daylight& day) {
    network_ = ground.road_network();
    ground_ = network_ ? ground.shared_from_this() : nullptr;
    day_ = day;
    pieces_.clear();
    std::size_t stretches = 0;
    lowest_m_ = std::numeric_limits<double>::infinity();
    for (const roads::RoadSection& piece : network_ ? network_->sections() : no_pieces) {
        SectionLight& own = pieces_.emplace_back();
        const glm::dvec2 middle_m = 0.5 * (piece.min_m + piece.max_m);
        own.middle_m = glm::dvec3(middle_m, ground.height_at(middle_m.x, middle_m.y).value_or(0.0));
        own.radius_m = 0.5 * glm::distance(piece.min_m, piece.max_m);
        lowest_m_ = std::min(lowest_m_, own.middle_m.z);
        for (std::size_t level = 0; level < piece.levels.size(); ++level) {
            own.first_light[level] = stretches;
            stretches += piece.levels[level].size() - 1;
        }
    }
    lights_.resize(stretches);
    chosen_.assign(pieces_.size(), {});
    frame_ = 0;
}

int RoadPainter::max_triangles(const FrameView& view, int triangle_target) const {
    const double reach_m = max_distance_of(view);
    const glm::dvec2 at_m(view.camera.eye_m);
    const double over_m = view.camera.eye_m.z - lowest_m_;
    if (!network_ || over_m >= reach_m || !network_->may_intersect(at_m - reach_m, at_m + reach_m)) {
        return 0;
    }
    if (triangle_target >= scene::unlimited_triangles) {
        return scene::unlimited_triangles;
    }
    const double most = std::min<double>(max_road_triangles, max_road_share * triangle_target);
    return static_cast<int>(most * std::min(2.0 - 2.0 * over_m / reach_m, 1.0));
}

void RoadPainter::paint(
    const landscape::GroundMesher& ground,
    const FrameView& view,
    bool is_front_to_back,
    int most,
    DecalClipper& cutter) {
    if (most <= 0) {
        return;
    }
    ++frame_;
    seen_.clear();
    const glm::dvec2 eye_m(view.camera.eye_m);
    const double reach_m = max_distance_of(view);
    const glm::dvec2 from_m = eye_m - reach_m;
    const glm::dvec2 to_m = eye_m + reach_m;
    candidates_.clear();
    ground.triangles_in(
        [&](const glm::dvec3& min_m, const glm::dvec3& max_m) {
            const glm::dvec2 first_m = glm::max(glm::dvec2(min_m), from_m);
            const glm::dvec2 last_m = glm::min(glm::dvec2(max_m), to_m);
            return first_m.x <= last_m.x && first_m.y <= last_m.y &&
                   network_->may_intersect(first_m, last_m);
        },
        candidates_);
    if (!is_front_to_back) {
        std::ranges::reverse(candidates_);
    }
    const int limit = cutter.triangles() + most - DecalClipper::max_triangles;
    for (const std::uint32_t candidate : candidates_) {
        if (cutter.triangles() > limit) {
            break;
        }
        cutter.set_triangle(candidate);
        paint_triangle(view, limit, cutter);
    }
}

void RoadPainter::paint_triangle(const FrameView& view, int limit, DecalClipper& cutter) {
    const auto& [a, b, c] = cutter.corners_m();
    const glm::dvec2 min_m = glm::min(glm::min(a, b), c);
    const glm::dvec2 max_m = glm::max(glm::max(a, b), c);
    const glm::dvec2 eye_m(view.camera.eye_m);
    if (!network_->may_intersect(min_m + eye_m, max_m + eye_m) || !cutter.is_seen() ||
        cutter.is_scenery()) {
        return;
    }
    numbers_.clear();
    network_->sections_in_box(min_m + eye_m, max_m + eye_m, numbers_);
    std::ranges::sort(numbers_);
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    const glm::vec3 ground = cutter.colour();
    for (const std::uint32_t number : numbers_) {
        if (chosen_[number].frame != frame_) {
            choose(number, view);
        }
        for (std::size_t i = chosen_[number].first; i < chosen_[number].end; ++i) {
            const VisiblePatch& stretch = seen_[i];
            if (stretch.min_m.x < max_m.x && stretch.max_m.x > min_m.x &&
                stretch.min_m.y < max_m.y && stretch.max_m.y > min_m.y &&
                cutter.triangles() <= limit) {
                const glm::vec3 colour = glm::mix(ground, stretch.colour, stretch.own);
                cutter.add_decal(
                    stretch.patch,
                    models::packed_colour(colour) & 0x00ffffffU,
                    GroundLayer::Surface,
                    1.0);
            }
        }
    }
}

void RoadPainter::light(std::uint32_t number, std::size_t level) {
    const std::vector<roads::RoadPoint>& points = network_->sections()[number].levels[level];
    for (std::size_t i = 1; i < points.size(); ++i) {
        lights_[pieces_[number].first_light[level] + i - 1] =
            light_at(*ground_, *day_, 0.5 * (points[i - 1].at_m + points[i].at_m));
    }
    pieces_[number].is_lit[level] = true;
}

/// The stretches of a piece as this frame shows them, none where they look too narrow.
void RoadPainter::choose(std::uint32_t number, const FrameView& view) {
    const SectionLight& piece = pieces_[number];
    const double nearest_m =
        std::max(glm::distance(piece.middle_m, view.camera.eye_m) - piece.radius_m, 1.0);
    const std::size_t level = level_from(nearest_m, view.pixel_rad);
    const std::vector<roads::RoadPoint>& points = network_->sections()[number].levels[level];
    if (!piece.is_lit[level]) {
        light(number, level);
    }
    SectionPatches& chosen = chosen_[number];
    chosen = {frame_, seen_.size(), seen_.size()};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 at_m = 0.5 * (points[i - 1].at_m + points[i].at_m);
        const double distance_m =
            glm::distance(glm::dvec3(at_m, piece.middle_m.z), view.camera.eye_m);
        const double seen_px = 2.0 * roads::half_width_m / (distance_m * view.pixel_rad);
        if (seen_px <= min_road_px) {
            continue;
        }
        const auto own = static_cast<float>(
            std::clamp((seen_px - min_road_px) / (road_px - min_road_px), 0.0, 1.0));
        const DecalClipper::Patch patch =
            patch_of(points[i - 1], points[i], glm::dvec2(view.camera.eye_m));
        seen_.push_back(
            {patch,
             glm::min(glm::min(patch[0], patch[1]), glm::min(patch[2], patch[3])),
             glm::max(glm::max(patch[0], patch[1]), glm::max(patch[2], patch[3])),
             asphalt * lights_[piece.first_light[level] + i - 1],
             own});
    }
    chosen.end = seen_.size();
}

} // namespace octant::visuals::planning
