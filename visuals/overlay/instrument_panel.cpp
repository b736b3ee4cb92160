#include "visuals/overlay/instrument_panel.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/overlay/head_up_glass.h"
#include "visuals/overlay/stroke_font.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace octant::visuals::overlay {

namespace {

constexpr double first_rad = rad_from_deg(-150.0);
constexpr double last_rad = rad_from_deg(150.0);

} // namespace

double scale_hand_rad(double value, const DialScale& scale) {
    const double share = (value - scale.min) / (scale.max - scale.min);
    return first_rad + std::clamp(share, 0.0, 1.0) * (last_rad - first_rad);
}

double altitude_hand_rad(double height_m, double feet_per_turn) {
    const double turns = ft_from_m(height_m) / feet_per_turn;
    return 2.0 * pi * (turns - std::floor(turns));
}

DialScale speed_scale_kt(double max_speed_mps) {
    const double max_kt = kt_from_mps(max_speed_mps);
    const double round_kt = max_kt > 400.0 ? 200.0 : 20.0;
    return {0.0, round_kt * std::max(std::ceil(max_kt / round_kt), 1.0)};
}

DialScale load_scale_g(double min_load_factor, double max_load_factor) {
    return {std::min(std::floor(min_load_factor), 0.0) - 1.0, std::max(std::ceil(max_load_factor), 1.0) + 1.0};
}

double label_step(const DialScale& scale) {
    const double max_numbers = scale.max >= 100.0 && scale.max < 400.0 ? 5.0 : 9.0;
    const double min_step = (scale.max - scale.min) / (max_numbers - 1.0);
    for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 100.0, 200.0, 500.0}) {
        if (step >= min_step) { return step; }
    }
    return 1000.0 * std::ceil(min_step / 1000.0);
}

namespace {

// Shares of a dial's radius.
constexpr float rim = 0.97F;
constexpr float tick_start_radius = 0.82F;
constexpr float number_radius = 0.62F;
constexpr float number_letter = 0.23F;
constexpr float card_letter = 0.18F; ///< of the heading, which has most of them
constexpr float card_number_at = 0.66F;
constexpr float caption_letter = 0.17F;
constexpr float long_hand = 0.78F;
constexpr float short_hand = 0.5F;
constexpr float horizon_max = 0.75F; ///< farthest from the middle: both colours are always seen
constexpr double horizon_per_rad = 1.0 / rad_from_deg(40.0);

/// Where a dial is smaller than this in the picture, only its hands are drawn.
constexpr float min_numbered_px = 22.0F;
constexpr float line_share = 0.035F; ///< of a line's width
constexpr float min_dial_line_px = 1.2F;

// As ColourVertex::colour.
constexpr std::uint32_t white = 0xffeef2f2U;
constexpr std::uint32_t face = 0xff1a1614U;
constexpr std::uint32_t rim_colour = 0xff5a5452U;
constexpr std::uint32_t sky = 0xffc48a46U;
constexpr std::uint32_t earth = 0xff2c4a72U;
constexpr std::uint32_t hand_colour = 0xfff4f6f6U;
constexpr std::uint32_t mark_colour = 0xff30c8ffU;

constexpr std::size_t rim_corners = 28;

using Ring = std::array<glm::vec2, rim_corners>;

/// Unit vector at an angle clockwise from the top, y down.
glm::vec2 towards(double angle_rad) {
    return {static_cast<float>(std::sin(angle_rad)), -static_cast<float>(std::cos(angle_rad))};
}

Ring ring_of(const glm::vec2& centre, float radius) {
    Ring ring;
    for (std::size_t i = 0; i < rim_corners; ++i) {
        ring[i] = centre + radius * towards(2.0 * pi * static_cast<double>(i) / double{rim_corners});
    }
    return ring;
}

/// Draws one dial.
class DialPainter {
public:
    DialPainter(const glm::vec2& centre, float radius, OverlayCanvas& faces, OverlayCanvas& hands)
        : centre_(centre), radius_(radius), faces_(faces), hands_(hands) {
        faces_.fill(ring_of(centre_, radius_), rim_colour);
        faces_.fill(ring_of(centre_, rim * radius_), face);
    }

