#include "visuals/overlay/pitch_ladder.h"

#include "sim/base/axes.h"
#include "sim/base/format_once.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace octant::visuals::overlay {

namespace {

// Shares of the glass's unit.
constexpr float min_spacing = 0.075F; ///< between rungs
constexpr float gap = 0.038F;           ///< half of it, in the middle of a rung
constexpr float rung_end = 0.115F;
constexpr float horizon_end = 0.21F;
constexpr float bend = 0.018F;
constexpr float number_distance = 0.014F;
constexpr int dashes = 3;
constexpr float dash_share = 0.62F; ///< of a dash and the space after it

constexpr double reach = 0.6; ///< from the middle of the glass to the farthest rung

/// A frame on the glass at the middle of a rung.
struct RungFrame {
    glm::vec2 middle{0.0F};
    glm::vec2 right{1.0F, 0.0F}; ///< unit vector along the horizon
    glm::vec2 up{0.0F, -1.0F};   ///< unit vector square to it, to greater pitch

    glm::vec2 at(float right_px, float up_px) const {
        return middle + right * right_px + up * up_px;
    }
};

/// The great circle of an azimuth: 0 = horizon, 90 = zenith, beyond it the other half.
struct Meridian {
    glm::dvec3 level{0.0, 1.0, 0.0};
    glm::dvec3 right{1.0, 0.0, 0.0};

    glm::dvec3 at(double pitch_rad) const {
        return std::cos(pitch_rad) * level + glm::dvec3(0.0, 0.0, std::sin(pitch_rad));
    }

    double pitch_of(const glm::dvec3& direction) const {
        return std::atan2(direction.z, glm::dot(direction, level));
    }
};

Meridian meridian_of(const HudGlass& glass, const glm::dvec3& anchor) {
    glm::dvec3 level(anchor.x, anchor.y, 0.0);
    if (glm::length(level) < 1e-6 * glm::length(anchor)) {
        level = direction_from_heading(
            euler_from_body_to_world(glm::conjugate(glass.world_to_body)).heading_rad);
    }
    level = glm::normalize(level);
    return {level, glm::dvec3(level.y, -level.x, 0.0)};
}

int degrees_between_rungs(const HudGlass& glass) {
    for (const int step_deg : {1, 2, 5, 10, 15}) {
        const double spacing_px = glass.focal_px * std::tan(rad_from_deg(step_deg));
        if (spacing_px >= static_cast<double>(min_spacing * glass.unit_px)) {
            return step_deg;
        }
    }
    return 30;
}

std::optional<RungFrame>
project(const HudGlass& glass, const Meridian& meridian, double pitch_rad) {
    constexpr double small = 0.01;
    const glm::dvec3 centre = meridian.at(pitch_rad);
    const auto middle = glass.project(centre);
    const auto right_of_middle = glass.project(centre + small * meridian.right);
    if (!middle || !right_of_middle) {
        return std::nullopt;
    }
    const glm::vec2 right = glm::normalize(*right_of_middle - *middle);
    return RungFrame{*middle, right, glm::vec2(right.y, -right.x)};
}

void draw_horizon(const RungFrame& place, float unit_px, OverlayCanvas& canvas) {
    for (const float side : {-unit_px, unit_px}) {
        canvas.line(place.at(side * gap, 0.0F), place.at(side * horizon_end, 0.0F));
    }
}

/// The outer half of a rung; `side` = unit to the right or the left.
void draw_half_rung(
    const RungFrame& place, float side, float bend_px, bool dashed, OverlayCanvas& canvas) {
    const glm::vec2 bent = place.at(side * rung_end, bend_px);
    const glm::vec2 end = place.at(side * rung_end, 0.0F);
    if (!dashed) {
        canvas.polyline(std::array{place.at(side * gap, 0.0F), end, bent});
        return;
    }
    const float period = (rung_end - gap) / (static_cast<float>(dashes) - 1.0F + dash_share);
    for (int dash = 0; dash < dashes; ++dash) {
        const float from = gap + period * static_cast<float>(dash);
        const float to = from + period * dash_share;
        if (dash + 1 < dashes) {
            canvas.line(place.at(side * from, 0.0F), place.at(side * to, 0.0F));
        } else {
            canvas.polyline(std::array{place.at(side * from, 0.0F), end, bent});
        }
    }
}

void draw_rung(
    const RungFrame& place, int pitch_deg, float unit_px, float letter_px, OverlayCanvas& canvas) {
    std::array<char, 8> digits{};
    const auto written = fmt::format_to_n(digits.data(), digits.size(), "{}", std::abs(pitch_deg));
    const std::string_view number(digits.data(), written.size);
    const float to_horizon = pitch_deg > 0 ? -bend : bend;
    for (const float side : {-unit_px, unit_px}) {
        draw_half_rung(place, side, to_horizon * unit_px, pitch_deg < 0, canvas);
        const float alignment = side < 0.0F ? 1.0F : 0.0F;
        canvas.text(
            {place.at(side * (rung_end + number_distance), 0.5F * to_horizon * unit_px),
             letter_px,
             alignment,
             place.right},
            number);
    }
}

/// Straight up a ring, straight down a ring with a cross.
void draw_pole(const RungFrame& place, bool below, float unit_px, OverlayCanvas& canvas) {
    const float radius = 0.5F * gap * unit_px;
    canvas.circle(place.middle, radius);
    if (below) {
        canvas.line(place.at(-radius, 0.0F), place.at(radius, 0.0F));
        canvas.line(place.at(0.0F, -radius), place.at(0.0F, radius));
    }
}

} // namespace

void draw_pitch_ladder(
    const HudGlass& glass, const glm::dvec3& anchor, float letter_px, OverlayCanvas& canvas) {
    const Meridian meridian = meridian_of(glass, anchor);
    const int step_deg = degrees_between_rungs(glass);
    const double middle_deg = deg_from_rad(meridian.pitch_of(glass.direction_to(glm::vec2(0.0F))));
    const auto nearest = static_cast<int>(std::lround(middle_deg / step_deg));
    const double reach_rad = std::atan(reach * static_cast<double>(glass.unit_px) / glass.focal_px);
    const int most = static_cast<int>(deg_from_rad(reach_rad)) / step_deg + 1;
    for (int rung = nearest - most; rung <= nearest + most; ++rung) {
        const int along_deg = rung * step_deg; // beyond the zenith more than 90
        auto place = project(glass, meridian, rad_from_deg(along_deg));
        if (!place) {
            continue;
        }
        const bool upside_down = std::abs(along_deg) > 90;
        const int pitch_deg = upside_down ? (along_deg > 0 ? 180 : -180) - along_deg : along_deg;
        if (upside_down) {
            place->right = -place->right;
            place->up = -place->up;
        }
        if (std::abs(pitch_deg) == 90) {
            draw_pole(*place, pitch_deg < 0, glass.unit_px, canvas);
        } else if (pitch_deg == 0) {
            draw_horizon(*place, glass.unit_px, canvas);
        } else {
            draw_rung(*place, pitch_deg, glass.unit_px, letter_px, canvas);
        }
    }
}

} // namespace octant::visuals::overlay
