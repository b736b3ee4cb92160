#include "models/heights/height_field_import.h"
#include "models/heights/image_on_ground.h"
#include "tests/models/heights/height_files.h"

#include <catch2/catch.hpp>

using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

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
        "drape.tif: expected an image without a coordinate system over ground without one "
        "(hills), got one with");
}