    void show_scale(const DialScale& scale, double value, std::string_view caption) {
        const double step = label_step(scale);
        const double unit = step >= 100.0 ? 100.0 : 1.0; // hundreds, as on the real ones
        const double half = 0.5 * step;
        for (double at = std::ceil(scale.min / half) * half; at <= scale.max; at += half) {
            const bool numbered = std::abs(std::remainder(at, step)) < 1e-6;
            add_tick(scale_hand_rad(at, scale), numbered);
            if (numbered) { add_number(scale_hand_rad(at, scale), ShortText("{:.0f}", at / unit + 0.0).text()); }
        }
        add_caption(caption, 0.34F);
        add_hand(scale_hand_rad(value, scale), long_hand, 0.055F);
        add_hub();
    }

    void show_altitude(double height_m) {
        for (int tenth = 0; tenth < 10; ++tenth) {
            const double angle_rad = 2.0 * pi * tenth / 10.0;
            add_tick(angle_rad, true);
            add_number(angle_rad, ShortText("{}", tenth).text());
        }
        constexpr double max_ft = 99999.0;
        const long shown = std::lround(std::clamp(ft_from_m(height_m), -9999.0, max_ft) / 10.0);
        add_caption(ShortText("{}", 10 * shown).text(), 0.31F);
        add_hand(altitude_hand_rad(height_m, 10000.0), short_hand, 0.09F);
        add_hand(altitude_hand_rad(height_m, 1000.0), long_hand, 0.05F);
        add_hub();
    }

    void show_heading(double heading_rad) {
        constexpr std::array<std::string_view, 12> names{
            "N", "3", "6", "E", "12", "15", "S", "21", "24", "W", "30", "33"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            const double angle_rad = 2.0 * pi * static_cast<double>(i) / 12.0 - heading_rad;
            add_tick(angle_rad, true);
            add_number(angle_rad, names[i], card_letter, card_number_at);
        }
        const auto line = [&](glm::vec2 from, glm::vec2 to) {
            hands_.line(centre_ + radius_ * from, centre_ + radius_ * to);
        };
        line({0.0F, -0.32F}, {0.0F, 0.32F});
        line({-0.26F, 0.0F}, {0.26F, 0.0F});
        line({-0.12F, 0.26F}, {0.12F, 0.26F});
        add_mark();
    }

    /// Sky and earth as the pilot has them ahead, behind a fixed aircraft.
    void show_attitude(const EulerAngles& attitude) {
        const glm::vec2 up = towards(-attitude.roll_rad);
        const auto shift = static_cast<float>(std::clamp(
            attitude.pitch_rad * horizon_per_rad, -static_cast<double>(horizon_max), static_cast<double>(horizon_max)));
        const float inner = 0.9F * radius_;
        const Ring ring = ring_of(centre_, inner);
        faces_.fill(ring, earth);
        const glm::vec2 on_horizon = centre_ - up * (shift * inner);
        fill_above(ring, on_horizon, up);
        const glm::vec2 along(-up.y, up.x);
        const float half = std::sqrt(1.0F - shift * shift) * inner;
        faces_.line(on_horizon - along * half, on_horizon + along * half);
        for (const int tens : {-2, -1, 1, 2}) {
            const float from_middle = static_cast<float>(rad_from_deg(10.0 * tens) * horizon_per_rad) - shift;
            if (std::abs(from_middle) < 0.75F) {
                const glm::vec2 at = centre_ + up * (from_middle * inner);
                const float reach = (tens % 2 == 0 ? 0.3F : 0.18F) * inner;
                faces_.line(at - along * reach, at + along * reach);
            }
        }
        const auto wing = [&](float side) {
            hands_.polyline(std::array{centre_ + radius_ * glm::vec2(0.55F * side, 0.0F),
                centre_ + radius_ * glm::vec2(0.2F * side, 0.0F), centre_ + radius_ * glm::vec2(0.2F * side, 0.1F)});
        };
        wing(-1.0F);
        wing(1.0F);
        hands_.circle(centre_, 0.04F * radius_);
        add_bank_pointer(up);
    }

private:
    bool is_numbered() const { return radius_ >= min_numbered_px; }

    /// The part of a ring on the side of a line that `up` points to.
    void fill_above(const Ring& ring, const glm::vec2& on_line, const glm::vec2& up) {
        std::array<glm::vec2, rim_corners + 2> part;
        std::size_t count = 0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const glm::vec2& from = ring[i];
            const glm::vec2& to = ring[(i + 1) % ring.size()];
            const float above_from = glm::dot(from - on_line, up);
            const float above_to = glm::dot(to - on_line, up);
            if (above_from >= 0.0F) { part[count++] = from; }
            if ((above_from >= 0.0F) != (above_to >= 0.0F)) {
                part[count++] = from + (to - from) * (above_from / (above_from - above_to));
            }
        }
        faces_.fill(std::span(part).first(count), sky);
    }

