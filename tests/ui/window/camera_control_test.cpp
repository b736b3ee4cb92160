#include "ui/window/camera_control.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant;
using ui::settings::RunSettings;
using visuals::scene::View;

TEST_CASE("a drag turns the look by its share of the window's height, up to straight up") {
    RunSettings settings;
    settings.view.kind = View::Cockpit;
    const RunSettings turned = ui::window::dragged(settings, {0.5F, 0.1F});
    CHECK(turned.view.azimuth_deg == Approx(-90.0));
    CHECK(turned.view.elevation_deg == Approx(18.0));
    CHECK(ui::window::dragged(settings, {0.0F, 5.0F}).view.elevation_deg == Approx(89.0));
}

TEST_CASE("the wheel zooms in and out within limits") {
    RunSettings settings;
    CHECK(ui::window::zoomed(settings, 1.0).view.zoom > 1.1);
    CHECK(ui::window::zoomed(settings, 1000.0).view.zoom == Approx(50.0));
    CHECK(ui::window::zoomed(settings, -1000.0).view.zoom == Approx(0.1));
}

TEST_CASE("the free camera begins at the last eye point and other views forget it") {
    visuals::scene::Camera camera;
    camera.eye_m = {1.0, 2.0, 3.0};
    const RunSettings free = ui::window::with_view(RunSettings(), View::Free, camera);
    REQUIRE(free.view.eye_m);
    CHECK(*free.view.eye_m == camera.eye_m);
    const RunSettings moved = ui::window::moved(free, {.right = 0, .up = 1, .ahead = 0, .fast = false}, 0.5);
    CHECK(moved.view.eye_m->z > 3.0);
    CHECK(glm::length(*moved.view.look_m - *moved.view.eye_m) ==
          Approx(glm::length(*free.view.look_m - *free.view.eye_m)));
    CHECK_FALSE(ui::window::with_view(free, View::Chase, camera).view.eye_m);
}
