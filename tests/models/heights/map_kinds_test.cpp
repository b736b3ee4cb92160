#include "models/heights/gdal_session.h"
#include "models/heights/height_field_import.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "tests/models/heights/height_files.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cpl_vsi.h>
#include <fstream>
#include <iostream>
#include <numbers>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

using std::filesystem::path;

/// Hills that no two samples share.
double hills_m(double x, double y) {
    return std::round(900.0 + 400.0 * std::sin(0.21 * x) * std::cos(0.17 * y) + 3.0 * x - 2.0 * y);
}

RasterFile hills(int columns, int rows) {
    RasterFile raster;
    raster.columns = columns;
    raster.rows = rows;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            raster.values.push_back(hills_m(x, y));
        }
    }
    raster.type = GDT_Int16;
    return raster;
}

RasterFile metric_hills() {
    RasterFile raster = hills(60, 50);
    raster.transform = {500000.0, 30.0, 0.0, 5500000.0, 0.0, -30.0};
    raster.system = "EPSG:32610";
    return raster;
}

/// Degrees from (west, north), samples 1/400 degree apart, the first at the corner.
RasterFile degree_hills(int columns, int rows, double west, double north) {
    constexpr double step = 1.0 / 400.0;
    RasterFile raster = hills(columns, rows);
    raster.transform = {west - 0.5 * step, step, 0.0, north + 0.5 * step, 0.0, -step};
    raster.system = "EPSG:4326";
    return raster;
}

/// A part of a raster.
RasterFile cut(const RasterFile& whole, int first_x, int first_y, int columns, int rows) {
    RasterFile part = whole;
    part.columns = columns;
    part.rows = rows;
    part.values.clear();
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            part.values.push_back(
                whole
                    .values[static_cast<std::size_t>((first_y + y) * whole.columns + first_x + x)]);
        }
    }
    part.transform[0] += first_x * whole.transform[1];
    part.transform[3] += first_y * whole.transform[5];
    return part;
}

double most_apart_m(const HeightField& a, const HeightField& b) {
    REQUIRE(a.columns() == b.columns());
    REQUIRE(a.rows() == b.rows());
    double most = 0.0;
    for (int row = 0; row < a.rows(); ++row) {
        for (int column = 0; column < a.columns(); ++column) {
            most = std::max(
                most,
                std::abs(static_cast<double>(a.height_m(column, row) - b.height_m(column, row))));
        }
    }
    return most;
}

Deviation deviation_of(const std::vector<path>& files, const HeightField& field) {
    const HeightSource source(files);
    return source
        .deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); })
        .value();
}

void write_reference(const path& file, const path& to) {
    const Dataset source(GDALOpen(to.c_str(), GA_ReadOnly));
    const Dataset made(GDALCreateCopy(
        GDALGetDriverByName("VRT"), file.c_str(), source.get(), FALSE, nullptr, nullptr, nullptr));
    REQUIRE(made);
}

void zip_file(const path& archive, const std::string& name, const path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    VSILFILE* const out = VSIFOpenL(("/vsizip/" + archive.string() + "/" + name).c_str(), "wb");
    REQUIRE(out != nullptr);
    REQUIRE(VSIFWriteL(bytes.data(), 1, bytes.size(), out) == bytes.size());
    VSIFCloseL(out);
}

} // namespace