    void add_bank_pointer(const glm::vec2& up) {
        const glm::vec2 across(-up.y, up.x);
        const glm::vec2 tip = centre_ + up * (0.86F * radius_);
        const glm::vec2 foot = centre_ + up * (0.7F * radius_);
        const glm::vec2 arm = across * (0.08F * radius_);
        hands_.fill(std::array{tip, foot + arm, foot - arm}, white);
    }

    void add_tick(double angle_rad, bool is_long) {
        const glm::vec2 out = towards(angle_rad);
        const float from = is_long ? tick_start_radius : 0.5F * (tick_start_radius + rim);
        faces_.line(centre_ + out * (from * radius_), centre_ + out * (rim * 0.96F * radius_));
    }

    void add_number(
        double angle_rad, std::string_view text, float letter = number_letter, float from_middle = number_radius) {
        if (is_numbered()) {
            const glm::vec2 at = centre_ + towards(angle_rad) * (from_middle * radius_);
            faces_.text({at, letter * radius_, 0.5F}, text);
        }
    }

    void add_caption(std::string_view text, float below) {
        if (is_numbered()) {
            const glm::vec2 at = centre_ + glm::vec2(0.0F, below * radius_);
            faces_.text({at, caption_letter * radius_, 0.5F}, text);
        }
    }

    void add_hand(double angle_rad, float length, float half_width) {
        const glm::vec2 out = towards(angle_rad);
        const glm::vec2 across(-out.y, out.x);
        const glm::vec2 tip = centre_ + out * (length * radius_);
        const glm::vec2 tail = centre_ - out * (0.14F * radius_);
        const glm::vec2 arm = across * (half_width * radius_);
        hands_.fill(std::array{tip + 0.3F * arm, tip - 0.3F * arm, tail - arm, tail + arm}, hand_colour);
    }

    void add_hub() { hands_.fill(ring_of(centre_, 0.1F * radius_), rim_colour); }

    /// Where the heading is read.
    void add_mark() {
        const glm::vec2 top = centre_ + glm::vec2(0.0F, -0.74F * radius_);
        const glm::vec2 arm(0.1F * radius_, 0.0F);
        const glm::vec2 rise(0.0F, -0.24F * radius_);
        hands_.fill(std::array{top, top + rise - arm, top + rise + arm}, mark_colour);
    }

    glm::vec2 centre_;
    float radius_;
    OverlayCanvas& faces_;
    OverlayCanvas& hands_;
};

void show(DialPainter& painter, const Dial& dial, const InstrumentLayout& layout, const InstrumentReadings& inputs) {
    const EulerAngles attitude = euler_from_body_to_world(inputs.state.body_to_world);
    switch (dial.quantity) {
    case Dial::Quantity::Speed:
        painter.show_scale(layout.speed_kt, kt_from_mps(glm::length(inputs.state.velocity_mps)), "KT");
        break;
    case Dial::Quantity::Altitude:
        painter.show_altitude(inputs.height_m);
        break;
    case Dial::Quantity::Attitude:
        painter.show_attitude(attitude);
        break;
    case Dial::Quantity::Heading:
        painter.show_heading(attitude.heading_rad);
        break;
    case Dial::Quantity::LoadFactor:
        painter.show_scale(layout.load_g, inputs.state.load_factor, "G");
        break;
    }
}

} // namespace

void add_instruments(OverlayLayers& layers, std::array<OverlayCanvas, 2>& canvases, const InstrumentLayout& layout,
    const InstrumentReadings& readings, const scene::Camera& camera, const glm::ivec2& size_px) {
    const HudGlass glass = make_hud_glass(readings.state, camera, size_px);
    auto& [faces, hands] = canvases;
    for (const Dial& dial : layout.dials) {
        const double px_per_m = glass.focal_px / dial.centre_m.x;
        const glm::vec2 centre(glm::dvec2(dial.centre_m.y, dial.centre_m.z) * px_per_m);
        const auto radius = static_cast<float>(dial.radius_m * px_per_m);
        if (!glass.may_show({centre - radius, centre + radius}, size_px)) { continue; }
        const float width_px = std::max(line_share * radius, min_dial_line_px);
        faces.begin(glass.to_picture, {width_px, 0.0F, white, 0});
        hands.begin(glass.to_picture, {1.6F * width_px, 0.0F, mark_colour, 0});
        DialPainter painter(centre, radius, faces, hands);
        show(painter, dial, layout, readings);
        layers.add(faces.finish());
        layers.add(hands.finish());
    }
}

} // namespace octant::visuals::overlay
