#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/real_files.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

/// Values 0, 1, 2, ... from the north-west.
RasterFile counted(int columns, int rows) {
    RasterFile raster;
    raster.columns = columns;
    raster.rows = rows;
    for (int i = 0; i < columns * rows; ++i) { raster.values.push_back(i); }
    return raster;
}

/// What `counted` must look like after reading: its rows turned to run from the south.
void check_counted(const HeightField& field, double unit = 1.0, double base = 0.0) {
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const int value = (field.rows() - 1 - row) * field.columns() + column;
            CHECK(field.height_m(column, row) == Approx(base + unit * value));
        }
    }
}

/// An SRTM tile whose heights are the line number from the north.
void write_tile(const std::filesystem::path& path, int side) {
    std::string bytes;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            bytes += static_cast<char>(y >> 8);
            bytes += static_cast<char>(y & 0xff);
        }
    }
    write_file(path, bytes);
}

} // namespace

TEST_CASE("a 16-bit PNG is read with the spacing and height scale that are given") {
    RasterFile raster = counted(4, 3);
    raster.type = GDT_UInt16;
    raster.values.back() = 40000;
    const auto path = scratch_file("heights.png");
    write_raster(path, "PNG", raster);
    const HeightField field = read_height_field(path, {.spacing_m = 12.5, .height_scale = 0.1});
    CHECK(field.columns() == 4);
    CHECK(field.rows() == 3);
    CHECK(field.spacing_m() == 12.5);
    CHECK(field.height_m(0, 2) == 0.0F);
    CHECK(field.height_m(1, 2) == Approx(0.1));
    CHECK(field.height_m(3, 0) == Approx(4000.0));
    CHECK(field.name == "heights.png");
    CHECK_FALSE(field.place);
}

TEST_CASE("binary PGM of 8 and of 16 bits and plain PGM are read") {
    const auto check = [](const std::string& name, const std::string& bytes) {
        const auto path = scratch_file(name);
        write_file(path, bytes);
        const HeightField field = read_height_field(path);
        CHECK(field.columns() == 3);
        CHECK(field.rows() == 2);
        CHECK(field.spacing_m() == 30.0);
        check_counted(field);
    };
    using std::string_literals::operator""s;
    check("byte.pgm", "P5\n3 2\n255\n\0\1\2\3\4\5"s);
    check("word.pgm", "P5\n3 2\n65535\n\0\0\0\1\0\2\0\3\0\4\0\5"s);
    check("plain.pgm", "P2 # made by hand\n3 2\n65535\n0 1 2\r\n3 4 # two to come\n5\n");
    const auto path = scratch_file("scaled.pgm");
    write_file(path, "P2 2 2 65535 0 40000 1 2");
    const HeightField field = read_height_field(path, {.spacing_m = 5.0, .height_scale = 0.05});
    CHECK(field.height_m(1, 1) == Approx(2000.0));
    CHECK(field.spacing_m() == 5.0);
}

TEST_CASE("an ASCII grid without a coordinate system counts as metres and its voids are filled") {
    const auto path = scratch_file("grid.asc");
    write_file(path, "ncols 3\nnrows 3\nxllcorner 1000\nyllcorner 2000\ncellsize 25\nNODATA_value -1\n"
                     "9 2 9\n4 -1 8\n9 6 9\n");
    const HeightField field = read_height_field(path);
    CHECK(field.spacing_m() == 25.0);
    CHECK(field.filled_voids == 1);
    CHECK(field.height_m(1, 1) == 5.0F);
    CHECK(field.height_m(0, 1) == 4.0F);
    CHECK(field.height_m(1, 2) == 2.0F);
    CHECK_FALSE(field.place);
}

