#include "models/heights/gdal_session.h"
#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/real_files.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <utility>

using namespace octant;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

HeightField read_written(const RasterFile& raster) {
    const auto path = scratch_file("doubt.tif");
    write_raster(path, "GTiff", raster);
    return read_height_field(path);
}

double& value_at(RasterFile& raster, int column, int line) {
    return raster.values[static_cast<std::size_t>(line * raster.columns + column)];
}

/// A file that was written before.
std::filesystem::path scratch_folder_file(const std::string& name) { return tests::scratch_folder() / name; }

/// What a note of a spike tells to do about it.
ImportOptions options_of(const MapNote& note) {
    const std::size_t at = note.text.find("--void ");
    REQUIRE(at != std::string::npos);
    std::istringstream words(note.text.substr(at + 7));
    std::string numbers;
    words >> numbers;
    std::istringstream list(numbers);
    ImportOptions options;
    for (std::string number; std::getline(list, number, ',');) { options.voids.values.push_back(std::stod(number)); }
    return options;
}

/// The step that a note of a seam tells.
double step_told_m(const MapNote& note) {
    const std::string before = "files meet, ";
    const std::size_t at = note.text.find(before);
    REQUIRE(at != std::string::npos);
    return std::stod(note.text.substr(at + before.size()));
}

