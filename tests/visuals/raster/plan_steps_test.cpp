#include "tests/visuals/raster/flat_plan.h"
#include "visuals/raster/vertex_stage.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdlib>

namespace octant::visuals::raster {

namespace {

using scene::DepthUse;
using scene::PaintStep;

constexpr glm::ivec2 steps_size_px{64, 64};
constexpr std::uint32_t red = 0xff0000ffU;
constexpr std::uint32_t green = 0xff00ff00U;
constexpr glm::ivec3 red_px{255, 0, 0};
constexpr glm::ivec3 green_px{0, 255, 0};

/// Two triangles that fill a rectangle.
std::vector<FlatTriangle> rectangle(glm::vec2 min, glm::vec2 max, std::uint32_t colour, float depth_m) {
    FlatTriangle lower{{min, glm::vec2(max.x, min.y), max}};
    FlatTriangle upper{{min, max, glm::vec2(min.x, max.y)}};
    for (FlatTriangle* const one : {&lower, &upper}) {
        one->depth_m.fill(depth_m);
        one->colour.fill(colour);
    }
    return {lower, upper};
}

void clear_whole_depth(FlatPlan& plan) {
    plan.plan().depth_boxes.push_back({glm::ivec2(0), steps_size_px});
    plan.plan().steps.push_back(
        {PaintStep::Content::ClearDepth, static_cast<std::uint32_t>(plan.plan().depth_boxes.size() - 1), 1});
}

/// Even light on a model that stands at the eye.
void light_evenly(scene::FramePlan& frame, std::uint32_t smooth) {
    frame.ambient = glm::vec3(1.0F);
    frame.parts = {glm::mat4(1.0F)};
    frame.smooth = {smooth};
}

/// Draws three indices of a model alone.
void paint_triangle(scene::FramePlan& frame, std::uint32_t first_index) {
    frame.aircraft = {{.model = 0, .first_index = first_index, .index_count = 3}};
    frame.steps.push_back({PaintStep::Content::Aircraft, 0, 1});
}

} // namespace

TEST_CASE("the nearer one is seen where steps ask for depth, whatever their order") {
    FlatPlan plan(steps_size_px);
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {64, 64}, red, 4.0F), DepthUse::Nearest);
    plan.paint(rectangle({0, 0}, {64, 64}, green, 8.0F), DepthUse::Nearest);
    CHECK(pixel(drawn(plan.plan(), steps_size_px, 16), 30, 30) == red_px);
}

TEST_CASE("what is drawn after a group by depth lies over it, what came before lies under it") {
    FlatPlan plan(steps_size_px);
    plan.paint(rectangle({0, 0}, {64, 64}, green, 2.0F));
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {40, 64}, red, 8.0F), DepthUse::Nearest);
    plan.paint(rectangle({0, 40}, {64, 64}, 0xffff0000U, 16.0F));
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 16);
    CHECK(pixel(picture, 50, 10) == green_px);
    CHECK(pixel(picture, 20, 10) == red_px);
    CHECK(pixel(picture, 20, 50) == glm::ivec3(0, 0, 255));
}

TEST_CASE("cleared depth forgets the group before") {
    FlatPlan plan(steps_size_px);
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {64, 64}, red, 4.0F), DepthUse::Nearest);
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {64, 64}, green, 8.0F), DepthUse::Nearest);
    CHECK(pixel(drawn(plan.plan(), steps_size_px, 16), 30, 30) == green_px);
}

TEST_CASE("depth alone hides what comes next and keeps the colours that are there") {
    FlatPlan plan(steps_size_px);
    plan.paint(rectangle({0, 0}, {64, 64}, green, 2.0F));
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {32, 64}, 0xffffffffU, 4.0F), DepthUse::DepthOnly);
    plan.paint(rectangle({0, 0}, {64, 64}, red, 8.0F), DepthUse::Nearest);
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 16);
    CHECK(pixel(picture, 10, 30) == green_px);
    CHECK(pixel(picture, 50, 30) == red_px);
}

