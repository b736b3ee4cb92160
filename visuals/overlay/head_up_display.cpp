// The layout follows what fighters show (MIL-STD-1787B, "Aircraft display symbology"): speed left, altitude right,
// heading above, a pitch ladder and a flight-path marker that lie on the world. Deviations: true instead of calibrated
// airspeed; the air moves with the ground and has the standard atmosphere's temperature above datum (ISO 2533,
// troposphere and tropopause); the height above ground is that straight below the aircraft.
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/overlay/head_up_glass.h"
#include "visuals/overlay/overlay.h"
#include "visuals/overlay/overlay_canvas.h"
#include "visuals/overlay/stroke_font.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
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
constexpr float gap = 0.038F;         ///< half of it, in the middle of a rung
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

    glm::vec2 at(float right_px, float up_px) const { return middle + right * right_px + up * up_px; }
};

/// The great circle of an azimuth: 0 = horizon, 90 = zenith, beyond it the other half.
struct Meridian {
    glm::dvec3 level{0.0, 1.0, 0.0};
    glm::dvec3 right{1.0, 0.0, 0.0};

    glm::dvec3 at(double pitch_rad) const {
        return std::cos(pitch_rad) * level + glm::dvec3(0.0, 0.0, std::sin(pitch_rad));
    }

    double pitch_of(const glm::dvec3& direction) const { return std::atan2(direction.z, glm::dot(direction, level)); }
};

Meridian meridian_of(const HudGlass& glass, const glm::dvec3& anchor) {
    glm::dvec3 level(anchor.x, anchor.y, 0.0);
    if (glm::length(level) < 1e-6 * glm::length(anchor)) {
        level = direction_from_heading(euler_from_body_to_world(glm::conjugate(glass.world_to_body)).heading_rad);
    }
    level = glm::normalize(level);
    return {level, glm::dvec3(level.y, -level.x, 0.0)};
}

int degrees_between_rungs(const HudGlass& glass) {
    for (const int step_deg : {1, 2, 5, 10, 15}) {
        const double spacing_px = glass.focal_px * std::tan(rad_from_deg(step_deg));
        if (spacing_px >= static_cast<double>(min_spacing * glass.unit_px)) { return step_deg; }
    }
    return 30;
}

std::optional<RungFrame> project(const HudGlass& glass, const Meridian& meridian, double pitch_rad) {
    constexpr double small = 0.01;
    const glm::dvec3 centre = meridian.at(pitch_rad);
    const auto middle = glass.project(centre);
    const auto right_of_middle = glass.project(centre + small * meridian.right);
    if (!middle || !right_of_middle) { return std::nullopt; }
    const glm::vec2 right = glm::normalize(*right_of_middle - *middle);
    return RungFrame{*middle, right, glm::vec2(right.y, -right.x)};
}

void draw_horizon(const RungFrame& place, float unit_px, OverlayCanvas& canvas) {
    for (const float side : {-unit_px, unit_px}) {
        canvas.line(place.at(side * gap, 0.0F), place.at(side * horizon_end, 0.0F));
    }
}

