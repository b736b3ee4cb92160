#include "visuals/overlay/overlay_canvas.h"
#include "visuals/overlay/stroke_font.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

#include "overlay_ink.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::overlay;
using namespace octant::visuals::scene;

namespace {

constexpr std::string_view letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.,-+/:;_=()'%^";
constexpr OverlayPen pen{4.0F, 2.0F, 0xff00ff00U, 0x80000000U};

OverlayCanvas new_canvas() {
    OverlayCanvas canvas;
    canvas.begin(glm::mat3(1.0F), pen);
    return canvas;
}

} // namespace

TEST_CASE("every letter of the font lies on its grid and looks different from the others") {
    std::vector<std::vector<int>> seen;
    for (const char letter : letters) {
        INFO(letter);
        const auto strokes = glyph_strokes(letter);
        REQUIRE(strokes.size() >= 2);
        CHECK(strokes.front().begins_stroke);
        CHECK_FALSE(strokes.back().begins_stroke);
        std::vector<int> drawing;
        for (const GlyphPoint& point : strokes) {
            CHECK((point.x >= 0 && point.x <= glyph_width));
            CHECK((point.y >= 0 && point.y <= glyph_height));
            drawing.insert(drawing.end(), {point.x, point.y, point.begins_stroke ? 1 : 0});
        }
        CHECK((letter == 'O' || std::ranges::find(seen, drawing) == seen.end()));
        seen.push_back(drawing);
    }
    CHECK(glyph_strokes(' ').empty());
    CHECK(glyph_strokes('\xe9').empty());
}

TEST_CASE("a line is opaque in its width, fades over a pixel and has a shade around it") {
    OverlayCanvas canvas = new_canvas();
    canvas.line({10.0F, 10.0F}, {50.0F, 10.0F});
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {30.0F, 10.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {30.0F, 11.4F}) == Approx(1.0));
    CHECK(ink_at(draw, {30.0F, 12.0F}) == Approx(0.5));
    CHECK(ink_at(draw, {30.0F, 12.6F}) == 0.0);
    CHECK(ink_at(draw, {30.0F, 13.9F}, false) == Approx(0.5).margin(0.01));
    CHECK(ink_at(draw, {30.0F, 14.1F}, false) == 0.0);
    CHECK(ink_at(draw, {51.5F, 10.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {52.5F, 10.0F}) == 0.0);
}

TEST_CASE("a corner of joined lines is filled to its tip, a sharp one is cut off") {
    OverlayCanvas canvas = new_canvas();
    canvas.polyline(std::array{glm::vec2(10, 50), glm::vec2(50, 50), glm::vec2(50, 10)});
    canvas.polyline(std::array{glm::vec2(10, 90), glm::vec2(90, 95), glm::vec2(10, 100)});
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {51.4F, 51.4F}) > 0.9);
    CHECK(ink_at(draw, {48.0F, 48.0F}) < 0.6);
    CHECK(ink_at(draw, {91.5F, 95.0F}) > 0.9);
    CHECK(ink_at(draw, {93.0F, 95.0F}) == 0.0);
}

TEST_CASE("a circle is closed: as strong where it ends as elsewhere") {
    OverlayCanvas canvas = new_canvas();
    canvas.circle({50.0F, 50.0F}, 20.0F);
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {70.0F, 50.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {30.0F, 50.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {50.0F, 50.0F}) == 0.0);
}

TEST_CASE("lines are cut at the clip box and go on where they come back") {
    OverlayCanvas canvas = new_canvas();
    canvas.clip_to({{20.0F, 0.0F}, {60.0F, 40.0F}});
    canvas.polyline(std::array{glm::vec2(0, 30), glm::vec2(40, 30), glm::vec2(40, 80), glm::vec2(50, 0)});
    canvas.line({0.0F, 90.0F}, {90.0F, 90.0F});
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {15.0F, 30.0F}) == 0.0);
    CHECK(ink_at(draw, {22.0F, 30.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {40.0F, 39.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {40.0F, 45.0F}) == 0.0);
    CHECK(ink_at(draw, {47.5F, 20.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {50.0F, 90.0F}) == 0.0);
}

TEST_CASE("text is placed by its height and width, and drawn whole or not at all") {
    OverlayCanvas canvas = new_canvas();
    canvas.text({{50.0F, 50.0F}, 30.0F, 0.5F}, "H");
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {40.0F, 36.0F}) == Approx(1.0)); // 20 x 30 around the middle
    CHECK(ink_at(draw, {60.0F, 64.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {50.0F, 50.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {50.0F, 40.0F}) == 0.0);
    canvas.begin(glm::mat3(1.0F), pen);
    canvas.clip_to({{0.0F, 0.0F}, {59.0F, 100.0F}});
    canvas.text({{50.0F, 50.0F}, 30.0F, 0.5F}, "H");
    CHECK(canvas.finish().indices.empty());
}

TEST_CASE("text goes along its direction, the tops of its letters to the left of it") {
    OverlayCanvas canvas = new_canvas();
    canvas.text({{50.0F, 50.0F}, 30.0F, 0.5F, {0.0F, 1.0F}}, "L"); // downwards: tops to the right
    const OverlayDraw draw = canvas.finish();
    CHECK(ink_at(draw, {64.0F, 40.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {35.0F, 58.0F}) == Approx(1.0));
    CHECK(ink_at(draw, {64.0F, 58.0F}) == 0.0);
}

TEST_CASE("a canvas that is used again needs no more memory") {
    OverlayCanvas canvas;
    const void* memory = nullptr;
    for (int picture = 0; picture < 3; ++picture) {
        canvas.begin(glm::mat3(1.0F), pen);
        canvas.text({{50.0F, 50.0F}, 30.0F, 0.5F}, letters);
        const OverlayDraw draw = canvas.finish();
        CHECK((picture == 0 || draw.vertices.data() == memory));
        memory = draw.vertices.data();
    }
}
