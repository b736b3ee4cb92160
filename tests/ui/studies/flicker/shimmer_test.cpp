#include "models/procedural/procedural_terrain.h"
#include "ui/studies/flicker/study_popping.h"
#include "ui/terrain/terrain_check.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace octant;
using namespace octant::ui::studies::flicker;
using namespace octant::ui::terrain;

namespace {

FlightCamera looking_down(double east_m) {
    FlightCamera frame;
    frame.camera = visuals::scene::camera_looking_at({east_m, 0.0, 1000.0}, {east_m, 0.0, 0.0});
    frame.aircraft_m = {0.0, 0.0, 1e6};
    return frame;
}

const models::heights::HeightField& level() {
    static const models::heights::HeightField field(101, 101, 100.0, std::vector<float>(std::size_t{101} * 101, 0.0F));
    return field;
}

} // namespace

TEST_CASE("ground seen from above moves across the picture as far as the eye does") {
    const visuals::terrain::GroundSamples ground(level());
    const glm::ivec2 size_px(160, 120);
    const double focal_px = 60.0 / std::tan(0.5 * looking_down(0.0).camera.vertical_fov_rad);
    const double east_m = 1000.0 / focal_px * 2.5; // two and a half pixels
    const auto matches = reprojected_pixels(ground, looking_down(0.0), looking_down(east_m), size_px, 0.0);
    REQUIRE(matches.size() > 1000);
    for (const ReprojectedPixel& place : matches) {
        CHECK(place.before.x == Approx(place.pixel.x + 2.5).margin(1e-6));
        CHECK(place.before.y == Approx(place.pixel.y).margin(1e-6));
    }
}

TEST_CASE("a picture that moves with the ground does not change; another does") {
    const visuals::terrain::GroundSamples ground(level());
    const glm::ivec2 size_px(160, 120);
    const double focal_px = 60.0 / std::tan(0.5 * looking_down(0.0).camera.vertical_fov_rad);
    const auto matches = reprojected_pixels(ground, looking_down(0.0), looking_down(1000.0 / focal_px), size_px, 0.0);
    const auto ramp = [&](int offset) {
        visuals::scene::Picture picture;
        picture.width = size_px.x;
        picture.height = size_px.y;
        for (int k = 0; k < size_px.x * size_px.y; ++k) {
            const auto grey = static_cast<std::uint8_t>(k % size_px.x + offset);
            picture.rgba.insert(picture.rgba.end(), {grey, grey, grey, 255});
        }
        return picture;
    };
    CHECK(mean_change(ramp(0), ramp(1), matches) == Approx(0.0).margin(1e-6));
    CHECK(mean_change(ramp(0), ramp(4), matches) == Approx(3.0).margin(1e-6));
    CHECK(mean_change(ramp(0), ramp(4), {}) == 0.0);
}

TEST_CASE("a random view depends on its seed and number alone") {
    const visuals::terrain::GroundSamples ground(level());
    const RandomView one = random_view(ground, true, 7, 3);
    const RandomView same = random_view(ground, true, 7, 3);
    const RandomView next = random_view(ground, true, 7, 4);
    CHECK(one.camera.eye_m == same.camera.eye_m);
    CHECK(one.coarseness == same.coarseness);
    CHECK(one.camera.eye_m != next.camera.eye_m);
    int beside = 0;
    for (std::uint64_t k = 0; k < 1000; ++k) {
        const RandomView view = random_view(ground, true, 1, k);
        const bool on_map =
            visuals::terrain::GroundSamples(level()).half_extent_m().x >= std::abs(view.camera.eye_m.x) &&
            5000.0 >= std::abs(view.camera.eye_m.y);
        beside += on_map ? 0 : 1;
        CHECK(view.camera.eye_m.z >= 2.0 - 1e-9);
        CHECK(view.camera.eye_m.z <= 20000.0 + 1e-6);
    }
    CHECK(beside > 80);
}
