#include "ui/window/look_control.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant;
using visuals::scene::Settings;
using visuals::scene::View;

TEST_CASE("a drag turns the look by its share of the window's height, up to straight up") {
    Settings settings;
    settings.view = View::Cockpit;
    const Settings turned = ui::window::dragged(settings, {0.5F, 0.1F});
    CHECK(turned.azimuth_deg == Approx(-90.0));
    CHECK(turned.elevation_deg == Approx(18.0));
    CHECK(ui::window::dragged(settings, {0.0F, 5.0F}).elevation_deg == Approx(89.0));
}

TEST_CASE("the wheel zooms in and out within limits") {
    Settings settings;
    CHECK(ui::window::zoomed(settings, 1.0).zoom > 1.1);
    CHECK(ui::window::zoomed(settings, 1000.0).zoom == Approx(50.0));
    CHECK(ui::window::zoomed(settings, -1000.0).zoom == Approx(0.1));
}

TEST_CASE("the free camera begins at the last eye point and other views forget it") {
    visuals::scene::Camera camera;
    camera.eye_m = {1.0, 2.0, 3.0};
    const Settings free = ui::window::with_view(Settings(), View::Free, camera);
    REQUIRE(free.eye_m);
    CHECK(*free.eye_m == camera.eye_m);
    const Settings moved = ui::window::moved(free, {.right = 0, .up = 1, .ahead = 0, .fast = false}, 0.5);
    CHECK(moved.eye_m->z > 3.0);
    CHECK(
        glm::length(*moved.look_m - *moved.eye_m) ==
        Approx(glm::length(*free.look_m - *free.eye_m)));
    CHECK_FALSE(ui::window::with_view(free, View::Chase, camera).eye_m);
}
