#include "sim/base/error.h"
#include "tests/visuals/gl/small_scene.h"
#include "visuals/gl/context.h"
#include "visuals/gl/object.h"
#include "visuals/gl/platform_tuning.h"

#include <catch2/catch.hpp>

#include <iostream>

using namespace octant;
using namespace octant::tests;

namespace {

/// Nothing, with the reason said, where EGL does not work without a display.
std::unique_ptr<gl::Context> egl_if_present() {
    try {
        return gl::make_egl_context();
    } catch (const Error& error) {
        std::cout << "SKIPPED: " << error.what() << '\n';
        return nullptr;
    }
}

scene::FramePlan plan_of(const glm::vec3& background) {
    scene::FramePlan plan = empty_plan();
    plan.background = background;
    return plan;
}

} // namespace

TEST_CASE("a driver older than OpenGL 4.5 is refused with what it has") {
    CHECK_NOTHROW(gl::require_gl_4_5("4.5 (Core Profile) Mesa 22.3.6"));
    CHECK_NOTHROW(gl::require_gl_4_5("4.6.0 NVIDIA 550.54"));
    CHECK_NOTHROW(gl::require_gl_4_5("5.0"));
    CHECK_NOTHROW(gl::require_gl_4_5("4.10"));
    CHECK_THROWS_WITH(gl::require_gl_4_5("3.3 (Core Profile) Mesa 22.3.6"),
        "expected OpenGL 4.5, got 3.3 (Core Profile) Mesa 22.3.6");
    CHECK_THROWS_WITH(gl::require_gl_4_5("OpenGL ES 3.2 Mesa"), "expected OpenGL 4.5, got OpenGL ES 3.2 Mesa");
    CHECK_THROWS_WITH(gl::require_gl_4_5("4"), "expected OpenGL 4.5, got 4");
}

TEST_CASE("a driver without a needed function is refused by the function's name") {
    const auto context = gl::make_osmesa_context();
    static const gl::Functions& there = context->functions();
    const auto only_versions = [](const char* name) -> gl::AnyFunction {
        return std::string(name) == "glGetString" ? reinterpret_cast<gl::AnyFunction>(there.get_string) : nullptr;
    };
    CHECK_THROWS_WITH(gl::load_functions(only_versions), "expected the driver to have glAttachShader, got nothing");
}

TEST_CASE("an off-screen context says what draws") {
    const auto context = gl::make_osmesa_context();
    CHECK_THAT(context->info().description, Catch::StartsWith("osmesa, OpenGL 4."));
    CHECK_FALSE(context->info().device.empty());
}

TEST_CASE("two off-screen contexts live side by side and draw each their own picture") {
    Studio first;
    Studio second;
    CHECK(middle(first.picture(plan_of(red))) == red_px);
    CHECK(middle(second.picture(plan_of(green))) == green_px);
    CHECK(middle(first.picture(plan_of(blue))) == blue_px);
    const std::uint64_t hash = hash_of_full_scene(first);
    CHECK(hash_of_full_scene(second) == hash);
}

TEST_CASE("renderers take turns in a thread whichever of their contexts was current") {
    Studio first;
    Studio second;
    const std::uint64_t hash = hash_of_full_scene(first);
    first.picture(plan_of(red));
    second.renderer().resize({16, 16}, 1);
    second.renderer().warm_up();
    CHECK(middle(second.picture(plan_of(green))) == green_px);
    std::unique_ptr<scene::Renderer> sibling = first.renderer().sibling({8, 8}, 1);
    second.renderer().finish();
    sibling->draw(plan_of(blue));
    scene::Picture picture;
    sibling->finish_and_read(picture);
    CHECK(middle(picture) == blue_px);
    second.renderer().draw(plan_of(green));
    sibling.reset(); // its objects are those of another context than the one that draws
    CHECK(hash_of_full_scene(first) == hash);
    second.renderer().finish_and_read(picture);
    CHECK(middle(picture) == green_px);
}

TEST_CASE("a context made after another one was destroyed draws the same") {
    std::uint64_t hash = 0;
    {
        Studio first;
        hash = hash_of_full_scene(first);
    }
    Studio second;
    CHECK(hash_of_full_scene(second) == hash);
}

TEST_CASE("EGL and OSMesa give the same picture bit for bit, in turns in one program") {
    auto context = egl_if_present();
    if (!context) { return; }
    Studio by_egl(std::move(context));
    Studio by_osmesa;
    if (by_egl.context().info().device != by_osmesa.context().info().device) {
        std::cout << "SKIPPED: EGL draws with " << by_egl.context().info().device << '\n';
        return;
    }
    for (int turn = 0; turn < 2; ++turn) { CHECK(hash_of_full_scene(by_egl) == hash_of_full_scene(by_osmesa)); }
}

TEST_CASE("an EGL context outlives another one on the same display") {
    auto context = egl_if_present();
    if (!context) { return; }
    CHECK_THAT(context->info().description, Catch::StartsWith("egl, OpenGL 4."));
    Studio stays(std::move(context));
    {
        Studio goes(gl::make_egl_context());
        CHECK(middle(goes.picture(plan_of(green))) == green_px);
    }
    CHECK(middle(stays.picture(plan_of(red))) == red_px);
    Studio later(gl::make_egl_context());
    CHECK(middle(later.picture(plan_of(blue))) == blue_px);
}

TEST_CASE("a picture that the driver cannot hold is refused with the sizes that it can") {
    const std::shared_ptr<gl::Context> context = gl::make_osmesa_context();
    GLint largest = 0;
    context->functions().get_integerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    const std::string most = std::to_string(largest);
    const auto refusal = [&](int width, int height) {
        return "expected a picture of 1 x 1 to " + most + " x " + most + " pixels, got " + std::to_string(width) +
               " x " + std::to_string(height);
    };
    const auto make = [&](int width, int height, int samples) { gl::Renderer(context, {width, height}, samples); };
    CHECK_THROWS_WITH(make(largest + 1, 10, 1), refusal(largest + 1, 10));
    CHECK_THROWS_WITH(make(10, largest + 1, 1), refusal(10, largest + 1));
    CHECK_THROWS_WITH(make(0, 10, 1), refusal(0, 10));
    CHECK_THROWS_WITH(make(10, -3, 1), refusal(10, -3));
    CHECK_THROWS_WITH(make(10, 10, 3), Catch::StartsWith("expected 1 or 4 samples a pixel (the driver has up to "));
    CHECK_THROWS_WITH(make(10, 10, 3), Catch::EndsWith("), got 3"));
    CHECK_NOTHROW(make(1, 1, 1));
}

TEST_CASE("a shader that is wrong is refused by name with the driver's reason") {
    const auto context = gl::make_osmesa_context();
    const char* const right = "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n";
    CHECK_THROWS_WITH(gl::make_program(context->functions(), "odd", {"#version 450 core\nnonsense\n", right}),
        Catch::StartsWith("shader odd: expected it to compile, got "));
    CHECK_THROWS_WITH(gl::make_program(context->functions(), "odd",
                          {right, "#version 450 core\nin vec3 missing;\nout vec3 pixel;\n"
                                  "void main() { pixel = missing; }\n"}),
        Catch::StartsWith("shader odd: expected it to link, got "));
}

TEST_CASE("spreading the raster threads leaves the picture as it was") {
    gl::tune_allocator();
    Studio studio;
    const std::uint64_t hash = hash_of_full_scene(studio);
    CHECK(gl::spread_raster_threads() >= 0);
    CHECK(hash_of_full_scene(studio) == hash);
}
