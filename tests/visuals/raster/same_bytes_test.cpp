#include "sim/base/random_generator.h"
#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <hwy/targets.h>
#include <memory>
#include <span>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 bytes_size_px{128, 96};

/// Triangles of all sizes and colours, with and without depth, cut by planes, near and far.
void paint_much(FlatPlan& plan) {
    RandomGenerator dice(5);
    for (int step = 0; step < 24; ++step) {
        std::vector<FlatTriangle> triangles;
        for (int i = 0; i < 200; ++i) {
            FlatTriangle triangle;
            const float across_px = static_cast<float>(below(dice, 12800)) / 100.0F;
            const float down_px = static_cast<float>(below(dice, 9600)) / 100.0F;
            const glm::vec2 middle(across_px, down_px);
            const auto reach = static_cast<float>(1 + below(dice, i % 20 == 0 ? 128 : 12));
            for (std::size_t k = 0; k < 3; ++k) {
                const auto part = [&] { return static_cast<float>(below(dice, 2001)) / 1000.0F - 1.0F; };
                const float x = part();
                triangle.at_px[k] = middle + reach * glm::vec2(x, part());
                triangle.depth_m[k] = 1.0F + static_cast<float>(below(dice, 1000)) / 10.0F;
                const std::uint32_t alpha = i % 4 == 0 ? 0U : 0xff000000U;
                triangle.colour[k] = static_cast<std::uint32_t>(below(dice, 1U << 24)) | alpha;
            }
            triangles.push_back(triangle);
        }
        const bool by_depth = step % 3 == 1;
        const bool cut = step % 5 == 2;
        if (cut) {
            scene::Clip clip;
            clip.count = 2;
            clip.planes[0] = glm::vec4(0.6F, 0.3F, -0.1F, 0.0F);
            clip.planes[1] = glm::vec4(-0.2F, 0.5F, 0.3F, 4.0F);
            plan.plan().clips.push_back(clip);
        }
        plan.paint(triangles, by_depth ? scene::DepthUse::Nearest : scene::DepthUse::None,
            cut ? static_cast<std::uint32_t>(plan.plan().clips.size() - 1) : scene::PaintStep::no_clip);
    }
}

/// Air that thins out upwards and is brighter towards the sun.
void put_in_haze(FlatPlan& plan) {
    plan.plan().haze = {.colour = glm::vec3(0.6F, 0.7F, 0.8F),
        .visibility_m = 60.0F,
        .falloff_per_m = 0.02F,
        .horizontal_to_sun = glm::vec2(0.6F, 0.8F),
        .sunward_colour = glm::vec3(0.9F, 0.8F, 0.6F)};
}

/// A texture of noise, and where it lies under the plan's triangles.
scene::GroundTexture put_on_noise(FlatPlan& plan) {
    RandomGenerator dice(9);
    const auto noise = [&](int width, int height, int values) {
        scene::GroundImage image{.width = width, .height = height, .texels = {}};
        for (int i = 0; i < width * height * values; ++i) {
            image.texels.push_back(static_cast<std::uint8_t>(below(dice, 256)));
        }
        return image;
    };
    const scene::TextureTransform place{glm::vec2(0.5F), glm::vec2(0.02F, 0.03F)};
    plan.plan().ground_texture = {place, place};
    return {.albedo = noise(150, 90, 3), .normal = noise(40, 50, 2)};
}

/// Compares pictures of all sample counts on one thread and on several.
void check_threads(const scene::FramePlan& plan, const scene::GroundTexture* texture,
    std::span<const scene::ModelBuffers> models = {}) {
    for (const int samples : {1, 4, 16}) {
        const scene::Picture one = drawn(plan, bytes_size_px, samples, 1, texture, models);
        CHECK((drawn(plan, bytes_size_px, samples, 2, texture, models).rgba == one.rgba));
        CHECK((drawn(plan, bytes_size_px, samples, 5, texture, models).rgba == one.rgba));
    }
}

