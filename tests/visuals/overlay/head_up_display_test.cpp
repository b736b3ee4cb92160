#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/overlay/overlay.h"
#include "visuals/scene/camera_rig.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "overlay_ink.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr glm::ivec2 size_px(1280, 720);

InstrumentReadings flying(const EulerAngles& attitude, double speed_mps, double climb_rad) {
    InstrumentReadings inputs;
    inputs.state.body_to_world = body_to_world_from_euler(attitude);
    inputs.state.velocity_mps = speed_mps * (std::cos(climb_rad) * direction_from_heading(attitude.heading_rad) +
                                                glm::dvec3(0.0, 0.0, std::sin(climb_rad)));
    inputs.height_m = 1000.0;
    inputs.height_above_ground_m = 200.0;
    return inputs;
}

const InstrumentReadings level = flying({1.0, 0.0, 0.0}, 100.0, 0.0);

Camera cockpit_camera(const InstrumentReadings& inputs, double azimuth_deg = 0, double elevation_deg = 0) {
    Settings settings;
    settings.view.kind = View::Cockpit;
    settings.view.azimuth_deg = azimuth_deg;
    settings.view.elevation_deg = elevation_deg;
    const GroundHeight no_ground = [](double, double) { return std::optional<double>(); };
    return camera_of(settings.view, inputs.state, {}, {}, {}, no_ground);
}

/// Where the renderer shows a direction of the world.
glm::vec2 seen_at(const Camera& camera, const glm::dvec3& direction) {
    const double aspect = static_cast<double>(size_px.x) / size_px.y;
    const glm::vec4 clip = view_to_clip(camera, aspect) * world_to_view(camera) * glm::vec4(glm::vec3(direction), 0.0F);
    const glm::vec2 share = glm::vec2(clip) / clip.w;
    return glm::vec2(0.5F + 0.5F * share.x, 0.5F - 0.5F * share.y) * glm::vec2(size_px);
}

std::vector<glm::vec2> places(const OverlayDraw& draw) {
    std::vector<glm::vec2> places;
    for (const OverlayVertex& vertex : draw.vertices) { places.push_back(vertex.at_px); }
    return places;
}

std::vector<glm::vec2> drawn_places(const InstrumentReadings& inputs) {
    OverlayCanvas display;
    return places(draw_head_up_display(display, inputs, cockpit_camera(inputs), size_px));
}

} // namespace

TEST_CASE("the horizon lies on the world's in any bank, climb and look") {
    OverlayCanvas display;
    for (const double roll_rad : {0.0, 0.9, -2.4}) {
        for (const double pitch_rad : {0.0, 0.12, -0.1}) {
            const InstrumentReadings inputs = flying({1.0, pitch_rad, roll_rad}, 200.0, pitch_rad);
            for (const double look_deg : {0.0, 14.0}) {
                const Camera camera = cockpit_camera(inputs, look_deg, -0.5 * look_deg);
                const OverlayDraw draw = draw_head_up_display(display, inputs, camera, size_px);
                for (const double aside_rad : {-0.06, 0.06}) {
                    const glm::dvec3 far = direction_from_heading(1.0 + aside_rad);
                    INFO(roll_rad << " " << pitch_rad << " " << look_deg);
                    CHECK(ink_at(draw, seen_at(camera, far)) > 0.9);
                }
            }
        }
    }
}

TEST_CASE("a rung lies at its pitch, whole above the horizon and dashed below") {
    OverlayCanvas display;
    const Camera camera = cockpit_camera(level);
    const OverlayDraw draw = draw_head_up_display(display, level, camera, size_px);
    const glm::dvec3 level_ahead = direction_from_heading(1.0);
    const glm::dvec3 level_right = direction_from_heading(1.0 + 0.5 * pi);
    const auto ink_along = [&](double pitch_deg) {
        int inked = 0;
        for (int i = 0; i < 40; ++i) {
            const double aside = 0.035 + 0.055 * i / 40.0;
            const glm::dvec3 rung =
                level_ahead + aside * level_right + glm::dvec3(0, 0, std::tan(rad_from_deg(pitch_deg)));
            inked += ink_at(draw, seen_at(camera, rung)) > 0.5 ? 1 : 0;
        }
        return inked;
    };
    CHECK(ink_along(5.0) == 40);
    CHECK(ink_along(10.0) == 40);
    CHECK(ink_along(7.0) == 0);
    CHECK((ink_along(-5.0) > 15 && ink_along(-5.0) < 35));
}

