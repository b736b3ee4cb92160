#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace octant;
using namespace octant::tests;

TEST_CASE("an empty plan gives the background everywhere") {
    Studio studio;
    const scene::Picture picture = studio.picture(empty_plan());
    CHECK(picture.width == side_px);
    CHECK(picture.height == side_px);
    REQUIRE(picture.rgba.size() == 4U * side_px * side_px);
    CHECK(pixel(picture, 0, 0) == grey_px);
    CHECK(pixel(picture, side_px - 1, side_px - 1) == grey_px);
}

TEST_CASE("the first row of the picture is its top, the first column its left") {
    Studio studio;
    Triangles ground;
    ground.add({-1.0F, 0.0F, 1.0F, 1.0F}, 100.0F, red).add({-1.0F, -1.0F, 0.0F, 0.0F}, 100.0F, green);
    scene::FramePlan plan = plan_of(ground);
    const scene::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 0, 0) == red_px);
    CHECK(pixel(picture, 63, 31) == red_px);
    CHECK(pixel(picture, 0, 32) == green_px);
    CHECK(pixel(picture, 31, 63) == green_px);
    CHECK(pixel(picture, 32, 32) == grey_px);
}

TEST_CASE("with depth a nearer ground triangle hides a farther one, whichever is drawn first") {
    Studio studio;
    for (const bool nearer_first : {true, false}) {
        Triangles ground;
        ground.add({}, nearer_first ? 10.0F : 20.0F, nearer_first ? red : green)
            .add({}, nearer_first ? 20.0F : 10.0F, nearer_first ? green : red);
        scene::FramePlan plan = plan_of(ground);
        CHECK(middle(studio.picture(plan, HiddenSurfaceMode::ByDepth)) == red_px);
    }
}

TEST_CASE("without depth the ground is painted in its order, whatever is nearer") {
    Studio studio;
    Triangles ground;
    ground.add({}, 10.0F, red).add({}, 20.0F, green);
    scene::FramePlan plan = plan_of(ground);
    CHECK(middle(studio.picture(plan)) == green_px);
}

// Depth is 0.5 / distance: 1 cm at 5 km changes it by 2e-10, and floats there are 7e-12 apart. The distances themselves
// are known to half a millimetre (floats at 5 km are 0.5 mm apart).
TEST_CASE("reversed depth tells 1 cm apart at 5 km") {
    Studio studio;
    for (const bool nearer_first : {true, false}) {
        Triangles ground;
        ground.add({}, nearer_first ? 5000.0F : 5000.01F, nearer_first ? red : green)
            .add({}, nearer_first ? 5000.01F : 5000.0F, nearer_first ? green : red);
        scene::FramePlan plan = plan_of(ground);
        const scene::Picture picture = studio.picture(plan, HiddenSurfaceMode::ByDepth);
        CHECK(count_of(picture, red_px) == side_px * side_px);
    }
}

TEST_CASE("what is nearer than the near plane is cut off, what is a million km away is not") {
    Studio studio;
    Triangles ground;
    ground.add({-1.0F, -1.0F, 0.0F, 1.0F}, 0.4F, red).add({0.0F, -1.0F, 1.0F, 1.0F}, 1e9F, green);
    scene::FramePlan plan = plan_of(ground);
    const scene::Picture picture = studio.picture(plan, HiddenSurfaceMode::ByDepth);
    CHECK(pixel(picture, 10, 32) == grey_px);
    CHECK(pixel(picture, 50, 32) == green_px);
}

TEST_CASE("the sky is behind everything, however near its triangles are") {
    Studio studio;
    load_squares(studio);
    Triangles sky;
    Triangles ground;
    sky.add({}, 1.0F, blue);
    ground.add({-1.0F, -1.0F, 1.0F, 0.0F}, 1e6F, green);
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = empty_plan();
        plan.sky = sky.draw();
        plan.ground = ground.draw();
        add_square(plan, 0, ahead(4.0F));
        const scene::Picture picture = studio.picture(plan, mode);
        CHECK(pixel(picture, 32, 0) == blue_px);
        CHECK(pixel(picture, 32, 63) == green_px);
        CHECK(middle(picture) == red_px);
    }
}

TEST_CASE("four samples a pixel soften an edge, one does not") {
    Triangles ground;
    ground.add({-0.4F, -0.5F, 0.5F, 0.5F}, 10.0F, red);
    ground.vertices[0].position_m.x += 3.0F; // a slanted left edge
    scene::FramePlan plan = empty_plan();
    plan.background = glm::vec3(0.0F);
    plan.ground = ground.draw();
    for (const int samples : {1, 4}) {
        Studio studio(gl::make_osmesa_context(), samples);
        const scene::Picture picture = studio.picture(plan);
        std::set<int> reds;
        for (int row = 0; row < side_px; ++row) {
            for (int column = 0; column < side_px; ++column) { reds.insert(pixel(picture, column, row)[0]); }
        }
        const std::set<int> shares{0, 64, 128, 191, 255};
        CHECK(std::includes(shares.begin(), shares.end(), reds.begin(), reds.end()));
        CHECK((reds.size() > 2) == (samples == 4));
    }
}

TEST_CASE("the same plan gives the same bytes again, also after warming up") {
    Studio studio;
    const std::uint64_t hash = hash_of_full_scene(studio);
    CHECK(hash_of_full_scene(studio) == hash);
    studio.renderer().warm_up();
    CHECK(hash_of_full_scene(studio) == hash);
    Studio warm;
    warm.renderer().warm_up();
    CHECK(hash_of_full_scene(warm) == hash);
}

TEST_CASE("a picture's memory is kept from frame to frame") {
    Studio studio;
    scene::Picture picture;
    studio.renderer().draw(empty_plan());
    studio.renderer().finish_and_read(picture);
    const auto* const before = picture.rgba.data();
    studio.renderer().draw(empty_plan());
    studio.renderer().finish_and_read(picture);
    CHECK(picture.rgba.data() == before);
}
