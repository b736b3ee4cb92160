#include "sim/base/random_generator.h"
#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cstdlib>

using namespace octant;
using namespace octant::tests;
using scene::PaintStep;
using Content = scene::PaintStep::Content;

namespace {

constexpr std::uint32_t whole = PaintStep::no_clip;

/// A plane through the line x = `offset` of the picture 10 m ahead; what is to the right is drawn.
scene::Clip right_of(float offset) {
    scene::Clip clip;
    clip.planes[0] = glm::vec4(1.0F, 0.0F, 0.0F, -10.0F * offset);
    clip.count = 1;
    return clip;
}

/// Green ground 10 m ahead that fills the picture, and red and blue squares of 2 m over its middle, drawn 32 and 16
/// pixels wide.
struct Overlapping {
    Triangles ground;
    scene::FramePlan plan = empty_plan();

    explicit Overlapping(Studio& studio) {
        load_squares(studio);
        ground.add({}, 10.0F, green);
        plan.ground = ground.draw();
        plan.repaint_indices = ground.indices;
        add_square(plan, 0, glm::scale(ahead(10.0F), glm::vec3(5.0F, 5.0F, 1.0F)));
        add_square(plan, 2, glm::scale(ahead(10.0F), glm::vec3(2.5F, 2.5F, 1.0F)));
    }
};

} // namespace

TEST_CASE("aircraft and ground are painted in the order of the steps") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.steps = {{Content::Aircraft, 0, 2, whole}};
    CHECK(middle(studio.picture(scene.plan)) == blue_px);
    scene.plan.steps = {{Content::Aircraft, 1, 1, whole}, {Content::Aircraft, 0, 1, whole}};
    CHECK(middle(studio.picture(scene.plan)) == red_px);
    scene.plan.steps = {{Content::Aircraft, 0, 2, whole}, {Content::GroundRepaint, 0, 6, whole}};
    CHECK(count_of(studio.picture(scene.plan), green_px) == side_px * side_px);
    scene.plan.steps = {
        {Content::Aircraft, 0, 1, whole}, {Content::GroundRepaint, 0, 6, whole}, {Content::Aircraft, 1, 1, whole}};
    const scene::Picture picture = studio.picture(scene.plan);
    CHECK(count_of(picture, blue_px) == 16 * 16);
    CHECK(count_of(picture, red_px) == 0);
}

TEST_CASE("a transparent surface is blended where it is nearest and hides nothing by its depth") {
    Studio studio;
    load_squares(studio, true);
    scene::FramePlan plan = empty_plan();
    add_square(plan, 0, glm::scale(ahead(4.0F), glm::vec3(4.0F, 4.0F, 1.0F)));
    add_square(plan, 2, glm::scale(ahead(1.0F), glm::vec3(0.25F, 0.25F, 1.0F)));
    add_square(plan, 1, ahead(2.0F));
    add_square(plan, 2, glm::scale(ahead(3.0F), glm::vec3(3.0F, 0.25F, 1.0F)));
    plan.depth_boxes = {{glm::ivec2(0), glm::ivec2(side_px)}};
    using scene::DepthUse;
    plan.steps = {{Content::ClearDepth, 0, 1}, {Content::Aircraft, 0, 2, whole, DepthUse::Nearest},
        {Content::Aircraft, 2, 1, whole, DepthUse::Nearest, 0.25F},
        {Content::Aircraft, 3, 1, whole, DepthUse::Nearest}};
    const scene::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 4, 4) == red_px);
    CHECK(pixel(picture, 18, 20) == Pixel{191, 64, 0, 255});
    CHECK(pixel(picture, 32, 32) == blue_px); // nearer than the transparent one
    CHECK(pixel(picture, 18, 32) == blue_px); // farther, drawn after it
}

TEST_CASE("only the named ground triangles are painted again") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.steps = {{Content::Aircraft, 0, 1, whole}, {Content::GroundRepaint, 3, 3, whole}};
    const scene::Picture picture = studio.picture(scene.plan);
    CHECK(pixel(picture, 40, 36) == red_px);
    CHECK(pixel(picture, 24, 28) == green_px);
}

