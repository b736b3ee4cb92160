#include "visuals/nature/scenery_shadows.h"

#include "sim/base/plane.h"
#include "visuals/nature/standing_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace octant::visuals::nature {

namespace {

constexpr float rim = 0.12F;        ///< so far in and out of the outline, of its distance from the middle
constexpr float unevenness = 0.10F; ///< of the outline, of its distance from the middle

/// Of sixteen around the unit circle, counter-clockwise. `share`: how far the odd ones have come from the straight
/// lines between the others.
glm::vec2 corner_of(std::size_t corner, float share) {
    constexpr float cosine = 0.923879533F; // of half an eighth of a turn
    constexpr float sine = 0.382683432F;
    const glm::vec2& way = compass_directions[corner / 2];
    if (corner % 2 == 0) { return way; }
    const glm::vec2 turned(cosine * way.x - sine * way.y, cosine * way.y + sine * way.x);
    return turned * glm::mix(cosine, 1.0F, share);
}

} // namespace

SceneryShadows::SceneryShadows(const Daylight& day)
    : to_sun_(day.to_sun()), level_(std::max(glm::length(glm::vec2(to_sun_)), 1e-3F)) {
    const float sky = glm::dot(luminance_weights, day.ambient());
    const float sun = glm::dot(luminance_weights, day.sunlight()) * std::max(to_sun_.z, 0.0F);
    left_ = sky / std::max(sky + sun, 1e-3F);
}

bool SceneryShadows::begin(const std::array<models::ColourVertex, 3>& triangle) {
    triangle_ = triangle;
    const glm::vec3& a = triangle[0].position_m;
    const glm::vec3& b = triangle[1].position_m;
    const glm::vec3& c = triangle[2].position_m;
    const glm::vec3 up = glm::cross(b - a, c - a);
    if (up.z <= 0.0F || glm::dot(up, a) >= 0.0F) { return false; }
    area_m2_ = up.z;
    slope_ = glm::vec2(up) / -up.z;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 side(triangle[(i + 1) % 3].position_m - triangle[i].position_m);
        inwards_[i] = glm::normalize(glm::vec2(-side.y, side.x));
    }
    return true;
}

void SceneryShadows::cut(Outline& outline, const glm::vec2& from_m, const glm::vec2& inwards) {
    Outline kept;
    for (std::size_t i = 0; i < outline.count; ++i) {
        const glm::vec3& a = outline.at_m[i];
        const glm::vec3& b = outline.at_m[i + 1 < outline.count ? i + 1 : 0];
        const float a_in = glm::dot(inwards, glm::vec2(a) - from_m);
        const float b_in = glm::dot(inwards, glm::vec2(b) - from_m);
        if (a_in >= 0.0F) { kept.at_m[kept.count++] = a; }
        if ((a_in > 0.0F && b_in < 0.0F) || (a_in < 0.0F && b_in > 0.0F)) {
            kept.at_m[kept.count++] = glm::mix(a, b, a_in / (a_in - b_in));
        }
    }
    outline = kept;
}

std::optional<SceneryShadows::Ellipse> SceneryShadows::shadow_of(const ShadowCaster& caster) const {
    const glm::vec2 foot_m(caster.foot_m);
    const float sinks = to_sun_.z - glm::dot(caster.slope, glm::vec2(to_sun_));
    const glm::vec2 half_m = -0.5F * caster.height_m / std::max(sinks, level_ / max_length) * glm::vec2(to_sun_);
    const float drawn_out_m = glm::length(half_m);
    const float long_m = std::sqrt(caster.radius_m * caster.radius_m + drawn_out_m * drawn_out_m);
    const glm::vec2 along = drawn_out_m > 1e-3F ? half_m / drawn_out_m : glm::vec2(1.0F, 0.0F);
    const float width_m = caster.radius_m / (1.0F + 0.3F * caster.taper); // a tapered one is widest before its middle
    Ellipse ellipse{foot_m + half_m, long_m * along, width_m * glm::vec2(-along.y, along.x), caster.taper, {}};
    const float reach = (1.0F + rim * caster.nearness) * (1.0F + unevenness);
    for (std::size_t i = 0; i < 3; ++i) {
        const float inside_m = glm::dot(inwards_[i], ellipse.middle_m - glm::vec2(triangle_[i].position_m));
        const float along_m = glm::dot(inwards_[i], ellipse.along_m);
        const float aside_m = (1.0F + caster.taper) * glm::dot(inwards_[i], ellipse.aside_m);
        const float reach_m = reach * std::sqrt(along_m * along_m + aside_m * aside_m);
        if (inside_m <= -reach_m) { return std::nullopt; }
        ellipse.crosses[i] = inside_m < reach_m;
    }
    return ellipse;
}

