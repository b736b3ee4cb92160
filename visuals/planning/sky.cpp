#include "visuals/planning/sky.h"

#include "sim/base/axes.h"
#include "sim/base/float4.h"
#include "sim/base/units.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_palette.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::planning {

namespace {

constexpr int sky_segments = 36;
/// Only the direction shows: the sky has no depth.
constexpr double dome_radius_m = 1000.0;

/// Elevations of the rings above the horizon, degrees, from the zenith down.
constexpr std::array rings_above_deg = {90.0, 75.0, 60.0, 48.0, 38.0, 30.0, 23.0, 17.0, 12.0, 8.0, 5.0, 2.5, 1.0, 0.0};
constexpr int rings_above = static_cast<int>(rings_above_deg.size());
constexpr int rings_below = 7;
/// From an eye at or below its height the plain is shown as from so far above it, so that it fades into the haze.
constexpr double raised_eye_m = 1000.0;

/// Rings around the sun: the disc's edge, then its glare.
constexpr int sun_segments = 32;
constexpr std::array glare_rings_deg = {0.2665, 0.5, 0.9, 1.5, 2.5, 4.0, 7.0, 12.0, 18.0, 24.0};

models::ColourVertex dome_vertex(const glm::dvec3& direction, const glm::vec3& colour) {
    return {glm::vec3(dome_radius_m * direction), models::packed_colour(colour) & 0x00ffffffU};
}

/// Mean density of the haze between the eye and a place `rise_m` above it, by that at the eye.
double mean_density(double rise_m, double falloff_per_m) {
    const double haze_density_exponent = rise_m * falloff_per_m;
    return std::abs(haze_density_exponent) < 1e-4 ? 1.0 : -std::expm1(-haze_density_exponent) / haze_density_exponent;
}

/// Distance at which a look down meets the plain; nothing above its horizon.
std::optional<double> infinite_plain_distance_m(double depression_rad, const SurroundingPlain& plain) {
    if (plain.height_below_eye_m <= 0.0 || depression_rad <= 0.0) { return std::nullopt; }
    if (plain.earth_radius_m <= 0.0) { return plain.height_below_eye_m / std::sin(depression_rad); }
    // The nearer root of h + d^2 / 2R = d tan(depression).
    const double slope = std::tan(depression_rad);
    const double under = slope * slope - 2.0 * plain.height_below_eye_m / plain.earth_radius_m;
    if (under < 0.0) { return std::nullopt; }
    return 2.0 * plain.height_below_eye_m / (slope + std::sqrt(under)) / std::cos(depression_rad);
}

/// The same for a plain that begins at the map's edge: over low ground of the map a look goes on to there.
std::optional<double> distance_to_plain_m(double depression_rad, const SurroundingPlain& plain) {
    const auto infinite_distance_m = infinite_plain_distance_m(depression_rad, plain);
    return infinite_distance_m ? std::optional(std::max(*infinite_distance_m, plain.map_edge_m)) : std::nullopt;
}

/// What a look down at the plain shows; `ray` is of unit length.
glm::vec3 colour_below(const glm::dvec3& ray, const SurroundingPlain& plain, const scene::Haze& haze) {
    const auto distance_m = distance_to_plain_m(std::asin(-ray.z), plain);
    constexpr double beyond_m = 1e9;
    const glm::dvec3 level(ray.x, ray.y, 0.0);
    return distance_m ? through_haze(haze, *distance_m * ray, plain.colour)
                      : through_haze({haze.colour, 1.0F, 0.0F, haze.horizontal_to_sun, haze.sunward_colour},
                            beyond_m * level, haze.colour);
}

/// Steepest look down at which the plain can show past the edge of the map, with a margin for ground that lies lower
/// than the plain.
double deepest_rad(const SurroundingPlain& plain) {
    const double height_m = std::max(plain.height_below_eye_m, 0.0) + 200.0;
    const double deepest = std::atan2(2.0 * height_m, std::max(plain.map_edge_m, 1.0));
    return std::clamp(deepest, rad_from_deg(3.0), pi / 2.0);
}

} // namespace

