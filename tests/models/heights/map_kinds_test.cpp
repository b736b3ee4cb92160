#include "models/heights/gdal_session.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cpl_vsi.h>
#include <fstream>
#include <iostream>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;

namespace {

using std::filesystem::path;

void write_reference(const path& file, const path& to) {
    const Dataset source(GDALOpen(to.c_str(), GA_ReadOnly));
    const Dataset made(
        GDALCreateCopy(GDALGetDriverByName("VRT"), file.c_str(), source.get(), FALSE, nullptr, nullptr, nullptr));
    REQUIRE(made);
}

/// Places a raster by its four corners in place of a grid.
void place_by_points(const path& file, const RasterFile& raster) {
    const Dataset made(GDALOpen(file.c_str(), GA_Update));
    REQUIRE(made);
    std::array<GDAL_GCP, 4> points = {};
    GDALInitGCPs(4, points.data());
    for (std::size_t k = 0; k < points.size(); ++k) {
        points[k].dfGCPPixel = (k & 1U) != 0 ? raster.columns : 0;
        points[k].dfGCPLine = (k & 2U) != 0 ? raster.rows : 0;
        points[k].dfGCPX = raster.transform[0] + points[k].dfGCPPixel * raster.transform[1];
        points[k].dfGCPY = raster.transform[3] + points[k].dfGCPLine * raster.transform[5];
    }
    REQUIRE(GDALSetGCPs(made.get(), 4, points.data(),
                wkt_of(models::heights::geographic_coordinate_system(wgs84).get()).c_str()) == CE_None);
    GDALDeinitGCPs(4, points.data());
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

    const std::array<Kind, 20> kinds = {{{"GTiff", "map.tif"}, {"COG", "cloud.tif"}, {"VRT", "map.vrt"},
        {"netCDF", "map.nc"}, {"EHdr", "map.bil"}, {"HFA", "map.img"}, {"ENVI", "map.envi"}, {"XYZ", "map.xyz"},
        {"JP2OpenJPEG", "map.jp2", 40.0}, {"GPKG", "map.gpkg", 30.0}, {"AAIGrid", "map.asc"}, {"SAGA", "map.sdat"},
        {"RST", "map.rst"}, {"GSBG", "map.grd"}, {"GS7BG", "map7.grd"}, {"BT", "map.bt"}, {"ERS", "map.ers"},
        {"PCIDSK", "map.pix"}, {"ISIS3", "map.cub"}, {"SIGDEM", "map.sigdem"}}};
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
        CHECK(max_apart_m(field, expected) <= kind.off_m + 1e-3);
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
                folder / ("tile" + std::to_string(3 * j + i) + ".tif"), "GTiff", cut(whole, 40 * i, 40 * j, 41, 41));
        }
    }
    const HeightField expected = read_height_field(tests::scratch_folder() / "whole.tif");
    const HeightField from_folder = read_height_field(map_inputs({folder.string()}));
    CHECK(from_folder.filled_voids == 0);
    CHECK(max_apart_m(from_folder, expected) == 0.0);
    const HeightField from_pattern = read_height_field(map_inputs({folder.string() + "/tile?.tif"}));
    CHECK(max_apart_m(from_pattern, expected) == 0.0);
    CHECK_THROWS_WITH(map_inputs({folder.string() + "/none*.tif"}), Catch::Matchers::Contains("found none"));
}

TEST_CASE("longitudes beyond 180 degrees and maps over the antimeridian are what they are elsewhere") {
    write_raster(scratch_file("west.tif"), "GTiff", degree_hills(81, 81, -122.0, 47.0));
    write_raster(scratch_file("turned.tif"), "GTiff", degree_hills(81, 81, 238.0, 47.0));
    const HeightField west = read_height_field(tests::scratch_folder() / "west.tif");
    const HeightField turned = read_height_field(tests::scratch_folder() / "turned.tif");
    CHECK(max_apart_m(west, turned) < 1e-3);
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
    const HeightField over = read_height_field(std::vector<path>{folder / "east_side.tif", folder / "west_side.tif"});
    CHECK(max_apart_m(over, expected) < 1e-3);
    CHECK(std::abs(over.place->longitude_deg) == Approx(180.0).margin(0.01));
}

TEST_CASE("heights in feet, fathoms, no unit and units by option become metres") {
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
    raster.unit = "-";
    write_raster(file, "GTiff", raster);
    CHECK(read_height_field(file).height_m(0, 0) == Approx(south_west));
    CHECK(read_height_field(file, options).height_m(0, 0) == Approx(south_west * 0.3048));
    raster.unit = "smoot";
    write_raster(file, "GTiff", raster);
    options.height_scale = 1.7018;
    CHECK(read_height_field(file, options).height_m(0, 0) == Approx(south_west * 1.7018));
}

TEST_CASE("a map that is placed by control points lies where they say") {
    RasterFile raster = degree_hills(41, 41, 8.0, 47.0);
    write_raster(scratch_file("grid.tif"), "GTiff", raster);
    const path points = scratch_file("points.tif");
    const RasterFile placed = raster;
    raster.transform.clear();
    raster.system.clear();
    write_raster(points, "GTiff", raster);
    place_by_points(points, placed);
    const HeightField expected = read_height_field(tests::scratch_folder() / "grid.tif");
    const HeightField field = read_height_field(points);
    REQUIRE(field.place);
    CHECK(field.place->latitude_deg == Approx(expected.place->latitude_deg).margin(1e-4));
    CHECK(field.place->longitude_deg == Approx(expected.place->longitude_deg).margin(1e-4));
    CHECK(field.filled_voids == 0);
    double max_m = 0.0;
    for (double x_m = -2500.0; x_m <= 2500.0; x_m += 100.0) {
        for (double y_m = -4500.0; y_m <= 4500.0; y_m += 100.0) {
            const auto own_m = field.height_at(x_m, y_m);
            const auto wanted_m = expected.height_at(x_m, y_m);
            REQUIRE((own_m && wanted_m));
            max_m = std::max(max_m, std::abs(*own_m - *wanted_m));
        }
    }
    CHECK(max_m < 5.0);
}

TEST_CASE("a map in an archive is read, and one of several in a file is asked for by name") {
    const path file = scratch_file("packed.tif");
    write_raster(file, "GTiff", metric_hills());
    const path archive = scratch_file("packed.zip");
    zip_file(archive, "inside/packed.tif", file);
    const HeightField expected = read_height_field(file);
    CHECK(max_apart_m(read_height_field(map_inputs({archive.string()})), expected) == 0.0);
    const std::string inside = "/vsizip/" + archive.string() + "/inside/packed.tif";
    CHECK(max_apart_m(read_height_field(map_inputs({inside})), expected) == 0.0);

    GDALAllRegister();
    if (GDALGetDriverByName("netCDF") == nullptr) {
        std::cout << "without netCDF, which this GDAL has not\n";
        return;
    }
    RasterFile two = metric_hills();
    two.bands = 2;
    const path several = scratch_file("several.nc");
    write_raster(several, "netCDF", two);
    CHECK_THROWS_WITH(read_height_field(several),
        Catch::Matchers::Contains("expected one raster, got 2") && Catch::Matchers::Contains("Band2"));
    const std::string second = "NETCDF:\"" + several.string() + "\":Band2";
    CHECK(max_apart_m(read_height_field(map_inputs({second})), expected) == 0.0);
}
