#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

using namespace octant;
using namespace octant::tests;

TEST_CASE("back faces of aircraft are not drawn, those of ground and sky are") {
    Studio studio;
    load_squares(studio);
    Triangles turned_away;
    turned_away.add({}, 10.0F, red, false);
    const glm::mat4 flipped = glm::rotate(ahead(10.0F), 3.14159265F, glm::vec3(0.0F, 1.0F, 0.0F));
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = plan_of(turned_away);
        CHECK(middle(studio.picture(plan, mode)) == red_px);
        plan.ground = {};
        set_square(plan, 0, flipped);
        CHECK(middle(studio.picture(plan, mode)) == grey_px);
        set_square(plan, 0, ahead(10.0F));
        CHECK(middle(studio.picture(plan, mode)) == red_px);
        plan = empty_plan();
        plan.sky = turned_away.draw();
        CHECK(middle(studio.picture(plan, mode)) == red_px);
    }
}

TEST_CASE("a polygon whose back is seen by its plane is not drawn, however its corners go round") {
    Studio studio;
    for (const float outwards : {1.0F, -1.0F}) { // as of slivers that the rounding of corners turns
        scene::ModelBuffers model = square_model(red);
        for (scene::ModelVertex& vertex : model.vertices) { vertex.face_normal *= outwards; }
        studio.renderer().load_models({&model, 1});
        scene::FramePlan plan = empty_plan();
        set_square(plan, 0, ahead(10.0F));
        for (const HiddenSurfaceMode mode : all_modes) {
            CHECK(middle(studio.picture(plan, mode)) == (outwards > 0.0F ? red_px : grey_px));
        }
    }
}

TEST_CASE("which way a sliver of an aircraft faces is told by its corners as they are rounded") {
    // From the middle of a pixel, in 1/256 of it. As they are the corners go round clockwise, when they are rounded the
    // other way, and the triangle covers the middle.
    Studio studio;
    const glm::vec2 middle_px(40.5F, 30.5F);
    scene::ModelBuffers model;
    for (const glm::vec2 at : {glm::vec2(-56.4F, -1.6F), {-49.28F, -1.46F}, {94.6F, 2.0F}}) {
        const glm::vec2 shares = (middle_px + at / 256.0F) / (0.5F * side_px) - 1.0F;
        model.vertices.push_back(square_model(red).vertices.front());
        model.vertices.back().position_m = glm::vec3(shares.x, -shares.y, 0.0F);
    }
    model.indices = {0, 1, 2};
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    set_square(plan, 0, ahead(1.0F));
    plan.aircraft.front().index_count = 3;
    const auto picture = studio.picture(plan);
    CHECK(pixel(picture, 40, 30) == red_px);
    CHECK(count_of(picture, red_px) == 1);
}

TEST_CASE("with depth an aircraft behind a wall of ground is hidden, else it is painted over it") {
    Studio studio;
    load_squares(studio);
    Triangles wall;
    wall.add({}, 20.0F, blue);
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = plan_of(wall);
        set_square(plan, 0, ahead(20.5F));
        CHECK(middle(studio.picture(plan, mode)) == (mode == HiddenSurfaceMode::ByDepth ? blue_px : red_px));
        set_square(plan, 0, ahead(19.5F));
        CHECK(middle(studio.picture(plan, mode)) == red_px);
        CHECK(pixel(studio.picture(plan, mode), 0, 0) == blue_px);
    }
}

TEST_CASE("of aircraft the last in the list is on top, unless depth decides") {
    Studio studio;
    load_squares(studio);
    for (const bool nearer_first : {true, false}) {
        scene::FramePlan plan = empty_plan();
        add_square(plan, nearer_first ? 0 : 1, ahead(nearer_first ? 10.0F : 12.0F));
        add_square(plan, nearer_first ? 1 : 0, ahead(nearer_first ? 12.0F : 10.0F));
        for (const HiddenSurfaceMode mode : all_modes) {
            const bool red_is_seen = mode == HiddenSurfaceMode::ByDepth || !nearer_first;
            CHECK(middle(studio.picture(plan, mode)) == (red_is_seen ? red_px : green_px));
        }
    }
}

TEST_CASE("within an aircraft the last polygon is on top, unless depth decides") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    scene::ModelBuffers behind = square_model(green);
    for (scene::ModelVertex& vertex : behind.vertices) { vertex.position_m.z = -0.25F; }
    append(model, behind);
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    add_square(plan, 0, ahead(10.0F));
    plan.aircraft[0].index_count = 12;
    CHECK(middle(studio.picture(plan)) == green_px);
    CHECK(middle(studio.picture(plan, HiddenSurfaceMode::ByDepth)) == red_px);
}

