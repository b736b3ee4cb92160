#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>

#include <array>
#include <vector>

using namespace octant;
using namespace octant::tests;

namespace {

constexpr std::uint32_t white = 0xffffffU;

/// Rectangles in pixels from the upper left.
struct Overlay {
    std::vector<scene::OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;

    Overlay& add(const glm::vec2& least, const glm::vec2& most, std::uint32_t colour, int alpha) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        const std::uint32_t packed = colour | static_cast<std::uint32_t>(alpha) << 24U;
        for (const glm::vec2 corner : {least, glm::vec2(most.x, least.y), most, glm::vec2(least.x, most.y)}) {
            vertices.push_back({corner, packed});
        }
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 3U, 2U}) { // either way round
            indices.push_back(first + corner);
        }
        return *this;
    }

    scene::OverlayDraw draw() const { return {vertices, indices}; }
};

scene::Picture part_of(const scene::Picture& picture, const scene::PixelRect& rect) {
    scene::Picture part;
    part.width = rect.width;
    part.height = rect.height;
    for (int row = 0; row < rect.height; ++row) {
        for (int column = 0; column < rect.width; ++column) {
            for (const int value : pixel(picture, rect.x + column, rect.y + row)) {
                part.rgba.push_back(static_cast<std::uint8_t>(value));
            }
        }
    }
    return part;
}

} // namespace

TEST_CASE("an overlay lies over everything at its pixels, by its alpha") {
    Studio studio;
    load_squares(studio);
    Overlay overlay;
    overlay.add({8.0F, 4.0F}, {16.0F, 60.0F}, white, 255).add({32.0F, 4.0F}, {40.0F, 60.0F}, 0, 128);
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = empty_plan();
        add_square(plan, 0, ahead(0.6F)); // red over the whole picture, near
        plan.overlay = overlay.draw();
        const scene::Picture picture = studio.picture(plan, mode);
        CHECK(pixel(picture, 8, 4) == Pixel{255, 255, 255, 255});
        CHECK(pixel(picture, 15, 59) == Pixel{255, 255, 255, 255});
        CHECK(pixel(picture, 7, 4) == red_px);
        CHECK(pixel(picture, 16, 4) == red_px);
        CHECK(pixel(picture, 8, 3) == red_px);
        CHECK(pixel(picture, 8, 60) == red_px);
        const Pixel half = pixel(picture, 36, 30);
        CHECK(half[0] == Approx(127).margin(1));
        CHECK(half[3] == 255);
        CHECK(studio.renderer().draw_calls() == 2);
        plan.overlay = {};
        CHECK(count_of(studio.picture(plan, mode), red_px) == side_px * side_px);
        CHECK(studio.renderer().draw_calls() == 1);
    }
}

TEST_CASE("by depth a transparent area is blended where it is nearer than what was drawn, and hides nothing") {
    using scene::PaintStep;
    Studio studio;
    scene::FramePlan plan = empty_plan();
    Triangles ground;
    ground.add({}, 8.0F, red).add({.left = 0.0F}, 2.0F, green).add({.top = 0.0F}, 6.0F, blue);
    plan.ground = ground.draw();
    Overlay sheet;
    sheet.add({0.0F, 0.0F}, {64.0F, 64.0F}, white, 128);
    for (scene::OverlayVertex& vertex : sheet.vertices) { vertex.depth = plan.view_to_clip[3][2] / 4.0F; }
    plan.overlay = sheet.draw();
    plan.depth_boxes = {{glm::ivec2(0), glm::ivec2(side_px)}};
    const auto by_depth = [](PaintStep::Content content, std::uint32_t first, std::uint32_t count) {
        return PaintStep{.content = content, .first = first, .count = count, .depth = scene::DepthUse::Nearest};
    };
    plan.steps = {{PaintStep::Content::ClearDepth, 0, 1}, by_depth(PaintStep::Content::Ground, 0, 12),
        by_depth(PaintStep::Content::Transparent, 0, 6), by_depth(PaintStep::Content::Ground, 12, 6)};
    scene::Picture picture;
    studio.renderer().draw(plan);
    studio.renderer().finish_and_read(picture);
    const Pixel seen = pixel(picture, 10, 10); // red under the sheet
    CHECK(seen[0] == 255);
    CHECK(seen[1] == Approx(128).margin(1));
    CHECK(pixel(picture, 50, 10) == green_px); // nearer than the sheet
    CHECK(pixel(picture, 10, 50) == blue_px);  // nearer than the red, and not hidden by the sheet
    CHECK(pixel(picture, 50, 50) == green_px);
}