/// A real map as one to be written, by GDAL alone.
RasterFile raster_from(const std::filesystem::path& path) {
    GDALAllRegister();
    const Dataset dataset(GDALOpen(path.c_str(), GA_ReadOnly));
    REQUIRE(dataset);
    RasterFile raster;
    raster.columns = GDALGetRasterXSize(dataset.get());
    raster.rows = GDALGetRasterYSize(dataset.get());
    raster.values.resize(static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
    REQUIRE(GDALRasterIO(GDALGetRasterBand(dataset.get(), 1), GF_Read, 0, 0, raster.columns, raster.rows,
                raster.values.data(), raster.columns, raster.rows, GDT_Float64, 0, 0) == CE_None);
    raster.transform = {500000.0, 60.0, 0.0, 5500000.0, 0.0, -60.0};
    raster.system = "EPSG:32610";
    return raster;
}

std::string error_of(const std::filesystem::path& path) {
    try {
        read_height_field(path);
    } catch (const Error& error) { return error.what(); }
    return "";
}

/// Two tiles of smooth ground beside each other, the eastern one raised; they share their border line where `shared`.
std::vector<MapNote> notes_of_tiles(double raised_m, bool shared, bool degrees = false) {
    RasterFile whole = degrees ? degree_hills(80, 50, 10.0, 46.0) : metric_hills();
    whole.type = GDT_Float32;
    const int east = whole.columns / 2;
    const auto west_path = scratch_file("west.tif");
    const auto east_path = scratch_file("east.tif");
    write_raster(west_path, "GTiff", cut(whole, 0, 0, shared ? east + 1 : east, whole.rows));
    RasterFile raised = cut(whole, east, 0, whole.columns - east, whole.rows);
    for (double& value : raised.values) { value += raised_m; }
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
    CHECK(has(spike.text, "doubt.tif: one sample is 6000 m, "));
    CHECK(has(spike.text, " m above all its neighbours, at "));
    CHECK(has(spike.text, "--void 6000 treats every sample of that value as missing (1 in all)"));
    REQUIRE(spike.places_m.size() == 1);
    // 60 x 50 samples 30 m apart: column 20 and row 39 from the south.
    CHECK(spike.places_m.front().x == Approx((20 - 29.5) * 30.0));
    CHECK(spike.places_m.front().y == Approx((39 - 24.5) * 30.0));
    CHECK(has(spike.text, "-285 m east and 435 m north of the middle"));
    CHECK(has(field.notes[1].text, "one sample is -900 m, "));
    CHECK(has(field.notes[1].text, "below all its neighbours"));
}

TEST_CASE("the option that a needle's note names takes it away, in any unit and type") {
    struct Kind {
        const char* unit;
        double scale;
        double offset;
        GDALDataType type;
        double raw;
        const char* told; ///< what --void takes, which is the number that the file stores
    };

    for (const Kind& kind : {Kind{"m", 0.5, 100.0, GDT_Int16, 9500.0, "--void 9500 "},
             Kind{"ft", 1.0, 0.0, GDT_Int16, 15000.0, "--void 15000 "},
             Kind{"", 1.0, 0.0, GDT_Float32, 4321.1234, "--void 4321.1235 "},
             Kind{"", 1.0, 0.0, GDT_Float64, 4321.1234567, "--void 4321.1234567 "},
             Kind{"ft", 0.1, 0.0, GDT_Float64, 123456.75, "--void 123456.75 "}}) {
        RasterFile raster = metric_hills();
        raster.unit = kind.unit;
        raster.scale = kind.scale;
        raster.offset = kind.offset;
        raster.type = kind.type;
        value_at(raster, 20, 10) = kind.raw;
        const auto path = scratch_file("doubt.tif");
        write_raster(path, "GTiff", raster);
        const HeightField field = read_height_field(path);
        REQUIRE(field.notes.size() == 1);
        INFO(field.notes.front().text);
        CHECK(has(field.notes.front().text, kind.told));
        const HeightField cured = read_height_field(path, options_of(field.notes.front()));
        CHECK(cured.filled_voids == 1);
        CHECK(cured.notes.empty());
    }
    const auto pgm = scratch_file("needle.pgm");
    std::string text = "P2 20 20 65535";
    for (int i = 0; i < 400; ++i) { text += i == 210 ? " 25001" : i == 17 ? " 1001" : " 1000"; }
    std::ofstream(pgm) << text;
    ImportOptions options;
    options.height_scale = 0.1;
    options.spacing_m = 29.0; // the default is told
    const HeightField field = read_height_field(pgm, options);
    REQUIRE(field.notes.size() == 1);
    CHECK(has(field.notes.front().text, "one sample is 2500.1 m"));
    CHECK(has(field.notes.front().text, "--void 25001 "));
    options.voids = options_of(field.notes.front()).voids;
    CHECK(read_height_field(pgm, options).notes.empty());
}

TEST_CASE("a note of a needle says how many samples have its number") {
    RasterFile raster = metric_hills();
    raster.type = GDT_Float32;
    for (int line = 0; line < 10; ++line) { // a slope of 30 m a sample that reaches the number
        for (int column = 0; column < 60; ++column) { value_at(raster, column, line) = 4000.0 - 30.0 * line; }
    }
    value_at(raster, 20, 40) = 4000.0;
    const std::vector<MapNote> notes = read_written(raster).notes;
    REQUIRE(notes.size() == 1);
    CHECK(has(notes.front().text, "--void 4000 treats every sample of that value as missing (61 in"));
}

TEST_CASE("a spike of several samples is one note, which cures all of it") {
    for (const int size : {2, 3, 8}) {
        for (const bool is_rough : {false, true}) {
            if (size == 8 && is_rough) {
                continue; // more numbers than --void takes
            }
            RasterFile raster = metric_hills();
            raster.type = GDT_Float32;
            for (int i = 0; i < size * size; ++i) {
                value_at(raster, 25 + i % size, 20 + i / size) = 6000.0 + (is_rough ? 7 * i % 11 : 0);
            }
            const auto path = scratch_file("doubt.tif");
            write_raster(path, "GTiff", raster);
            const std::vector<MapNote> notes = read_height_field(path).notes;
            CAPTURE(size, is_rough);
            REQUIRE(notes.size() == 1);
            INFO(notes.front().text);
            CHECK(has(notes.front().text, fmt::format(": {} samples are up to 60", size * size)));
            const HeightField cured = read_height_field(path, options_of(notes.front()));
            CHECK(cured.notes.empty());
            CHECK(cured.filled_voids == size * size);
        }
    }
}

TEST_CASE("spikes and pits in the corners and among voids are told") {
    for (const double wrong : {6000.0, -3000.0}) {
        for (const int column : {0, 59}) {
            for (const int line : {0, 49}) {
                RasterFile raster = metric_hills();
                value_at(raster, column, line) = wrong;
                const std::vector<MapNote> notes = read_written(raster).notes;
                REQUIRE(notes.size() == 1);
                CHECK(has(notes.front().text, "one sample is"));
            }
        }
    }
    RasterFile raster = metric_hills();
    raster.no_data = -32000.0;
    for (const int column : {12, 19, 21, 28}) { value_at(raster, column, 20) = -32000.0; }
    value_at(raster, 20, 20) = 6000.0;
    CHECK(read_written(raster).notes.size() == 1);
}

TEST_CASE("a needle in degrees is told with the height that the file has") {
    RasterFile raster = degree_hills(60, 50, 10.0, 46.0);
    value_at(raster, 20, 10) = 7777.0;
    const HeightField field = read_written(raster);
    REQUIRE(field.notes.size() == 1);
    CHECK(has(field.notes.front().text, "--void 7777 "));
    CHECK(read_height_field(scratch_folder_file("doubt.tif"), options_of(field.notes.front())).notes.empty());
    // The sample lies at 10 E + 20 / 400 degrees and 46 N - 10 / 400 degrees.
    CHECK(has(field.notes.front().text, "at 45.97"));
    CHECK(has(field.notes.front().text, ", 10.0"));
}

TEST_CASE("a needle beside voids and at the map's edge is told, also by an import in bands") {
    RasterFile raster = metric_hills();
    raster.no_data = -32000.0;
    for (int column = 24; column < 30; ++column) { value_at(raster, column, 20) = -32000.0; }
    value_at(raster, 26, 21) = 5000.0;
    value_at(raster, 0, 40) = 5000.0;
    const auto path = scratch_file("edge.tif");
    write_raster(path, "GTiff", raster);
    CHECK(read_height_field(path).notes.size() == 2);
    HeightSource source({path});
    std::vector<float> band(static_cast<std::size_t>(source.columns()) * 10);
    for (int row = 0; row < source.rows(); row += 10) { source.read(row, band); }
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
    for (const MapNote& note : read_written(raster).notes) { FAIL_CHECK(note.text); }
}

TEST_CASE("many needles make three sentences and a number, and all are marked") {
    RasterFile raster = metric_hills();
    for (int i = 0; i < 9; ++i) { value_at(raster, 5 + 20 * (i % 3), 5 + 20 * (i / 3)) = 4000.0 + i; }
    const std::vector<MapNote> notes = read_written(raster).notes;
    REQUIRE(notes.size() == 3);
    CHECK(has(notes.back().text, "; 6 more such places are marked in --picture"));
    CHECK(notes.back().places_m.size() == 7);
}

TEST_CASE("ground that is too steep everywhere has another width of cells, and one note says so") {
    RasterFile raster = hills(60, 50); // without a place, 400 m up and down
    for (int i = 0; i < 36; ++i) { value_at(raster, 5 + 10 * (i % 6), 5 + 8 * (i / 6)) += 1500.0; }
    const auto path = scratch_file("steep.tif");
    write_raster(path, "GTiff", raster);
    const std::vector<MapNote> notes = read_height_field(path).notes;
    REQUIRE(notes.size() == 1);
    CHECK(has(notes.front().text, "steep.tif: 36 places are steeper than any ground on earth if cells are 30 m wide: "
                                  "--terrain-spacing says how wide they are"));
    CHECK(read_height_field(path, {.spacing_m = 2000.0}).notes.empty());
}

TEST_CASE("a step along a seam is told with both tiles and its height") {
    for (const bool shared : {false, true}) {
        for (const bool degrees : {false, true}) {
            const std::vector<MapNote> notes = notes_of_tiles(12.0, shared, degrees);
            REQUIRE(notes.size() == 1);
            CHECK(has(notes.front().text, "west.tif and east.tif: heights step by"));
            CHECK(step_told_m(notes.front()) == Approx(12.0).margin(1.0));
            CHECK(notes.front().places_m.size() > 20);
        }
    }
}

TEST_CASE("a step of a few metres in rugged ground is told, and none where there is none") {
    // Slopes of random sizes, half of them steeper than 5 m a cell.
    RasterFile whole;
    whole.columns = 200;
    whole.rows = 300;
    whole.transform = {500000.0, 60.0, 0.0, 5500000.0, 0.0, -60.0};
    whole.system = "EPSG:32610";
    std::uint32_t random = 1;
    for (int i = 0; i < 200 * 300; ++i) {
        random = random * 1664525U + 1013904223U;
        const double part = static_cast<double>(random >> 8U) / 16777216.0 - 0.5;
        const double west_m = i % 200 > 0 ? whole.values.back() : 1500.0;
        const double north_m = i >= 200 ? whole.values[static_cast<std::size_t>(i) - 200] : 1500.0;
        whole.values.push_back(0.5 * (west_m + north_m) + 20.0 * part);
    }
    for (const bool is_east : {true, false}) {
        for (const double raised_m : {0.0, 0.5, 7.0, -7.0, 20.0}) {
            RasterFile first = is_east ? cut(whole, 0, 0, 100, 300) : cut(whole, 0, 0, 200, 150);
            RasterFile other = is_east ? cut(whole, 100, 0, 100, 300) : cut(whole, 0, 150, 200, 150);
            for (double& value : other.values) { value += raised_m; }
            write_raster(scratch_file("first.tif"), "GTiff", first);
            write_raster(scratch_file("other.tif"), "GTiff", other);
            const auto notes =
                read_height_field(std::vector{scratch_folder_file("first.tif"), scratch_folder_file("other.tif")})
                    .notes;
            CAPTURE(is_east, raised_m);
            REQUIRE(notes.size() == (std::abs(raised_m) > 1.0 ? 1 : 0));
            if (!notes.empty()) {
                CHECK(has(notes.front().text, "load only one of the two files"));
                CHECK(step_told_m(notes.front()) == Approx(std::abs(raised_m)).margin(4.0));
            }
        }
    }
}

TEST_CASE("real rugged maps in two tiles: a step of 7 m is told, and none where there is none") {
    for (const char* const name : {"gcanyon_1025.tif", "pugetsound_1025.tif"}) {
        const auto path = tests::real_file("terrain/" + std::string(name));
        if (!path) { continue; }
        const RasterFile whole = raster_from(*path);
        for (const double raised_m : {0.0, 7.0}) {
            RasterFile east = cut(whole, 500, 0, whole.columns - 500, whole.rows);
            for (double& value : east.values) { value += raised_m; }
            write_raster(scratch_file("west.tif"), "GTiff", cut(whole, 0, 0, 501, whole.rows));
            write_raster(scratch_file("east.tif"), "GTiff", east);
            const auto notes =
                read_height_field(std::vector{scratch_folder_file("west.tif"), scratch_folder_file("east.tif")}).notes;
            CAPTURE(name, raised_m);
            REQUIRE(notes.size() == (raised_m > 0.0 ? 1 : 0));
            if (!notes.empty()) { CHECK(step_told_m(notes.front()) == Approx(raised_m).margin(2.0)); }
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
    CHECK(has(notes.front().text, "water-level"));
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
    std::ofstream(late, std::ios::binary) << std::string("II*\0\x00\x10\x00\x00", 8) + std::string(100, 'x');
    CHECK(has(error_of(late), "only the first 108 of its at least 4102 bytes"));
}

TEST_CASE("pictures and containers that are cut short are refused in the same words") {
    RasterFile raster = metric_hills();
    raster.type = GDT_UInt16;
    for (const auto& [driver, name] : std::vector<std::pair<const char*, const char*>>{{"PNG", "cut.png"},
             {"JP2OpenJPEG", "cut.jp2"}, {"HFA", "cut.img"}, {"netCDF", "cut.nc"}, {"GTiff", "cut.tif"},
             {"GPKG", "cut.gpkg"}, {"SAGA", "cut.sdat"}}) {
        RasterFile same = raster;
        same.type = std::string(driver) == "GPKG" ? GDT_Float32 : raster.type;
        const auto path = scratch_file(name);
        write_raster(path, driver, same);
        const auto bytes = std::filesystem::file_size(path);
        CHECK(error_of(path).empty());
        for (const std::uintmax_t part : {bytes - 1, bytes / 2, bytes / 20 + 16}) {
            truncate_file(path, part);
            if (std::string(driver) == "HFA" && part == bytes - 1) {
                continue; // its last byte is no height's
            }
            CAPTURE(name, part);
            CHECK(has(error_of(path), fmt::format("got only the first {} of its ", part)));
        }
    }
    const auto strips = scratch_file("strips.tif"); // one directory entry: 100 StripOffsets (273, LONG) from byte 26 on
    std::ofstream(strips, std::ios::binary)
        << std::string("II*\0\x08\0\0\0\x01\0\x11\x01\x04\0\x64\0\0\0\x1a\0\0\0\0\0\0\0", 26) + std::string(74, '\0');
    CHECK(has(error_of(strips), "got only the first 100 of its at least 426 bytes"));
    const auto tiny = scratch_file("tiny.tif");
    for (const std::size_t bytes : {3U, 4U, 5U, 8U, 9U, 12U, 40U}) {
        std::ofstream(tiny, std::ios::binary)
            << (std::string("II*\0\x08\0\0\0\x0c\0", 10) + std::string(90, '\0')).substr(0, bytes);
        CHECK(has(error_of(tiny), fmt::format("got only the first {} of its at least ", bytes)));
    }
}

TEST_CASE("good maps get no warnings") {
    for (const char* const name :
        {"vancouver_2049.tif", "pugetsound_1025.tif", "gcanyon_1025.tif", "srtm3_N49W123.tif", "N51E000.hgt"}) {
        if (const auto path = tests::real_file("terrain/" + std::string(name))) {
            for (const MapNote& note : read_height_field(*path).notes) { FAIL_CHECK(note.text); }
        }
    }
}
