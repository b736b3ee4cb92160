#include "visuals/planning/planner.h"

#include "models/colour_vertex.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/planning/ground_frame.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/scene/settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

namespace octant::visuals::planning {

namespace {

constexpr double min_area_m2 = 1e-5;
/// A little more than two rounding steps of renderers (1/256 pixel), by which two sides may be rounded apart.
constexpr double overlap_px = 0.01;
constexpr double max_overlap = 0.05; ///< of the distance from the eye

double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a corner of an edge moves across it in a plane, along a vector of length 1 on the map, so that the eye sees
/// it move by an angle. `across` is in the plane, `sideways` a unit vector across the plane through the eye and the
/// edge.
double moved_m(const glm::dvec3& corner_m, const glm::dvec3& across, const glm::dvec3& sideways, double angle_rad) {
    const double seen = std::abs(glm::dot(across, sideways));
    return glm::length(corner_m) * std::min(angle_rad / std::max(seen, 1e-9), max_overlap);
}

} // namespace

void DecalClipper::begin(const scene::TriangleDraw& triangles, const FrameView& view) {
    triangles_ = triangles;
    view_ = &view;
    overlap_rad_ = overlap_px * view.pixel_rad;
    decals_.clear();
    corners_m_.clear();
    triangle_count_ = 0;
}

void DecalClipper::set_triangle(std::uint32_t triangle) {
    number_ = triangle;
    has_sides_ = false;
    place_triangle(triangles_, triangle, triangle_);
    for (std::size_t i = 0; i < 3; ++i) { corners_on_plan_m_[i] = glm::dvec2(triangle_[i].at_m); }
}

bool DecalClipper::is_seen() const {
    const glm::dvec3& a = triangle_[0].at_m;
    const glm::dvec3 up = glm::cross(triangle_[1].at_m - a, triangle_[2].at_m - a);
    return up.z > 0.0 && glm::dot(up, a) < 0.0 && may_be_in_view();
}

/// False only for a triangle of which nothing is in view, nor of what is painted a little beyond its sides.
bool DecalClipper::may_be_in_view() const {
    return std::ranges::all_of(view_->frustum, [&](const glm::dvec3& inwards) {
        return std::ranges::any_of(triangle_, [&](const ViewVertex& corner) {
            const double inside_m = glm::dot(inwards, corner.at_m);
            return inside_m >= 0.0 || inside_m >= -view_->pixel_rad * glm::length(corner.at_m);
        });
    });
}

glm::vec3 DecalClipper::colour() const {
    const std::uint32_t* const corner = &triangles_.indices[std::size_t{3} * number_];
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t packed = triangles_.vertices[corner[i]].colour;
        sum += glm::vec3(packed & 0xffU, packed >> 8U & 0xffU, packed >> 16U & 0xffU);
    }
    return sum / (3.0F * 255.0F);
}

bool DecalClipper::is_scenery() const {
    const std::uint32_t* const corner = &triangles_.indices[std::size_t{3} * number_];
    return std::all_of(
        corner, corner + 3, [&](std::uint32_t vertex) { return triangles_.vertices[vertex].colour >> 24U == 0; });
}

/// The plane and the sides of the triangle at hand, and how far each end moves outwards to overlap: on most triangles
/// nothing is laid.
void DecalClipper::place_sides() {
    has_sides_ = true;
    plane_ = plane_of(triangle_);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& from_m = triangle_[i].at_m;
        const glm::dvec3& to_m = triangle_[(i + 1) % 3].at_m;
        const glm::dvec2 edge = glm::normalize(glm::dvec2(to_m - from_m));
        const glm::dvec2 out(edge.y, -edge.x);
        const glm::dvec3 across(out, -glm::dot(glm::dvec2(plane_.normal), out) / plane_.normal.z);
        const glm::dvec3 upright = glm::cross(from_m, to_m);
        const glm::dvec3 sideways = upright / std::max(glm::length(upright), 1e-9);
        sides_[i] = {glm::dvec2(from_m), glm::dvec2(to_m), out, moved_m(from_m, across, sideways, overlap_rad_),
            moved_m(to_m, across, sideways, overlap_rad_)};
    }
}

