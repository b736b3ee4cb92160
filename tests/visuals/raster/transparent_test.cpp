#include "visuals/raster/renderer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

#include "flat_plan.h"

using namespace octant;
using namespace octant::visuals;
using namespace octant::visuals::raster;
using scene::PaintStep;

namespace {

constexpr glm::ivec2 area_size_px(64, 64);

FlatTriangle over_all(std::uint32_t colour) {
    FlatTriangle triangle;
    triangle.at_px = {glm::vec2(-50, -50), glm::vec2(200, -50), glm::vec2(-50, 200)};
    triangle.colour.fill(colour);
    return triangle;
}

/// A slanted four-sided area of two triangles, and its places as a pixel sees them.
struct Sheet {
    std::vector<scene::OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec2& by_px, std::uint32_t colour, float depth = 0.0F) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const glm::vec2 at : {glm::vec2(3.3F, 4.7F), {50.2F, 9.1F}, {60.9F, 55.5F}, {8.4F, 48.8F}}) {
            vertices.push_back({at + by_px, colour, depth});
        }
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) { indices.push_back(first + corner); }
    }
};

constexpr std::uint32_t half_white = 0x80ffffffU;
constexpr std::uint32_t half_black = 0x80000000U;
constexpr std::uint32_t whole_red = 0xff0000ffU;

} // namespace

TEST_CASE("a transparent area is blended over what is painted before it and hidden by what comes after") {
    for (const int samples : {1, 4, 16}) {
        FlatPlan plan(area_size_px);
        Sheet sheet;
        sheet.add({}, half_white);
        plan.paint({over_all(whole_red)});
        plan.plan().overlay = {sheet.vertices, sheet.indices};
        plan.plan().steps.push_back({PaintStep::Content::Transparent, 0, 6});
        FlatTriangle corner = over_all(0xff00ff00U);
        corner.at_px = {glm::vec2(30, 0), glm::vec2(64, 0), glm::vec2(64, 34)};
        plan.paint({corner});
        const scene::Picture picture = drawn(plan.plan(), area_size_px, samples);
        CHECK(pixel(picture, 20, 30) == glm::ivec3(255, 128, 128));
        CHECK(pixel(picture, 1, 1) == glm::ivec3(255, 0, 0));
        CHECK(pixel(picture, 55, 12) == glm::ivec3(0, 255, 0));
    }
}

TEST_CASE("by depth a transparent area is blended where it is nearer than what was drawn, and hides nothing") {
    for (const int samples : {1, 4, 16}) {
        FlatPlan plan(area_size_px); // its near plane is 1 m away
        Sheet sheet;
        sheet.add({}, half_white, 1.0F / 7.0F);
        plan.paint({over_all(whole_red)}, scene::DepthUse::Nearest); // 10 m away
        FlatTriangle near = over_all(0xff00ff00U);
        near.at_px = {glm::vec2(32, -50), glm::vec2(200, -50), glm::vec2(32, 200)};
        near.depth_m.fill(5.0F);
        plan.paint({near}, scene::DepthUse::Nearest);
        plan.plan().overlay = {sheet.vertices, sheet.indices};
        plan.plan().steps.push_back(
            {.content = PaintStep::Content::Transparent, .first = 0, .count = 6, .depth = scene::DepthUse::Nearest});
        scene::Picture picture = drawn(plan.plan(), area_size_px, samples);
        CHECK(pixel(picture, 20, 30) == glm::ivec3(255, 128, 128));
        CHECK(pixel(picture, 40, 30) == glm::ivec3(0, 255, 0));
        CHECK(pixel(picture, 1, 1) == glm::ivec3(255, 0, 0));
        // In the renderer's last group as in one before it.
        FlatTriangle corner = over_all(0xffff0000U);
        corner.at_px = {glm::vec2(0, 40), glm::vec2(0, 64), glm::vec2(24, 64)};
        plan.paint({corner});
        picture = drawn(plan.plan(), area_size_px, samples);
        CHECK(pixel(picture, 20, 30) == glm::ivec3(255, 128, 128));
        CHECK(pixel(picture, 5, 55) == glm::ivec3(0, 0, 255));
    }
}