TEST_CASE("a shadow piece is painted again like the ground it counts on after") {
    Studio studio;
    Overlapping scene(studio);
    Triangles shadow;
    shadow.add({-0.25F, -0.25F, 0.25F, 0.25F}, 10.0F, grey);
    scene.plan.shadow_vertices = shadow.vertices;
    scene.plan.repaint_indices.clear();
    for (const std::uint32_t corner : shadow.indices) { scene.plan.repaint_indices.push_back(corner + 4); }
    scene.plan.steps = {{Content::Aircraft, 0, 1, whole}, {Content::GroundRepaint, 0, 6, whole}};
    const scene::Picture picture = studio.picture(scene.plan);
    CHECK(count_of(picture, grey_px) == 16 * 16);
    CHECK(count_of(picture, red_px) == 32 * 32 - 16 * 16);
}

TEST_CASE("a clip cuts an aircraft's draw and that of the ground at its plane, and no other") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.clips = {right_of(0.0F), right_of(0.125F)};
    scene.plan.steps = {
        {Content::Aircraft, 0, 1, 0}, {Content::GroundRepaint, 0, 6, 1}, {Content::Aircraft, 1, 1, whole}};
    const scene::Picture picture = studio.picture(scene.plan);
    CHECK(count_of(picture, red_px) == 4 * 8 * 2); // columns 32 to 35, rows outside the blue ones
    CHECK(pixel(picture, 31, 18) == green_px);
    CHECK(pixel(picture, 32, 18) == red_px);
    CHECK(pixel(picture, 35, 18) == red_px);
    CHECK(pixel(picture, 36, 18) == green_px);
    CHECK(count_of(picture, blue_px) == 16 * 16);
}

TEST_CASE("up to eight planes cut a draw, each by its own offset") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.steps = {{Content::Aircraft, 0, 1, 0}};
    scene::Clip octagon;
    octagon.planes = {glm::vec4(1.0F, 0.0F, 0.0F, 3.75F), glm::vec4(-1.0F, 0.0F, 0.0F, 2.5F),
        glm::vec4(0.0F, 1.0F, 0.0F, 1.25F), glm::vec4(0.0F, -1.0F, 0.0F, 3.125F), glm::vec4(1.0F, 1.0F, 0.0F, 100.0F),
        glm::vec4(0.0F, 0.0F, 1.0F, 11.0F), glm::vec4(0.0F, 0.0F, -1.0F, -9.0F), glm::vec4(-1.0F, 0.0F, 0.0F, 1.25F)};
    for (const auto& [count, columns] : {std::pair(8, 12 + 4), {7, 12 + 8}, {1, 12 + 16}}) {
        octagon.count = count;
        scene.plan.clips = {octagon};
        const int rows = count > 3 ? 4 + 10 : 32;
        CHECK(count_of(studio.picture(scene.plan), red_px) == columns * rows);
    }
    octagon.planes[4].w = -100.0F;
    octagon.count = 8;
    scene.plan.clips = {octagon};
    CHECK(count_of(studio.picture(scene.plan), red_px) == 0);
}

TEST_CASE("planes lie in world axes whichever way the eye looks") {
    Studio studio;
    Overlapping scene(studio);
    const glm::mat4 world_to_view = glm::rotate(glm::mat4(1.0F), 1.2F, glm::vec3(0.0F, 1.0F, 0.0F));
    const glm::mat4 view_to_world = glm::transpose(world_to_view);
    scene.plan.world_to_view = world_to_view;
    scene.plan.ground = {};
    for (glm::mat4& part : scene.plan.parts) { part = view_to_world * part; }
    scene::Clip clip = right_of(0.125F);
    clip.planes[0] = view_to_world * clip.planes[0];
    scene.plan.clips = {clip};
    scene.plan.steps = {{Content::Aircraft, 0, 1, 0}};
    const scene::Picture picture = studio.picture(scene.plan);
    CHECK(pixel(picture, 35, 32) == grey_px);
    CHECK(pixel(picture, 36, 32) == red_px);
}