TEST_CASE("a projected GeoTIFF in metres is taken sample by sample and placed on the earth") {
    RasterFile raster = counted(5, 4);
    raster.transform = {500000.0 - 2.5 * 20.0, 20.0, 0.0, 5540000.0 + 2.0 * 20.0, 0.0, -20.0};
    raster.system = "EPSG:32610";
    const auto path = scratch_file("utm.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    CHECK(field.spacing_m() == 20.0);
    check_counted(field);
    REQUIRE(field.place);
    CHECK(field.place->longitude_deg == Approx(-123.0).margin(1e-9));
    CHECK(field.place->latitude_deg == Approx(50.0114).margin(2e-3));
}

TEST_CASE("files that run from the south or from the east are turned") {
    RasterFile raster = counted(3, 2);
    raster.transform = {90.0, -30.0, 0.0, 0.0, 0.0, 30.0};
    raster.system = "EPSG:32610";
    raster.transform[0] += 500000.0;
    raster.transform[3] += 5000000.0;
    const auto path = scratch_file("turned.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    const std::vector<float> expected = {2, 1, 0, 5, 4, 3};
    for (int i = 0; i < 6; ++i) { CHECK(field.height_m(i % 3, i / 3) == expected[static_cast<std::size_t>(i)]); }
}

TEST_CASE("feet on the ground and feet of height become metres") {
    RasterFile raster = counted(3, 3);
    // Oregon GIC Lambert in international feet.
    raster.transform = {1300000.0, 100.0, 0.0, 700000.0, 0.0, -100.0};
    raster.system = "EPSG:2992";
    raster.unit = "ft";
    const auto path = scratch_file("feet.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    CHECK(field.spacing_m() == Approx(30.48));
    check_counted(field, 0.3048);
    raster.unit = "US survey foot";
    write_raster(path, "GTiff", raster);
    check_counted(read_height_field(path), 1200.0 / 3937.0);
}

TEST_CASE("scale and offset of a band are applied") {
    RasterFile raster = counted(4, 4);
    raster.type = GDT_Int16;
    raster.transform = {0.0, 10.0, 0.0, 0.0, 0.0, -10.0};
    raster.scale = 0.5;
    raster.offset = 100.0;
    const auto path = scratch_file("scaled.tif");
    write_raster(path, "GTiff", raster);
    check_counted(read_height_field(path), 0.5, 100.0);
}

TEST_CASE("degrees become a square grid in metres that keeps the ground where it was") {
    // Heights are 1000 m a degree of longitude plus 5000 m a degree of latitude.
    const double step = 1.0 / 1200.0;
    const double west = 8.0;
    const double north = 60.3;
    RasterFile raster;
    raster.columns = 241;
    raster.rows = 241;
    for (int y = 0; y < raster.rows; ++y) {
        for (int x = 0; x < raster.columns; ++x) {
            raster.values.push_back(1000.0 * x * step + 5000.0 * (raster.rows - 1 - y) * step);
        }
    }
    raster.transform = {west - 0.5 * step, step, 0.0, north + 0.5 * step, 0.0, -step};
    raster.system = "EPSG:4326";
    const auto path = scratch_file("degrees.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    REQUIRE(field.place);
    CHECK(field.place->longitude_deg == Approx(8.1).margin(1e-9));
    CHECK(field.place->latitude_deg == Approx(60.2).margin(1e-3));
    // A degree at 60.2 degrees north: 55,455 m east (WGS 84 radius 6,394,260 m), 111,420 m north.
    const double east_m = 6394260.0 * std::cos(60.2 * 3.14159265358979 / 180.0) * 3.14159265358979 / 180.0;
    const double north_m = 111420.0;
    CHECK(field.spacing_m() == Approx(0.5 * step * east_m).epsilon(1e-3));
    const double width_north_m =
        0.2 * east_m * (std::cos(60.3 * 3.14159265358979 / 180.0) / std::cos(60.2 * 3.14159265358979 / 180.0));
    CHECK(2.0 * field.half_extent_m().x == Approx(width_north_m).margin(2.0 * field.spacing_m()));
    CHECK(2.0 * field.half_extent_m().y == Approx(0.2 * north_m).margin(3.0 * field.spacing_m()));
    // On the central meridian straight north is straight up the file.
    const double centre = *field.height_at(0.0, 0.0);
    CHECK(*field.height_at(0.0, 5000.0) - centre == Approx(5000.0 / north_m * 5000.0).margin(0.5));
    CHECK(*field.height_at(3000.0, 0.0) - centre == Approx(3000.0 / east_m * 1000.0).margin(0.5));
    CHECK(centre == Approx(1000.0 * 0.1 + 5000.0 * (field.place->latitude_deg - 60.1)).margin(0.05));
}

TEST_CASE("web Mercator is brought to true scale") {
    RasterFile raster = counted(91, 91);
    raster.transform = {1000000.0, 100.0, 0.0, 8400000.0, 0.0, -100.0};
    raster.system = "EPSG:3857";
    const auto path = scratch_file("mercator.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    REQUIRE(field.place);
    const double latitude_rad = field.place->latitude_deg * 3.14159265358979 / 180.0;
    CHECK(field.spacing_m() == Approx(50.0 * std::cos(latitude_rad)).epsilon(0.005));
    CHECK(field.columns() > 160);
}

TEST_CASE("an SRTM tile is read by its name and size") {
    const auto path = scratch_file("S01W001.hgt");
    write_tile(path, 1201);
    const HeightField field = read_height_field(path);
    CHECK(field.spacing_m() == Approx(46.2).epsilon(0.005));
    REQUIRE(field.place);
    CHECK(field.place->latitude_deg == Approx(-0.5).margin(1e-3));
    CHECK(field.place->longitude_deg == Approx(-0.5).margin(1e-9));
    CHECK(field.height_m(0, 0) == Approx(1200.0).margin(1.0));
    CHECK(field.height_m(0, field.rows() - 1) == Approx(0.0).margin(1.0));
    CHECK(field.filled_voids == 0);
}

TEST_CASE("a USGS DEM is read in its own projection") {
    RasterFile raster = counted(6, 5);
    raster.type = GDT_Int16;
    raster.transform = {500000.0 - 15.0, 30.0, 0.0, 5000000.0 + 15.0, 0.0, -30.0};
    raster.system = "EPSG:26710";
    const auto path = scratch_file("survey.dem");
    write_raster(path, "USGSDEM", raster);
    const HeightField field = read_height_field(path);
    CHECK(field.columns() == 6);
    CHECK(field.rows() == 6);
    CHECK(field.spacing_m() == 30.0);
    // GDAL's writer adds a row without data in the south.
    CHECK(field.filled_voids == 6);
    CHECK(field.height_m(0, 5) == 0.0F);
    CHECK(field.height_m(2, 3) == 14.0F);
    CHECK(field.height_m(5, 1) == 29.0F);
    CHECK(field.place);
}

TEST_CASE("samples without data are told by the usual marks and filled") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double mark : {-32768.0, -32767.0, -9999.0, double(NAN), infinity, -3.4e38}) {
        RasterFile raster = counted(3, 3);
        raster.transform = {0.0, 10.0, 0.0, 0.0, 0.0, -10.0};
        raster.values[4] = mark;
        const auto path = scratch_file("marks.tif");
        write_raster(path, "GTiff", raster);
        const HeightField field = read_height_field(path);
        CHECK(field.filled_voids == 1);
        CHECK(field.height_m(1, 1) == 4.0F);
    }
}

TEST_CASE("a declared mark and the usual ones count") {
    RasterFile raster = counted(3, 3);
    raster.transform = {0.0, 10.0, 0.0, 0.0, 0.0, -10.0};
    raster.values[4] = -9999.0;
    raster.values[8] = 7.0;
    raster.no_data = 7.0;
    const auto path = scratch_file("declared.tif");
    write_raster(path, "GTiff", raster);
    const HeightField field = read_height_field(path);
    CHECK(field.filled_voids == 3); // 7 stands twice
    CHECK(field.lowest_m() >= 0.0F);
}

TEST_CASE("reading leaves no file behind and reads the same heights twice") {
    RasterFile raster = counted(4, 3);
    raster.type = GDT_UInt16;
    const auto path = scratch_file("alone.png");
    std::filesystem::remove_all(path.parent_path());
    std::filesystem::create_directories(path.parent_path());
    write_raster(path, "PNG", raster);
    const HeightField first = read_height_field(path);
    const HeightField second = read_height_field(path);
    for (int i = 0; i < 12; ++i) { CHECK(first.height_m(i % 4, i / 4) == second.height_m(i % 4, i / 4)); }
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
        CHECK(entry.path().filename() == "alone.png");
    }
}

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
    const auto path = tests::real_file("terrain/" + std::string(name));
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