/// Cuts off what lies to the right of a line.
void DecalClipper::cut(ClippedPatch& piece, const glm::dvec2& from, const glm::dvec2& to) {
    ClippedPatch kept;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2& a = piece.corners[i];
        const glm::dvec2& b = piece.corners[i + 1 < piece.count ? i + 1 : 0];
        const double a_side = area2(from, to, a);
        const double b_side = area2(from, to, b);
        if (a_side >= 0.0) { kept.corners[kept.count++] = a; }
        if ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0)) {
            kept.corners[kept.count++] = glm::mix(a, b, a_side / (a_side - b_side));
        }
    }
    piece = kept;
}

/// Which sides of the triangle at hand cut a patch; nothing where it lies beyond one of them.
std::optional<DecalClipper::SideFlags> DecalClipper::sides_across(const ClippedPatch& patch) const {
    SideFlags across{};
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        std::size_t inside = 0;
        for (std::size_t i = 0; i < patch.count; ++i) {
            const bool is_in = area2(sides_[side].from_m, sides_[side].to_m, patch.corners[i]) >= 0.0;
            inside += is_in ? 1U : 0U;
        }
        if (inside == 0) { return std::nullopt; }
        across[side] = inside < patch.count;
    }
    return across;
}

/// A patch cut to some sides of the triangle at hand, which move out by so many overlaps.
DecalClipper::ClippedPatch DecalClipper::piece_of(
    const ClippedPatch& patch, const SideFlags& across, double overlaps) const {
    ClippedPatch piece = patch;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (across[i]) {
            const Side& side = sides_[i];
            cut(piece, side.from_m + side.out * (side.from_moved_m * overlaps),
                side.to_m + side.out * (side.to_moved_m * overlaps));
        }
    }
    return piece;
}

void DecalClipper::add_decal(const Patch& patch, std::uint32_t colour, GroundLayer layer, double overlaps) {
    const auto area_m2 = [](const ClippedPatch& piece) {
        double sum_m2 = 0.0;
        for (std::size_t i = 2; i < piece.count; ++i) {
            sum_m2 += 0.5 * area2(piece.corners[0], piece.corners[i - 1], piece.corners[i]);
        }
        return sum_m2;
    };
    if (!has_sides_) { place_sides(); }
    ClippedPatch all{{}, patch.size()};
    std::ranges::copy(patch, all.corners.begin());
    const std::optional<SideFlags> across = sides_across(all);
    if (!across || area_m2(piece_of(all, *across, 0.0)) <= min_area_m2) { return; }
    const ClippedPatch piece = piece_of(all, *across, overlaps);
    decals_.push_back({number_, static_cast<std::uint32_t>(corners_m_.size()), static_cast<std::uint32_t>(piece.count),
        colour, layer});
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2& at_m = piece.corners[i];
        const double up_m = -(glm::dot(glm::dvec2(plane_.normal), at_m) + plane_.offset_m) / plane_.normal.z;
        corners_m_.emplace_back(at_m, up_m);
    }
    triangle_count_ += static_cast<int>(piece.count) - 2;
}

namespace {

constexpr double whole_px = 0.6; ///< what looks as wide has its own colour ...
constexpr double min_px = 0.3;   ///< ... and what looks narrower is not painted
constexpr int default_triangles = 1600;
constexpr double max_share = 0.2; ///< of the triangles that are aimed at
constexpr double near_m = 700.0;  ///< up to here all that is usual is kept for it

} // namespace

RunwayPainter::RunwayPainter(std::shared_ptr<const models::heights::RunwayStrip> strip) : strip_(std::move(strip)) {
    if (strip_) {
        patches_ = nature::runway_rectangles(strip_->length_m, strip_->width_m, strip_->heading_rad);
        std::ranges::stable_sort(patches_, {}, [](const nature::RunwayRectangle& patch) { return patch.min_m.x; });
    }
}

void RunwayPainter::set_daylight(const nature::Daylight& day) {
    light_ = day.ambient() + day.sunlight() * std::max(static_cast<float>(day.to_sun().z), 0.0F);
}