TEST_CASE("what lies infinitely far is seen where nothing else is; a shadow lies on its ground") {
    FlatPlan plan(steps_size_px);
    clear_whole_depth(plan);
    plan.paint(rectangle({0, 0}, {32, 64}, red, 4.0F), DepthUse::Nearest);
    plan.paint(rectangle({0, 0}, {64, 64}, green, 100.0F), DepthUse::InfinitelyFar);
    plan.paint(rectangle({0, 0}, {10, 64}, 0xffff0000U, 4.0F), DepthUse::OnGround);
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 16);
    CHECK(pixel(picture, 20, 30) == red_px);
    CHECK(pixel(picture, 50, 30) == green_px);
    CHECK(pixel(picture, 5, 30) == glm::ivec3(0, 0, 255));
}

TEST_CASE("both sides of a cut make the whole, through the eye or not") {
    const float offset_m = GENERATE(0.0F, 1.5F);
    for (const int samples : {1, 16}) {
        FlatPlan plan(steps_size_px);
        for (const float side : {1.0F, -1.0F}) {
            scene::Clip clip;
            clip.count = 1;
            clip.planes[0] = side * glm::vec4(0.7F, 0.4F, 0.1F, offset_m);
            plan.plan().clips.push_back(clip);
        }
        plan.paint(rectangle({0, 0}, {64, 64}, red, 4.0F), DepthUse::None, 0);
        plan.paint(rectangle({0, 0}, {64, 64}, red, 4.0F), DepthUse::None, 1);
        const scene::Picture picture = drawn(plan.plan(), steps_size_px, samples);
        CHECK(count_of(picture, red_px) == steps_size_px.x * steps_size_px.y);
        // Each side alone is not.
        FlatPlan half(steps_size_px);
        half.plan().clips = plan.plan().clips;
        half.paint(rectangle({0, 0}, {64, 64}, red, 4.0F), DepthUse::None, 0);
        const scene::Picture one = drawn(half.plan(), steps_size_px, samples);
        CHECK(pixel(one, 63, 0) == red_px);
        CHECK(pixel(one, 0, 63) == glm::ivec3(0));
    }
}

TEST_CASE("polygons of an aircraft are flat or smooth as their bits say, whichever are drawn") {
    scene::ModelBuffers model;
    for (std::uint32_t polygon = 0; polygon < 2; ++polygon) {
        const float left = polygon == 0 ? -1.0F : 0.0F;
        for (const glm::vec2 at : {glm::vec2(left, -1.0F), glm::vec2(left + 1.0F, -1.0F), glm::vec2(left, 1.0F)}) {
            scene::ModelVertex vertex;
            vertex.position_m = glm::vec3(at, -1.0F);
            vertex.normal = glm::vec3(0.0F, 0.0F, 1.0F);
            vertex.face_normal = vertex.normal;
            vertex.colour = green;
            vertex.face_colour = red;
            vertex.polygon = polygon;
            model.vertices.push_back(vertex);
            model.indices.push_back(static_cast<std::uint32_t>(model.indices.size()));
        }
    }
    FlatPlan plan(steps_size_px);
    scene::FramePlan& frame = plan.plan();
    light_evenly(frame, GENERATE(0U, 2U));
    paint_triangle(frame, 3); // the second one
    const scene::Picture picture = drawn(frame, steps_size_px, 16, 1, nullptr, std::span(&model, 1));
    CHECK(pixel(picture, 36, 60) == (frame.smooth[0] == 0 ? red_px : green_px));
    CHECK(pixel(picture, 10, 60) == glm::ivec3(0));
}

