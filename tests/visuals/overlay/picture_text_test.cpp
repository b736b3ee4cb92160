#include "visuals/overlay/overlay.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

using namespace octant::visuals;

namespace {

/// What is drawn of lines in a picture.
struct Drawn {
    std::size_t vertices = 0;
    float right_px = 0.0F;
    float bottom_px = 0.0F;
};

Drawn drawn(const std::vector<std::string>& lines, const glm::ivec2& picture_px) {
    overlay::OverlayCanvas canvas;
    const scene::OverlayDraw draw = overlay::draw_text(canvas, lines, picture_px);
    Drawn all{.vertices = draw.vertices.size()};
    for (const scene::OverlayVertex& vertex : draw.vertices) {
        all.right_px = std::max(all.right_px, vertex.at_px.x);
        all.bottom_px = std::max(all.bottom_px, vertex.at_px.y);
    }
    return all;
}

const std::string long_line = "grounds differ by -40.0 m: theirs 40.0 m, ours 0.0 m, and so on for "
                              "as long as there are words that a picture of this width has no room for";

} // namespace

TEST_CASE("a line that is too long for a picture goes on below, with all its letters") {
    const Drawn wide = drawn({long_line}, {4000, 450});
    const Drawn narrow = drawn({long_line}, {800, 450});
    CHECK(wide.right_px > 800.0F);
    CHECK(narrow.right_px < 800.0F);
    CHECK(narrow.vertices == wide.vertices);
    const Drawn two_lines = drawn({"A", "A"}, {800, 450});
    CHECK(narrow.bottom_px >= two_lines.bottom_px);
}

TEST_CASE("a word that is longer than a picture is wide is broken, and lines end at its lower end") {
    const Drawn narrow = drawn({std::string(200, 'W')}, {200, 450});
    CHECK(narrow.right_px < 200.0F);
    CHECK(narrow.vertices == drawn({std::string(200, 'W')}, {9000, 450}).vertices);
    CHECK(drawn(std::vector<std::string>(100, long_line), {64, 48}).bottom_px < 70.0F);
}