/// Compares pictures of all sample counts by all instruction sets of the processor.
void check_sets(const scene::FramePlan& plan, const scene::GroundTexture* texture,
    std::span<const scene::ModelBuffers> models = {}) {
    const std::int64_t all = hwy::SupportedTargets();
    for (const int samples : {1, 4, 16}) {
        const scene::Picture best = drawn(plan, bytes_size_px, samples, 1, texture, models);
        int sets = 0;
        for (int bit = 0; bit < 63; ++bit) {
            const std::int64_t target = std::int64_t{1} << bit;
            if ((all & target) == 0) { continue; }
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            CAPTURE(samples, hwy::TargetName(target));
            CHECK((drawn(plan, bytes_size_px, samples, 1, texture, models).rgba == best.rgba));
            ++sets;
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        CHECK(sets >= 2);
    }
}

/// An aircraft of triangles of all sizes, most of which have one of three textures, some with holes, in painting order,
/// then by depth, then as glass.
scene::ModelBuffers put_textured_aircraft(FlatPlan& plan) {
    RandomGenerator dice(31);
    scene::ModelBuffers model;
    for (int i = 0; i < 3; ++i) {
        models::TextureLevel noise{20 + 7 * i, 12, {}};
        for (int k = 0; k < 4 * noise.width * noise.height; ++k) {
            noise.rgba.push_back(static_cast<std::uint8_t>(below(dice, 256)));
        }
        models::SurfaceTexture texture{
            std::make_shared<const models::TexturePicture>(models::texture_picture("noise", noise))};
        texture.wrap_u = static_cast<models::TextureWrap>(i);
        texture.alpha = static_cast<models::TextureAlpha>(i);
        model.textures.push_back(texture);
    }
    const auto number = [&](float from, float to) { return from + (to - from) * static_cast<float>(dice.next()); };
    for (std::uint32_t i = 0; i < 900; ++i) {
        const float depth_m = number(-3.0F, 60.0F);
        const glm::vec2 middle(number(-1.0F, 1.0F), number(-1.0F, 1.0F));
        const float reach_m = i % 30 == 0 ? 20.0F : number(0.1F, 4.0F);
        for (std::uint32_t k = 0; k < 3; ++k) {
            scene::ModelVertex vertex;
            const glm::vec2 aside(number(-reach_m, reach_m), number(-reach_m, reach_m));
            vertex.position_m = glm::vec3(middle * depth_m + aside, -depth_m - number(0.0F, reach_m));
            vertex.normal = glm::vec3(number(-1.0F, 1.0F), 0.3F, 0.6F);
            vertex.face_normal = glm::vec3(0.0F);
            const std::uint32_t alpha = i % 3 == 0 ? 0x60000000U : 0xff000000U; // one in three mirrors the sky
            vertex.colour = vertex.face_colour = static_cast<std::uint32_t>(below(dice, 1U << 24)) | alpha;
            vertex.part = i % 2;
            vertex.polygon = i % 64;
            vertex.on_texture = glm::vec2(number(-3.0F, 3.0F), number(-3.0F, 3.0F));
            vertex.texture = i % 4;
            model.indices.push_back(static_cast<std::uint32_t>(model.vertices.size()));
            model.vertices.push_back(vertex);
        }
    }
    using Content = scene::PaintStep::Content;
    scene::FramePlan& all = plan.plan();
    all.parts = {glm::mat4(1.0F), glm::mat4(1.0F)};
    all.parts[1][3] = glm::vec4(0.3F, -0.2F, -1.0F, 1.0F);
    all.smooth = {0x5a5a1234U, 0xffff0000U};
    for (std::uint32_t i = 0; i < 3; ++i) { all.aircraft.push_back({.first_index = i * 900, .index_count = 900}); }
    all.depth_boxes = {{glm::ivec2(0), bytes_size_px}};
    all.mirrored_sky = {glm::vec3(0.2F, 0.4F, 0.8F), glm::vec3(0.3F, 0.2F, 0.1F)};
    all.steps.push_back({Content::Aircraft, 0, 1});
    all.steps.push_back({Content::ClearDepth, 0, 1});
    all.steps.push_back({Content::Aircraft, 1, 1, scene::PaintStep::no_clip, scene::DepthUse::Nearest});
    all.steps.push_back({Content::Aircraft, 2, 1, scene::PaintStep::no_clip, scene::DepthUse::Nearest, 0.4F});
    return model;
}

} // namespace

TEST_CASE("textured aircraft have the same bytes on any number of threads and by all instruction sets") {
    FlatPlan plan(bytes_size_px);
    const scene::ModelBuffers model = put_textured_aircraft(plan);
    put_in_haze(plan);
    // Over it a slanted transparent triangle by depth.
    const std::vector<scene::OverlayVertex> corners{
        {{3.0F, 5.0F}, 0x80ffffffU, 0.3F}, {{120.0F, 9.0F}, 0xc04080ffU, 0.02F}, {{20.0F, 90.0F}, 0x40ff8040U, 0.01F}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    plan.plan().overlay = {corners, indices};
    plan.plan().steps.push_back(
        {scene::PaintStep::Content::Transparent, 0, 3, scene::PaintStep::no_clip, scene::DepthUse::Nearest});
    plan.plan().lights_pixels = GENERATE(false, true);
    check_threads(plan.plan(), nullptr, std::span(&model, 1));
    check_sets(plan.plan(), nullptr, std::span(&model, 1));
}

TEST_CASE("any number of threads makes the same bytes") {
    FlatPlan plan(bytes_size_px);
    paint_much(plan);
    check_threads(plan.plan(), nullptr);
    put_in_haze(plan);
    plan.plan().detail_texture = strong_detail();
    check_threads(plan.plan(), nullptr);
    plan.plan().detail_texture.reset();
    const scene::GroundTexture texture = put_on_noise(plan);
    check_threads(plan.plan(), &texture);
}

TEST_CASE("all instruction sets make the same bytes") {
    FlatPlan plan(bytes_size_px);
    paint_much(plan);
    check_sets(plan.plan(), nullptr);
    put_in_haze(plan);
    check_sets(plan.plan(), nullptr);
    plan.plan().detail_texture = strong_detail();
    check_sets(plan.plan(), nullptr);
    plan.plan().detail_texture.reset();
    const scene::GroundTexture texture = put_on_noise(plan);
    check_sets(plan.plan(), &texture);
}

} // namespace octant::visuals::raster
