#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/scene/camera_rig.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace octant;
using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr glm::ivec2 dial_picture_px(1280, 720);
constexpr double dial_radius_m = 0.04;

using Quantity = Dial::Quantity;

InstrumentReadings flying(const EulerAngles& attitude, double speed_kt, double height_ft, double load_factor) {
    InstrumentReadings inputs;
    inputs.state.body_to_world = body_to_world_from_euler(attitude);
    inputs.state.velocity_mps = mps_from_kt(speed_kt) * direction_from_heading(attitude.heading_rad);
    inputs.state.load_factor = load_factor;
    inputs.height_m = m_from_ft(height_ft);
    return inputs;
}

Camera dial_camera(const InstrumentReadings& inputs, double azimuth_deg = 0.0) {
    ViewSettings view;
    view.kind = View::Cockpit;
    view.azimuth_deg = azimuth_deg;
    const GroundHeight no_ground = [](double, double) { return std::optional<double>(); };
    return camera_of(view, inputs.state, {}, {}, {}, no_ground);
}

InstrumentLayout one_dial(Quantity quantity) {
    return {
        {{quantity, {0.78, 0.1, 0.2}, dial_radius_m}}, speed_scale_kt(mps_from_kt(800.0)), load_scale_g(-3.0, 7.33)};
}

/// Dials in memory of their own.
struct Panel {
    std::array<OverlayCanvas, 2> canvases;
    OverlayLayers layers;

    OverlayDraw draw(const InstrumentLayout& layout, const InstrumentReadings& inputs, const Camera& camera) {
        layers.clear();
        add_instruments(layers, canvases, layout, inputs, camera, dial_picture_px);
        return layers.all();
    }
};

/// Colour of what is drawn last at a place of the dial above: radii right and down from its middle.
std::uint32_t colour_at(const OverlayDraw& draw, const glm::dvec2& radii, std::uint32_t nothing = 0) {
    const double px_per_m = 0.5 * dial_picture_px.y / std::tan(rad_from_deg(22.5)) / 0.78;
    const glm::dvec2 at = 0.5 * glm::dvec2(dial_picture_px) + px_per_m * (glm::dvec2(0.1, 0.2) + dial_radius_m * radii);
    std::uint32_t colour = nothing;
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec2(draw.vertices[draw.indices[i + k]].at_px); };
        const auto side = [&](std::size_t k) {
            const glm::dvec2 along = corner((k + 1) % 3) - corner(k);
            const glm::dvec2 to = at - corner(k);
            return along.x * to.y - along.y * to.x;
        };
        const bool inside =
            (side(0) > 0.0 && side(1) > 0.0 && side(2) > 0.0) || (side(0) < 0.0 && side(1) < 0.0 && side(2) < 0.0);
        if (inside) { colour = draw.vertices[draw.indices[i]].colour; }
    }
    return colour;
}

/// Whether a hand lies half-way out at an angle clockwise from the top, and none opposite.
bool points_at(Quantity quantity, const InstrumentReadings& inputs, double angle_deg) {
    Panel panel;
    const OverlayDraw draw = panel.draw(one_dial(quantity), inputs, dial_camera(inputs));
    const double angle_rad = rad_from_deg(angle_deg);
    const glm::dvec2 out(std::sin(angle_rad), -std::cos(angle_rad));
    const auto is_light = [&](const glm::dvec2& at) { return (colour_at(draw, at) & 0xffU) > 0xe0U; };
    return is_light(0.4 * out) && !is_light(-0.2 * out);
}

bool is_blue(std::uint32_t colour) { return (colour >> 16U & 0xffU) > (colour & 0xffU); }

} // namespace

