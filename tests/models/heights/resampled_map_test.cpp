#include "models/heights/height_field_import.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

using std::filesystem::path;

HeightDeviation deviation_of(const std::vector<path>& files, const HeightField& field) {
    const HeightSource source(files);
    return source.deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); }).value();
}

} // namespace

TEST_CASE("a map that names no coordinate system takes the one it is given") {
    RasterFile raster = degree_hills(41, 41, 8.0, 47.0);
    write_raster(scratch_file("named.tif"), "GTiff", raster);
    const HeightField named = read_height_field(tests::scratch_folder() / "named.tif");
    raster.system.clear();
    write_raster(scratch_file("nameless.asc"), "AAIGrid", raster);
    ImportOptions options;
    options.system = "EPSG:4326";
    const HeightField given = read_height_field(tests::scratch_folder() / "nameless.asc", options);
    CHECK(max_apart_m(named, given) < 1e-3);
    CHECK(given.place->latitude_deg == Approx(named.place->latitude_deg));
    options.system = "EPSG:2056"; // a file's own system counts for more
    const HeightField own = read_height_field(tests::scratch_folder() / "named.tif", options);
    CHECK(max_apart_m(named, own) == 0.0);
}

TEST_CASE("a rotated map lies where its six numbers say") {
    constexpr double angle = 0.5;
    constexpr double cell_m = 30.0;
    RasterFile raster;
    raster.columns = 80;
    raster.rows = 70;
    const double across_x = cell_m * std::cos(angle);
    const double across_y = cell_m * std::sin(angle);
    raster.transform = {500000.0, across_x, across_y, 5500000.0, across_y, -across_x};
    raster.system = "EPSG:32610";
    const auto plane_m = [](double x, double y) { return 0.1 * (x - 500000.0) - 0.05 * (y - 5500000.0) + 500.0; };
    for (int y = 0; y < raster.rows; ++y) {
        for (int x = 0; x < raster.columns; ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            raster.values.push_back(plane_m(raster.transform[0] + px * raster.transform[1] + py * raster.transform[2],
                raster.transform[3] + px * raster.transform[4] + py * raster.transform[5]));
        }
    }
    const path file = scratch_file("rotated.tif");
    write_raster(file, "GTiff", raster);
    const HeightField field = read_height_field(file);
    CHECK(field.spacing_m() == Approx(cell_m));
    CHECK(field.filled_voids > 0);
    REQUIRE(field.system);
    for (const double off : {-400.0, 0.0, 300.0}) {
        CHECK(*field.height_at(off, 0.5 * off) ==
              Approx(plane_m(field.system->centre_x + off, field.system->centre_y + 0.5 * off)).margin(0.05));
    }
}

TEST_CASE("at 70 degrees north the frame is true and its corners say how true") {
    const path file = scratch_file("north.tif");
    write_raster(file, "GTiff", degree_hills(201, 101, 20.0, 70.1));
    const HeightField field = read_height_field(file);
    // Half a step of longitude at 69.98 degrees: 47.7 m; one of latitude: 279 m.
    CHECK(field.spacing_m() == Approx(47.7).epsilon(0.01));
    const auto distortion = distortion_at_corners(*field.system, field.half_extent_m());
    REQUIRE(distortion);
    CHECK(distortion->scale_percent < 0.001);
    CHECK(distortion->turn_deg == Approx(0.25 * std::sin(70.0 * std::numbers::pi / 180.0)).epsilon(0.05));
    const HeightDeviation deviation = deviation_of({file}, field);
    CHECK(deviation.places > 10000);
    CHECK(deviation.rms_m < 1.5);
}

TEST_CASE("oblong cells whose sides are in simple proportion keep every sample") {
    for (const auto& [east_m, north_m, expected_m] : {std::array{90.0, 270.0, 90.0}, std::array{90.0, 60.0, 30.0}}) {
        RasterFile raster = hills(40, 30);
        raster.transform = {500000.0, east_m, 0.0, 5500000.0, 0.0, -north_m};
        raster.system = "EPSG:32610";
        const path file = scratch_file("oblong.tif");
        write_raster(file, "GTiff", raster);
        const HeightField field = read_height_field(file);
        CHECK(field.spacing_m() == expected_m);
        CHECK(field.filled_voids == 0);
        CHECK(deviation_of({file}, field).worst_m < 1e-3);
    }
}

TEST_CASE("summits keep their heights where a map is resampled") {
    const path file = scratch_file("summits.tif");
    const RasterFile raster = degree_hills(121, 121, 8.0, 47.0);
    write_raster(file, "GTiff", raster);
    const HeightField field = read_height_field(file);
    double highest_inside_m = 0.0;
    for (int y = 3; y < raster.rows - 3; ++y) {
        for (int x = 3; x < raster.columns - 3; ++x) {
            highest_inside_m =
                std::max(highest_inside_m, raster.values[static_cast<std::size_t>(y * raster.columns + x)]);
        }
    }
    CHECK(static_cast<double>(field.highest_m()) >= highest_inside_m);
}

TEST_CASE("maps of different systems and resolutions make one ground") {
    const path coarse = scratch_file("coarse.tif");
    RasterFile wide = hills(60, 60);
    for (double& value : wide.values) { value = 700.0; }
    wide.transform = {399000.0, 300.0, 0.0, 5213000.0, 0.0, -300.0};
    wide.system = "EPSG:32632";
    write_raster(coarse, "GTiff", wide);
    const path fine = scratch_file("fine.tif");
    write_raster(fine, "GTiff", degree_hills(25, 25, 7.75, 46.97));
    const HeightField field = read_height_field(std::vector<path>{fine, coarse});
    CHECK(field.spacing_m() == Approx(95.0).epsilon(0.01));
    const HeightSource source({fine, coarse});
    const auto deviation = source.deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    REQUIRE(deviation);
    CHECK(field.lowest_m() < 700.0F);
    CHECK(2.0 * field.half_extent_m().x == Approx(17700.0).epsilon(0.05));
}