glm::vec3 through_haze(const scene::Haze& haze, const glm::dvec3& position_m, const glm::vec3& own) {
    if (haze.visibility_m <= 0.0F) { return own; }
    const double distance_m = std::max(glm::length(position_m), 1e-6);
    const double depth = distance_m / static_cast<double>(haze.visibility_m) *
                         mean_density(position_m.z, static_cast<double>(haze.falloff_per_m));
    const double towards =
        std::max(glm::dot(glm::dvec2(position_m), glm::dvec2(haze.horizontal_to_sun)) / distance_m, 0.0);
    const glm::vec3 air = glm::mix(haze.colour, haze.sunward_colour, static_cast<float>(towards * towards));
    return glm::mix(air, own, static_cast<float>(std::exp(-depth)));
}

Sky::Sky(const nature::Daylight& day, nature::Backdrop land)
    : first_azimuth_rad_(std::atan2(day.horizontal_to_sun().x, day.horizontal_to_sun().y)), land_(std::move(land)),
      water_(day) {
    for (int segment_index = 0; segment_index < sky_segments; ++segment_index) {
        levels_.push_back(direction_from_heading(first_azimuth_rad_ - 2.0 * pi * segment_index / sky_segments));
    }
    find_sea();
    add_dome(day);
    add_sun(day);
    sky_vertices_ = vertices_.size();
    vertices_.resize(sky_vertices_ + land_.vertices.size());
    for (const nature::Backdrop::BackdropVertex& corner : land_.vertices) {
        land_half_m_ = glm::max(land_half_m_, glm::abs(glm::dvec2(corner.at_m)));
    }
    const std::size_t innermost = land_.vertices.size() - land_.outer_vertices;
    for (const nature::Backdrop::BackdropVertex& corner : std::span(land_.vertices).subspan(innermost)) {
        map_half_m_ = glm::max(map_half_m_, glm::abs(glm::dvec2(corner.at_m)));
    }
}

/// Looks at the outermost of the land around the map.
void Sky::find_sea() {
    const std::span outermost = std::span(land_.vertices).first(land_.outer_vertices);
    for (const glm::dvec3& level : levels_) {
        const nature::Backdrop::BackdropVertex* nearest = nullptr;
        double most = 0.0;
        for (const nature::Backdrop::BackdropVertex& vertex : outermost) {
            const glm::dvec2 at_m(vertex.at_m);
            const double cosine = glm::dot(at_m, glm::dvec2(level)) / glm::length(at_m);
            if (nearest == nullptr || cosine > most) {
                nearest = &vertex;
                most = cosine;
            }
        }
        sea_.push_back(nearest != nullptr && nearest->is_water ? std::optional(nearest->colour) : std::nullopt);
    }
}

/// Triangles between two rings of vertices, counter-clockwise seen from the inside of the dome where corners go
/// clockwise seen from above.
void Sky::add_ring_triangles(std::uint32_t upper, std::uint32_t lower, int vertices) {
    for (int corner = 0; corner < vertices; ++corner) {
        const auto here = static_cast<std::uint32_t>(corner);
        const auto next = static_cast<std::uint32_t>((corner + 1) % vertices);
        indices_.insert(indices_.end(), {upper + here, lower + next, lower + here});
        indices_.insert(indices_.end(), {upper + here, upper + next, lower + next});
    }
}

/// The rings below the horizon are left to around().
void Sky::add_dome(const nature::Daylight& day) {
    for (const double elevation_deg : rings_above_deg) {
        const double elevation_rad = rad_from_deg(elevation_deg);
        for (const glm::dvec3& level : levels_) {
            const double share = elevation_deg < 90.0 ? std::cos(elevation_rad) : 0.0;
            const glm::dvec3 direction(share * level.x, share * level.y, std::sin(elevation_rad));
            vertices_.push_back(dome_vertex(direction, day.sky(direction)));
        }
    }
    vertices_.resize(vertices_.size() + std::size_t{rings_below} * sky_segments);
    for (int ring = 0; ring + 1 < rings_above + rings_below; ++ring) {
        const auto upper = static_cast<std::uint32_t>(ring * sky_segments);
        add_ring_triangles(upper, upper + sky_segments, sky_segments);
    }
}

