#include "sim/base/random_generator.h"
#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <hwy/targets.h>

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
void check_threads(const scene::FramePlan& plan, const scene::GroundTexture* texture) {
    for (const int samples : {1, 4, 16}) {
        const scene::Picture one = drawn(plan, bytes_size_px, samples, 1, texture);
        CHECK(drawn(plan, bytes_size_px, samples, 2, texture).rgba == one.rgba);
        CHECK(drawn(plan, bytes_size_px, samples, 5, texture).rgba == one.rgba);
    }
}

/// Compares pictures of all sample counts by all instruction sets of the processor.
void check_sets(const scene::FramePlan& plan, const scene::GroundTexture* texture) {
    const std::int64_t all = hwy::SupportedTargets();
    for (const int samples : {1, 4, 16}) {
        const scene::Picture best = drawn(plan, bytes_size_px, samples, 1, texture);
        int sets = 0;
        for (int bit = 0; bit < 63; ++bit) {
            const std::int64_t target = std::int64_t{1} << bit;
            if ((all & target) == 0) { continue; }
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            CAPTURE(samples, hwy::TargetName(target));
            CHECK((drawn(plan, bytes_size_px, samples, 1, texture).rgba == best.rgba));
            ++sets;
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        CHECK(sets >= 2);
    }
}

} // namespace

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
