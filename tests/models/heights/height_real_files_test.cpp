#include "models/heights/height_field_import.h"
#include "tests/models/heights/height_files.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

struct Expected {
    int columns = 0;
    int rows = 0;
    double spacing_m = 0.0;
    double lowest_m = 0.0;
    double highest_m = 0.0;
    long voids = 0;
};

/// Nothing when the file is not on this computer.
std::optional<HeightField> read_and_check(const std::string& name, const Expected& expected) {
    const auto path = real_terrain_file(name);
    if (!path) { return std::nullopt; }
    HeightField field = read_height_field(*path);
    CHECK(field.columns() == expected.columns);
    CHECK(field.rows() == expected.rows);
    CHECK(field.spacing_m() == Approx(expected.spacing_m).epsilon(1e-4));
    CHECK(field.lowest_m() == Approx(expected.lowest_m).margin(0.1));
    CHECK(field.highest_m() == Approx(expected.highest_m).margin(0.1));
    CHECK(field.filled_voids == expected.voids);
    CHECK(field.name == name);
    return field;
}

} // namespace

TEST_CASE("Puget Sound is read as published: 1025 samples 160 m apart") {
    read_and_check("pugetsound_1025.tif", {1025, 1025, 160.0, 0.0, 4379.8, 0});
}

TEST_CASE("the Grand Canyon is read as published: 1025 samples 60 m apart") {
    read_and_check("gcanyon_1025.tif", {1025, 1025, 60.0, 350.1, 1870.7, 0});
    read_and_check("gcanyon_1025_smooth.tif", {1025, 1025, 60.0, 350.1, 1870.7, 0});
}

TEST_CASE("the field of Vancouver is read in its own projection and knows its place") {
    const auto field = read_and_check("vancouver_2049.tif", {2049, 2049, 52.0, -37.0, 2656.0, 0});
    if (field) {
        REQUIRE(field->place);
        CHECK(field->place->latitude_deg == Approx(49.533).margin(0.001));
        CHECK(field->place->longitude_deg == Approx(-123.093).margin(0.001));
    }
}

TEST_CASE("an SRTM tile of the lower Thames is brought to metres") {
    const auto field = read_and_check("N51E000.hgt", {2374, 3842, 28.93355, -15.78, 264.0, 37});
    if (field) {
        REQUIRE(field->place);
        CHECK(field->place->latitude_deg == Approx(51.5).margin(0.001));
        CHECK(field->place->longitude_deg == Approx(0.5).margin(1e-6));
    }
}

TEST_CASE("a geographic GeoTIFF has its sea and mountain voids filled") {
    read_and_check("srtm3_N49W123.tif", {2376, 3681, 30.1819, -29.73, 2674.0, 210255});
}