/// Over the dome: glare from outside in, then the disc. What would lie below the horizon is moved up to it.
void Sky::add_sun(const nature::Daylight& day) {
    const glm::dvec3& to_sun = day.to_sun();
    const glm::dvec3 right(-to_sun.y, to_sun.x, 0.0);
    const glm::dvec3 across = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 up = glm::cross(to_sun, across);
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    const auto add = [&](double from_sun_rad, int segment_index, bool of_disc) {
        const double turn = -2.0 * pi * segment_index / sun_segments;
        glm::dvec3 direction =
            std::cos(from_sun_rad) * to_sun + std::sin(from_sun_rad) * (std::cos(turn) * across + std::sin(turn) * up);
        if (direction.z < 0.0) { direction = glm::normalize(glm::dvec3(direction.x, direction.y, 0.0)); }
        const double angle_rad = std::acos(std::clamp(glm::dot(direction, to_sun), -1.0, 1.0));
        vertices_.push_back(dome_vertex(
            direction, of_disc ? glm::max(day.disc(), glm::min(day.sky(direction) + day.glare(0.0), glm::vec3(1.0F)))
                               : day.sky(direction) + day.glare(angle_rad)));
    };
    for (auto ring = glare_rings_deg.rbegin(); ring != glare_rings_deg.rend(); ++ring) {
        for (int segment_index = 0; segment_index < sun_segments; ++segment_index) {
            add(rad_from_deg(*ring), segment_index, false);
        }
    }
    const auto disc = static_cast<std::uint32_t>(vertices_.size());
    for (int segment_index = 0; segment_index < sun_segments; ++segment_index) {
        add(nature::Daylight::disc_rad, segment_index, true);
    }
    for (std::uint32_t ring = first; ring + sun_segments < disc; ring += sun_segments) {
        add_ring_triangles(ring, ring + sun_segments, sun_segments);
    }
    for (std::uint32_t segment_index = 2; segment_index < sun_segments; ++segment_index) {
        indices_.insert(indices_.end(), {disc, disc + segment_index - 1, disc + segment_index});
    }
}

/// Fills in the directions of the rings below the horizon.
void Sky::place_plain(const SurroundingPlain& plain) {
    const double deepest = deepest_rad(plain);
    plain_rays_.clear();
    for (int ring = 1; ring <= rings_below; ++ring) {
        // The rings crowd towards the horizon, where the plain's colour changes fastest.
        const double share = ring / static_cast<double>(rings_below);
        const double elevation_rad = -deepest * share * share;
        const double across = std::cos(elevation_rad);
        const double up = std::sin(elevation_rad);
        for (const glm::dvec3& level : levels_) { plain_rays_.emplace_back(across * level.x, across * level.y, up); }
    }
}

/// Fills in the places of the land's vertices, with the eye subtracted.
void Sky::place_land(const SurroundingPlain& plain, const glm::dvec3& eye_m) {
    land_m_.clear();
    for (const nature::Backdrop::BackdropVertex& corner : land_.vertices) {
        glm::dvec3 at_m = corner.at_m - eye_m;
        if (plain.earth_radius_m > 0.0) {
            at_m.z -= (at_m.x * at_m.x + at_m.y * at_m.y) / (2.0 * plain.earth_radius_m);
        }
        land_m_.push_back(at_m);
    }
}

/// Fills in outside_: for each vertex the planes that have it outside.
void Sky::find_outside(const Frustum& frustum, std::size_t vertices) {
    constexpr float margin = 1e-3F; // of the distance: far more than rounding moves a corner
    std::array<glm::vec3, 4> inward{};
    std::ranges::transform(frustum, inward.begin(), [](const glm::dvec3& normal) { return glm::vec3(normal); });
    outside_.resize((vertices + 3) / 4 * 4);
    for (std::size_t i = 0; i < vertices; i += 4) {
        std::array<glm::vec3, 4> at_m;
        for (std::size_t k = 0; k < 4; ++k) { at_m[k] = vertices_[std::min(i + k, vertices - 1)].position_m; }
        const Float4 x_m = {at_m[0].x, at_m[1].x, at_m[2].x, at_m[3].x};
        const Float4 y_m = {at_m[0].y, at_m[1].y, at_m[2].y, at_m[3].y};
        const Float4 z_m = {at_m[0].z, at_m[1].z, at_m[2].z, at_m[3].z};
        const Float4 limit = splat4(-margin) * (max4(x_m, -x_m) + max4(y_m, -y_m) + max4(z_m, -z_m));
        Mask4 outside{};
        for (int plane = 0; plane < 4; ++plane) {
            const glm::vec3& normal = inward[static_cast<std::size_t>(plane)];
            const Float4 inside_m = splat4(normal.x) * x_m + splat4(normal.y) * y_m + splat4(normal.z) * z_m;
            const int bit = 1 << plane;
            outside |= (inside_m < limit) & Mask4{bit, bit, bit, bit};
        }
        std::memcpy(&outside_[i], &outside, sizeof(outside));
    }
}