TEST_CASE("the hands of dials point at what known states are") {
    const EulerAngles north{};
    // 300 degrees of turn, from 150 degrees left of the top, for 800 kt and for -4 to 9 g.
    CHECK(points_at(Quantity::Speed, flying(north, 400.0, 0.0, 1.0), 0.0));
    CHECK(points_at(Quantity::Speed, flying(north, 480.0, 0.0, 1.0), 30.0));
    CHECK(points_at(Quantity::Speed, flying(north, 160.0, 0.0, 1.0), -90.0));
    CHECK(points_at(Quantity::LoadFactor, flying(north, 300.0, 0.0, 2.5), 0.0));
    CHECK(points_at(Quantity::LoadFactor, flying(north, 300.0, 0.0, 5.1), 60.0));
    CHECK(points_at(Quantity::LoadFactor, flying(north, 300.0, 0.0, -4.0), -150.0));
    // 2,750 ft: three quarters of a turn of the long hand, a little over a quarter of the other's.
    CHECK(points_at(Quantity::Altitude, flying(north, 300.0, 2000.0, 1.0), 72.0));
    CHECK(altitude_hand_rad(m_from_ft(2750.0), 1000.0) == Approx(1.5 * pi));
    CHECK(altitude_hand_rad(m_from_ft(2750.0), 10000.0) == Approx(0.55 * pi));
    CHECK(altitude_hand_rad(m_from_ft(-250.0), 1000.0) == Approx(1.5 * pi));
    CHECK_FALSE(points_at(Quantity::Speed, flying(north, 400.0, 0.0, 1.0), 20.0));
}

TEST_CASE("the horizon of the attitude dial lies as the world's does") {
    Panel panel;
    const auto is_sky = [&](const EulerAngles& attitude, const glm::dvec2& radii) {
        const InstrumentReadings inputs = flying(attitude, 300.0, 1000.0, 1.0);
        return is_blue(colour_at(panel.draw(one_dial(Quantity::Attitude), inputs, dial_camera(inputs)), radii));
    };
    const EulerAngles level{};
    CHECK(is_sky(level, {0.3, -0.3}));
    CHECK_FALSE(is_sky(level, {0.3, 0.35}));
    const EulerAngles right_wing_down{0.4, 0.0, rad_from_deg(90.0)};
    CHECK(is_sky(right_wing_down, {-0.35, 0.3}));
    CHECK_FALSE(is_sky(right_wing_down, {0.35, 0.3}));
    const EulerAngles climbing{0.0, rad_from_deg(20.0), 0.0}; // half-way out of 40 degrees
    CHECK(is_sky(climbing, {0.6, 0.35}));
    CHECK_FALSE(is_sky(climbing, {0.6, 0.6}));
    const EulerAngles diving{0.0, rad_from_deg(-85.0), 0.0};
    CHECK_FALSE(is_sky(diving, {0.5, -0.5}));
    CHECK(is_sky(diving, {0.06, -0.78}));
}

TEST_CASE("scales hold the limits of the aircraft and have few round numbers") {
    CHECK(speed_scale_kt(mps_from_kt(800.0)) == DialScale{0.0, 800.0});
    CHECK(speed_scale_kt(mps_from_kt(152.0)) == DialScale{0.0, 160.0});
    CHECK(load_scale_g(-3.0, 7.33) == DialScale{-4.0, 9.0});
    CHECK(load_scale_g(0.3, 2.0) == DialScale{-1.0, 3.0});
    CHECK(label_step(speed_scale_kt(mps_from_kt(390.0))) == 100.0);
    CHECK(label_step({0.0, 8000.0}) == 1000.0);
    CHECK(label_step({0.0, 800.0}) == 100.0);
    CHECK(label_step({0.0, 160.0}) == 40.0);
    CHECK(label_step({-1.0, 3.0}) == 1.0);
    CHECK(scale_hand_rad(2000.0, {0.0, 800.0}) == Approx(rad_from_deg(150.0)));
}

TEST_CASE("dials stay on the panel: a look aside moves them out of the picture") {
    Panel panel;
    const InstrumentReadings inputs = flying({1.0, 0.1, 0.3}, 400.0, 2500.0, 1.0);
    const InstrumentLayout layout = one_dial(Quantity::Heading);
    CHECK_FALSE(panel.draw(layout, inputs, dial_camera(inputs)).indices.empty());
    CHECK_FALSE(panel.draw(layout, inputs, dial_camera(inputs, 20.0)).indices.empty());
    for (const double azimuth_deg : {90.0, 180.0, -60.0}) {
        const Camera camera = dial_camera(inputs, azimuth_deg);
        CHECK(panel.draw(layout, inputs, camera).indices.empty());
    }
}