TEST_CASE("maps of twenty kinds are the same ground") {
    struct Kind {
        const char* driver;
        const char* file;
        double off_m = 0.0; ///< what the kind itself loses
    };

    const std::array<Kind, 20> kinds = {
        {{"GTiff", "map.tif"},       {"COG", "cloud.tif"},    {"VRT", "map.vrt"},
         {"netCDF", "map.nc"},       {"EHdr", "map.bil"},     {"HFA", "map.img"},
         {"ENVI", "map.envi"},       {"XYZ", "map.xyz"},      {"JP2OpenJPEG", "map.jp2", 40.0},
         {"GPKG", "map.gpkg", 30.0}, {"AAIGrid", "map.asc"},  {"SAGA", "map.sdat"},
         {"RST", "map.rst"},         {"GSBG", "map.grd"},     {"GS7BG", "map7.grd"},
         {"BT", "map.bt"},           {"ERS", "map.ers"},      {"PCIDSK", "map.pix"},
         {"ISIS3", "map.cub"},       {"SIGDEM", "map.sigdem"}}};
    const RasterFile raster = metric_hills();
    write_raster(scratch_file("expected.tif"), "GTiff", raster);
    const HeightField expected = read_height_field(tests::scratch_folder() / "expected.tif");
    int read = 0;
    for (const Kind& kind : kinds) {
        INFO(kind.driver);
        GDALAllRegister();
        if (GDALGetDriverByName(kind.driver) == nullptr) {
            std::cout << "without " << kind.driver << ", which this GDAL has not\n";
            continue;
        }
        RasterFile same = raster;
        if (std::string(kind.driver) == "GPKG") {
            same.type = GDT_Float32; // tiles of heights
        }
        const path file = scratch_file(kind.file);
        if (std::string(kind.driver) == "VRT") {
            write_reference(file, tests::scratch_folder() / "expected.tif");
        } else {
            write_raster(file, kind.driver, same);
        }
        const HeightField field = read_height_field(file);
        CHECK(field.spacing_m() == Approx(30.0));
        CHECK(most_apart_m(field, expected) <= kind.off_m + 1e-3);
        ++read;
    }
    CHECK(read >= 16);
}

TEST_CASE("tiles that share their borders are the ground of the whole, also from a folder") {
    const RasterFile whole = degree_hills(121, 81, 8.0, 47.0);
    write_raster(scratch_file("whole.tif"), "GTiff", whole);
    const path folder = scratch_file("tiles");
    std::filesystem::create_directories(folder);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 3; ++i) {
            write_raster(
                folder / ("tile" + std::to_string(3 * j + i) + ".tif"),
                "GTiff",
                cut(whole, 40 * i, 40 * j, 41, 41));
        }
    }
    const HeightField expected = read_height_field(tests::scratch_folder() / "whole.tif");
    const HeightField from_folder = read_height_field(map_inputs({folder.string()}));
    CHECK(from_folder.filled_voids == 0);
    CHECK(most_apart_m(from_folder, expected) == 0.0);
    const HeightField from_pattern =
        read_height_field(map_inputs({folder.string() + "/tile?.tif"}));
    CHECK(most_apart_m(from_pattern, expected) == 0.0);
    CHECK_THROWS_WITH(
        map_inputs({folder.string() + "/none*.tif"}), Catch::Matchers::Contains("found none"));
}

