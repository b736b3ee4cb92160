#include "visuals/terrain/bisection_ground_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "ground_fields.h"

namespace octant::visuals::terrain {

TEST_CASE("a single peak is an error of its own height for whatever leaves it out") {
    std::vector<float> heights_m(25, 0.0F);
    heights_m[2 * 5 + 1] = 64.0F;
    const GroundTiles ground = make_ground_tiles({5, 5, 30.0, heights_m});
    const std::uint8_t peak = ground.codes().code_of(64.0F);
    CHECK(ground.error_code(1, NodePart::South, 0, 1) == peak);
    CHECK(ground.error_code(0, NodePart::West, 0, 0) >= peak);
    CHECK(ground.error_code(0, NodePart::Centre, 0, 0) >= peak);
    CHECK(ground.error_code(1, NodePart::South, 1, 1) == 0);
    CHECK(ground.error_code(1, NodePart::West, 2, 0) == 0);
}

TEST_CASE("a plane has no errors") {
    std::vector<float> heights_m;
    for (int row = 0; row < 33; ++row) {
        for (int column = 0; column < 33; ++column) { heights_m.push_back(static_cast<float>(3 * column - 2 * row)); }
    }
    const GroundTiles ground = make_ground_tiles({33, 33, 10.0, heights_m});
    CHECK(ground.error_code(0, NodePart::Centre, 0, 0) == 0);
    CHECK(ground.error_code(4, NodePart::Centre, 7, 9) == 0);
}

TEST_CASE("the number of threads changes no byte of a ground") {
    const models::heights::HeightField field = rough_metre_field(700, 300);
    const GroundTiles one = make_ground_tiles(field, 1);
    for (const int threads : {2, 3}) {
        const GroundTiles other = make_ground_tiles(field, threads);
        REQUIRE(other.memory().size() == one.memory().size());
        CHECK(std::memcmp(other.memory().data(), one.memory().data(), one.memory().size()) == 0);
    }
}

TEST_CASE("ranges contain the samples of their nodes and nothing else") {
    for (const auto& [columns, rows] : {std::pair{5, 5}, {100, 65}, {131, 300}}) {
        const models::heights::HeightField field = rough_metre_field(columns, rows);
        const GroundTiles ground = make_ground_tiles(field);
        for (int level = 0; level <= ground.layout().range_level(); ++level) {
            const GroundLayout::Level& at = ground.layout().level(level);
            for (int y = 0; y < at.rows; ++y) {
                for (int x = 0; x < at.columns; ++x) {
                    float lowest_m = 1e9F;
                    float highest_m = -1e9F;
                    for (int row = y * at.edge; row <= std::min((y + 1) * at.edge, rows - 1); ++row) {
                        for (int column = x * at.edge; column <= std::min((x + 1) * at.edge, columns - 1); ++column) {
                            lowest_m = std::min(lowest_m, field.height_m(column, row));
                            highest_m = std::max(highest_m, field.height_m(column, row));
                        }
                    }
                    CHECK(ground.lowest_m(level, x, y) == lowest_m);
                    CHECK(ground.highest_m(level, x, y) == highest_m);
                }
            }
        }
        CHECK(ground.metadata().lowest_m == field.lowest_m());
        CHECK(ground.metadata().highest_m == field.highest_m());
    }
}

TEST_CASE("fractions of a metre are kept to half a unit") {
    std::vector<float> heights_m;
    for (int i = 0; i < 400; ++i) { heights_m.push_back(1000.0F + 700.0F * std::sin(static_cast<float>(i))); }
    const models::heights::HeightField field(20, 20, 5.0, heights_m);
    const GroundTiles ground = make_ground_tiles(field);
    CHECK(ground.shape().height_unit_m == 0x1p-5);
    for (int i = 0; i < 400; ++i) {
        const float off_m = ground.height_m(i % 20, i / 20) - field.height_m(i % 20, i / 20);
        CHECK(std::abs(off_m) <= 0x1p-6F);
    }
}

TEST_CASE("a ground takes at most 3.52 bytes a sample") {
    const GroundLayout layout(1025, 1025);
    CHECK(static_cast<double>(layout.total_bytes()) <= 3.52 * 1025 * 1025);
}

} // namespace octant::visuals::terrain
