#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <unistd.h>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

constexpr const char* unreadable = "expected a height field that GDAL can read, got ";

RasterFile flat(int columns, int rows, double height = 5.0) {
    RasterFile raster;
    raster.columns = columns;
    raster.rows = rows;
    raster.values.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), height);
    raster.transform = {500000.0, 10.0, 0.0, 5000000.0, 0.0, -10.0};
    raster.system = "EPSG:32610";
    return raster;
}

void check_refused(const std::filesystem::path& path, const std::string& message) {
    CHECK_THROWS_WITH(read_height_field(path), path.string() + ": " + message);
}

void check_text_refused(const std::string& name, const std::string& bytes, const std::string& message) {
    const auto path = scratch_file(name);
    write_file(path, bytes);
    check_refused(path, message);
}

void check_raster_refused(const RasterFile& raster, const std::string& message, const char* driver = "GTiff") {
    const auto path = scratch_file(std::string("refused.") + driver);
    write_raster(path, driver, raster);
    check_refused(path, message);
}

/// Damaged files: what GDAL says differs by version, so only our part of the message is fixed.
void check_damaged(const std::filesystem::path& path) {
    try {
        read_height_field(path);
        FAIL("read a damaged " << path);
    } catch (const Error& error) {
        const std::string message = error.what();
        const std::string start = path.string() + ": " + unreadable;
        CHECK(message.substr(0, start.size()) == start);
        CHECK(message.size() > start.size());
        CHECK(message.find('\n') == std::string::npos);
        CHECK(message.size() < start.size() + 120);
    }
}

} // namespace

TEST_CASE("what is no file of this computer is refused") {
    check_refused("/nowhere/a.tif", "expected a file, found none");
    check_refused(tests::scratch_folder(),
        std::string(unreadable) + "another kind of file (any raster format of GDAL's is read)");
    check_refused("/dev/zero", "expected a regular file, got a device or pipe");
    const std::string virtual_path = "expected a file on this computer, got a virtual path of GDAL";
    check_refused("/vsicurl/http://localhost/a.tif", virtual_path);
    check_refused("/vsimem/a.tif", virtual_path);
    check_refused("GTIFF_DIR:1:/nowhere/a.tif", std::string(unreadable) + "No such file or directory");
}

TEST_CASE("a file without read permission is refused") {
    if (::geteuid() == 0) {
        std::cout << "SKIPPED: root may read everything\n";
        return;
    }
    const auto path = scratch_file("secret.tif");
    write_file(path, "x");
    std::filesystem::permissions(path, std::filesystem::perms::none);
    check_refused(path, "cannot be opened for reading: Permission denied");
}

TEST_CASE("an empty file and files of other kinds are refused") {
    const std::string other = std::string(unreadable) + "another kind of file (any raster format of GDAL's is read)";
    check_text_refused("empty.tif", "", std::string(unreadable) + "an empty file");
    check_text_refused("letter.tif", "Dear reader\n", other);
    check_text_refused("one.byte", "P", other);
    check_text_refused("far.vrt",
        "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Byte\" "
        "band=\"1\"><SimpleSource><SourceFilename>/vsicurl/http://localhost/a.tif"
        "</SourceFilename><SourceProperties RasterXSize=\"2\" RasterYSize=\"2\"/></SimpleSource>"
        "</VRTRasterBand></VRTDataset>",
        "expected heights on this computer, got a reference to '/vsicurl/http://localhost/a.tif'");
    check_text_refused("N51E000.hgt", std::string(1000, '\0'),
        std::string(unreadable) + "only the first 1000 of the 2884802 bytes of a .hgt tile");
}

TEST_CASE("damaged files are refused in one line that begins the same for every format") {
    RasterFile raster = flat(300, 300);
    for (std::size_t i = 0; i < raster.values.size(); ++i) {
        raster.values[i] = static_cast<double>((i * i * 2654435761U >> 7U) % 3001U);
    }
    const auto tiff = scratch_file("cut.tif");
    write_raster(tiff, "GTiff", raster);
    truncate_file(tiff, 150000);
    check_damaged(tiff);
    truncate_file(tiff, 100);
    check_damaged(tiff);
    const auto ascii = scratch_file("cut.asc");
    write_raster(ascii, "AAIGrid", raster);
    truncate_file(ascii, 150000);
    CHECK_THROWS_WITH(read_height_field(ascii), Catch::Contains("cut.asc:113: expected 90000 heights, got the end"));
    raster.type = GDT_UInt16;
    const auto png = scratch_file("cut.png");
    write_raster(png, "PNG", raster);
    truncate_file(png, 60000);
    check_damaged(png);
    truncate_file(png, 20);
    check_damaged(png);
    const auto pgm = scratch_file("cut.pgm");
    write_raster(pgm, "PNM", raster);
    truncate_file(pgm, 60000);
    check_damaged(pgm);
    truncate_file(pgm, 5);
    check_damaged(pgm);
}

TEST_CASE("an ASCII grid with words for numbers is refused") {
    const auto path = scratch_file("words.asc");
    write_file(path, "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize abc\n1 2\n3 4\n");
    CHECK_THROWS_AS(read_height_field(path), Error);
}

