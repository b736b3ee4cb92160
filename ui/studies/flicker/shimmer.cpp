// What is left of flicker: pictures of a flight compared after the motion is taken out.
#include "ui/studies/flicker/shimmer.h"

#include "ui/terrain/ground_view.h"
#include "visuals/terrain/curvature_drop.h"
#include "visuals/terrain/ground_query.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <optional>

namespace octant::ui::studies::flicker {

namespace terrain = visuals::terrain;

namespace {

constexpr int pixel_step = 4;
constexpr double reach_m = 100000.0;

/// Two hits this near to each other, with distance, are the same ground.
double same_ground_tolerance_m(double distance_m) {
    return 0.5 + 0.002 * distance_m;
}

glm::dvec3 lowered(glm::dvec3 place_m, const glm::dvec3& eye_m, double radius_m) {
    const glm::dvec2 level_m = glm::dvec2(place_m) - glm::dvec2(eye_m);
    place_m.z -= terrain::curvature_drop_m(glm::dot(level_m, level_m), radius_m);
    return place_m;
}

/// Whether a pixel, from the middle, lies near the aircraft's.
bool near_aircraft(
    const flight::FlightCamera& frame, const terrain::PerspectiveView& view, const glm::dvec2& pixel) {
    const glm::dvec3 seen = view.seen_m(frame.aircraft_m - view.eye_m);
    if (seen.z <= frame.aircraft_radius_m) {
        return seen.z > -frame.aircraft_radius_m;
    }
    const double radius_px = 1.5 * view.focal_px * frame.aircraft_radius_m / seen.z;
    return glm::distance(view.pixel(seen), pixel) < radius_px;
}

/// Where the frame shows a place of the ground, from the middle of the picture.
std::optional<glm::dvec2> pixel_of(
    const terrain::GroundSamples& ground,
    const terrain::PerspectiveView& view,
    const glm::dvec3& place_m,
    double radius_m) {
    const glm::dvec3 from_eye_m = lowered(place_m, view.eye_m, radius_m) - view.eye_m;
    const glm::dvec3 seen = view.seen_m(from_eye_m);
    if (!view.shows(seen)) {
        return std::nullopt;
    }
    const auto hit_m =
        terrain::intersect_ground(ground, view.eye_m, glm::normalize(from_eye_m), reach_m, radius_m);
    if (!hit_m || glm::distance(*hit_m, place_m) > same_ground_tolerance_m(glm::length(from_eye_m))) {
        return std::nullopt;
    }
    return view.pixel(seen);
}

double luminance(const visuals::scene::Picture& picture, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
             static_cast<std::size_t>(x));
    return 0.2126 * picture.rgba[at] + 0.7152 * picture.rgba[at + 1] +
           0.0722 * picture.rgba[at + 2];
}

double luminance_between(const visuals::scene::Picture& picture, const glm::dvec2& at) {
    const int x = static_cast<int>(at.x);
    const int y = static_cast<int>(at.y);
    const double east = at.x - x;
    const double south = at.y - y;
    return (1.0 - south) *
               ((1.0 - east) * luminance(picture, x, y) + east * luminance(picture, x + 1, y)) +
           south * ((1.0 - east) * luminance(picture, x, y + 1) +
                    east * luminance(picture, x + 1, y + 1));
}

} // namespace

std::vector<ReprojectedPixel> reprojected_pixels(
    const terrain::GroundSamples& ground,
    const flight::FlightCamera& earlier,
    const flight::FlightCamera& later,
    const glm::ivec2& size_px,
    double radius_m) {
    const terrain::PerspectiveView before = ui::terrain::picture_view(earlier.camera, size_px);
    const terrain::PerspectiveView now = ui::terrain::picture_view(later.camera, size_px);
    const glm::dvec2 corner(-now.half_width_px + 0.5, now.half_height_px - 0.5);
    std::vector<ReprojectedPixel> matches;
    for (int y = 0; y < size_px.y; y += pixel_step) {
        for (int x = 0; x < size_px.x; x += pixel_step) {
            const glm::dvec2 pixel = corner + glm::dvec2(x, -y);
            if (near_aircraft(later, now, pixel)) {
                continue;
            }
            const glm::dvec3 ray =
                glm::normalize(now.ahead + (now.right * pixel.x + now.up * pixel.y) / now.focal_px);
            const auto hit_m = terrain::intersect_ground(ground, now.eye_m, ray, reach_m, radius_m);
            const auto was =
                hit_m ? pixel_of(ground, before, *hit_m, radius_m) : std::optional<glm::dvec2>();
            if (!was || near_aircraft(earlier, before, *was)) {
                continue;
            }
            const glm::dvec2 at(was->x - corner.x, corner.y - was->y);
            if (at.x >= 0.0 && at.y >= 0.0 && at.x < size_px.x - 1 && at.y < size_px.y - 1) {
                matches.push_back({{x, y}, at});
            }
        }
    }
    return matches;
}

double mean_change(
    const visuals::scene::Picture& earlier,
    const visuals::scene::Picture& later,
    const std::vector<ReprojectedPixel>& matches) {
    double sum = 0.0;
    for (const ReprojectedPixel& place : matches) {
        sum += std::abs(
            luminance(later, place.pixel.x, place.pixel.y) -
            luminance_between(earlier, place.before));
    }
    return matches.empty() ? 0.0 : sum / static_cast<double>(matches.size());
}

} // namespace octant::ui::studies::flicker
