#include "ui/terrain/map_picture.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace octant;
using namespace octant::models::heights;

namespace {

HeightField ramp(int columns, int rows) {
    std::vector<float> heights_m;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) { heights_m.push_back(static_cast<float>(10 * column)); }
    }
    return {columns, rows, 30.0, heights_m};
}

/// Red pixels in a square around a pixel.
int red_around(const ui::report::Picture& picture, int x, int y, int reach) {
    int red = 0;
    for (int j = y - reach; j <= y + reach; ++j) {
        for (int i = x - reach; i <= x + reach; ++i) {
            if (i < 0 || j < 0 || i >= picture.width_px || j >= picture.height_px) { continue; }
            const auto at = 3 * static_cast<std::size_t>(j * picture.width_px + i);
            const auto part = [&](std::size_t k) { return std::to_integer<int>(picture.bytes[at + k]); };
            red += part(0) > 200 && part(1) < 30 && part(2) < 40 ? 1 : 0;
        }
    }
    return red;
}

} // namespace

TEST_CASE("a map's picture rings the places of its notes in red, north up") {
    const HeightField field = ramp(90, 45); // 10 pixels a sample
    // The sample of column 80 and row 40, in the north-east.
    const glm::dvec2 place_m((80 - 44.5) * 30.0, (40 - 22.0) * 30.0);
    const visuals::terrain::GroundSamples samples(field);
    const std::vector<MapNote> notes{{"all of it"}, {"there", {place_m}}};
    const ui::report::Picture picture = ui::terrain::map_picture(samples, notes);
    CHECK(picture.view().is_whole());
    CHECK(red_around(picture, 12 + 805, 12 + 450 - 405, 16) > 40);
    CHECK(red_around(picture, 12 + 805, 12 + 450 - 405, 6) == 0);
    CHECK(red_around(picture, 100, 400, 60) == 0);
    CHECK(picture.bytes == ui::terrain::map_picture(samples, notes).bytes);
}

TEST_CASE("a map of one cell and one long strip have pictures, too") {
    for (const HeightField& field : {ramp(2, 2), ramp(2, 700), ramp(2500, 3)}) {
        const auto picture = ui::terrain::map_picture(visuals::terrain::GroundSamples(field), {});
        CHECK(picture.view().is_whole());
        CHECK(picture.width_px <= 1100);
        CHECK(picture.height_px <= 1000);
    }
}
