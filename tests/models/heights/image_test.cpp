#include "models/heights/image.h"
#include "tests/models/heights/height_files.h"

#include <catch2/catch.hpp>

#include <array>
#include <fstream>
#include <string>
#include <utility>

using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

using Colour = std::array<int, 4>;

Colour colour(const Image& image, int column, int row) {
    const std::uint8_t* const at = image.pixel(column, row);
    return {at[0], at[1], at[2], at[3]};
}

Image read_written(const char* name, const char* driver, const RasterFile& raster) {
    const auto file = scratch_file(name);
    write_raster(file, driver, raster);
    return read_image(file);
}

} // namespace

TEST_CASE("an image keeps its colours and its rows, the top one first") {
    const RasterFile raster{.columns = 2,
        .rows = 2,
        .values = {255, 0, 0, 9, /* green */ 0, 255, 0, 9, /* blue */ 0, 0, 255, 9},
        .type = GDT_Byte,
        .bands = 3};
    const Image image = read_written("corners.png", "PNG", raster);
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 2);
    CHECK(colour(image, 0, 0) == Colour{255, 0, 0, 255});
    CHECK(colour(image, 1, 0) == Colour{0, 255, 0, 255});
    CHECK(colour(image, 0, 1) == Colour{0, 0, 255, 255});
    CHECK(colour(image, 1, 1) == Colour{9, 9, 9, 255});
    CHECK(image.wkt.empty());
    CHECK(image.name == "corners.png");
    CHECK(image.note.empty());
}

TEST_CASE("grey, palettes and alpha are taken as the colours that they mean") {
    const Image grey = read_written("grey.png", "PNG", {.columns = 2, .rows = 1, .values = {7, 200}, .type = GDT_Byte});
    CHECK(colour(grey, 1, 0) == Colour{200, 200, 200, 255});
    const Image palette = read_written(
        "palette.png", "PNG", {.columns = 1, .rows = 1, .values = {0}, .type = GDT_Byte, .has_palette = true});
    CHECK(colour(palette, 0, 0) == Colour{255, 0, 0, 255});
    const Image alpha = read_written("alpha.png", "PNG",
        {.columns = 2, .rows = 1, .values = {1, 2, 3, 4, 5, 6, 0, 255}, .type = GDT_Byte, .bands = 4});
    CHECK(colour(alpha, 0, 0)[3] == 0);
    CHECK(colour(alpha, 1, 0) == Colour{2, 4, 6, 255});
}

TEST_CASE("a pixel without data in any part is not there") {
    const Image image = read_written("no-data.tif", "GTiff",
        {.columns = 2, .rows = 1, .values = {0, 0, 0, 5, 0, 0}, .type = GDT_Byte, .bands = 3, .no_data = 0.0});
    CHECK(colour(image, 0, 0)[3] == 0);
    CHECK(colour(image, 1, 0) == Colour{0, 5, 0, 255});
}

TEST_CASE("a placed image says where it lies") {
    const Image image = read_written("placed.tif", "GTiff",
        {.columns = 2,
            .rows = 1,
            .values = {1, 2},
            .type = GDT_Byte,
            .transform = {500000, 10, 0, 5400000, 0, -10},
            .system = "EPSG:32610"});
    CHECK(image.wkt.find("UTM zone 10N") != std::string::npos);
    CHECK(image.transform == std::array<double, 6>{500000, 10, 0, 5400000, 0, -10});
}

TEST_CASE("textures of FlightGear's models are read: SGI and TGA with alpha") {
    // Two pixels: half transparent red, opaque green. SGI has planes, TGA blue before red.
    std::string sgi("\x01\xda\x00\x01\x00\x03\x00\x02\x00\x01\x00\x04", 12);
    sgi += std::string("\0\0\0\0\0\0\0\xff", 8);
    sgi.resize(512, '\0');
    sgi += std::string("\xff\x00\x00\xff\x00\x00\x80\xff", 8);
    std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28", 18);
    tga += std::string("\x00\x00\xff\x80\x00\xff\x00\xff", 8);
    for (const auto& [name, bytes] : {std::pair{"two.rgb", sgi}, std::pair{"two.tga", tga}}) {
        const auto file = scratch_file(name);
        std::ofstream(file, std::ios::binary) << bytes;
        const Image image = read_image(file);
        REQUIRE(image.width == 2);
        CHECK(colour(image, 0, 0) == Colour{255, 0, 0, 128});
        CHECK(colour(image, 1, 0) == Colour{0, 255, 0, 255});
    }
}

TEST_CASE("what is no image of 8 bits is refused in one line") {
    const auto deep = scratch_file("deep.png");
    write_raster(deep, "PNG", {.columns = 1, .rows = 1, .values = {300}, .type = GDT_UInt16});
    CHECK_THROWS_WITH(read_image(deep), deep.string() + ": expected 8 bits a colour part (Byte), got UInt16");
    const auto text = scratch_file("words.png");
    std::ofstream(text) << "no picture at all\n";
    CHECK_THROWS_WITH(read_image(text), text.string() +
                                            ": expected an image that GDAL can read, got another kind of file "
                                            "(GeoTIFF, PNG, JPEG, BMP, SGI and TGA are read)");
    const auto missing = scratch_file("missing.png");
    CHECK_THROWS_WITH(read_image(missing), missing.string() + ": expected a file, found none");
    const auto cut = scratch_file("cut.png");
    write_raster(cut, "PNG", {.columns = 64, .rows = 64, .values = std::vector<double>(64 * 64, 3), .type = GDT_Byte});
    truncate_file(cut, 60);
    CHECK_THROWS_WITH(read_image(cut), Catch::StartsWith(cut.string() + ": expected an image"));
}