TEST_CASE("an aircraft is drawn from its own model and its own range of indices") {
    Studio studio;
    scene::ModelBuffers two_colours = square_model(red);
    const scene::ModelBuffers other = square_model(blue);
    append(two_colours, other);
    const std::array<scene::ModelBuffers, 2> models{square_model(green), two_colours};
    studio.renderer().load_models(models);
    scene::FramePlan plan = empty_plan();
    add_square(plan, 1, ahead(10.0F));
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.aircraft[0].first_index = 6;
    CHECK(middle(studio.picture(plan)) == blue_px);
    set_square(plan, 0, ahead(10.0F));
    CHECK(middle(studio.picture(plan)) == green_px);
    studio.renderer().load_models({&other, 1});
    CHECK(middle(studio.picture(plan)) == blue_px);
}

TEST_CASE("an aircraft of several ranges is drawn by them in their order") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    for (const auto& colour : {green, blue}) { append(model, square_model(colour)); }
    const std::array<scene::ModelBuffers, 2> models{square_model(green), model};
    studio.renderer().load_models(models);
    scene::FramePlan plan = empty_plan();
    add_square(plan, 1, ahead(10.0F));
    const std::array<scene::IndexRange, 2> blue_last{{{0, 6, 1, 0}, {12, 6, 1, 2}}};
    plan.aircraft[0].ranges = blue_last;
    CHECK(middle(studio.picture(plan)) == blue_px);
    const std::array<scene::IndexRange, 2> red_last{{{6, 12, 2, 1}, {0, 6, 1, 0}}};
    plan.aircraft[0].ranges = red_last;
    CHECK(middle(studio.picture(plan)) == red_px);
    add_square(plan, 0, ahead(9.0F)); // beside one that has a range only
    CHECK(middle(studio.picture(plan)) == green_px);
}

TEST_CASE("each part of an aircraft turns with its own matrix") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    scene::ModelBuffers blade = square_model(green);
    for (scene::ModelVertex& vertex : blade.vertices) {
        vertex.position_m *= glm::vec3(0.2F, 1.0F, 1.0F);
        vertex.part = 1;
    }
    append(model, blade);
    const std::array<scene::ModelBuffers, 2> models{square_model(blue), model};
    studio.renderer().load_models(models);
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = empty_plan();
        add_square(plan, 0, glm::translate(ahead(4.0F), glm::vec3(-3.0F, 0.0F, 0.0F)));
        add_square(plan, 1, ahead(4.0F));
        plan.aircraft[1].index_count = 12;
        plan.parts.push_back(ahead(3.9F));
        const scene::Picture upright = studio.picture(plan, mode);
        CHECK(pixel(upright, 0, 32) == blue_px);
        CHECK(middle(upright) == green_px);
        CHECK(pixel(upright, 32, 26) == green_px);
        CHECK(pixel(upright, 26, 32) == red_px);
        plan.parts[2] = glm::rotate(plan.parts[2], 1.57079633F, glm::vec3(0.0F, 0.0F, 1.0F));
        const scene::Picture turned = studio.picture(plan, mode);
        CHECK(middle(turned) == green_px);
        CHECK(pixel(turned, 32, 26) == red_px);
        CHECK(pixel(turned, 26, 32) == green_px);
    }
}

TEST_CASE("aircraft drawn together give the picture of those drawn one by one") {
    Studio studio;
    load_squares(studio);
    scene::FramePlan together = empty_plan();
    for (int i = 0; i < 60; ++i) {
        const auto turn = static_cast<float>(i);
        const glm::vec3 aside(3.0F * std::sin(2.4F * turn), 3.0F * std::cos(2.4F * turn), 0.0F);
        add_square(together, static_cast<std::uint32_t>(i % 3), glm::translate(ahead(12.0F - 0.1F * turn), aside));
    }
    scene::FramePlan apart = together;
    apart.steps.clear();
    for (std::uint32_t i = 0; i < 60; ++i) {
        apart.steps.push_back({scene::PaintStep::Content::Aircraft, i, 1, scene::PaintStep::no_clip});
    }
    const scene::Picture picture = studio.picture(together);
    CHECK((studio.picture(apart).rgba == picture.rgba));
    // They do not cross, so depth finds the same; its order within models changes nothing.
    CHECK((studio.picture(together, HiddenSurfaceMode::ByDepth).rgba == picture.rgba));
}
