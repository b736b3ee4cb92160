#include "ui/world/scene_ground.h"

#include <catch2/catch.hpp>

using namespace octant::ui::world;

TEST_CASE("an eye point under the ground is told with one above it") {
    const auto note = low_eye_note({100.0, -200.0, 300.0}, 512.4);
    REQUIRE(note);
    CHECK(*note == "--eye 100,-200,300 lies 212.4 m under the ground, which is 512.4 m high there: "
                   "--eye 100,-200,515 lies above it");
    CHECK_FALSE(low_eye_note({100.0, -200.0, 512.5}, 512.4));
    CHECK_FALSE(low_eye_note({1e6, 0.0, -5.0}, std::nullopt)); // off the map
}

TEST_CASE("a map whose samples make too few triangles is told") {
    const auto note = few_samples_note("map.tif", {60, 60}, 20000, "--triangles with fewer");
    REQUIRE(note);
    CHECK(*note == "map.tif: 60 x 60 samples make at most 6962 triangles, and 20000 are asked for: "
                   "--triangles with fewer");
    CHECK_FALSE(few_samples_note("map.tif", {101, 101}, 20000, ""));
}