TEST_CASE(
    "longitudes beyond 180 degrees and maps over the antimeridian are what they are elsewhere") {
    write_raster(scratch_file("west.tif"), "GTiff", degree_hills(81, 81, -122.0, 47.0));
    write_raster(scratch_file("turned.tif"), "GTiff", degree_hills(81, 81, 238.0, 47.0));
    const HeightField west = read_height_field(tests::scratch_folder() / "west.tif");
    const HeightField turned = read_height_field(tests::scratch_folder() / "turned.tif");
    CHECK(most_apart_m(west, turned) < 1e-3);
    CHECK(turned.place->longitude_deg == Approx(-121.9));

    const RasterFile here = degree_hills(81, 41, 9.9, 47.0);
    write_raster(scratch_file("here.tif"), "GTiff", here);
    RasterFile east_side = cut(here, 0, 0, 41, 41);
    RasterFile west_side = cut(here, 40, 0, 41, 41);
    east_side.transform[0] += 170.0;
    west_side.transform[0] += 170.0 - 360.0;
    write_raster(scratch_file("east_side.tif"), "GTiff", east_side);
    write_raster(scratch_file("west_side.tif"), "GTiff", west_side);
    const path folder = tests::scratch_folder();
    const HeightField expected = read_height_field(folder / "here.tif");
    const HeightField over =
        read_height_field(std::vector<path>{folder / "east_side.tif", folder / "west_side.tif"});
    CHECK(most_apart_m(over, expected) < 1e-3);
    CHECK(std::abs(over.place->longitude_deg) == Approx(180.0).margin(0.01));
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
    const auto plane_m = [](double x, double y) {
        return 0.1 * (x - 500000.0) - 0.05 * (y - 5500000.0) + 500.0;
    };
    for (int y = 0; y < raster.rows; ++y) {
        for (int x = 0; x < raster.columns; ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            raster.values.push_back(plane_m(
                raster.transform[0] + px * raster.transform[1] + py * raster.transform[2],
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
        CHECK(
            *field.height_at(off, 0.5 * off) ==
            Approx(plane_m(field.system->centre_x + off, field.system->centre_y + 0.5 * off))
                .margin(0.05));
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
    CHECK(
        distortion->turn_deg ==
        Approx(0.25 * std::sin(70.0 * std::numbers::pi / 180.0)).epsilon(0.05));
    const Deviation deviation = deviation_of({file}, field);
    CHECK(deviation.places > 10000);
    CHECK(deviation.rms_m < 1.5);
}

TEST_CASE("oblong cells whose sides are in simple proportion keep every sample") {
    for (const auto& [east_m, north_m, expected_m] :
         {std::array{90.0, 270.0, 90.0}, std::array{90.0, 60.0, 30.0}}) {
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
            highest_inside_m = std::max(
                highest_inside_m, raster.values[static_cast<std::size_t>(y * raster.columns + x)]);
        }
    }
    CHECK(static_cast<double>(field.highest_m()) >= highest_inside_m);
}

TEST_CASE("heights in feet, fathoms and units by option become metres") {
    RasterFile raster = metric_hills();
    raster.system = "EPSG:32610+6360"; // NAVD 88 in US survey feet
    const path file = scratch_file("compound.tif");
    write_raster(file, "GTiff", raster);
    const double south_west = hills_m(0.0, 49.0);
    CHECK(read_height_field(file).height_m(0, 0) == Approx(south_west * 1200.0 / 3937.0));
    raster.system = "EPSG:32610";
    write_raster(file, "GTiff", raster);
    ImportOptions options;
    options.height_scale = 0.3048;
    CHECK(read_height_field(file, options).height_m(0, 0) == Approx(south_west * 0.3048));
    raster.unit = "fathom";
    write_raster(file, "GTiff", raster);
    CHECK(read_height_field(file).height_m(0, 0) == Approx(south_west * 1.8288));
    raster.unit = "smoot";
    write_raster(file, "GTiff", raster);
    options.height_scale = 1.7018;
    CHECK(read_height_field(file, options).height_m(0, 0) == Approx(south_west * 1.7018));
}

TEST_CASE("maps of different systems and resolutions make one ground") {
    const path coarse = scratch_file("coarse.tif");
    RasterFile wide = hills(60, 60);
    for (double& value : wide.values) {
        value = 700.0;
    }
    wide.transform = {399000.0, 300.0, 0.0, 5213000.0, 0.0, -300.0};
    wide.system = "EPSG:32632";
    write_raster(coarse, "GTiff", wide);
    const path fine = scratch_file("fine.tif");
    write_raster(fine, "GTiff", degree_hills(25, 25, 7.75, 46.97));
    const HeightField field = read_height_field(std::vector<path>{fine, coarse});
    CHECK(field.spacing_m() == Approx(95.0).epsilon(0.01));
    const HeightSource source({fine, coarse});
    const auto deviation =
        source.deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    REQUIRE(deviation);
    CHECK(field.lowest_m() < 700.0F);
    CHECK(2.0 * field.half_extent_m().x == Approx(17700.0).epsilon(0.05));
}

TEST_CASE("a map in an archive is read, and one of several in a file is asked for by name") {
    const path file = scratch_file("packed.tif");
    write_raster(file, "GTiff", metric_hills());
    const path archive = scratch_file("packed.zip");
    zip_file(archive, "inside/packed.tif", file);
    const HeightField expected = read_height_field(file);
    CHECK(most_apart_m(read_height_field(map_inputs({archive.string()})), expected) == 0.0);
    const std::string inside = "/vsizip/" + archive.string() + "/inside/packed.tif";
    CHECK(most_apart_m(read_height_field(map_inputs({inside})), expected) == 0.0);

    GDALAllRegister();
    if (GDALGetDriverByName("netCDF") == nullptr) {
        std::cout << "without netCDF, which this GDAL has not\n";
        return;
    }
    RasterFile two = metric_hills();
    two.bands = 2;
    const path several = scratch_file("several.nc");
    write_raster(several, "netCDF", two);
    CHECK_THROWS_WITH(
        read_height_field(several),
        Catch::Matchers::Contains("expected one raster, got 2") &&
            Catch::Matchers::Contains("Band2"));
    const std::string second = "NETCDF:\"" + several.string() + "\":Band2";
    CHECK(most_apart_m(read_height_field(map_inputs({second})), expected) == 0.0);
}