TEST_CASE("ground painted again cut by a plane has the colours that it has whole") {
    Studio studio;
    const FullScene full;
    scene::FramePlan plan = full.plan();
    plan.aircraft.clear();
    plan.steps.clear();
    plan.repaint_indices.assign(plan.ground.indices.begin(), plan.ground.indices.end());
    const auto count = static_cast<std::uint32_t>(plan.repaint_indices.size());
    const scene::Picture once = studio.picture(plan);
    plan.clips[0].planes[0] = glm::vec4(0.8F, 0.0F, -0.6F, -300.0F);
    plan.clips[0].count = 1;
    plan.steps = {{Content::GroundRepaint, 0, count, 0}};
    const scene::Picture twice = studio.picture(plan);
    // Cutting adds corners, rounded to 1/256 pixel: edges may move by a pixel, colours by a step.
    CHECK(differing(once, twice, 1) == 0);
    plan.ground = {plan.ground.vertices, {}};
    const scene::Picture right = studio.picture(plan);
    const int unlike = differing(once, right, 1);
    CHECK(unlike > side_px * side_px / 8); // the plane does cut
    CHECK(unlike < side_px * side_px * 7 / 8);
}

TEST_CASE("a plan after one with clips is drawn uncut") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.clips = {right_of(0.0F)};
    scene.plan.steps = {{Content::Aircraft, 0, 1, 0}};
    CHECK(count_of(studio.picture(scene.plan), red_px) == 32 * 16);
    scene.plan.steps = {{Content::Aircraft, 0, 1, whole}};
    CHECK(count_of(studio.picture(scene.plan), red_px) == 32 * 32);
    scene.plan.ground = {};
    CHECK(count_of(studio.picture(scene.plan, HiddenSurfaceMode::ByDepth), red_px) > 32 * 16);
}

TEST_CASE("the renderer says how many draw calls the last picture took") {
    Studio studio;
    Overlapping scene(studio);
    scene.plan.steps.clear();
    studio.picture(scene.plan);
    CHECK(studio.renderer().draw_calls() == 1);
    scene.plan.clips = {right_of(0.0F)};
    scene.plan.steps = {{Content::GroundRepaint, 0, 6, 0}, {Content::Aircraft, 0, 1, whole}};
    studio.picture(scene.plan);
    CHECK(studio.renderer().draw_calls() == 3);
    studio.picture(empty_plan());
    CHECK(studio.renderer().draw_calls() == 0);
}

TEST_CASE("solids are hidden by depth among themselves, and by nothing painted before") {
    Studio studio;
    load_squares(studio, true);
    scene::FramePlan plan = empty_plan();
    Triangles ground;
    ground.add({}, 5.0F, green);
    plan.ground = ground.draw();
    plan.repaint_indices = ground.indices;
    add_square(plan, 0, ahead(10.0F));
    add_square(plan, 2, ahead(12.0F));
    plan.depth_boxes = {{{0, 0}, {side_px, side_px}}};
    plan.steps = {{Content::ClearDepth, 0, 1, whole}, {Content::Aircraft, 0, 2, whole, scene::DepthUse::Nearest}};
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.steps = {{Content::ClearDepth, 0, 1, whole}, {Content::Aircraft, 1, 1, whole, scene::DepthUse::Nearest},
        {Content::Aircraft, 0, 1, whole, scene::DepthUse::Nearest}};
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.steps = {{Content::ClearDepth, 0, 1, whole}, {Content::Aircraft, 0, 1, whole, scene::DepthUse::Nearest},
        {Content::ClearDepth, 0, 1, whole}, {Content::Aircraft, 1, 1, whole, scene::DepthUse::Nearest}};
    CHECK(middle(studio.picture(plan)) == blue_px);
}

TEST_CASE("ground drawn as depth alone hides solids and changes no pixel") {
    Studio studio;
    load_squares(studio, true);
    scene::FramePlan plan = empty_plan();
    Triangles ground;
    ground.add({}, 10.0F, green);
    plan.repaint_indices = ground.indices;
    plan.ground = {ground.vertices, {}};
    plan.depth_boxes = {{{0, 0}, {side_px, side_px}}};
    add_square(plan, 0, ahead(9.0F));
    add_square(plan, 2, ahead(11.0F));
    plan.steps = {{Content::ClearDepth, 0, 1, whole}, {Content::GroundRepaint, 0, 6, whole, scene::DepthUse::DepthOnly},
        {Content::Aircraft, 1, 1, whole, scene::DepthUse::Nearest}};
    CHECK(middle(studio.picture(plan)) == grey_px);
    plan.steps.back() = {Content::Aircraft, 0, 1, whole, scene::DepthUse::Nearest};
    CHECK(middle(studio.picture(plan)) == red_px);
}