TEST_CASE("by depth a slanted transparent area is cut where it passes through what was drawn") {
    FlatPlan plan(area_size_px);
    plan.paint({over_all(whole_red)}, scene::DepthUse::Nearest); // 10 m away
    // One over the depth is linear over the picture: 1/5 m at the left edge, 1/20 m at the right, 1/10 m at 2/3.
    std::vector<scene::OverlayVertex> vertices;
    for (const glm::vec2 at : {glm::vec2(0, 0), {60, 0}, {60, 64}, {0, 64}}) {
        vertices.push_back({at, half_white, at.x == 0.0F ? 0.2F : 0.05F});
    }
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    plan.plan().overlay = {vertices, indices};
    plan.plan().steps.push_back(
        {.content = PaintStep::Content::Transparent, .first = 0, .count = 6, .depth = scene::DepthUse::Nearest});
    const scene::Picture picture = drawn(plan.plan(), area_size_px, 16);
    for (int row = 1; row < 64; ++row) {
        CHECK(pixel(picture, 38, row) == glm::ivec3(255, 128, 128));
        CHECK(pixel(picture, 41, row) == glm::ivec3(255, 0, 0));
    }
}

TEST_CASE("no line shows where the triangles of a transparent area meet") {
    FlatPlan plan(area_size_px);
    Sheet sheet;
    sheet.add({}, 0xe0ffffffU);
    plan.plan().overlay = {sheet.vertices, sheet.indices};
    plan.plan().steps.push_back({PaintStep::Content::Transparent, 0, 6});
    const scene::Picture picture = drawn(plan.plan(), area_size_px, 16);
    for (int along = 12; along < 45; ++along) { CHECK(pixel(picture, along, along) == glm::ivec3(224)); }
}

TEST_CASE("transparent areas over one another are blended in their order") {
    for (const bool white_last : {false, true}) {
        FlatPlan plan(area_size_px);
        Sheet sheet;
        sheet.add({}, white_last ? half_black : half_white);
        sheet.add({}, white_last ? half_white : half_black);
        plan.paint({over_all(whole_red)});
        plan.plan().overlay = {sheet.vertices, sheet.indices};
        plan.plan().steps.push_back({PaintStep::Content::Transparent, 0, 6});
        plan.plan().steps.push_back({PaintStep::Content::Transparent, 6, 6});
        const glm::ivec3 seen = pixel(drawn(plan.plan(), area_size_px, 16), 30, 30);
        CHECK(seen.x == Approx(white_last ? 191 : 127).margin(1));
        CHECK(seen.y == Approx(white_last ? 128 : 64).margin(1));
    }
}

TEST_CASE("what lies over the picture lies over its transparent areas") {
    FlatPlan plan(area_size_px);
    Sheet sheet;
    sheet.add({}, half_white);
    sheet.add({}, 0xff0000ffU);
    plan.plan().overlay = {sheet.vertices, sheet.indices};
    plan.plan().steps.push_back({PaintStep::Content::Overlay, 6, 6});
    plan.plan().steps.insert(plan.plan().steps.begin(), {PaintStep::Content::Transparent, 0, 6});
    CHECK(pixel(drawn(plan.plan(), area_size_px, 16), 30, 30) == glm::ivec3(255, 0, 0));
}

TEST_CASE("many transparent areas among triangles have the same bytes on any number of threads") {
    constexpr glm::ivec2 size_px(200, 150);
    RandomGenerator dice(5);
    FlatPlan plan(size_px);
    Sheet sheet;
    const auto somewhere = [&](std::uint64_t width, std::uint64_t height) {
        return glm::vec2(
            static_cast<float>(below(dice, width)) - 30.0F, static_cast<float>(below(dice, height)) - 30.0F);
    };
    for (std::uint32_t i = 0; i < 40; ++i) {
        FlatTriangle triangle;
        for (glm::vec2& at : triangle.at_px) { at = somewhere(250, 200); }
        triangle.colour.fill(0xff000000U | static_cast<std::uint32_t>(below(dice, 0xffffffU)));
        plan.paint({triangle});
        sheet.add(somewhere(180, 130), static_cast<std::uint32_t>(below(dice, 0xffffffffULL)));
        plan.plan().steps.push_back({PaintStep::Content::Transparent, 6 * i, 6});
    }
    plan.plan().overlay = {sheet.vertices, sheet.indices};
    const scene::Picture one = drawn(plan.plan(), size_px, 16, 1);
    for (const int threads : {2, 5}) { CHECK(drawn(plan.plan(), size_px, 16, threads).rgba == one.rgba); }
}