TEST_CASE("glass mirrors the sky and the sun's glint, other surfaces do not") {
    // A square far ahead in view axes, which are those of the world: it mirrors what is behind the eye, overhead.
    const std::array own{0.25, 0.5, 0.75};
    const auto seen = [&](std::uint32_t alpha, std::uint32_t smooth, bool is_phong, const glm::vec3& to_sun) {
        scene::ModelBuffers model;
        add_square(model, 10.0F, -400.0F, 0x00bf8040U | alpha << 24U);
        FlatPlan plan(steps_size_px);
        scene::FramePlan& frame = plan.plan();
        light_evenly(frame, smooth);
        frame.sunlight = glm::vec3(0.0F, 0.0F, 0.01F);
        frame.to_sun = to_sun;
        frame.lights_pixels = is_phong;
        frame.mirrored_sky = {glm::vec3(0.5F, 0.25F, 0.75F), glm::vec3(0.0F)};
        frame.aircraft = {{.model = 0, .first_index = 0, .index_count = 6}};
        frame.steps.push_back({PaintStep::Content::Aircraft, 0, 1});
        return pixel(drawn(frame, steps_size_px, 1, 1, nullptr, std::span(&model, 1)), 32, 32);
    };
    constexpr glm::vec3 aside(1.0F, 0.0F, 0.0F);
    const glm::ivec3 expected(
        glm::round(255.0 * (0.92 * glm::dvec3(own[0], own[1], own[2]) + 0.08 * glm::dvec3(0.5, 0.25, 0.75))));
    for (const std::uint32_t smooth : {0U, ~0U}) {
        CHECK(seen(255, smooth, false, aside) == glm::ivec3(64, 128, 191));
        const glm::ivec3 mirrored = seen(254, smooth, false, aside);
        const glm::ivec3 with_glint = seen(254, smooth, false, {0.0F, 0.0F, 1.0F});
        for (int part = 0; part < 3; ++part) { CHECK(std::abs(mirrored[part] - expected[part]) <= 2); }
        CHECK(with_glint.x == mirrored.x);
        CHECK(with_glint.z - mirrored.z >= 3); // 0.08 * 12 * 0.01 of the sun's blue light, and what lies in it
    }
    const glm::ivec3 phong = seen(254, ~0U, true, aside);
    for (int part = 0; part < 3; ++part) { CHECK(std::abs(phong[part] - expected[part]) <= 2); }
}

TEST_CASE("a sliver of a polygon that faces away is not drawn where rounding turns it round") {
    // The corners, not much farther apart than they are rounded, go round as those of a front do; whether it is one,
    // the polygon's normal says where there is one.
    const float px = 2.0F / 64.0F;
    for (const float outwards : {1.0F, -1.0F, 0.0F}) {
        scene::ModelBuffers model;
        for (const glm::vec2 at : {glm::vec2(0.497F, 20.0F), glm::vec2(0.497F, -20.0F), glm::vec2(0.503F, 20.0F)}) {
            scene::ModelVertex vertex;
            vertex.position_m = glm::vec3(px * at, -1.0F);
            vertex.face_normal = glm::vec3(0.0F, 0.0F, outwards);
            vertex.face_colour = red;
            model.vertices.push_back(vertex);
            model.indices.push_back(static_cast<std::uint32_t>(model.indices.size()));
        }
        FlatPlan plan(steps_size_px);
        scene::FramePlan& frame = plan.plan();
        light_evenly(frame, 0U);
        paint_triangle(frame, 0);
        const scene::Picture picture = drawn(frame, steps_size_px, 1, 1, nullptr, std::span(&model, 1));
        CHECK((count_of(picture, red_px) > 0) == (outwards >= 0.0F));
    }
}

TEST_CASE("a transparent surface is blended over what is seen behind it, none over what is nearer") {
    scene::ModelBuffers model;
    for (const std::uint32_t colour : {red, green, 0xffff0000U}) { add_square(model, 1.0F, 0.0F, colour); }
    const auto ahead = [](float ahead_m, float scale) {
        glm::mat4 place(scale);
        place[3] = glm::vec4(0.0F, 0.0F, -ahead_m, 1.0F);
        return place;
    };
    const int samples = GENERATE(1, 4, 16);
    FlatPlan plan(steps_size_px);
    scene::FramePlan& frame = plan.plan();
    light_evenly(frame, ~0U);
    frame.parts = {ahead(4.0F, 4.0F), ahead(2.0F, 1.0F), ahead(1.0F, 0.25F)};
    for (std::uint32_t i = 0; i < 3; ++i) {
        frame.aircraft.push_back({.model = 0, .first_index = 6 * i, .index_count = 6, .first_part = i});
    }
    using Content = PaintStep::Content;
    clear_whole_depth(plan);
    frame.steps.push_back({Content::Aircraft, 0, 1, PaintStep::no_clip, DepthUse::Nearest});
    const bool shares_depth = GENERATE(true, false);
    if (shares_depth) { frame.steps.push_back({Content::Aircraft, 2, 1, PaintStep::no_clip, DepthUse::Nearest}); }
    frame.steps.push_back({Content::Aircraft, 1, 1, PaintStep::no_clip, DepthUse::Nearest, 0.25F});
    if (!shares_depth) { // painted over all
        frame.steps.push_back({Content::Aircraft, 2, 1});
    }
    const scene::Picture picture = drawn(frame, steps_size_px, samples, 1, nullptr, std::span(&model, 1));
    CAPTURE(samples, shares_depth);
    CHECK(pixel(picture, 4, 4) == red_px);
    CHECK(pixel(picture, 18, 20) == glm::ivec3(191, 64, 0));
    CHECK(pixel(picture, 44, 44) == glm::ivec3(191, 64, 0));
    CHECK(pixel(picture, 32, 32) == glm::ivec3(0, 0, 255));
}

