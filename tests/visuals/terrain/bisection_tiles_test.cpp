#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_tile_builder.h"
#include "visuals/terrain/bisection_tiles.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "ground_fields.h"

namespace octant::visuals::terrain {

namespace {

float step_to(const ErrorCodes& codes, int code) {
    return codes.metres(static_cast<std::uint8_t>(code)) / codes.metres(static_cast<std::uint8_t>(code - 1));
}

} // namespace

TEST_CASE("an error's code is the smallest that is not below it") {
    for (const ErrorCodes& codes : {ErrorCodes(0x1p-4), ErrorCodes(0x1p-12)}) {
        CHECK(codes.metres(0) == 0.0F);
        CHECK(codes.code_of(0.0F) == 0);
        CHECK(codes.code_of(std::numeric_limits<float>::min()) == 1);
        CHECK(codes.code_of(1e9F) == 255);
        for (int code = 1; code < 256; ++code) {
            const float error_m = codes.metres(static_cast<std::uint8_t>(code));
            const float below_m = codes.metres(static_cast<std::uint8_t>(code - 1));
            CHECK(below_m < error_m);
            CHECK(codes.code_of(error_m) == code);
            CHECK(codes.code_of(0.5F * (error_m + below_m)) == code);
        }
    }
}

TEST_CASE("a ground's own codes reach beyond what it spans, in fine steps but at the ends") {
    const ErrorCodes codes(0.125);
    CHECK(codes.metres(1) == 0.25F * 0.125F);
    CHECK(codes.metres(255) >= 2.0F * 65'000.0F * 0.125F);
    for (int code = 2; code < 256; ++code) {
        const float error_m = codes.metres(static_cast<std::uint8_t>(code));
        const bool fine = error_m > 4.01F * 0.125F && error_m < 8192.1F * 0.125F;
        CHECK(step_to(codes, code) < (fine ? 1.0363F : 1.1488F));
        CHECK(ErrorCodes(0.25).metres(static_cast<std::uint8_t>(code)) == 2.0F * error_m);
    }
}

TEST_CASE("the table of codes agrees with the search") {
    for (const ErrorCodes& codes : {ErrorCodes(0x1p-4), ErrorCodes(0.25)}) {
        const ErrorEncoder coder(codes, 0.25);
        CHECK(coder.code_of(0.0F) == 0);
        for (float steps = 1e-3F; steps < 1e6F; steps *= 1.003F) {
            CHECK(coder.code_of(steps) == codes.code_of(0.25F * steps));
        }
        for (int code = 1; code < 256; ++code) {
            const float error_m = codes.metres(static_cast<std::uint8_t>(code));
            CHECK(coder.code_of(4.0F * error_m) == code);
            CHECK(coder.steps_of(static_cast<std::uint8_t>(code)) == 4.0F * error_m);
        }
    }
}

namespace {

constexpr std::array<std::pair<int, int>, 10> sizes = {
    {{2, 2}, {3, 3}, {5, 5}, {9, 9}, {17, 17}, {2, 40}, {6, 11}, {33, 7}, {100, 65}, {131, 200}}};

} // namespace

TEST_CASE("every sample of a ground of any size is read back exactly") {
    for (const auto& [columns, rows] : sizes) {
        const models::heights::HeightField field = rough_metre_field(columns, rows);
        const GroundTiles ground = make_ground_tiles(field);
        int wrong = 0;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                wrong += ground.height_m(column, row) == field.height_m(column, row) ? 0 : 1;
            }
        }
        INFO(columns << " x " << rows);
        CHECK(wrong == 0);
        CHECK(ground.half_extent_m() == field.half_extent_m());
    }
}

TEST_CASE("corners and nodes hold the samples of their places, beyond the field its reflection") {
    for (const auto& [columns, rows] : sizes) {
        const models::heights::HeightField field = rough_metre_field(columns, rows);
        const GroundTiles ground = make_ground_tiles(field);
        const auto at = [&field](
                            int column, int row) { return static_cast<float>(padded_height_m(field, column, row)); };
        INFO(columns << " x " << rows);
        CHECK(ground.corner_m(0) == at(0, 0));
        const int end = ground.layout().level(0).edge;
        CHECK(ground.corner_m(1) == at(end, 0));
        CHECK(ground.corner_m(2) == at(0, end));
        CHECK(ground.corner_m(3) == at(end, end));
        int wrong = 0;
        for (int level = 0; level < ground.levels(); ++level) {
            const GroundLayout::Level& layout = ground.layout().level(level);
            const int edge = layout.edge;
            const int half = edge / 2;
            for (int row = 0; row <= layout.rows; ++row) {
                for (int column = 0; column <= layout.columns; ++column) {
                    const int x = column * edge;
                    const int y = row * edge;
                    if (column < layout.columns) {
                        wrong += ground.height_m(level, NodePart::South, column, row) != at(x + half, y);
                    }
                    if (row < layout.rows) {
                        wrong += ground.height_m(level, NodePart::West, column, row) != at(x, y + half);
                    }
                    if (column < layout.columns && row < layout.rows) {
                        wrong += ground.height_m(level, NodePart::Centre, column, row) != at(x + half, y + half);
                    }
                }
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("between samples a ground is as high as its field, and nothing lies beside it") {
    const models::heights::HeightField field = rough_metre_field(20, 13);
    const GroundTiles ground = make_ground_tiles(field);
    for (double x_m = -300.0; x_m <= 300.0; x_m += 37.0) {
        for (double y_m = -200.0; y_m <= 200.0; y_m += 31.0) {
            CHECK(ground.height_at(x_m, y_m) == field.height_at(x_m, y_m));
        }
    }
    CHECK(ground.height_at(285.0, 180.0) == field.height_at(285.0, 180.0));
}

TEST_CASE("a row of heights is that of its samples") {
    for (const auto& [columns, rows] :
        {std::pair(2, 2), {3, 3}, {129, 129}, {130, 71}, {33, 200}, {257, 2}, {2, 257}, {300, 140}}) {
        CAPTURE(columns, rows);
        std::vector<float> heights_m;
        for (int i = 0; i < columns * rows; ++i) { heights_m.push_back(static_cast<float>((i * 7919) % 1000)); }
        const GroundTiles ground = make_ground_tiles({columns, rows, 10.0, heights_m});
        std::vector<float> row_m(static_cast<std::size_t>(columns));
        for (int row = 0; row < rows; ++row) {
            std::ranges::fill(row_m, -1.0F);
            ground.copy_row(row, row_m);
            for (int column = 0; column < columns; ++column) {
                CAPTURE(column, row);
                REQUIRE(row_m[static_cast<std::size_t>(column)] == ground.height_m(column, row));
            }
        }
    }
}

} // namespace octant::visuals::terrain