TEST_CASE("pictures in colour and numbers that are no heights are refused") {
    RasterFile colour = flat(4, 4);
    colour.type = GDT_Byte;
    colour.bands = 3;
    colour.values.assign(48, 5.0);
    colour.values.back() = 6.0;
    const std::string refused =
        "expected one band of heights, got a colour picture: --band N takes one of its bands for heights";
    check_raster_refused(colour, refused, "PNG");
    check_raster_refused(colour, refused, "PNM");
    colour.bands = 1;
    colour.has_palette = true;
    colour.values.assign(16, 0.0);
    check_raster_refused(colour, refused, "PNG");
    RasterFile complex = flat(4, 4);
    complex.type = GDT_CFloat32;
    check_raster_refused(complex, "expected real heights, got complex numbers");
    RasterFile warm = flat(4, 4);
    warm.unit = std::string("K");
    check_raster_refused(
        warm, "expected heights in metres or feet, got 'K': --height-scale says how many metres that is");
}

TEST_CASE("a field without any height is refused") {
    RasterFile raster = flat(4, 4, -32768.0);
    raster.no_data = -32768.0;
    check_raster_refused(raster, "expected at least one height, got only samples without data");
    check_raster_refused(flat(4, 4, std::nan("")), "expected at least one height, got only samples without data");
}

TEST_CASE("heights that no ground has are refused") {
    const auto message = [](const std::string& got, const std::string& scale) {
        return "expected heights from -12000 to 9000 m, got " + got + " m: " + scale + "--void " + got +
               " treats it as missing";
    };
    const std::string scale = "--height-scale says how many metres a unit is, ";
    check_raster_refused(flat(4, 4, 9000.5), message("9000.5", scale));
    check_raster_refused(flat(4, 4, -12001.0), message("-12001", scale));
    RasterFile metres = flat(4, 4, 9000.5);
    metres.unit = "m"; // --height-scale could not help
    check_raster_refused(metres, message("9000.5", ""));
    check_text_refused("bright.pgm", "P2 2 2 65535 1 20000 30000 40000", message("20000", scale));
}

TEST_CASE("sizes that are too small or too large are refused before anything is read") {
    const auto message = [](const std::string& got) { return "expected 2 x 2 to 20000 x 20000 samples, got " + got; };
    const std::string streamed = "expected 2 x 2 to 65536 x 65536 samples, got ";
    check_raster_refused(flat(1, 1), streamed + "1 x 1");
    check_raster_refused(flat(1, 5), streamed + "1 x 5");
    check_text_refused("huge.asc", "ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n", streamed + "1 x 2");
    check_text_refused("huge.pgm", "P2 100000 100000 255 1 2", message("100000 x 100000"));
    check_text_refused("thin.pgm", "P2 1 100 255 1 2", message("1 x 100"));
    const auto path = scratch_file("huge-raw.pgm");
    write_file(path, "P5 2000000000 2000000000 255\n1");
    CHECK_THROWS_AS(read_height_field(path), Error);
}

TEST_CASE("grids that cannot be laid on the ground are refused") {
    RasterFile degrees;
    const std::string which =
        ", which are degrees or metres: --terrain-system EPSG:4326 or --terrain-system metres says which";
    degrees = flat(40, 40);
    degrees.system.clear();
    degrees.transform = {8.0, 0.25, 0.0, 47.0, 0.0, -0.25};
    check_raster_refused(degrees, "expected a coordinate system, got none and cells of 0.25" + which);
    degrees = flat(180, 90);
    degrees.system.clear();
    degrees.transform = {-180.0, 2.0, 0.0, 90.0, 0.0, -2.0};
    check_raster_refused(degrees, "expected a coordinate system, got none and cells of 2" + which);
    ImportOptions options;
    for (const char* const name : {"nowhere", "EPSG:0", "http://localhost/system.wkt"}) {
        options.system = name;
        CHECK_THROWS_WITH(read_height_field(tests::scratch_folder() / "refused.GTiff", options),
            "--terrain-system: expected a coordinate system such as EPSG:4326, got '" + std::string(name) + "'");
    }
    const std::string no_frame =
        "expected ground up to 1000 km wide and away from the poles that a local frame fits, got ";
    RasterFile world = flat(72, 36);
    world.system = "EPSG:4326";
    world.transform = {-180.0, 5.0, 0.0, 90.0, 0.0, -5.0};
    check_raster_refused(world, no_frame + "358.6 x 175.0 degrees about latitude 0.0");
    RasterFile pole = flat(20, 20);
    pole.system = "EPSG:4326";
    pole.transform = {0.0, 0.05, 0.0, 90.5, 0.0, -0.05};
    check_raster_refused(pole, no_frame + "edges that have no places there");
    RasterFile flattened = flat(4, 4);
    flattened.transform = {500000.0, 10.0, 10.0, 5000000.0, 10.0, 10.0};
    check_raster_refused(flattened, "expected a cell size that is a number, got 10 x 10");
}

TEST_CASE("a plain PGM that is wrong is refused with the line") {
    const auto check = [](const std::string& bytes, const std::string& message) {
        const auto path = scratch_file("wrong.pgm");
        write_file(path, bytes);
        CHECK_THROWS_WITH(read_height_field(path), path.string() + message);
    };
    check("P2\n", ":2: expected a width, got the end of the file");
    check("P2\nabc 2", ":2: expected a width from 1 to 1000000000, got 'abc'");
    check("P2\n2 -2\n", ":2: expected a height from 1 to 1000000000, got '-2'");
    check("P2\n2 2\n70000\n", ":3: expected a largest value from 1 to 65535, got '70000'");
    check("P2 2 2\n9\n1 2\n3", ":4: expected a grey value, got the end of the file");
    check("P2 2 2\n9\n1 2\n3 10", ":4: expected a grey value from 0 to 9, got '10'");
    check("P2 2 2\n9\n1 2\n3 x\x1b\n", ":4: expected a grey value from 0 to 9, got 'x?'");
    check("P2 900 900 9 1 2", ": expected 810000 values, got a file of 16 bytes");
}
