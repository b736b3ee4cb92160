#include "models/heights/height_field_export.h"
#include "models/heights/height_field_import.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "tests/models/heights/height_files.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

HeightField rough_field(int columns, int rows, double spacing_m) {
    std::vector<float> heights_m;
    for (int i = 0; i < columns * rows; ++i) {
        heights_m.push_back(static_cast<float>((static_cast<unsigned>(i) * 2654435761U) % 400000U) / 97.0F - 1234.5F);
    }
    return {columns, rows, spacing_m, heights_m};
}

void check_same(const HeightField& got, const HeightField& expected) {
    REQUIRE(got.columns() == expected.columns());
    REQUIRE(got.rows() == expected.rows());
    CHECK(got.spacing_m() == expected.spacing_m());
    int differing = 0;
    for (int row = 0; row < got.rows(); ++row) {
        for (int column = 0; column < got.columns(); ++column) {
            const float a = got.height_m(column, row);
            const float b = expected.height_m(column, row);
            differing += std::memcmp(&a, &b, sizeof a) == 0 ? 0 : 1;
        }
    }
    CHECK(differing == 0);
}

} // namespace

TEST_CASE("a field that was written is read back bit for bit, whatever its size and spacing") {
    const auto path = scratch_file("field.tif");
    for (const double spacing_m : {0.01, 1.0, 20.0, 30.000000000000004, 92.66254, 1.0 / 3.0}) {
        for (const int columns : {2, 3, 65, 130}) {
            const HeightField field = rough_field(columns, 67, spacing_m);
            write_height_field(path, field);
            check_same(read_height_field(path), field);
        }
    }
}

TEST_CASE("a height of -9999 among others like it and a negative zero survive writing") {
    const auto path = scratch_file("odd.tif");
    const HeightField field(2, 2, 5.0, {-9999.0F, -0.0F, 0.1F, -9990.5F});
    write_height_field(path, field);
    const HeightField back = read_height_field(path);
    check_same(back, field);
    CHECK(back.filled_voids == 0);
    CHECK_FALSE(back.place);
}

TEST_CASE("a field's place survives writing") {
    const auto path = scratch_file("placed.tif");
    for (const GeoPosition place : {GeoPosition{49.5, -123.25}, GeoPosition{-33.123456789, 151.0}}) {
        HeightField field = rough_field(20, 31, 90.0);
        field.place = place;
        write_height_field(path, field);
        const HeightField back = read_height_field(path);
        check_same(back, field);
        REQUIRE(back.place);
        CHECK(back.place->latitude_deg == Approx(place.latitude_deg).margin(1e-9));
        CHECK(back.place->longitude_deg == Approx(place.longitude_deg).margin(1e-9));
    }
}

TEST_CASE("the same field gives the same bytes") {
    const auto first = scratch_file("first.tif");
    const auto second = scratch_file("second.tif");
    const HeightField field = rough_field(70, 50, 12.0);
    write_height_field(first, field);
    write_height_field(second, field);
    CHECK(read_file(first) == read_file(second));
}

TEST_CASE("a field that cannot be written says why and leaves nothing behind") {
    const HeightField field = rough_field(4, 4, 1.0);
    CHECK_THROWS_WITH(
        write_height_field("/nowhere/x.tif", field), "/nowhere/x.tif: cannot be written: No such file or directory");
    CHECK_THROWS_WITH(write_height_field("/dev/full", field), "/dev/full: cannot be written: No space left on device");
}