SceneryShadows::Outline SceneryShadows::outline_of(
    const ShadowCaster& caster, const Ellipse& ellipse, float size, float strength) {
    // Convex: the corners between others are as far out as these are in the mean.
    std::array<float, corners + 1> uneven;
    for (std::size_t i = 0; i < corners; i += 2) {
        const float random = static_cast<float>(caster.random_bits >> i & 3U) * (2.0F / 3.0F) - 1.0F;
        uneven[i] = 1.0F + unevenness * (1.0F - 0.5F * caster.nearness) * random;
    }
    uneven[corners] = uneven[0];
    for (std::size_t i = 1; i < corners; i += 2) { uneven[i] = 0.5F * (uneven[i - 1] + uneven[i + 1]); }
    Outline outline;
    for (std::size_t i = 0; i<corners; i += caster.nearness> 0.0F ? 1 : 2) {
        const glm::vec2 at_m = ellipse.place_m(corner_of(i, caster.nearness) * (size * uneven[i]));
        outline.at_m[outline.count++] = glm::vec3(at_m, strength);
    }
    return outline;
}

void SceneryShadows::add(const ShadowCaster& caster, float scale, const StandingTriangles& to) const {
    const std::optional<Ellipse> ellipse = shadow_of(caster);
    if (!ellipse) { return; }
    add_part(outline_of(caster, *ellipse, 1.0F - rim * caster.nearness, caster.strength), ellipse->crosses, scale, to);
}

void SceneryShadows::add_rim(const ShadowCaster& caster, float scale, const StandingTriangles& to) const {
    if (caster.nearness <= 0.0F) { return; }
    const std::optional<Ellipse> ellipse = shadow_of(caster);
    if (!ellipse) { return; }
    const Outline inner = outline_of(caster, *ellipse, 1.0F - rim * caster.nearness, caster.strength);
    const Outline outer = outline_of(caster, *ellipse, 1.0F + rim * caster.nearness, 0.0F);
    const auto sides_outside = [&](std::size_t corner) { // beyond which sides both of its places lie
        unsigned outside = 0;
        for (unsigned side = 0; side < 3; ++side) {
            const auto is_outside = [&](const glm::vec3& at_m) {
                return glm::dot(inwards_[side], glm::vec2(at_m) - glm::vec2(triangle_[side].position_m)) < 0.0F;
            };
            if (is_outside(inner.at_m[corner]) && is_outside(outer.at_m[corner])) { outside |= 1U << side; }
        }
        return outside;
    };
    unsigned outside_next = sides_outside(0);
    for (std::size_t i = 0; i < corners; ++i) {
        const std::size_t next = (i + 1) % corners;
        const unsigned outside = std::exchange(outside_next, sides_outside(next));
        if ((outside & outside_next) != 0) { continue; }
        Outline part;
        for (const glm::vec3& at_m : {inner.at_m[i], outer.at_m[i], outer.at_m[next], inner.at_m[next]}) {
            part.at_m[part.count++] = at_m;
        }
        add_part(part, ellipse->crosses, scale, to);
    }
}

/// Cuts a convex polygon to the sides of the triangle that it may cross and appends it.
void SceneryShadows::add_part(
    Outline outline, const std::array<bool, 3>& crosses, float scale, const StandingTriangles& to) const {
    for (std::size_t side = 0; side < 3; ++side) {
        if (!crosses[side]) { continue; }
        const glm::vec2 from_m(triangle_[side].position_m);
        std::size_t outside = 0;
        for (std::size_t i = 0; i < outline.count; ++i) {
            outside += glm::dot(inwards_[side], glm::vec2(outline.at_m[i]) - from_m) < 0.0F ? 1U : 0U;
        }
        if (outside == outline.count) { return; }
        if (outside > 0) { cut(outline, from_m, inwards_[side]); }
    }
    if (outline.count < 3) { return; }
    const auto& [a, b, c] = triangle_;
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (std::size_t i = 0; i < outline.count; ++i) {
        const glm::vec2 plan_m(outline.at_m[i]);
        const float left = glm::mix(1.0F, left_, outline.at_m[i].z);
        const glm::vec3 at_m(plan_m, a.position_m.z + glm::dot(slope_, plan_m - glm::vec2(a.position_m)));
        const float u = std::clamp(signed_area2(b.position_m, c.position_m, at_m) / area_m2_, 0.0F, 1.0F);
        const float v = std::clamp(signed_area2(c.position_m, a.position_m, at_m) / area_m2_, 0.0F, 1.0F - u);
        std::uint32_t colour = 0;
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const auto part = [&](const models::ColourVertex& corner) {
                return static_cast<float>(corner.colour >> shift & 0xffU);
            };
            const float mean = u * part(a) + v * part(b) + (1.0F - u - v) * part(c);
            colour |= static_cast<std::uint32_t>((shift < 24 ? left : 1.0F) * mean + 0.5F) << shift;
        }
        to.vertices.push_back({at_m * scale, colour});
    }
    for (std::uint32_t i = 2; i < outline.count; ++i) {
        to.indices.insert(to.indices.end(), {first, first + i - 1, first + i});
    }
}

} // namespace octant::visuals::nature