TEST_CASE("light is lost in haze as exp says, to single precision") {
    CHECK(exp_of_minus(0.0F) == Approx(1.0).epsilon(1e-7));
    for (float x = 0.001F; x < 80.0F; x *= 1.03F) {
        CHECK(exp_of_minus(x) == Approx(std::exp(-static_cast<double>(x))).epsilon(4e-6));
    }
}

TEST_CASE("neighbours of the overlay with one colour are blended as one") {
    FlatPlan plan(steps_size_px);
    const std::uint32_t half_white = 0x80ffffffU;
    const std::vector<scene::OverlayVertex> vertices{{{3.3F, 4.7F}, half_white}, {{50.2F, 9.1F}, half_white},
        {{60.9F, 55.5F}, half_white}, {{8.4F, 48.8F}, half_white}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    plan.plan().overlay = {vertices, indices};
    plan.plan().steps.push_back({PaintStep::Content::Overlay, 0, 6});
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 16);
    for (int along = 12; along < 45; ++along) { CHECK(pixel(picture, along, along) == glm::ivec3(128)); }
}

TEST_CASE("an inset is a picture of its own within a thin frame") {
    FlatPlan plan(steps_size_px);
    plan.paint(rectangle({0, 0}, {64, 64}, red, 4.0F));
    FlatPlan inset({20, 10});
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(-50, -50), glm::vec2(200, -50), glm::vec2(-50, 200)};
    triangle.colour.fill(green);
    inset.paint({triangle});
    Renderer renderer(std::make_shared<ThreadPool>(2), steps_size_px, 16);
    renderer.draw(plan.plan());
    renderer.draw_inset(inset.plan(), {30, 40, 20, 10});
    scene::Picture picture;
    renderer.finish_and_read(picture);
    CHECK(pixel(picture, 30, 40) == green_px);
    CHECK(pixel(picture, 49, 49) == green_px);
    CHECK(pixel(picture, 50, 45) == glm::ivec3(20, 23, 26));
    CHECK(pixel(picture, 52, 45) == red_px);
}

TEST_CASE("levels between corners go straight, and correctly for perspective where that shows") {
    FlatPlan plan(steps_size_px);
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(0.5F, 0.5F), glm::vec2(0.5F, 200.0F), glm::vec2(64.5F, 0.5F)};
    triangle.depth_m = {1.0F, 1.0F, 4.0F};
    triangle.colour = {0xff000000U, 0xff000000U, 0xff0000ffU};
    plan.paint({triangle});
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 1);
    // Half-way across, a straight line in space has come a fifth of the way: 1 / (1 + 4).
    CHECK(pixel(picture, 32, 0).x == Approx(255.0 / 5.0).margin(2.0));
}

TEST_CASE("levels of a small triangle are right for perspective, however steep they are") {
    FlatPlan plan(steps_size_px);
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(0.5F, 0.5F), glm::vec2(0.5F, 8.5F), glm::vec2(8.5F, 0.5F)};
    triangle.depth_m = {1.0F, 1.0F, 1.02F};
    triangle.colour = {0xff000000U, 0xff000000U, 0xffffffffU};
    plan.paint({triangle});
    const scene::Picture picture = drawn(plan.plan(), steps_size_px, 1);
    for (int column = 1; column < 8; ++column) { // 31 to 33 levels a pixel
        const double share = column / 8.0;
        const double level = 255.0 * (share / 1.02) / (1.0 - share + share / 1.02);
        CAPTURE(column);
        CHECK(pixel(picture, column, 0).x == Approx(level).margin(2.0));
    }
}

} // namespace octant::visuals::raster