int RunwayPainter::max_triangles(const glm::dvec3& eye_m, int triangle_target) const {
    if (!strip_ || triangle_target >= scene::unlimited_triangles) { return strip_ ? scene::unlimited_triangles : 0; }
    const glm::dvec2 position_m(eye_m);
    const double distance_m = std::hypot(strip_->distance_m(position_m), eye_m.z - strip_->plane_m(position_m));
    const double most = std::min<double>(default_triangles, max_share * triangle_target);
    return static_cast<int>(most * std::clamp(near_m / std::max(distance_m, 1.0), 0.1, 1.0));
}

void RunwayPainter::paint(const landscape::GroundMesher& ground, const FrameView& view, bool is_front_to_back, int most,
    DecalClipper& cutter) {
    if (!strip_) { return; }
    eye_m_ = glm::dvec2(view.camera.eye_m);
    choose_patches(view);
    if (seen_.empty()) { return; }
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
    if (!is_front_to_back) { std::ranges::reverse(candidates_); }
    for (const std::uint32_t candidate : candidates_) {
        cutter.set_triangle(candidate);
        if (cutter.is_seen()) { paint_triangle(most, cutter); }
    }
}

/// A marking that looks narrow takes the colour of the surface, and so does not go in a step.
void RunwayPainter::choose_patches(const FrameView& view) {
    seen_.clear();
    for (const nature::RunwayRectangle& patch : patches_) {
        const glm::dvec2 middle_m = strip_->place(0.5 * glm::dvec2(patch.min_m + patch.max_m));
        const double distance_m = glm::distance(glm::dvec3(middle_m, strip_->plane_m(middle_m)), view.camera.eye_m);
        const glm::vec2 size_m = patch.max_m - patch.min_m;
        const double seen_px = static_cast<double>(std::min(size_m.x, size_m.y)) / (distance_m * view.pixel_rad);
        if (seen_px <= min_px) { continue; }
        const auto own = static_cast<float>(std::clamp((seen_px - min_px) / (whole_px - min_px), 0.0, 1.0));
        const glm::vec3 colour = patch.is_painted
                                     ? glm::mix(nature::runway_surface_colour, nature::runway_paint_colour, own)
                                     : nature::runway_surface_colour;
        seen_.push_back({glm::dvec2(patch.min_m), glm::dvec2(patch.max_m),
            models::packed_colour(colour * light_) & 0x00ffffffU, patch.is_painted});
    }
}

/// A marking overlaps twice as far as the surface below it, which must not show along its ends.
void RunwayPainter::paint_triangle(int most, DecalClipper& cutter) const {
    std::array<glm::dvec2, 3> corners = cutter.corners_m();
    for (glm::dvec2& corner : corners) { corner = strip_->strip_from_world(corner + eye_m_); }
    const glm::dvec2 min_m = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 max_m = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const double first_m = min_m.x - static_cast<double>(nature::max_rectangle_length_m);
    const auto along_m = [](const VisiblePatch& patch) { return patch.min_m.x; };
    for (auto patch = std::ranges::lower_bound(seen_, first_m, {}, along_m);
         patch != seen_.end() && patch->min_m.x < max_m.x; ++patch) {
        const bool intersects = patch->max_m.x > min_m.x && patch->min_m.y < max_m.y && patch->max_m.y > min_m.y;
        if (intersects && (!patch->is_marking || cutter.triangles() < most)) {
            cutter.add_decal(plan_outline(*patch), patch->colour,
                patch->is_marking ? GroundLayer::Marking : GroundLayer::Surface, patch->is_marking ? 2.0 : 1.0);
        }
    }
}

DecalClipper::Patch RunwayPainter::plan_outline(const VisiblePatch& patch) const {
    DecalClipper::Patch corners = {
        patch.min_m, {patch.max_m.x, patch.min_m.y}, patch.max_m, {patch.min_m.x, patch.max_m.y}};
    for (glm::dvec2& corner : corners) { corner = strip_->place(corner) - eye_m_; }
    return corners;
}