/// Adds a triangle to shown_indices_ and its corners to is_shown_ unless it is outside a plane.
void Sky::show_triangle(const std::uint32_t* corners, std::uint32_t first_vertex) {
    const auto outside = [&](std::size_t corner) { return outside_[first_vertex + corners[corner]]; };
    if ((outside(0) & outside(1) & outside(2)) != 0) { return; }
    for (std::size_t corner = 0; corner < 3; ++corner) {
        shown_indices_.push_back(first_vertex + corners[corner]);
        is_shown_[first_vertex + corners[corner]] = 1;
    }
}

/// Adds the land's triangles in painting order: rings from outside in, in each the cells from the one that is opposite
/// to the eye's as seen from the middle, and of a cell's two triangles the farther one first. A look from an eye inside
/// all rings turns steadily away from the eye's cell, so nothing is painted over what hides it.
void Sky::show_land(const glm::dvec2& eye_m) {
    const auto first = static_cast<std::uint32_t>(sky_vertices_);
    const std::size_t cells = land_.outer_vertices;
    const auto at_m = [this](std::size_t vertex) { return glm::dvec2(land_.vertices[vertex].at_m); };
    const auto is_left_of = [&](std::size_t corner) { return cross(at_m(corner % cells), eye_m) >= 0.0; };
    std::size_t own_cell = 0;
    while (own_cell + 1 < cells && !(is_left_of(own_cell) && !is_left_of(own_cell + 1))) { ++own_cell; }
    for (std::size_t ring = 0; ring < land_.indices.size(); ring += 6 * cells) {
        for (std::size_t nearer = cells; nearer-- > 0;) {
            const std::size_t away = nearer % 2 == 1 ? (nearer + 1) / 2 : cells - nearer / 2;
            const std::uint32_t* const cell = &land_.indices[ring + 6 * ((own_cell + away) % cells)];
            const auto outside = [&](std::size_t corner) { return outside_[first + cell[corner]]; };
            if ((outside(0) & outside(1) & outside(2) & outside(5)) != 0) { continue; }
            const glm::dvec2 inner_m = at_m(cell[2]);
            const bool outer_first = cross(at_m(cell[0]) - inner_m, eye_m - inner_m) <= 0.0;
            show_triangle(outer_first ? cell : cell + 3, first);
            show_triangle(outer_first ? cell + 3 : cell, first);
        }
    }
}

scene::TriangleDraw Sky::around(
    const SurroundingPlain& plain, const scene::Haze& haze, const glm::dvec3& eye_m, const Frustum& frustum) {
    // From beyond the map and below the land it would be a ceiling.
    const bool is_inside = std::max(std::abs(eye_m.x) - map_half_m_.x, std::abs(eye_m.y) - map_half_m_.y) <= 0.0;
    const bool has_land = !land_.vertices.empty() && (is_inside || plain.height_below_eye_m > 0.0);
    SurroundingPlain beyond = plain;
    if (plain.height_below_eye_m <= 0.0 && std::isfinite(plain.height_below_eye_m)) {
        beyond.height_below_eye_m = raised_eye_m;
    }
    if (has_land) {
        const glm::dvec2 to_edge_m = land_half_m_ - glm::abs(glm::dvec2(eye_m));
        beyond.map_edge_m = std::max(plain.map_edge_m, std::min(to_edge_m.x, to_edge_m.y));
    }
    constexpr std::size_t first_below = std::size_t{rings_above} * sky_segments;
    place_plain(plain);
    for (std::size_t i = 0; i < plain_rays_.size(); ++i) {
        vertices_[first_below + i].position_m = glm::vec3(dome_radius_m * plain_rays_[i]);
    }
    if (has_land) {
        place_land(plain, eye_m);
        for (std::size_t i = 0; i < land_m_.size(); ++i) {
            vertices_[sky_vertices_ + i].position_m = glm::vec3(land_m_[i]);
        }
    }
    const std::size_t vertices = has_land ? vertices_.size() : sky_vertices_;
    find_outside(frustum, vertices);
    is_shown_.assign(vertices, 0);
    shown_indices_.clear();
    for (std::size_t i = 0; i < indices_.size(); i += 3) { show_triangle(&indices_[i], 0); }
    if (has_land) { show_land(glm::dvec2(eye_m)); }
    for (std::size_t i = 0; i < plain_rays_.size(); ++i) {
        if (is_shown_[first_below + i] == 0) { continue; }
        const glm::dvec3& ray = plain_rays_[i];
        const std::optional<glm::vec3>& sea = sea_[i % levels_.size()];
        beyond.colour = sea ? water_.shaded_colour(*sea, glm::vec3(ray)) : plain.colour;
        vertices_[first_below + i] = dome_vertex(ray, colour_below(ray, beyond, haze));
    }
    for (std::size_t i = 0; has_land && i < land_m_.size(); ++i) {
        if (is_shown_[sky_vertices_ + i] == 0) { continue; }
        const nature::Backdrop::BackdropVertex& corner = land_.vertices[i];
        const auto cover_code = static_cast<std::uint32_t>(std::lround(corner.cover_code));
        const glm::vec3 own =
            corner.is_water ? water_.shaded_colour(corner.colour, glm::vec3(land_m_[i])) : corner.colour;
        const std::uint32_t colour = models::packed_colour(through_haze(haze, land_m_[i], own)) & 0x00ffffffU;
        vertices_[sky_vertices_ + i].colour = colour | cover_code << 24U;
    }
    number_shown_vertices();
    return {shown_vertices_, shown_indices_};
}

