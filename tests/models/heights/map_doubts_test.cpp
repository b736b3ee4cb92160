#include "models/heights/height_field_import.h"
#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "tests/models/heights/sample_maps.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

using namespace octant;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

HeightField read_written(const RasterFile& raster) {
    const auto path = scratch_file("doubt.tif");
    write_raster(path, "GTiff", raster);
    return read_height_field(path);
}

double& value_at(RasterFile& raster, int column, int line) {
    return raster.values[static_cast<std::size_t>(line * raster.columns + column)];
}

std::string error_of(const std::filesystem::path& path) {
    try {
        read_height_field(path);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Two tiles of smooth ground beside each other, the eastern one raised; they share their border
/// line where `shared`.
std::vector<MapNote> notes_of_tiles(double raised_m, bool shared, bool degrees = false) {
    RasterFile whole = degrees ? degree_hills(80, 50, 10.0, 46.0) : metric_hills();
    whole.type = GDT_Float32;
    const int east = whole.columns / 2;
    const auto west_path = scratch_file("west.tif");
    const auto east_path = scratch_file("east.tif");
    write_raster(west_path, "GTiff", cut(whole, 0, 0, shared ? east + 1 : east, whole.rows));
    RasterFile raised = cut(whole, east, 0, whole.columns - east, whole.rows);
    for (double& value : raised.values) {
        value += raised_m;
    }
    write_raster(east_path, "GTiff", raised);
    return read_height_field({west_path, east_path}).notes;
}

} // namespace

TEST_CASE("a needle and a pit are told with their place and the option that leaves them out") {
    RasterFile raster = metric_hills();
    value_at(raster, 20, 10) = 6000.0;
    value_at(raster, 40, 30) = -900.0;
    const HeightField field = read_written(raster);
    REQUIRE(field.notes.size() == 2);
    const MapNote& spike = field.notes[0];
    CHECK(has(spike.text, "doubt.tif: a height of 6000 m stands alone"));
    CHECK(has(spike.text, "--void 6000"));
    REQUIRE(spike.places_m.size() == 1);
    // 60 x 50 samples 30 m apart: column 20 and row 39 from the south.
    CHECK(spike.places_m.front().x == Approx((20 - 29.5) * 30.0));
    CHECK(spike.places_m.front().y == Approx((39 - 24.5) * 30.0));
    CHECK(has(spike.text, "-285 m east and 435 m north of the middle"));
    CHECK(has(field.notes[1].text, "a height of -900 m stands alone"));
    CHECK(has(field.notes[1].text, "below all around it"));
}

TEST_CASE("the option that leaves a needle out has all digits of its height") {
    RasterFile raster = metric_hills();
    raster.type = GDT_Float32;
    value_at(raster, 20, 10) = 4321.1234;
    const HeightField field = read_written(raster);
    REQUIRE(field.notes.size() == 1);
    INFO(field.notes.front().text);
    CHECK(has(field.notes.front().text, "--void 4321.12354 ")); // the nearest float
}

TEST_CASE("a needle in degrees is told with the height that the file has") {
    RasterFile raster = degree_hills(60, 50, 10.0, 46.0);
    value_at(raster, 20, 10) = 7777.0;
    const HeightField field = read_written(raster);
    REQUIRE(field.notes.size() == 1);
    CHECK(has(field.notes.front().text, "--void 7777"));
    // The sample lies at 10 E + 20 / 400 degrees and 46 N - 10 / 400 degrees.
    CHECK(has(field.notes.front().text, "at 45.97"));
    CHECK(has(field.notes.front().text, ", 10.0"));
}

TEST_CASE("a needle beside voids and at the map's edge is told, also by an import in bands") {
    RasterFile raster = metric_hills();
    raster.no_data = -32000.0;
    for (int column = 24; column < 30; ++column) {
        value_at(raster, column, 20) = -32000.0;
    }
    value_at(raster, 26, 21) = 5000.0;
    value_at(raster, 0, 40) = 5000.0;
    const auto path = scratch_file("edge.tif");
    write_raster(path, "GTiff", raster);
    CHECK(read_height_field(path).notes.size() == 2);
    HeightSource source({path});
    REQUIRE(source.whole_metres());
    std::vector<std::int16_t> band(static_cast<std::size_t>(source.columns()) * 10);
    for (int row = 0; row < source.rows(); row += 10) {
        source.read(row, band);
    }
    CHECK(source.notes().size() == 2);
}

TEST_CASE("cliffs, ridges, mesas, steps and peaks are no needles") {
    RasterFile raster = metric_hills();
    for (int line = 0; line < raster.rows; ++line) {
        for (int column = 0; column < raster.columns; ++column) {
            double& value = value_at(raster, column, line);
            value = column > 30 ? 1500.0 : 300.0; // a cliff of 1,200 m
            if (line == 10) {
                value = 1900.0; // a wall
            }
            if (std::abs(column - 12) < 6 && std::abs(line - 30) < 6) {
                value = 900.0; // a mesa
            }
            const double away = std::hypot(column - 48, line - 34);
            if (away < 10.0) {
                value = 2500.0 - 55.0 * away; // a cone of 61 degrees
            }
        }
    }
    for (const MapNote& note : read_written(raster).notes) {
        FAIL_CHECK(note.text);
    }
}

TEST_CASE("many needles make three sentences and a number, and all are marked") {
    RasterFile raster = metric_hills();
    for (int i = 0; i < 9; ++i) {
        value_at(raster, 5 + 6 * i, 25) = 4000.0 + i;
    }
    const std::vector<MapNote> notes = read_written(raster).notes;
    REQUIRE(notes.size() == 3);
    CHECK(has(notes.back().text, "6 more heights stand alone"));
    CHECK(notes.back().places_m.size() == 7);
}

TEST_CASE("a step along a seam is told with both tiles and its height") {
    for (const bool shared : {false, true}) {
        for (const bool degrees : {false, true}) {
            const std::vector<MapNote> notes = notes_of_tiles(12.0, shared, degrees);
            REQUIRE(notes.size() == 1);
            CHECK(has(notes.front().text, "west.tif and east.tif: heights step by"));
            const auto at = notes.front().text.find(" m more than the slope");
            REQUIRE(at != std::string::npos);
            CHECK(std::stod(notes.front().text.substr(at - 4, 4)) == Approx(12.0).margin(1.0));
            CHECK(notes.front().places_m.size() > 20);
        }
    }
}

TEST_CASE("tiles that fit together have no seam") {
    CHECK(notes_of_tiles(0.0, false).empty());
    CHECK(notes_of_tiles(0.0, true).empty());
    CHECK(notes_of_tiles(0.0, true, true).empty());
    CHECK(notes_of_tiles(0.5, false).empty());
}

TEST_CASE("heights above the ellipsoid are told, as a system of three axes says it") {
    RasterFile raster = degree_hills(60, 60, 11.0, 46.0);
    raster.system = "EPSG:4979";
    const std::vector<MapNote> notes = read_written(raster).notes;
    REQUIRE(notes.size() == 1);
    CHECK(has(notes.front().text, "heights count from the ellipsoid"));
    CHECK(has(notes.front().text, "--water-level"));
    raster.system = "EPSG:4326+5773"; // EGM 96
    CHECK(read_written(raster).notes.empty());
}

TEST_CASE("a file that is cut short is refused with its bytes and how many there should be") {
    RasterFile raster = metric_hills();
    raster.type = GDT_Float32;
    const auto tiff = scratch_file("whole.tif");
    write_raster(tiff, "GTiff", raster);
    const auto whole = std::filesystem::file_size(tiff);
    truncate_file(tiff, 5000);
    CHECK(has(error_of(tiff), fmt::format("only the first 5000 of its {} bytes", whole)));
    const auto envi = scratch_file("whole.img");
    write_raster(envi, "ENVI", raster);
    truncate_file(envi, 5000);
    CHECK(has(error_of(envi), "only the first 5000 of its 12000 bytes")); // 60 x 50 x 4
    const auto netcdf = scratch_file("whole.nc");
    write_raster(netcdf, "netCDF", raster);
    truncate_file(netcdf, 9000);
    CHECK(has(error_of(netcdf), "only the first 9000 of its"));
    const auto tile = scratch_file("N51E000.hgt");
    std::ofstream(tile, std::ios::binary) << std::string(2000000, '\0');
    CHECK(has(error_of(tile), "only the first 2000000 of the 2884802 bytes of a .hgt tile"));
    const auto late = scratch_file("late.tif"); // its description would lie behind the heights
    std::ofstream(late, std::ios::binary)
        << std::string("II*\0\x00\x10\x00\x00", 8) + std::string(100, 'x');
    CHECK(has(error_of(late), "only the first 108 of its more than 4096 bytes"));
}

TEST_CASE("good maps get no warnings") {
    for (const char* const name :
         {"vancouver_2049.tif",
          "pugetsound_1025.tif",
          "gcanyon_1025.tif",
          "srtm3_N49W123.tif",
          "N51E000.hgt"}) {
        if (const auto path = real_terrain_file(name)) {
            for (const MapNote& note : read_height_field(*path).notes) {
                FAIL_CHECK(note.text);
            }
        }
    }
}