namespace {

constexpr glm::vec3 asphalt(0.44F, 0.43F, 0.41F); ///< display values under a light of 1
constexpr double road_px = 1.2;                   ///< what looks as wide has its own colour ...
constexpr double min_road_px = 0.6;               ///< ... and what looks narrower is not painted
constexpr double level_error_px = 0.25;
constexpr double farthest_road_m = 40000.0; ///< roads beyond it are never painted
constexpr int max_road_triangles = 1200;
constexpr double max_road_share = 0.06; ///< of the triangles that are aimed at
constexpr std::span<const roads::RoadSection> no_pieces;

/// A unit vector upwards from the ground.
glm::vec3 normal_of(const landscape::Ground& ground, const glm::dvec2& at_m) {
    const double step_m = ground.spacing_m();
    const double own_m = ground.height_at(at_m.x, at_m.y).value_or(0.0);
    const auto height_m = [&](double x_m, double y_m) { return ground.height_at(x_m, y_m).value_or(own_m); };
    return glm::vec3(glm::normalize(glm::dvec3(height_m(at_m.x - step_m, at_m.y) - height_m(at_m.x + step_m, at_m.y),
        height_m(at_m.x, at_m.y - step_m) - height_m(at_m.x, at_m.y + step_m), 2.0 * step_m)));
}

glm::vec3 light_at(const landscape::Ground& ground, const nature::Daylight& day, const glm::dvec2& at_m) {
    const nature::LightVisibility left = ground.light_visibility(at_m.x, at_m.y);
    const float towards = std::max(glm::dot(normal_of(ground, at_m), glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() * left.sky + day.sunlight() * (towards * left.sun);
}

/// The stretch of a road from one point to the next, on the plan around the eye.
DecalClipper::Patch patch_of(const roads::RoadPoint& from, const roads::RoadPoint& to, const glm::dvec2& eye_m) {
    const glm::dvec2 from_m = from.at_m - eye_m;
    const glm::dvec2 to_m = to.at_m - eye_m;
    return {
        from_m - from.to_left_edge_m, to_m - to.to_left_edge_m, to_m + to.to_left_edge_m, from_m + from.to_left_edge_m};
}

/// From farther off a road looks too narrow.
double max_distance_of(const FrameView& view) {
    return std::min(2.0 * roads::half_width_m / (min_road_px * view.pixel_rad), farthest_road_m);
}

/// The coarsest level that looks right from so far.
std::size_t level_from(double distance_m, double pixel_rad) {
    const double allowed_m = level_error_px * distance_m * pixel_rad;
    std::size_t level = 0;
    while (level + 1 < roads::level_error_m.size() && roads::level_error_m[level + 1] <= allowed_m) { ++level; }
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
    if (!network_ || over_m >= reach_m || !network_->may_intersect(at_m - reach_m, at_m + reach_m)) { return 0; }
    if (triangle_target >= scene::unlimited_triangles) { return scene::unlimited_triangles; }
    const double most = std::min<double>(max_road_triangles, max_road_share * triangle_target);
    return static_cast<int>(most * std::min(2.0 - 2.0 * over_m / reach_m, 1.0));
}

void RoadPainter::paint(const landscape::GroundMesher& ground, const FrameView& view, bool is_front_to_back, int most,
    DecalClipper& cutter) {
    if (most <= 0) { return; }
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
            return first_m.x <= last_m.x && first_m.y <= last_m.y && network_->may_intersect(first_m, last_m);
        },
        candidates_);
    if (!is_front_to_back) { std::ranges::reverse(candidates_); }
    const int limit = cutter.triangles() + most - DecalClipper::max_triangles;
    for (const std::uint32_t candidate : candidates_) {
        if (cutter.triangles() > limit) { break; }
        cutter.set_triangle(candidate);
        paint_triangle(view, limit, cutter);
    }
}

void RoadPainter::paint_triangle(const FrameView& view, int limit, DecalClipper& cutter) {
    const auto& [a, b, c] = cutter.corners_m();
    const glm::dvec2 min_m = glm::min(glm::min(a, b), c);
    const glm::dvec2 max_m = glm::max(glm::max(a, b), c);
    const glm::dvec2 eye_m(view.camera.eye_m);
    if (!network_->may_intersect(min_m + eye_m, max_m + eye_m) || !cutter.is_seen() || cutter.is_scenery()) { return; }
    numbers_.clear();
    network_->sections_in_box(min_m + eye_m, max_m + eye_m, numbers_);
    std::ranges::sort(numbers_);
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    const glm::vec3 ground = cutter.colour();
    for (const std::uint32_t number : numbers_) {
        if (chosen_[number].frame != frame_) { choose(number, view); }
        for (std::size_t i = chosen_[number].first; i < chosen_[number].end; ++i) {
            const VisiblePatch& stretch = seen_[i];
            if (stretch.min_m.x < max_m.x && stretch.max_m.x > min_m.x && stretch.min_m.y < max_m.y &&
                stretch.max_m.y > min_m.y && cutter.triangles() <= limit) {
                const glm::vec3 colour = glm::mix(ground, stretch.colour, stretch.own);
                cutter.add_decal(stretch.patch, models::packed_colour(colour) & 0x00ffffffU, GroundLayer::Surface, 1.0);
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
    const double nearest_m = std::max(glm::distance(piece.middle_m, view.camera.eye_m) - piece.radius_m, 1.0);
    const std::size_t level = level_from(nearest_m, view.pixel_rad);
    const std::vector<roads::RoadPoint>& points = network_->sections()[number].levels[level];
    if (!piece.is_lit[level]) { light(number, level); }
    SectionPatches& chosen = chosen_[number];
    chosen = {frame_, seen_.size(), seen_.size()};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 at_m = 0.5 * (points[i - 1].at_m + points[i].at_m);
        const double distance_m = glm::distance(glm::dvec3(at_m, piece.middle_m.z), view.camera.eye_m);
        const double seen_px = 2.0 * roads::half_width_m / (distance_m * view.pixel_rad);
        if (seen_px <= min_road_px) { continue; }
        const auto own = static_cast<float>(std::clamp((seen_px - min_road_px) / (road_px - min_road_px), 0.0, 1.0));
        const DecalClipper::Patch patch = patch_of(points[i - 1], points[i], glm::dvec2(view.camera.eye_m));
        seen_.push_back({patch, glm::min(glm::min(patch[0], patch[1]), glm::min(patch[2], patch[3])),
            glm::max(glm::max(patch[0], patch[1]), glm::max(patch[2], patch[3])),
            asphalt * lights_[piece.first_light[level] + i - 1], own});
    }
    chosen.end = seen_.size();
}

namespace {

/// Where the fine pattern lies on the ground of a frame.
scene::DetailTexture ground_detail_texture(
    std::shared_ptr<const scene::LandCoverContrast> contrast, const glm::dvec3& eye_m);

scene::DetailTexture ground_detail_texture(
    std::shared_ptr<const scene::LandCoverContrast> contrast, const glm::dvec3& eye_m) {
    scene::DetailTexture detail_texture;
    for (int scale = 0; scale < scene::DetailPattern::scales; ++scale) {
        const glm::dvec2 tiles = scene::detail_tile_position(eye_m, scale);
        const auto at = static_cast<std::size_t>(scale);
        detail_texture.at_eye[at] = glm::vec2(tiles - glm::floor(tiles));
        detail_texture.eye_height_tiles[at] = static_cast<float>(glm::fract(eye_m.z / scene::detail_tile_m(scale)));
    }
    detail_texture.contrast = std::move(contrast);
    return detail_texture;
}

} // namespace

scene::OverlayDraw FrameOverlay::draw(const scene::OverlayDraw& transparents, const scene::Camera& camera,
    std::span<const sim::AircraftState> states, bool marks_path, std::span<const std::string> overlay_lines) {
    const glm::ivec2& size_px = settings_.view.size_px;
    layers_.clear();
    layers_.add(transparents);
    if (marks_path) { layers_.add(path_marks(camera, states.front().position_m)); }
    if (settings_.view.kind == scene::View::Cockpit) {
        const overlay::InstrumentReadings inputs = shown_inputs(states.front());
        layers_.add(instruments_.draw(scene_.dials, inputs, camera, size_px));
        if (settings_.view.head_up_display) { layers_.add(head_up_display_.draw(inputs, camera, size_px)); }
    }
    if (!overlay_lines.empty()) { layers_.add(text_.draw(overlay_lines, size_px)); }
    return layers_.all();
}

/// The names of the legs of the first aircraft's path, where the legs begin.
scene::OverlayDraw FrameOverlay::path_marks(const scene::Camera& camera, const glm::dvec3& aircraft_m) {
    marks_.begin(camera, settings_.view.size_px, aircraft_m - camera.eye_m);
    for (const DrawnPath::Leg& leg : scene_.path->legs) {
        marks_.add({scene_.path->points[leg.first_point].position_m - camera.eye_m, leg.name});
    }
    return marks_.finish();
}

overlay::InstrumentReadings FrameOverlay::shown_inputs(const sim::AircraftState& state) const {
    overlay::InstrumentReadings inputs{state, state.position_m.z, {}};
    if (const auto ground_m = scene_.ground->height_at(state.position_m.x, state.position_m.y)) {
        inputs.height_above_ground_m = state.position_m.z - *ground_m;
    }
    return inputs;
}

namespace {

/// At the ground's mean height. Without a sky the haze is the background all around.
scene::Haze haze_of(const scene::AirSettings& air, const nature::Daylight& day) {
    scene::Haze haze{air.background, static_cast<float>(air.visibility_m)};
    haze.falloff_per_m = air.haze_height_m > 0.0 ? static_cast<float>(1.0 / air.haze_height_m) : 0.0F;
    if (air.sky) {
        haze.colour = day.haze_away();
        haze.horizontal_to_sun = glm::vec2(day.horizontal_to_sun());
        haze.sunward_colour = day.haze_sunward();
    }
    return haze;
}

Sky sky_of(const Scene& scene, const scene::AirSettings& air, const nature::Daylight& day) {
    return Sky(day, air.sky ? scene.ground->backdrop() : nature::Backdrop());
}

double distance_to_edge_m(const landscape::Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

} // namespace

Atmosphere::Atmosphere(const Scene& scene, const scene::AirSettings& settings)
    : scene_(scene), settings_(settings), daylight_(landscape::daylight_of(settings)),
      to_sun_(landscape::direction_to_sun(settings)), haze_(haze_of(settings, daylight_)),
      sky_(sky_of(scene, settings, daylight_)) {}

void Atmosphere::set_sun() {
    daylight_ = landscape::daylight_of(settings_);
    to_sun_ = landscape::direction_to_sun(settings_);
    haze_ = haze_of(settings_, daylight_);
    sky_ = sky_of(scene_, settings_, daylight_);
}

/// How far one sees at a height: the air is as thick as the settings say at the ground's mean one.
float Atmosphere::visibility_m(double eye_height_m) const {
    const double mean_m = scene_.ground->mean_height_m();
    double thinner = 1.0;
    if (settings_.haze_height_m > 0.0) {
        const double above_m = eye_height_m - (std::isfinite(mean_m) ? mean_m : 0.0);
        thinner = std::exp(std::clamp(above_m / settings_.haze_height_m, -3.0, 30.0));
    }
    return static_cast<float>(settings_.visibility_m * thinner);
}

void Atmosphere::write(const FrameView& view, scene::FramePlan& plan) {
    const glm::dvec3& eye_m = view.camera.eye_m;
    const landscape::Ground& ground = *scene_.ground;
    plan.to_sun = glm::vec3(to_sun_);
    plan.ambient = daylight_.ambient();
    plan.sunlight = daylight_.sunlight();
    plan.haze = haze_;
    plan.haze.visibility_m = visibility_m(eye_m.z);
    if (settings_.sky) {
        plan.sky = sky_.around({eye_m.z - ground.mean_height_m(), distance_to_edge_m(ground, eye_m),
                                   ground.mean_colour(), view.earth_radius_m},
            plan.haze, eye_m);
    }
}

namespace {

/// Whether the ground of a scene has the fine pattern.
bool has_detail_texture(const Scene& scene, const scene::GroundSettings& settings) {
    return settings.near_detail && !scene.ground_texture && scene.ground->land_cover_contrast();
}

} // namespace

Planner::Planner(const Scene& scene, const scene::Settings& settings, std::unique_ptr<landscape::GroundMesher> mesher)
    : scene_(scene), settings_(settings),
      mesher_(mesher ? std::move(mesher)
                     : scene.ground->mesher(landscape::mesh_settings(settings, scene.ground_texture != nullptr))),
      atmosphere_(scene, settings.air), fleet_(scene, settings),
      smooth_(settings.shading, settings.adapt.shading, fleet_.placed()), runway_(scene.ground->runway()),
      shadows_(atmosphere_.to_sun()), transparents_(scene, settings, atmosphere_.daylight()), overlay_(scene, settings),
      painter_(plan_) {
    runway_.set_daylight(atmosphere_.daylight());
    update_roads();
    plan_.background = settings.air.background;
    plan_.mesh_display = settings.ground.show_mesh;
    plan_.sample_spacing_m = std::max(static_cast<float>(scene.ground->spacing_m()), 1e-3F);
    plan_.lights_pixels = settings.shading.kind == scene::AircraftShading::Phong;
}

FrameView Planner::view_of(const scene::Camera& camera) const {
    return frame_view(camera, settings_.view.size_px, mesher_->earth_radius_m());
}

/// There are none where a texture has colours of its own.
void Planner::update_roads() {
    if (settings_.ground.roads && !scene_.ground_texture) { roads_.follow(*scene_.ground, atmosphere_.daylight()); }
}

landscape::MeshRequest Planner::ground_request(const scene::Camera& camera, std::optional<int> triangle_target) const {
    const int asked = requested_triangles(triangle_target);
    const FrameView view = view_of(camera);
    const int kept = runway_.max_triangles(camera.eye_m, asked) + roads_.max_triangles(view, asked);
    return {camera, view.aspect, asked >= scene::unlimited_triangles ? asked : std::max(asked - kept, 1)};
}

int Planner::requested_triangles(std::optional<int> triangle_target) const {
    return triangle_target.value_or(scene::triangle_target(settings_));
}

void Planner::reset_detail(const scene::Camera& camera) { mesher_->reset_detail(ground_request(camera, std::nullopt)); }

void Planner::begin_next_mesh(
    const scene::Camera& camera, std::optional<int> triangle_target, const IdleThreadRunner& on_idle_thread) {
    mesher_->begin_next_mesh(ground_request(camera, triangle_target), on_idle_thread);
}

bool Planner::set_sun() {
    const landscape::GroundMesher* const before = mesher_.get();
    mesher_ = landscape::reuse_or_make_mesher(
        std::move(mesher_), *scene_.ground, landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    atmosphere_.set_sun();
    shadows_ = ShadowCaster(atmosphere_.to_sun());
    runway_.set_daylight(atmosphere_.daylight());
    update_roads();
    transparents_.set_daylight(atmosphere_.daylight());
    return mesher_.get() == before;
}

PlannedFrame Planner::plan(const PlanRequest& request) {
    const FrameView view = view_of(request.camera);
    PlanCounts counts;
    place_aircraft(request, view);
    begin_plan(view);
    GroundFrame ground{
        mesher_->triangles(ground_request(request.camera, request.triangle_target), counts.ground), {}, {}};
    shadows_.begin(ground.all, plan_.ground_texture.has_value(), plan_.shadow_vertices);
    paint_ground(request, view, ground, counts);
    cast_shadows(view, ground);
    atmosphere_.write(view, plan_);
    transparents_.make(view, {request.states, request.articulated_parts}, fleet_, plan_);
    plan_.overlay = overlay_.draw(
        transparents_.draw(), request.camera, request.states, transparents_.has_ribbon(), request.overlay_lines);
    count(choose_smooth(request.smooth), counts);
    counts.shadow_triangles = static_cast<int>(ground.shadow_indices.size() / 3) - counts.painted_triangles;
    painter_.paint({view, fleet_, smooth_, transparents_, ground, *mesher_}, settings_.surface.hidden_surface, counts);
    return {plan_, counts};
}

void Planner::advance_without_drawing(const PlanRequest& request) {
    place_aircraft(request, view_of(request.camera));
    choose_smooth(request.smooth);
}

void Planner::place_aircraft(const PlanRequest& request, const FrameView& view) {
    fleet_.place(view, {request.states, request.articulated_parts}, transparents_.effects());
    fleet_.refine(view);
    if (request.on_refined) { request.on_refined(); }
}

SmoothChoice::Count Planner::choose_smooth(const SmoothTarget& smooth_target) {
    const nature::Daylight& day = atmosphere_.daylight();
    return smooth_.choose(fleet_.placed(), fleet_.refined(), smooth_target, atmosphere_.to_sun(),
        glm::vec2(day.ambient().x, day.sunlight().x), plan_.smooth);
}

/// Empties the lists of the plan and writes what depends on the view and the aircraft alone.
void Planner::begin_plan(const FrameView& view) {
    plan_.aircraft.clear();
    plan_.refined.clear();
    plan_.steps.clear();
    plan_.clips.clear();
    plan_.repaint_indices.clear();
    plan_.depth_boxes.clear();
    plan_.world_to_view = world_to_view(view.camera);
    plan_.view_to_clip = view_to_clip(view.camera, view.aspect);
    plan_.parts.resize(fleet_.parts().size());
    std::ranges::transform(fleet_.parts(), plan_.parts.begin(), [](const glm::dmat4& part) { return glm::mat4(part); });
    if (scene_.ground_texture) {
        plan_.ground_texture = landscape::ground_texture_transforms(*scene_.ground_texture, view.camera.eye_m);
    }
    plan_.detail_texture.reset();
    if (has_detail_texture(scene_, settings_.ground)) {
        plan_.detail_texture = ground_detail_texture(scene_.ground->land_cover_contrast(), view.camera.eye_m);
    }
}

/// Lays roads and the runway within the triangles that are kept for them, which are those of what stands on the ground.
void Planner::paint_ground(
    const PlanRequest& request, const FrameView& view, const GroundFrame& ground, PlanCounts& counts) {
    const int asked = requested_triangles(request.triangle_target);
    const bool is_front_to_back = settings_.surface.hidden_surface == scene::HiddenSurface::DepthBuffer;
    const glm::dvec3& eye_m = view.camera.eye_m;
    cutter_.begin(ground.all, view);
    runway_.paint(*mesher_, view, is_front_to_back, runway_.max_triangles(eye_m, asked), cutter_);
    roads_.paint(*mesher_, view, is_front_to_back, roads_.max_triangles(view, asked), cutter_);
    shadows_.set_decals(cutter_.decals());
    counts.painted_triangles = cutter_.triangles();
    counts.ground.triangles += counts.painted_triangles;
    counts.ground.scenery_triangles += counts.painted_triangles;
}

void Planner::cast_shadows(const FrameView& view, GroundFrame& ground) {
    if (settings_.surface.shadows) {
        const auto bounding_boxes = fleet_.bounding_boxes();
        for (std::size_t i = 0; i < bounding_boxes.size(); ++i) {
            shadows_.cast(fleet_.placed()[i], bounding_boxes[i], *mesher_, view);
        }
    }
    shadows_.sort_pieces();
    ground.shadows = shadows_.pieces();
    ground.shadow_indices = shadows_.indices();
}

void Planner::count(const SmoothChoice::Count& shaded, PlanCounts& counts) const {
    for (const PlacedAircraft& aircraft : fleet_.placed()) {
        counts.aircraft_polygons += aircraft.polygon_count;
        counts.aircraft_polygons += is_refined(aircraft) ? aircraft.model->turning.polygons : 0;
    }
    if (!fleet_.placed().empty()) {
        const PlacedAircraft& first = fleet_.placed().front();
        counts.draw_cell = first.cell;
        counts.aircraft_level = static_cast<int>(first.representation) + (is_far(first) ? 1 : 0);
    }
    counts.refine_splits = fleet_.splits();
    counts.refine_collapses = fleet_.collapses();
    counts.smoothable_polygons = shaded.polygons;
    counts.smooth_polygons = shaded.smooth;
    counts.transparent_triangles = static_cast<int>(transparents_.draw().indices.size() / 3);
}

} // namespace octant::visuals::planning