/// Fills in shown_vertices_ in the order of vertices_, and makes shown_indices_ refer to them.
void Sky::number_shown_vertices() {
    shown_vertices_.clear();
    first_land_vertex_ = 0;
    number_.resize(is_shown_.size());
    for (std::size_t i = 0; i < is_shown_.size(); ++i) {
        number_[i] = static_cast<std::uint32_t>(shown_vertices_.size());
        if (is_shown_[i] == 0) { continue; }
        shown_vertices_.push_back(vertices_[i]);
        first_land_vertex_ += i < sky_vertices_ ? 1 : 0;
    }
    for (std::uint32_t& index : shown_indices_) { index = number_[index]; }
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

double distance_to_edge_m(const landscape::Ground& ground, const glm::dvec3& eye_m) {
    const glm::dvec2 half_m = ground.half_extent_m();
    return std::max(std::min(half_m.x - std::abs(eye_m.x), half_m.y - std::abs(eye_m.y)), 0.0);
}

nature::Daylight daylight_over(const landscape::Ground& ground, const scene::AirSettings& settings) {
    const auto source = ground.source();
    return landscape::daylight_of(settings, landscape::climate_at(source ? source->place : std::nullopt));
}

} // namespace

Atmosphere::Atmosphere(const Scene& scene, const scene::AirSettings& settings)
    : scene_(scene), settings_(settings), daylight_(daylight_over(*scene.ground, settings)),
      to_sun_(landscape::direction_to_sun(settings)), haze_(haze_of(settings, daylight_)),
      sky_(daylight_, settings.sky ? scene.ground->backdrop() : nature::Backdrop()) {}

void Atmosphere::write(const FrameView& view, scene::FramePlan& plan) {
    const glm::dvec3& eye_m = view.camera.eye_m;
    const landscape::Ground& ground = *scene_.ground;
    plan.to_sun = glm::vec3(to_sun_);
    plan.ambient = daylight_.ambient();
    plan.sunlight = daylight_.sunlight();
    plan.haze = haze_;
    plan.haze.visibility_m = visibility_m(eye_m.z);
    plan.mirrored_sky.reset();
    plan.truth.land_has_cover_codes = ground.land_cover_contrast() != nullptr;
    if (settings_.sky) {
        plan.mirrored_sky = {glm::min(daylight_.sky({0.0, 0.0, 1.0}), glm::vec3(1.0F)), ground.mean_colour()};
        plan.sky = sky_.around({eye_m.z - ground.mean_height_m(), distance_to_edge_m(ground, eye_m),
                                   ground.mean_colour(), view.earth_radius_m},
            plan.haze, eye_m, view.frustum);
        plan.truth.first_land_vertex = sky_.first_land_vertex();
    }
}

/// The visibility at a height. That of the settings holds at the ground's mean height.
float Atmosphere::visibility_m(double eye_height_m) const {
    const double mean_m = scene_.ground->mean_height_m();
    double thinner = 1.0;
    if (settings_.haze_height_m > 0.0) {
        const double above_m = eye_height_m - (std::isfinite(mean_m) ? mean_m : 0.0);
        thinner = std::exp(std::clamp(above_m / settings_.haze_height_m, -3.0, 30.0));
    }
    return static_cast<float>(settings_.visibility_m * thinner);
}

} // namespace octant::visuals::planning