TEST_CASE("later parts of an overlay cover earlier ones") {
    Studio studio;
    Overlay overlay;
    overlay.add({0.0F, 0.0F}, {64.0F, 64.0F}, 0x0000ffU, 255).add({0.0F, 0.0F}, {64.0F, 64.0F}, 0xff0000U, 255);
    scene::FramePlan plan = empty_plan();
    plan.overlay = overlay.draw();
    CHECK(count_of(studio.picture(plan), blue_px) == side_px * side_px);
}

TEST_CASE("an inset shows what a renderer of its size shows, around it nothing changes") {
    const scene::PixelRect rect{101, 37, 64, 48};
    const FullScene full;
    Overlay overlay;
    overlay.add({3.0F, 5.0F}, {20.0F, 9.0F}, white, 200);
    Studio large(gl::make_osmesa_context(), 1, 200, 120);
    Studio small(gl::make_osmesa_context(), 1, rect.width, rect.height);
    for (Studio* studio : {&large, &small}) { studio->renderer().load_models(full.models()); }
    for (const HiddenSurfaceMode outer_way : all_modes) {
        for (const HiddenSurfaceMode mode : all_modes) {
            const scene::FramePlan plan = full.plan();
            scene::FramePlan inset = full.plan();
            inset.overlay = overlay.draw();
            const scene::Picture alone = small.picture(inset, mode, FullScene::shadow_indices);
            const scene::Picture without = large.picture(plan, outer_way, FullScene::shadow_indices);
            scene::Picture with;
            large.renderer().draw(framed(plan, outer_way, FullScene::shadow_indices));
            large.renderer().draw_inset(framed(inset, mode, FullScene::shadow_indices), rect);
            large.renderer().finish_and_read(with);
            CHECK(differing(part_of(with, rect), alone, 2) <= 3);
            const scene::PixelRect framed{rect.x - 1, rect.y - 1, rect.width + 2, rect.height + 2};
            scene::Picture restored = with;
            for (int row = framed.y; row < framed.y + framed.height; ++row) {
                for (int i = 4 * framed.x; i < 4 * (framed.x + framed.width); ++i) {
                    const auto at = static_cast<std::size_t>(4 * with.width * row + i);
                    restored.rgba[at] = without.rgba[at];
                }
            }
            CHECK(differing(restored, without, 0) == 0);
            CHECK(differing(with, without, 0) > rect.width * rect.height / 4);
        }
    }
}

TEST_CASE("in an inset planes cut where they cut in a picture of its own") {
    Studio studio;
    load_squares(studio);
    scene::FramePlan inset = empty_plan();
    add_square(inset, 0, ahead(0.6F)); // red over the whole inset
    inset.clips.push_back({{glm::vec4(1.0F, 0.0F, 0.0F, 0.0F), glm::vec4(0.0F, 1.0F, 0.0F, 0.0F)}, 2});
    inset.steps = {{scene::PaintStep::Content::Aircraft, 0, 1, 0}};
    const scene::PixelRect rect{24, 40, 20, 20};
    studio.renderer().draw(empty_plan());
    studio.renderer().draw_inset(inset, rect);
    scene::Picture picture;
    studio.renderer().finish_and_read(picture);
    const scene::Picture part = part_of(picture, rect);
    CHECK(count_of(part, red_px) == 10 * 10); // the upper right quarter
    CHECK(pixel(part, 10, 9) == red_px);
    CHECK(pixel(part, 9, 9) == grey_px);
    CHECK(pixel(part, 10, 10) == grey_px);
}

TEST_CASE("an inset may lie in a corner, and the next picture is whole again") {
    Studio studio;
    load_squares(studio);
    scene::FramePlan green_plan = empty_plan();
    green_plan.background = green;
    for (const HiddenSurfaceMode mode : all_modes) {
        scene::FramePlan plan = empty_plan();
        studio.renderer().draw(framed(plan, mode));
        studio.renderer().draw_inset(framed(green_plan, mode), {0, 44, 20, 20});
        scene::Picture picture;
        studio.renderer().finish_and_read(picture);
        CHECK(count_of(picture, green_px) == 20 * 20);
        CHECK(pixel(picture, 0, 63) == green_px);
        CHECK(pixel(picture, 19, 44) == green_px);
        CHECK(count_of(picture, grey_px) == side_px * side_px - 21 * 21); // a frame of one pixel
        CHECK(count_of(studio.picture(green_plan, mode), green_px) == side_px * side_px);
    }
}