/// The outer half of a rung; `side` = unit to the right or the left.
void draw_half_rung(const RungFrame& place, float side, float bend_px, bool dashed, OverlayCanvas& canvas) {
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

void draw_rung(const RungFrame& place, int pitch_deg, float unit_px, float letter_px, OverlayCanvas& canvas) {
    std::array<char, 8> digits{};
    const auto written = fmt::format_to_n(digits.data(), digits.size(), "{}", std::abs(pitch_deg));
    const std::string_view number(digits.data(), written.size);
    const float to_horizon = pitch_deg > 0 ? -bend : bend;
    for (const float side : {-unit_px, unit_px}) {
        draw_half_rung(place, side, to_horizon * unit_px, pitch_deg < 0, canvas);
        const float alignment = side < 0.0F ? 1.0F : 0.0F;
        canvas.text({place.at(side * (rung_end + number_distance), 0.5F * to_horizon * unit_px), letter_px, alignment,
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

/// Draws the horizon and the rungs of pitch where they are in the world, around the azimuth of `anchor` (world axes,
/// any length): whole lines above the horizon, dashes below, ends bent towards the horizon, numbers beside them in
/// degrees. As many degrees apart as fit.
void draw_pitch_ladder(const HudGlass& glass, const glm::dvec3& anchor, float letter_px, OverlayCanvas& canvas) {
    const Meridian meridian = meridian_of(glass, anchor);
    const int step_deg = degrees_between_rungs(glass);
    const double middle_deg = deg_from_rad(meridian.pitch_of(glass.direction_to(glm::vec2(0.0F))));
    const auto nearest = static_cast<int>(std::lround(middle_deg / step_deg));
    const double reach_rad = std::atan(reach * static_cast<double>(glass.unit_px) / glass.focal_px);
    const int max_rungs = static_cast<int>(deg_from_rad(reach_rad)) / step_deg + 1;
    for (int rung = nearest - max_rungs; rung <= nearest + max_rungs; ++rung) {
        const int along_deg = rung * step_deg; // beyond the zenith more than 90
        auto place = project(glass, meridian, rad_from_deg(along_deg));
        if (!place) { continue; }
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

// Shares of the glass's unit, x to the right, y down from where the body's axis points.
constexpr float box_letter = 0.026F;
constexpr float small_letter = 0.021F;
constexpr float tape_letter = 0.018F;
constexpr float ladder_letter = 0.0175F;
constexpr float box_side = 0.262F; ///< of the speed and altitude boxes towards the middle
constexpr float tape_bottom = -0.345F;
constexpr float tape_half = 0.17F;
constexpr float tape_per_deg = 0.0085F;
constexpr float short_tick = 0.011F;
constexpr float long_tick = 0.018F;
constexpr float marker_radius = 0.0115F;
constexpr float marker_wing = 0.032F;
constexpr float marker_tail = 0.024F;
constexpr float line_width = 0.0025F;
constexpr OverlayBox world_symbol_box{{-0.235F, -0.275F}, {0.235F, 0.33F}}; ///< of what lies on the world
constexpr OverlayBox display_box{{-0.46F, -0.42F}, {0.46F, 0.36F}};

/// Room for letters that cannot be smaller in small pictures.
constexpr glm::vec2 min_whole_px{110.0F, 68.0F};
constexpr float min_letter_px = 7.0F; ///< a pixel for each step of the letters' grid, and one
constexpr float min_line_px = 1.15F;
constexpr glm::vec3 green{0.22F, 1.0F, 0.36F};
constexpr std::uint32_t halo_colour = 0xb0041c00U; ///< dark green, as ColourVertex::colour

constexpr double min_marked_speed_mps = 5.0; ///< below, no flight path is shown
constexpr double full_marker_speed_mps = 20.0;
constexpr double min_mach = 0.3;

OverlayBox scaled(const OverlayBox& box, float unit_px) { return {box.min * unit_px, box.max * unit_px}; }

OverlayBox display_box_of(const HudGlass& glass) {
    const OverlayBox box = scaled(display_box, glass.unit_px);
    return {glm::min(box.min, -min_whole_px), glm::max(box.max, min_whole_px)};
}

/// To whole numbers, of at most six digits.
long rounded(double value, double step = 1.0) {
    constexpr double max_value = 999999.0;
    return std::lround(std::clamp(value, -max_value, max_value) / step) * std::lround(step);
}

double speed_of_sound_mps(double height_m) {
    constexpr double sea_level_k = 288.15;
    constexpr double lapse_k_per_m = 0.0065;
    constexpr double tropopause_k = 216.65;
    constexpr double heat_ratio_times_gas_constant = 1.4 * 287.05287;
    const double temperature_k = std::max(sea_level_k - lapse_k_per_m * height_m, tropopause_k);
    return std::sqrt(heat_ratio_times_gas_constant * temperature_k);
}

/// Draws one picture's signs.
class HudPainter {
public:
    HudPainter(const InstrumentReadings& inputs, const HudGlass& glass, OverlayCanvas& canvas)
        : inputs_(inputs), glass_(glass), canvas_(canvas), unit_px_(glass.unit_px),
          flight_path_(inputs.state.velocity_mps) {}

    void draw() {
        canvas_.clip_to(scaled(world_symbol_box, unit_px_));
        draw_pitch_ladder(glass_, ladder_direction(), letter_px(ladder_letter), canvas_);
        draw_flight_path_marker();
        draw_axis_mark();
        canvas_.clip_to(display_box_of(glass_));
        draw_left();
        draw_right();
        draw_heading();
    }

private:
    float letter_px(float share) const { return std::max(share * unit_px_, min_letter_px); }

    glm::dvec3 body_axis() const { return inputs_.state.body_to_world * glm::dvec3(1.0, 0.0, 0.0); }

    /// Where the flight goes, held at the field's edge: the ladder stands around it, and before the nose where the
    /// aircraft hardly moves or goes elsewhere.
    glm::dvec3 ladder_direction() const {
        const double speed_mps = glm::length(flight_path_);
        const double share = glm::smoothstep(min_marked_speed_mps, full_marker_speed_mps, speed_mps);
        const auto place = share > 0.0 ? glass_.project(flight_path_) : std::nullopt;
        if (!place) { return body_axis(); }
        const OverlayBox box = scaled(world_symbol_box, unit_px_);
        const glm::dvec3 seen = glass_.direction_to(glm::clamp(*place, box.min, box.max));
        return glm::mix(body_axis(), glm::normalize(seen), share);
    }

    /// Crossed out where the flight goes beyond the field.
    void draw_flight_path_marker() {
        const auto place = glass_.project(flight_path_);
        if (!place || glm::length(flight_path_) < min_marked_speed_mps) { return; }
        const OverlayBox box = scaled(world_symbol_box, unit_px_);
        const float reach_px = marker_wing * unit_px_;
        const glm::vec2 at = glm::clamp(*place, box.min + reach_px, box.max - reach_px);
        const float radius = marker_radius * unit_px_;
        const float tail = marker_tail * unit_px_;
        canvas_.circle(at, radius);
        canvas_.line(at - glm::vec2(reach_px, 0.0F), at - glm::vec2(radius, 0.0F));
        canvas_.line(at + glm::vec2(radius, 0.0F), at + glm::vec2(reach_px, 0.0F));
        canvas_.line(at - glm::vec2(0.0F, tail), at - glm::vec2(0.0F, radius));
        if (at != *place) {
            const glm::vec2 arm(0.9F * radius);
            const glm::vec2 other_arm(arm.x, -arm.y);
            canvas_.line(at - arm, at + arm);
            canvas_.line(at - other_arm, at + other_arm);
        }
    }

    /// The waterline mark: where the body's axis points.
    void draw_axis_mark() {
        constexpr float far = 0.03F;
        constexpr float near = 0.015F;
        constexpr float half = 0.0075F;
        constexpr float low = 0.012F;
        std::array<glm::vec2, 7> points{
            {{-far, 0.0F}, {-near, 0.0F}, {-half, low}, {0.0F, 0.0F}, {half, low}, {near, 0.0F}, {far, 0.0F}}};
        for (glm::vec2& point : points) { point *= unit_px_; }
        canvas_.polyline(points);
    }

    /// A box with room for `letters` whose edge towards the middle is `side`, and what is in it.
    void draw_boxed(float side, std::size_t letters, std::string_view number) {
        const float height = letter_px(box_letter);
        const float step = height / glyph_height;
        const float pad = 0.45F * height;
        const float outward = side < 0.0F ? -1.0F : 1.0F;
        const float inner = side * unit_px_;
        const float width = step * static_cast<float>(text_width(letters)) + 2.0F * pad;
        const float outer = inner + outward * width;
        const float half = 0.5F * height + pad;
        canvas_.box({{std::min(inner, outer), -half}, {std::max(inner, outer), half}});
        canvas_.line({inner - outward * 1.3F * pad, 0.0F}, {inner, 0.0F});
        canvas_.text({{std::max(inner, outer) - pad, 0.0F}, height, 1.0F}, number);
    }

    /// The middle of row `row` above (-) or below (+) the boxes.
    float row_y(int row) const {
        const float row_gap = 0.95F * letter_px(box_letter) + 0.95F * letter_px(small_letter);
        const float line = 1.65F * letter_px(small_letter);
        const auto beyond = static_cast<float>(std::abs(row) - 1);
        return (row < 0 ? -1.0F : 1.0F) * (row_gap + beyond * line);
    }

    void draw_row(int row, float side, std::string_view text) {
        const float alignment = side < 0.0F ? 1.0F : 0.0F;
        canvas_.text({{side * unit_px_, row_y(row)}, letter_px(small_letter), alignment}, text);
    }

    void draw_left() {
        const double speed_mps = glm::length(inputs_.state.velocity_mps);
        draw_boxed(-box_side, 4, ShortText("{}", rounded(kt_from_mps(speed_mps))).text());
        draw_row(1, -box_side, ShortText("G {:4.1f}", inputs_.state.load_factor).text());
        const double mach = speed_mps / speed_of_sound_mps(inputs_.height_m);
        if (mach >= min_mach) { draw_row(2, -box_side, ShortText("M {:4.2f}", mach).text()); }
    }

    void draw_right() {
        constexpr double step_ft = 10.0;
        const double climb_mps = inputs_.state.velocity_mps.z;
        draw_boxed(box_side, 5, ShortText("{}", rounded(ft_from_m(inputs_.height_m), step_ft)).text());
        const long climb_fpm = rounded(60.0 * ft_from_m(climb_mps), step_ft);
        draw_row(-1, box_side, ShortText("VS {:+}", climb_fpm).text());
        if (inputs_.height_above_ground_m) {
            const double height_ft = ft_from_m(*inputs_.height_above_ground_m);
            draw_row(1, box_side, ShortText("R {}", rounded(height_ft)).text());
        }
    }

    void draw_heading() {
        const double heading_deg = deg_from_rad(euler_from_body_to_world(inputs_.state.body_to_world).heading_rad);
        draw_tape(heading_deg);
        const float bottom = tape_bottom * unit_px_;
        const float caret = 0.008F * unit_px_;
        const float tip = bottom + 0.5F * caret;
        canvas_.polyline(std::array{
            glm::vec2(-caret, tip + 1.6F * caret), glm::vec2(0.0F, tip), glm::vec2(caret, tip + 1.6F * caret)});
        const float height = letter_px(small_letter);
        const long shown = rounded(heading_deg) % 360;
        canvas_.text({{0.0F, tip + 2.2F * caret + 0.5F * height}, height, 0.5F}, ShortText("{:03}", shown).text());
    }

    /// A tick each 5 degrees, longer each 10, and numbers as close as they fit.
    void draw_tape(double heading_deg) {
        const float per_deg = tape_per_deg * unit_px_;
        const float bottom = tape_bottom * unit_px_;
        const float height = letter_px(tape_letter);
        const float number_px = height / glyph_height * static_cast<float>(text_width(3));
        const int number_deg = 10.0F * per_deg > 1.3F * number_px ? 10 : 30;
        const double half_deg = static_cast<double>(tape_half / tape_per_deg);
        const auto first = static_cast<int>(std::ceil((heading_deg - half_deg) / 5.0));
        const auto last = static_cast<int>(std::floor((heading_deg + half_deg) / 5.0));
        for (int fifth = first; fifth <= last; ++fifth) {
            const int deg = 5 * fifth;
            const float x = static_cast<float>(deg - heading_deg) * per_deg;
            const float top = bottom - (deg % 10 == 0 ? long_tick : short_tick) * unit_px_;
            canvas_.line({x, bottom}, {x, top});
            if (deg % number_deg == 0) {
                const int shown = (deg + 720) % 360;
                canvas_.text({{x, bottom - long_tick * unit_px_ - 0.95F * height}, height, 0.5F},
                    ShortText("{:03}", shown).text());
            }
        }
    }

    const InstrumentReadings& inputs_;
    const HudGlass& glass_;
    OverlayCanvas& canvas_;
    float unit_px_;
    glm::dvec3 flight_path_;
};

} // namespace

scene::OverlayDraw draw_head_up_display(
    OverlayCanvas& canvas, const InstrumentReadings& readings, const scene::Camera& camera, const glm::ivec2& size_px) {
    const HudGlass glass = make_hud_glass(readings.state, camera, size_px);
    if (!glass.may_show(display_box_of(glass), size_px)) { return {}; }
    const float width_px = std::max(line_width * glass.unit_px, min_line_px);
    canvas.begin(glass.to_picture, {width_px, 1.4F, models::packed_colour(green), halo_colour});
    HudPainter(readings, glass, canvas).draw();
    return canvas.finish();
}

} // namespace octant::visuals::overlay
