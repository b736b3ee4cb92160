#include "models/heights/height_source.h"
#include "models/heights/image.h"
#include "tests/models/heights/sample_maps.h"

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

TEST_CASE("a PNG image of 16 bits a part is read as one of 8, rounded") {
    const auto deep = scratch_file("deep.png");
    write_raster(deep, "PNG", {.columns = 3, .rows = 1, .values = {300, 32768, 65535}, .type = GDT_UInt16});
    const Image image = read_image(deep);
    CHECK(colour(image, 0, 0) == Colour{1, 1, 1, 255});
    CHECK(colour(image, 1, 0) == Colour{128, 128, 128, 255});
    CHECK(colour(image, 2, 0) == Colour{255, 255, 255, 255});
}

TEST_CASE("what is no image of 8 bits is refused in one line") {
    const auto deep = scratch_file("deep.tif"); // of which nobody says how bright 300 is
    write_raster(deep, "GTiff", {.columns = 1, .rows = 1, .values = {300}, .type = GDT_UInt16});
    CHECK_THROWS_WITH(read_image(deep), deep.string() + ": expected 8 bits a colour part (Byte), got UInt16");
    const auto text = scratch_file("words.png");
    std::ofstream(text) << "no picture at all\n";
    CHECK_THROWS_WITH(read_image(text), text.string() +
                                            ": expected an image that GDAL can read, got another kind of "
                                            "file (GeoTIFF, PNG, JPEG, BMP, SGI, TGA, GIF and WebP are read)");
    const auto missing = scratch_file("missing.png");
    CHECK_THROWS_WITH(read_image(missing), missing.string() + ": expected a file, found none");
    const auto cut = scratch_file("cut.png");
    write_raster(cut, "PNG", {.columns = 64, .rows = 64, .values = std::vector<double>(64 * 64, 3), .type = GDT_Byte});
    truncate_file(cut, 60);
    CHECK_THROWS_WITH(read_image(cut), Catch::StartsWith(cut.string() + ": expected an image"));
}

namespace {

constexpr int max_px = 1000;

/// 400 x 400 m of level ground about 500000, 5400000 of UTM 10 N.
HeightField utm_ground() {
    const auto file = scratch_file("ground.tif");
    write_raster(file, "GTiff",
        {.columns = 5,
            .rows = 5,
            .values = std::vector<double>(25, 10),
            .transform = {499750, 100, 0, 5400250, 0, -100},
            .system = "EPSG:32610"});
    return read_height_field(file);
}

/// 100 x 100 m pixels from 500000, 5400100 towards east and south: 10, 20, 30 and 40 of grey.
Image grey_image(const std::string& system, const std::vector<double>& transform) {
    const auto file = scratch_file("drape.tif");
    write_raster(file, "GTiff",
        {.columns = 2,
            .rows = 2,
            .values = {10, 20, 30, 40},
            .type = GDT_Byte,
            .transform = transform,
            .system = system});
    return read_image(file);
}

} // namespace

TEST_CASE("ground read from a map knows the middle of it in the map's own coordinates") {
    const HeightField field = utm_ground();
    REQUIRE(field.system);
    CHECK(field.system->centre_x == Approx(500000.0).margin(1e-6));
    CHECK(field.system->centre_y == Approx(5400000.0).margin(1e-6));
    CHECK(field.system->unit_m == 1.0);
}

TEST_CASE("a placed image lies on the ground where its coordinates say, and nowhere else") {
    const HeightField field = utm_ground();
    const Image laid =
        resampled_to_ground(grey_image("EPSG:32610", {500000, 100, 0, 5400100, 0, -100}), area_of(field), max_px);
    REQUIRE(laid.width == 4);
    REQUIRE(laid.height == 4);
    CHECK(int{laid.pixel(2, 1)[0]} == 10);
    CHECK(int{laid.pixel(3, 1)[0]} == 20);
    CHECK(int{laid.pixel(2, 2)[0]} == 30);
    CHECK(int{laid.pixel(3, 2)[2]} == 40);
    int there = 0;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            there += laid.pixel(column, row)[3] == 255 ? 1 : 0;
            CHECK((laid.pixel(column, row)[3] == 0 || laid.pixel(column, row)[3] == 255));
        }
    }
    CHECK(there == 4);
    CHECK(laid.note == "drape.tif: covers 25 % of the ground");
}

// Half a second of arc is 10 m here from west to east and 15 m from south to north.
TEST_CASE("an image in degrees is brought into the ground's system") {
    const HeightField field = utm_ground();
    const double degree = 0.01;
    REQUIRE(field.place);
    const Image laid = resampled_to_ground(grey_image("EPSG:4326", {field.place->longitude_deg - degree, degree, 0,
                                                                       field.place->latitude_deg + degree, 0, -degree}),
        area_of(field), max_px);
    const auto at = [&](double east, double north) {
        return int{laid.pixel(
            static_cast<int>((0.5 + 0.5 * east) * laid.width), static_cast<int>((0.5 - 0.5 * north) * laid.height))[0]};
    };
    CHECK(at(-0.9, 0.9) < at(0.9, 0.9));
    CHECK(at(0.9, 0.9) < at(-0.9, -0.9));
    CHECK(at(-0.9, -0.9) < at(0.9, -0.9));
    CHECK(at(0.9, -0.9) <= 40);
    CHECK(laid.note.empty());
}

TEST_CASE("an image without a place is stretched over the ground, a large one made smaller") {
    Image image;
    image.width = 4;
    image.height = 2;
    image.rgba.assign(32, 255);
    image.rgba[0] = 7;
    const HeightField field(3, 3, 10.0, std::vector<float>(9, 0.0F));
    const Image laid = resampled_to_ground(image, area_of(field), 4);
    CHECK(laid.width == 4);
    CHECK(laid.rgba == image.rgba);
    for (std::size_t at = 0; at < image.rgba.size(); ++at) {
        const bool west = at / 4 % 4 < 2;
        image.rgba[at] = at % 4 == 3 ? 255 : west ? 50 : 150;
    }
    const Image reduced = resampled_to_ground(image, area_of(field), 2);
    REQUIRE(reduced.width == 2);
    REQUIRE(reduced.height == 2);
    CHECK(std::abs(int{reduced.pixel(0, 0)[0]} - 50) <= 25);
    CHECK(std::abs(int{reduced.pixel(1, 1)[1]} - 150) <= 25);
    CHECK(int{reduced.pixel(1, 0)[3]} == 255);
}

TEST_CASE("an image that lies elsewhere, or that the ground has no coordinates for, is refused") {
    const Image image = grey_image("EPSG:32610", {600000, 100, 0, 5400100, 0, -100});
    CHECK_THROWS_WITH(resampled_to_ground(image, area_of(utm_ground()), max_px),
        "drape.tif: expected an image of the ground of ground.tif, got one that lies elsewhere");
    HeightField made(3, 3, 10.0, std::vector<float>(9, 0.0F));
    made.name = "hills";
    CHECK_THROWS_WITH(resampled_to_ground(image, area_of(made), max_px),
        "drape.tif: expected an image without a coordinate system over ground without one (hills), got one with");
}