TEST_CASE("the flight-path marker rings where the flight goes") {
    OverlayCanvas display;
    for (const double roll_rad : {0.0, 1.2, 3.0}) {
        const InstrumentReadings inputs = flying({1.0, 0.12, roll_rad}, 200.0, 0.05);
        const Camera camera = cockpit_camera(inputs);
        const OverlayDraw draw = draw_head_up_display(display, inputs, camera, size_px);
        const glm::vec2 at = seen_at(camera, inputs.state.velocity_mps);
        const auto radius = 0.0115F * static_cast<float>(size_px.y);
        int ring = 0;
        for (int i = 0; i < 16; ++i) {
            const auto angle_rad = static_cast<float>(0.2 + i * pi / 8.0);
            ring += ink_at(draw, at + radius * glm::vec2(std::cos(angle_rad), std::sin(angle_rad))) > 0.5 ? 1 : 0;
        }
        CHECK(ring == 16);
    }
}

TEST_CASE("a flight path beyond the display is marked at its edge, one behind not at all") {
    const auto farthest_down = [](const InstrumentReadings& inputs) {
        float most = 0.0F;
        for (const glm::vec2& place : drawn_places(inputs)) { most = std::max(most, place.y); }
        return most;
    };
    const InstrumentReadings falling = flying({1.0, 0.0, 0.0}, 100.0, -0.6);
    CHECK(farthest_down(falling) < 0.86F * static_cast<float>(size_px.y));
    const InstrumentReadings backing = flying({1.0, 0.0, 0.0}, -20.0, 0.0);
    const InstrumentReadings still = flying({1.0, 0.0, 0.0}, 0.0, 0.0);
    CHECK(drawn_places(falling).size() > drawn_places(level).size()); // crossed out
    CHECK(drawn_places(backing).size() < drawn_places(level).size());
    CHECK(drawn_places(still).size() < drawn_places(level).size());
}

TEST_CASE("speed is shown in whole knots, height in tens of feet, load in tenths") {
    InstrumentReadings inputs = level;
    inputs.state.velocity_mps *= mps_from_kt(90.2) / 100.0;
    const auto as_shown = drawn_places(inputs);
    InstrumentReadings other = inputs;
    other.state.velocity_mps *= 90.4 / 90.2;
    other.height_m += m_from_ft(0.5);
    other.state.load_factor = 1.02;
    CHECK(drawn_places(other) == as_shown);
    other.state.velocity_mps *= 91.2 / 90.4;
    CHECK(drawn_places(other) != as_shown);
    other = inputs;
    other.height_m += m_from_ft(10.0);
    CHECK(drawn_places(other) != as_shown);
    other = inputs;
    other.state.load_factor = 1.1;
    CHECK(drawn_places(other) != as_shown);
    other = inputs;
    other.height_above_ground_m.reset();
    CHECK(drawn_places(other).size() < as_shown.size());
}

TEST_CASE("the display stays ahead of the pilot: a look aside moves it out of the picture") {
    OverlayCanvas display;
    const auto middle_x = [&](double azimuth_deg) {
        const auto drawn = places(draw_head_up_display(display, level, cockpit_camera(level, azimuth_deg), size_px));
        float least = std::numeric_limits<float>::max();
        float most = std::numeric_limits<float>::lowest();
        for (const glm::vec2& place : drawn) {
            least = std::min(least, place.x);
            most = std::max(most, place.x);
        }
        return 0.5F * (least + most);
    };
    CHECK(middle_x(0.0) == Approx(640.0).margin(20.0));
    CHECK(middle_x(15.0) < 450.0F);
    CHECK(middle_x(-15.0) > 830.0F);
    for (const double azimuth_deg : {80.0, 180.0, -120.0}) {
        CHECK(draw_head_up_display(display, level, cockpit_camera(level, azimuth_deg), size_px).indices.empty());
    }
}

TEST_CASE("the display is as large in a larger picture, and drawn at all in a small one") {
    OverlayCanvas display;
    const auto width_share = [&](const glm::ivec2& size) {
        float most = 0.0F;
        for (const glm::vec2& place : places(draw_head_up_display(display, level, cockpit_camera(level), size))) {
            most = std::max(most, std::abs(place.x - 0.5F * static_cast<float>(size.x)));
        }
        return most / static_cast<float>(size.y);
    };
    CHECK(width_share({2560, 1440}) == Approx(width_share(size_px)).margin(0.005));
    CHECK(width_share({1920, 1080}) == Approx(width_share(size_px)).margin(0.005));
    CHECK(width_share({640, 360}) == Approx(width_share(size_px)).margin(0.01));
    CHECK(width_share({160, 120}) > 0.2F);
}

TEST_CASE("straight up and straight down something is drawn, all of it finite") {
    OverlayCanvas display;
    for (const double pitch_deg : {90.0, 89.9, -90.0, 85.0, -84.0}) {
        const InstrumentReadings inputs = flying({1.0, rad_from_deg(pitch_deg), 0.3}, 200.0, rad_from_deg(pitch_deg));
        const auto drawn = places(draw_head_up_display(display, inputs, cockpit_camera(inputs), size_px));
        CHECK(drawn.size() > 500);
        CHECK(std::ranges::all_of(
            drawn, [](const glm::vec2& place) { return std::abs(place.x) < 2000.0F && std::abs(place.y) < 2000.0F; }));
    }
}
