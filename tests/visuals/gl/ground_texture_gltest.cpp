#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant;
using namespace octant::tests;

namespace {

/// Four texels over 20 x 20 m about the middle: red in the south-west, green in the south-east, blue in the north-west,
/// grey in the north-east. `slope` is every texel's normal.
scene::GroundTexture four_texels(std::uint8_t slope_x = 128) {
    scene::GroundTexture texture;
    texture.albedo = {.width = 2,
        .height = 2,
        .texels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128},
        .first_m = {-5.0, -5.0},
        .step_m = {10.0, 10.0}};
    texture.normal = texture.albedo;
    texture.normal.texels = {slope_x, 128, slope_x, 128, slope_x, 128, slope_x, 128};
    return texture;
}

/// Fills the picture: 10 m below an eye over the middle that looks straight down.
scene::FramePlan plan_over(const Triangles& ground) {
    scene::FramePlan plan = empty_plan();
    plan.background = glm::vec3(0.0F);
    plan.ground = ground.draw();
    const scene::TextureTransform place{glm::vec2(0.5F), glm::vec2(0.05F)};
    plan.ground_texture = scene::GroundTextureTransforms{place, place};
    return plan;
}

Triangles whole_ground() {
    Triangles ground;
    ground.add({}, 10.0F, glm::vec3(0.0F));
    return ground;
}

} // namespace

TEST_CASE("textured ground has south at the texture's first row and west at its first column") {
    Studio studio;
    studio.renderer().load_ground_texture(four_texels());
    const Triangles ground = whole_ground();
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = plan_over(ground);
        const scene::Picture picture = studio.picture(plan, mode);
        CHECK(pixel(picture, 2, 61) == red_px);
        CHECK(pixel(picture, 61, 61) == green_px);
        CHECK(pixel(picture, 2, 2) == blue_px);
        CHECK(pixel(picture, 61, 2) == grey_px);
    }
}

TEST_CASE("ground without a texture in its plan keeps its vertices' colours") {
    Studio studio;
    studio.renderer().load_ground_texture(four_texels());
    Triangles ground;
    ground.add({}, 10.0F, red);
    scene::FramePlan plan = plan_over(ground);
    plan.ground_texture.reset();
    CHECK(count_of(studio.picture(plan), red_px) == side_px * side_px);
}

TEST_CASE("textured ground is lit by the normals of its texture") {
    Studio studio;
    const Triangles ground = whole_ground();
    scene::FramePlan plan = plan_over(ground);
    plan.ambient = glm::vec3(0.0F);
    plan.sunlight = glm::vec3(1.0F);
    plan.to_sun = {1.0F, 0.0F, 0.0F};
    const auto corner = [&](int slope_x) {
        studio.renderer().load_ground_texture(four_texels(static_cast<std::uint8_t>(slope_x)));
        return pixel(studio.picture(plan), 2, 61)[0];
    };
    CHECK(corner(255) == 255); // faces east, where the sun is
    CHECK(corner(128) == 0);   // level
    CHECK(corner(1) == 0);     // faces west
    CHECK(corner(128 + 64) == Approx(255.0 * 64.0 / 127.0).margin(1.0));
}

TEST_CASE("a shadow on textured ground leaves its share of the texture's colour") {
    Studio studio;
    studio.renderer().load_ground_texture(four_texels());
    const Triangles ground = whole_ground();
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = plan_over(ground);
        for (const models::ColourVertex& vertex : ground.vertices) {
            plan.shadow_vertices.push_back({vertex.position_m, 0x80000000U});
        }
        plan.repaint_indices = {4, 5, 6};
        plan.steps = {{scene::PaintStep::Content::GroundRepaint, 0, 3}};
        const scene::Picture picture = studio.picture(plan, mode, 3);
        CHECK(pixel(picture, 61, 61) == Pixel{0, 128, 0, 255});
        CHECK(pixel(picture, 2, 2) == blue_px); // not in the shadow
    }
}

TEST_CASE("what is painted on textured ground has its own colour, in haze too") {
    Studio studio;
    studio.renderer().load_ground_texture(four_texels());
    const Triangles ground = whole_ground();
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = plan_over(ground);
        plan.ambient = glm::vec3(0.3F); // its colour has its light already
        for (const models::ColourVertex& vertex : ground.vertices) {
            plan.shadow_vertices.push_back({vertex.position_m, 0x000000ffU});
        }
        for (const models::ColourVertex& vertex : ground.vertices) {
            plan.shadow_vertices.push_back({vertex.position_m, 0xff000000U});
        }
        plan.repaint_indices = {4, 5, 6, 8, 10, 11};
        plan.steps = {{scene::PaintStep::Content::GroundRepaint, 0, 6}};
        const scene::Picture clear = studio.picture(plan, mode, 6);
        CHECK(pixel(clear, 61, 61) == red_px);
        CHECK(pixel(clear, 2, 2)[2] == Approx(0.3 * 255.0).margin(1.0)); // of the texture
        plan.haze.colour = glm::vec3(0.0F, 1.0F, 0.0F);
        plan.haze.visibility_m = 14.0F;
        const Pixel hazy = pixel(studio.picture(plan, mode, 6), 32, 40);
        const double left = std::exp(-std::sqrt(300.0) / 14.0); // as at all corners
        CHECK(hazy[0] == Approx(255.0 * left).margin(2.0));
        CHECK(hazy[1] == Approx(255.0 * (1.0 - left)).margin(2.0));
    }
}

TEST_CASE("textured ground that is painted again is cut by its planes") {
    Studio studio;
    studio.renderer().load_ground_texture(four_texels());
    const Triangles ground = whole_ground();
    scene::FramePlan plan = plan_over(ground);
    plan.ground.indices = {};
    plan.repaint_indices = ground.indices;
    plan.clips.push_back({{glm::vec4(1.0F, 0.0F, 0.0F, 0.0F)}, 1});
    plan.steps = {{scene::PaintStep::Content::GroundRepaint, 0, 6, 0}};
    const scene::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 61, 61) == green_px);
    CHECK(pixel(picture, 2, 61) == Pixel{0, 0, 0, 255});
}

TEST_CASE("renderers on a processor differ from GPUs by their names") {
    CHECK(gl::is_software_device("llvmpipe (LLVM 15.0.6, 256 bits)"));
    CHECK(gl::is_software_device("softpipe"));
    CHECK_FALSE(gl::is_software_device("NVIDIA H200/PCIe/SSE2"));
    CHECK_FALSE(gl::is_software_device("Mesa Intel(R) UHD Graphics 620"));
    CHECK(gl::is_software_renderer(gl::make_osmesa_context()->functions()));
}