TEST_CASE("depth is cleared inside its box only") {
    Studio studio;
    load_squares(studio, true);
    scene::FramePlan plan = empty_plan();
    add_square(plan, 0, glm::scale(ahead(10.0F), glm::vec3(20.0F, 20.0F, 1.0F)));
    add_square(plan, 2, glm::scale(ahead(20.0F), glm::vec3(40.0F, 40.0F, 1.0F)));
    plan.depth_boxes = {{{0, 0}, {side_px, side_px}}, {{8, 4}, {20, 14}}};
    plan.steps = {{Content::ClearDepth, 0, 1, whole}, {Content::Aircraft, 0, 1, whole, scene::DepthUse::Nearest},
        {Content::ClearDepth, 1, 1, whole}, {Content::Aircraft, 1, 1, whole, scene::DepthUse::Nearest}};
    const scene::Picture picture = studio.picture(plan);
    CHECK(count_of(picture, blue_px) == 12 * 10);
    CHECK(pixel(picture, 8, 4) == blue_px);
    CHECK(pixel(picture, 19, 13) == blue_px);
}

TEST_CASE("slivers of ground keep their numbers to the last bit") {
    // Corners hundreds of metres apart in depth, on one line of the picture but for 1e-5 of it.
    Studio studio;
    RandomGenerator dice(5);
    Triangles slivers;
    constexpr std::uint32_t number = 0xff1ebde2U;
    for (std::uint32_t i = 0; i < 30000; ++i) {
        const glm::vec2 from{glm::dvec2{dice.between(-0.9, 0.9), dice.between(-0.9, 0.9)}};
        const glm::vec2 mode{glm::dvec2{dice.between(-0.3, 0.3), dice.between(-0.3, 0.3)}};
        for (const float share : {0.0F, 0.4F, 1.0F}) {
            const glm::vec2 aside(-mode.y, mode.x);
            const glm::vec2 at = from + mode * share + aside * (share == 0.4F ? 2e-5F : 0.0F);
            const auto ahead_m = static_cast<float>(dice.between(5000.0, 9000.0));
            slivers.vertices.push_back({glm::vec3(at * ahead_m, -ahead_m), number});
            slivers.indices.push_back(static_cast<std::uint32_t>(slivers.indices.size()));
        }
    }
    scene::FramePlan plan = plan_of(slivers);
    plan.ground_has_polygon_numbers = true;
    const scene::Picture picture = studio.picture(plan);
    const int right = count_of(picture, {0xe2, 0xbd, 0x1e, 255});
    CHECK(right > 100);
    CHECK(right + count_of(picture, grey_px) == side_px * side_px);
}

TEST_CASE("a smooth polygon has the light of its corners, a flat one that of its face") {
    Studio studio;
    scene::ModelBuffers model = square_model(glm::vec3(1.0F));
    for (scene::ModelVertex& vertex : model.vertices) {
        vertex.normal = vertex.position_m.x > 0.0F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    }
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.ambient = glm::vec3(0.0F);
    plan.sunlight = glm::vec3(1.0F);
    plan.to_sun = glm::vec3(0, 0, 1);
    add_square(plan, 0, glm::scale(ahead(10.0F), glm::vec3(10.0F, 10.0F, 1.0F)));
    const scene::Picture flat = studio.picture(plan);
    CHECK(pixel(flat, 2, side_px / 2)[0] == 255);
    CHECK(pixel(flat, side_px - 3, side_px / 2)[0] == 255);
    plan.smooth = {1};
    const scene::Picture smooth = studio.picture(plan);
    CHECK(pixel(smooth, 2, side_px / 2)[0] > 235);
    CHECK(pixel(smooth, side_px - 3, side_px / 2)[0] < 20);
    CHECK(std::abs(int{middle(smooth)[0]} - 127) < 6);
}
