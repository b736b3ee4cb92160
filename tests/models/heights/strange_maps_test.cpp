// Maps as strangers send them. Right values are those of gdalinfo and gdallocationinfo (GDAL 3.6.2), which read the
// same files without any of our code, or are computed by hand.

#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/height_source.h"
#include "models/heights/height_voids.h"
#include "models/heights/map_inputs.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fstream>
#include <thread>
#include <unistd.h>
#include <utility>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::heights::test;
using Catch::Contains;
using std::filesystem::path;

namespace {

path kept_map(const std::string& name) { return path(OCTANT_SOURCE_DIR) / "tests/data/maps" / name; }

/// The notes of a field, one a line.
std::string notes_text(const HeightField& field) {
    std::string text;
    for (const MapNote& note : field.notes) { text += note.text + "\n"; }
    return text;
}

/// Height of a sample that GDAL counts as column and line from the north-west.
double height_at(const HeightField& field, int column, int line) {
    return static_cast<double>(field.height_m(column, field.rows() - 1 - line));
}

void write_text(const path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// 8 x 6 heights from 100 to 147 m, 30 m apart.
RasterFile small_map() {
    RasterFile raster;
    raster.columns = 8;
    raster.rows = 6;
    for (int i = 0; i < 48; ++i) { raster.values.push_back(100.0 + i); }
    raster.transform = {500000.0, 30.0, 0.0, 5000000.0, 0.0, -30.0};
    raster.system = "EPSG:32632";
    return raster;
}

HeightField read_small(const RasterFile& raster, const ImportOptions& options = {}) {
    const path file = scratch_file("small.tif");
    write_raster(file, "GTiff", raster);
    return read_height_field(file, options);
}

/// A text grid of 3 x 2 samples with these words for heights.
path ascii_grid(const std::string& heights, const std::string& header = "") {
    const path file = scratch_file("words.asc");
    write_text(file, "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n" + header + heights + "\n");
    return file;
}

} // namespace

TEST_CASE("a sidecar's value for no data counts, and no sidecar is written") {
    const path folder = tests::empty_folder("sidecar");
    for (const char* const name : {"pam-nodata.tif", "pam-nodata.tif.aux.xml"}) {
        std::filesystem::copy_file(kept_map(name), folder / name);
    }
    const HeightField field = read_height_field(folder / "pam-nodata.tif");
    CHECK(field.filled_voids == 400);
    CHECK(height_at(field, 35, 12) == Approx(524.885009765625));
    CHECK(field.notes.empty());
    std::filesystem::remove(folder / "pam-nodata.tif.aux.xml");
    read_height_field(folder / "pam-nodata.tif");
    read_height_field(folder / "pam-nodata.tif");
    CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
}

TEST_CASE("a sidecar gives georeference, unit and scale to a file that has none") {
    RasterFile raster = small_map();
    raster.transform.clear();
    raster.system.clear();
    raster.type = GDT_UInt16;
    const path file = scratch_file("plain.png");
    write_raster(file, "PNG", raster);
    write_text(file.string() + ".aux.xml",
        "<PAMDataset><SRS>EPSG:32632</SRS><GeoTransform>500000, 25, 0, 5000000, 0, -25"
        "</GeoTransform><PAMRasterBand band=\"1\"><UnitType>ft</UnitType><Scale>2</Scale>"
        "<Offset>10</Offset></PAMRasterBand></PAMDataset>");
    const HeightField field = read_height_field(file);
    std::filesystem::remove(file.string() + ".aux.xml");
    CHECK(field.spacing_m() == 25.0);
    CHECK(field.place);
    CHECK(height_at(field, 1, 0) == Approx((2.0 * 101.0 + 10.0) * 0.3048));
}

TEST_CASE("the mask of a dataset and its alpha band tell where there is no data") {
    const HeightField masked = read_height_field(kept_map("internal-mask.tif"));
    CHECK(masked.filled_voids == 400);
    CHECK(masked.lowest_m() > 322.0F);
    CHECK(height_at(masked, 35, 12) == Approx(524.885009765625));
    for (const GDALDataType type : {GDT_Int16, GDT_Float32}) {
        RasterFile raster = small_map();
        raster.type = type;
        raster.bands = 2;
        raster.values.resize(96, 255.0);
        raster.values[48 + 20] = 0.0;
        raster.values[20] = 0.0;
        const path file = scratch_file("alpha.tif");
        write_raster(file, "GTiff", raster);
        {
            const Dataset dataset(GDALOpen(file.c_str(), GA_Update));
            GDALSetRasterColorInterpretation(GDALGetRasterBand(dataset.get(), 2), GCI_AlphaBand);
        }
        const HeightField field = read_height_field(file);
        CHECK(field.filled_voids == 1);
        CHECK(height_at(field, 4, 2) == Approx(120.0).margin(0.5));
    }
}

TEST_CASE("a mask beside a file, in another format, tells where there is no data") {
    RasterFile raster = small_map();
    raster.type = GDT_Int16;
    const path file = scratch_file("beside.img");
    write_raster(file, "HFA", raster);
    {
        CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "NO");
        const Dataset dataset(GDALOpen(file.c_str(), GA_ReadOnly));
        REQUIRE(GDALCreateDatasetMaskBand(dataset.get(), GMF_PER_DATASET) == CE_None);
        std::vector<std::uint8_t> there(48, 255);
        there[0] = 0;
        REQUIRE(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataset.get(), 1)), GF_Write, 0, 0, 8, 6, there.data(),
                    8, 6, GDT_Byte, 0, 0) == CE_None);
        CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
    }
    CHECK(read_height_field(file).filled_voids == 1);
    std::filesystem::remove(file.string() + ".msk");
}

TEST_CASE("undeclared values that no height has are voids, counted in a note") {
    const HeightField kept = read_height_field(kept_map("minus99999.tif"));
    CHECK(kept.filled_voids == 400);
    CHECK_THAT(notes_text(kept), Contains("minus99999.tif: 400 samples of -99999 count as missing"));
    for (const double mark : {-9999.0, -10000.0, -32768.0, 32767.0, -99999.0, 65535.0, -999.0, 1e20, -1e9}) {
        RasterFile raster = small_map();
        raster.type = std::abs(mark) <= 32768.0 ? GDT_Int16 : GDT_Float32;
        raster.values[9] = mark;
        raster.values[30] = mark;
        const HeightField field = read_small(raster);
        CAPTURE(mark);
        CHECK(field.filled_voids == 2);
        CHECK(field.lowest_m() >= 100.0F);
        CHECK(field.highest_m() <= 147.0F);
        CHECK_THAT(notes_text(field), Contains("2 samples of "));
    }
}

TEST_CASE("negative heights that were stored unsigned are voids with a note") {
    RasterFile raster = small_map();
    raster.type = GDT_UInt16;
    raster.values[3] = 65536.0 - 12.0;
    raster.values[4] = 65536.0 - 3.0;
    raster.values[5] = 65536.0 - 9999.0;
    for (const GDALDataType type : {GDT_UInt16, GDT_Float32}) {
        raster.type = type;
        CHECK(read_small(raster).filled_voids == 3);
    }
    const HeightField field = read_small(raster);
    CHECK_THAT(notes_text(field), Contains("2 samples from 65524 to 65533 (negative numbers stored"));
    CHECK_THAT(notes_text(field), Contains("1 sample of 55537"));
}

TEST_CASE("true heights are no voids, whatever their numbers") {
    RasterFile trench = small_map();
    for (std::size_t i = 0; i < trench.values.size(); ++i) {
        trench.values[i] = -10020.0 + static_cast<double>(i); // passes -10000 and -9999
    }
    const HeightField sea = read_small(trench);
    CHECK(sea.filled_voids == 0);
    CHECK(sea.notes.empty());
    RasterFile centimetres = small_map();
    centimetres.type = GDT_UInt16;
    for (std::size_t i = 0; i < centimetres.values.size(); ++i) {
        centimetres.values[i] = 40000.0 + 500.0 * static_cast<double>(i);
    }
    CHECK_THROWS_WITH(read_small(centimetres), Contains("--height-scale says how many metres"));
    CHECK(read_small(centimetres, {.height_scale = 0.01}).highest_m() == Approx(635.0));
}

TEST_CASE("common voids are found beside the file's own and the option's, unless it says none") {
    for (const GDALDataType type : {GDT_Float32, GDT_Int16}) {
        RasterFile raster = small_map();
        raster.type = type;
        raster.values[9] = 0.0;
        raster.values[10] = -9999.0;
        ImportOptions options;
        options.voids.values = {0.0};
        const HeightField field = read_small(raster, options);
        CHECK(field.filled_voids == 2);
        CHECK(field.lowest_m() == 100.0F);
        CHECK_THAT(notes_text(field), Contains("1 sample of -9999 count as missing"));
        raster.no_data = -32768.0;
        raster.values[11] = -32768.0;
        CHECK(read_small(raster, options).filled_voids == 3);
        raster.no_data = 0.0;
        raster.values[11] = -10000.0;
        const HeightField declared = read_small(raster);
        CHECK(declared.filled_voids == 3);
        CHECK_THAT(notes_text(declared), Contains("1 sample of -9999, 1 sample of -10000"));
        options.voids = {{}, true};
        raster.no_data = 131.0; // a height of the map
        const HeightField whole = read_small(raster, options);
        CHECK(whole.filled_voids == 0);
        CHECK(whole.lowest_m() == -10000.0F);
        CHECK(height_at(whole, 7, 3) == 131.0);
        options.voids.values = {-9999.0, -10000.0};
        CHECK(read_small(raster, options).filled_voids == 2);
        CHECK(read_small(raster, options).lowest_m() == 0.0F);
    }
}

TEST_CASE("numbers beyond all heights are voids, counted in a note") {
    for (const double mark : {-3.4028234663852886e38, -3.4028230607370965e38, 1.70141e38, -1e32}) {
        RasterFile raster = small_map();
        raster.values[9] = mark;
        raster.values[30] = mark;
        const HeightField field = read_small(raster);
        CAPTURE(mark);
        CHECK(field.filled_voids == 2);
        CHECK(field.lowest_m() == 100.0F);
        CHECK_THAT(notes_text(field), Contains("2 samples of ") && Contains("e+3"));
        raster.no_data = mark;
        CHECK(read_small(raster).filled_voids == 2);
        CHECK(read_small(raster).notes.empty());
    }
    RasterFile many = small_map();
    for (std::size_t i = 0; i < 6; ++i) { many.values[7 * i] = -1e33 - 1e32 * static_cast<double>(i); }
    CHECK(read_small(many).filled_voids == 6);
    RasterFile large = small_map();
    large.values[9] = 1e20; // the nearest float is 100000002004087734272
    CHECK_THAT(notes_text(read_small(large)), Contains("1 sample of 1e+20 count"));
    large.values[9] = 1.5e9 + 0.5;
    large.type = GDT_Float64;
    CHECK_THROWS_WITH(read_small(large), Contains("--void 1500000000.5 treats it as missing"));
}

TEST_CASE("a plain PGM has its undeclared voids found and the option's honoured") {
    const path file = scratch_file("voids.pgm");
    write_text(file, "P2 3 3 65535 10 11 12 13 65535 15 16 17 18");
    const HeightField field = read_height_field(file);
    CHECK(field.filled_voids == 1);
    CHECK_THAT(notes_text(field), Contains("1 sample of 65535"));
    ImportOptions options;
    options.voids.values = {10.0};
    write_text(file, "P2 3 3 255 10 11 12 13 14 15 16 17 18");
    CHECK(read_height_field(file, options).filled_voids == 1);
}

TEST_CASE("a damaged number in a text grid is refused with its line") {
    CHECK_THROWS_WITH(
        read_height_field(kept_map("letter.asc")), Contains("letter.asc:27: expected a height, got '4O7'"));
    CHECK_THROWS_WITH(
        read_height_field(ascii_grid("1 2 3\n4 5x 6")), Contains("words.asc:7: expected a height, got '5x'"));
    CHECK_THROWS_WITH(read_height_field(ascii_grid("1 2 3\n4 1.5D+02 6")), Contains(":7: "));
    CHECK_THROWS_WITH(read_height_field(ascii_grid("1 2 3\n4 5e 6")), Contains(":7: "));
    CHECK_THROWS_WITH(read_height_field(ascii_grid("1 2 3\n4 5")),
        Contains(":8: expected 6 heights, got the end of the file after 5"));
    CHECK_THROWS_WITH(
        read_height_field(ascii_grid("O1 2 3\n4 5 6")), Contains("words.asc:6: expected a height, got 'O1'"));
    CHECK_THROWS_WITH(read_height_field(ascii_grid("1 2 3\n4 " + std::string(5000000, '5') + " 6")),
        Contains("words.asc:7: expected a number, got a word of more than 1000 letters"));
    const path surfer = scratch_file("surfer.grd");
    write_text(surfer, "DSAA\n2 2\n0 30\n0 30\n1 4\n1 2\n3 NA\n");
    CHECK_THROWS_WITH(read_height_field(surfer), Contains("surfer.grd:7: expected a height, got 'NA'"));
}

TEST_CASE("a damaged number in points is refused with its line, also in the first one") {
    const path points = scratch_file("points.xyz");
    const std::string rest = "30 0 2\n0 30 3\n30 30 ";
    write_text(points, "x y z\n0 0 1\n" + rest + "4O\n");
    CHECK_THROWS_WITH(read_height_field(points), Contains("points.xyz:5: expected a number, got '4O'"));
    for (const char* const first : {"0 0 4O\n", "O 0 4\n", "0,0,1m\n"}) {
        write_text(points, first + rest + "4\n");
        CHECK_THROWS_WITH(read_height_field(points), Contains("points.xyz:1: expected a number, got '"));
    }
    for (const char* const first : {"x y z\n", "X,Y,Z\n", ""}) {
        write_text(points, std::string(first) + "0 0 1\n" + rest + "4\n");
        CHECK(read_height_field(points).highest_m() == 4.0F);
    }
}

TEST_CASE("a text grid may begin with a word without data") {
    for (const char* const word : {"NA", "nan", "NULL", "void", "***"}) {
        CAPTURE(word);
        const std::string first = word;
        for (const std::string& header : {std::string(), "NODATA_value " + first + "\n"}) {
            const HeightField field = read_height_field(ascii_grid(first + " 0 12\n13 0 15", header));
            CHECK(field.filled_voids == 1);
            CHECK(height_at(field, 1, 0) == 0.0);
            CHECK(height_at(field, 2, 0) == 12.0);
            CHECK(height_at(field, 0, 1) == 13.0);
            CHECK(height_at(field, 2, 1) == 15.0);
            CHECK_THAT(notes_text(field), Contains("1 sample with a word such as '" + first + "'"));
        }
        // GDAL alone takes each such row for a part of the header and finds no heights.
        CHECK(read_height_field(ascii_grid(first + " 11 12\n" + first + " 14 15")).filled_voids == 2);
        CHECK(read_height_field(ascii_grid(first + "\n11\n12\n13\n14\n15")).filled_voids == 1);
    }
    const path grid = ascii_grid("NA 11 12\n13 14 15");
    write_text(path(grid).replace_extension(".prj"),
        "Projection    UTM\nZone          32\nDatum         WGS84\nSpheroid      WGS84\n"
        "Units         METERS\nZunits        NO\nParameters\n");
    const HeightSource source({grid});
    CHECK(source.place());
    std::filesystem::remove(path(grid).replace_extension(".prj"));
}

TEST_CASE("words without data at every other sample are found, and extra numbers are told") {
    std::string heights;
    for (int i = 0; i < 100; ++i) {
        for (int j = 0; j < 100; ++j) { heights += (i + j) % 2 == 0 ? "NA " : "7 "; }
        heights += "\n";
    }
    const path file = scratch_file("chess.asc");
    const std::string header = "ncols 100\nnrows 100\nxllcorner 1000\nyllcorner 0\ncellsize 30\n";
    write_text(file, header + heights);
    CHECK(read_height_field(file).filled_voids == 5000);
    write_text(file, header + heights + "8 9\n");
    CHECK_THAT(notes_text(read_height_field(file)),
        Contains(
            "2 extra numbers after the last height ignored; a row may be too long, which shifts all rows below it"));
}

TEST_CASE("words without data in a text grid are voids, counted in a note") {
    const HeightField kept = read_height_field(kept_map("na.asc"));
    CHECK(kept.filled_voids == 1);
    CHECK(kept.lowest_m() == 322.0F);
    CHECK_THAT(notes_text(kept), Contains("na.asc: 1 sample with a word such as 'NA'"));
    for (const char* const word : {"NA", "***", "*****", "null", "NaN", "-nan", "N/A", "1.#QNAN"}) {
        CAPTURE(word);
        const HeightField field = read_height_field(ascii_grid(std::string("10 11 12\n13 ") + word + " 15"));
        CHECK(field.filled_voids == 1);
        CHECK(field.lowest_m() == 10.0F);
    }
    // GDAL takes a word for the value 0: heights of 0 m would be lost.
    const HeightField sea = read_height_field(ascii_grid("0 0 1\nNA 0 1", "NODATA_value NA\n"));
    CHECK(sea.filled_voids == 1);
    // Numbers may be spread over lines in any way; a comma is a decimal point to GDAL, too.
    CHECK(read_height_field(ascii_grid("1\n2 3 -4,5e0\n+5. 6")).lowest_m() == -4.5F);
}

TEST_CASE("axes in degrees are never metres, at any spacing") {
    const HeightField coarse = read_height_field(kept_map("cf-degrees.nc"));
    CHECK(coarse.spacing_m() > 1000.0);
    REQUIRE(coarse.place);
    CHECK(coarse.place->latitude_deg == Approx(46.983).margin(0.01)); // by gdalinfo's corners
    CHECK(coarse.place->longitude_deg == Approx(6.983).margin(0.01));
    CHECK_THAT(notes_text(coarse), Contains("axes are in degrees: taken as longitude and latitude"));
    const HeightSource source({kept_map("cf-degrees.nc")});
    CHECK(source.cell_m().x == Approx(111320.0 / 30.0 * std::cos(46.983 * 3.14159265 / 180.0)).epsilon(3e-3));
    CHECK(source.system_name() == "WGS 84");
    for (const double cell_deg : {0.0003, 0.02, 0.1, 0.5}) {
        RasterFile raster = small_map();
        raster.system.clear();
        raster.transform = {8.0, cell_deg, 0.0, 47.0, 0.0, -cell_deg};
        const HeightField field = read_small(raster);
        CHECK(field.spacing_m() > 0.3 * 111000.0 * cell_deg);
        CHECK_THAT(notes_text(field), Contains("look like degrees: taken as longitude and latitude"));
    }
    RasterFile metres = small_map();
    metres.system.clear();
    metres.transform = {8.0, 0.5, 0.0, 47.0, 0.0, -0.5};
    ImportOptions options;
    options.system = "metres";
    CHECK_NOTHROW(check_coordinate_system(options));
    CHECK(read_small(metres, options).spacing_m() == 0.5);
}

TEST_CASE("cells of a few units that may be degrees are taken as metres with a note") {
    RasterFile raster = small_map();
    raster.system.clear();
    for (const double cell : {1.0, 2.0, 5.0}) {
        raster.transform = {-4.0 * cell, cell, 0.0, 3.0 * cell, 0.0, -cell};
        const HeightField field = read_small(raster);
        CHECK(field.spacing_m() == cell);
        CHECK(!field.place);
        CHECK_THAT(notes_text(field), Contains("may be degrees: taken as metres"));
    }
    raster.transform = {3000.0, 1.0, 0.0, 2000.0, 0.0, -1.0};
    CHECK(read_small(raster).notes.empty());
    raster.transform = {0.0, 30.0, 0.0, 180.0, 0.0, -30.0};
    CHECK(read_small(raster).notes.empty());
}

TEST_CASE("coordinates in metres are refused where a system says that they are degrees") {
    RasterFile raster = small_map();
    raster.system.clear();
    ImportOptions options;
    options.system = "EPSG:4326";
    CHECK_THROWS_WITH(read_small(raster, options),
        Contains("small.tif: expected longitudes and latitudes, as --terrain-system says, got coordinates up to "
                 "5000000: --terrain-system takes a system in metres"));
    raster.system = "EPSG:4326";
    CHECK_THROWS_WITH(read_small(raster), Contains("as the system of the file says, got coordinates up to"));
    options.system = "EPSG:32632";
    raster.transform = {8.0, 0.01, 0.0, 47.0, 0.0, -0.01};
    CHECK_THAT(
        notes_text(read_small(raster, options)), Contains("--terrain-system ignored: the file names its own system"));
}

TEST_CASE("degrees on a datum without a name are taken as WGS 84, with a note") {
    RasterFile raster = small_map();
    raster.transform = {8.0, 0.01, 0.0, 47.0, 0.0, -0.01};
    raster.system = "GEOGCS[\"unnamed\",DATUM[\"unknown\",SPHEROID[\"GRS "
                    "1980\",6378137,298.257222101]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
    const HeightField field = read_small(raster);
    REQUIRE(field.place);
    CHECK(field.place->latitude_deg == Approx(46.97).margin(1e-6));
    CHECK_THAT(notes_text(field), Contains("on a datum that is not named are taken as WGS 84"));
    raster.system = "EPSG:4326";
    CHECK(read_small(raster).notes.empty());
    raster.system = "LOCAL_CS[\"degrees\",UNIT[\"degree\",0.0174532925199433]]";
    CHECK(read_small(raster).spacing_m() > 300.0);
}

TEST_CASE("units of heights are recognised by their meaning") {
    for (const char* const metre :
        {"m", "Meters", "METRE", "metres", "m asl", "m a.s.l.", "[m]", "Metres above mean sea level"}) {
        CHECK(metres_from_unit(metre) == 1.0);
    }
    for (const char* const foot :
        {"ft", "Feet", "FOOT", "foot", "feet above MSL", "ft (NAVD88)", "International Foot"}) {
        CHECK(metres_from_unit(foot) == 0.3048);
    }
    for (const char* const survey : {"US_survey_foot", "U.S. Survey Feet", "US survey foot", "us-ft", "ftUS", "Foot_US",
             "foot (US survey)", "ussurveyft"}) {
        CHECK(metres_from_unit(survey).value_or(0.0) == Approx(0.3048006096).epsilon(1e-9));
    }
    CHECK(metres_from_unit("Kilometers") == 1000.0);
    CHECK(metres_from_unit("cm") == 0.01);
    for (const char* const other : {"K", "m/s", "m s-1", "m2", "m\u00b2", "degrees", "percent", "mm/day"}) {
        CAPTURE(other);
        CHECK(!metres_from_unit(other));
    }
    const HeightField field = read_height_field(kept_map("unit-Meters.tif"));
    CHECK(height_at(field, 20, 30) == Approx(484.902679443359));
    CHECK(field.notes.empty());
}

TEST_CASE("a system in feet whose heights name no unit gets a note") {
    const HeightField field = read_height_field(kept_map("stateplane-feet.tif"));
    CHECK(height_at(field, 20, 30) == Approx(1590.88806152344));
    CHECK_THAT(notes_text(field), Contains("in feet (US survey foot)") && Contains("--height-scale 0.30480061"));
    CHECK(read_height_field(kept_map("stateplane-feet.tif"), {.height_scale = 0.30480061}).notes.empty());
}

TEST_CASE("the band whose name says elevation is taken, and an option takes any") {
    const HeightField field = read_height_field(kept_map("band2-is-elevation.tif"));
    CHECK(height_at(field, 20, 30) == Approx(484.902679443359));
    CHECK_THAT(notes_text(field), Contains("band 2 (elevation) of 1 (slope), 2 (elevation) is taken for heights"));
    ImportOptions options;
    for (const char* const slope : {"1", "slope", "SLOPE"}) {
        options.band = slope;
        const HeightField other = read_height_field(kept_map("band2-is-elevation.tif"), options);
        CHECK(height_at(other, 20, 30) == Approx(1.18597781658173));
        CHECK(other.notes.empty());
    }
    options.band = "3";
    CHECK_THROWS_WITH(read_height_field(kept_map("band2-is-elevation.tif"), options),
        Contains("--band 3: the file has 2 bands, 1 (slope), 2 (elevation)"));
    RasterFile two = small_map();
    two.bands = 2;
    CHECK_THAT(notes_text(read_small(two)), Contains("band 1 of 1, 2 is taken for heights"));
}

TEST_CASE("three bands of bytes are a picture, one of them is heights if an option says so") {
    const path file = kept_map("rgb-undefined.tif");
    CHECK_THROWS_WITH(read_height_field(file), Contains("expected one band of heights, got 3 of 8 bits, which make a"));
    CHECK(read_height_field(file, {.band = "2"}).columns() == 60);
}

TEST_CASE("Terrarium and Mapbox tiles are decoded and placed by their number") {
    const HeightField kept = read_height_field(kept_map("terrarium.png"));
    CHECK(height_at(kept, 10, 20) == Approx(129 * 256 + 143 + 245 / 256.0 - 32768.0));
    CHECK_THAT(notes_text(kept), Contains("by the rule of Terrarium tiles"));
    RasterFile mapbox;
    mapbox.columns = 64;
    mapbox.rows = 64;
    mapbox.type = GDT_Byte;
    mapbox.bands = 3;
    std::vector<long> codes;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            codes.push_back(std::lround(10.0 * (10000.0 + 300.0 + 25.0 * std::sin(0.1 * x) * y)));
        }
    }
    for (const int shift : {16, 8, 0}) {
        for (const long code : codes) { mapbox.values.push_back(static_cast<double>((code >> shift) & 255)); }
    }
    const path folder = tests::empty_folder("tiles") / "9" / "268";
    std::filesystem::create_directories(folder);
    write_raster(folder / "179.png", "PNG", mapbox);
    const HeightSource tile({folder / "179.png"});
    // Column 268 of 2^9 is at 8.4375 degrees east; row 179 begins 47.5172 degrees north (OpenStreetMap).
    REQUIRE(tile.place());
    CHECK(tile.place()->longitude_deg == Approx(8.4375 + 0.5 * 0.703125).margin(1e-3));
    CHECK(tile.place()->latitude_deg == Approx(0.5 * (47.5172 + 47.0401)).margin(1e-2));
    CHECK(tile.height_at(0.0, 0.0).value_or(0.0) == Approx(300.0 + 25.0 * std::sin(3.15) * 31.5).margin(8.0));
    CHECK_THAT(tile.notes().front().text, Contains("by the rule of Mapbox tiles"));
}

TEST_CASE("a band that tells the error of heights or the like is not taken for heights") {
    const auto field_of = [](const std::vector<std::string>& names) {
        RasterFile raster = small_map();
        raster.bands = static_cast<int>(names.size());
        raster.values.clear();
        for (int i = 0; i < 48 * raster.bands; ++i) { raster.values.push_back(100.0 * (i / 48)); }
        const path file = scratch_file("bands.tif");
        write_raster(file, "GTiff", raster);
        {
            const Dataset dataset(GDALOpen(file.c_str(), GA_Update));
            for (int i = 0; i < raster.bands; ++i) {
                const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), i + 1);
                GDALSetDescription(band, names[static_cast<std::size_t>(i)].c_str());
                GDALSetRasterColorInterpretation(band, GCI_Undefined);
            }
        }
        return read_height_field(file);
    };
    for (const char* const other : {"height_error", "dem_std", "Elevation uncertainty", "slope of DEM", "dem-count",
             "DSM mask", "canopy_height", "geoid height", "heightError"}) {
        CAPTURE(other);
        CHECK(field_of({other, "height"}).lowest_m() == 100.0F);
        CHECK(field_of({other, "z"}).lowest_m() == 100.0F);
        const HeightField first = field_of({"height", other});
        CHECK(first.lowest_m() == 0.0F);
        CHECK(first.notes.empty());
    }
    CHECK(field_of({"height above geoid", "count"}).notes.empty());
    CHECK_THAT(notes_text(field_of({"dem_first", "dem_last"})),
        Contains("band 1 (dem_first) of 1 (dem_first), 2 (dem_last) is taken for heights"));
    RasterFile one = small_map();
    CHECK_THROWS_WITH(read_small(one, {.band = "7"}), Contains("small.tif: --band 7: the file has one band, 1"));
}

TEST_CASE("the sea of a Mapbox tile is at 0 m") {
    RasterFile tile;
    tile.columns = 16;
    tile.rows = 16;
    tile.type = GDT_Byte;
    tile.bands = 3;
    for (const double channel : {1.0, 134.0, 160.0}) { // 100000 tenths of a metre
        tile.values.insert(tile.values.end(), 256, channel);
    }
    tile.values[512] = 161.0;
    const path file = scratch_file("sea.png");
    write_raster(file, "PNG", tile);
    const HeightField field = read_height_field(file);
    CHECK(field.lowest_m() == 0.0F);
    CHECK(field.highest_m() == 0.1F);
    tile.values[40] = tile.values[256 + 40] = tile.values[512 + 40] = 0.0; // black
    write_raster(file, "PNG", tile);
    CHECK(read_height_field(file).filled_voids == 1);
}

TEST_CASE("photographs and drawings are no coded heights") {
    RasterFile picture;
    picture.columns = 64;
    picture.rows = 64;
    picture.type = GDT_Byte;
    picture.bands = 3;
    for (const double part : {128.0, 90.0, 60.0}) { // soft colours in the range of Terrarium's red
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                picture.values.push_back(part + std::floor(20.0 * std::sin(0.2 * x + part) * std::cos(0.1 * y)));
            }
        }
    }
    const path file = scratch_file("photo.png");
    write_raster(file, "PNG", picture);
    CHECK_THROWS_WITH(read_height_field(file), Contains("got a colour picture"));
}

TEST_CASE("a picture in colour that is grey everywhere is one of heights") {
    RasterFile picture;
    picture.columns = 40;
    picture.rows = 30;
    picture.type = GDT_Byte;
    picture.bands = 3;
    for (int band = 0; band < 3; ++band) {
        for (int i = 0; i < 40 * 30; ++i) { picture.values.push_back(i % 40 + i / 40); }
    }
    const path file = scratch_file("grey.png");
    write_raster(file, "PNG", picture);
    const HeightField field = read_height_field(file);
    CHECK(height_at(field, 7, 5) == 12.0);
    CHECK_THAT(notes_text(field), Contains("red, green and blue are the same everywhere: taken for heights"));
    const std::string width =
        "does not say how wide its cells are: taken as 30 m; --terrain-spacing says another width";
    CHECK_THAT(notes_text(field), Contains(width));
    CHECK_THAT(notes_text(read_height_field(file, {.spacing_m = 12.0})), !Contains(width));
    picture.values.back() += 1.0;
    write_raster(file, "PNG", picture);
    CHECK_THROWS_WITH(read_height_field(file), Contains("got a colour picture"));
}

TEST_CASE("Cesium heightmaps are decoded, compressed or not, and placed by their number") {
    std::string bytes;
    for (int i = 0; i < 65 * 65; ++i) {
        const int code = 5 * (1000 + i % 65 + 2 * (i / 65));
        bytes += static_cast<char>(code & 255);
        bytes += static_cast<char>(code >> 8);
    }
    bytes += std::string(2, '\0');
    const path folder = tests::empty_folder("cesium") / "12" / "4290";
    std::filesystem::create_directories(folder);
    write_text(folder / "3110.terrain", bytes);
    const HeightSource tile({folder / "3110.terrain"});
    REQUIRE(tile.place());
    const double side_deg = 180.0 / 4096.0;
    CHECK(tile.place()->longitude_deg == Approx(4290.5 * side_deg - 180.0).margin(1e-6));
    CHECK(tile.place()->latitude_deg == Approx(3110.5 * side_deg - 90.0).margin(1e-3));
    CHECK(tile.height_at(0.0, 0.0).value_or(0.0) == Approx(32.0 + 64.0).margin(0.1));
    const path packed = folder.parent_path() / "packed.terrain"; // its name is no number
    VSILFILE* const out = VSIFOpenL(("/vsigzip/" + packed.string()).c_str(), "wb");
    VSIFWriteL(bytes.data(), 1, bytes.size(), out);
    VSIFCloseL(out);
    const HeightField field = read_height_field(packed);
    CHECK(!field.place);
    CHECK(height_at(field, 3, 2) == 7.0);
    CHECK(map_inputs({folder.string()}).size() == 1);
    write_text(packed, bytes.substr(0, 5000));
    CHECK_THROWS_WITH(read_height_field(packed), Contains("such as a quantized mesh"));
}

TEST_CASE("reading maps of any format leaves their folder as it is") {
    const path folder = tests::empty_folder("listing");
    const std::vector<std::pair<const char*, const char*>> formats = {{"GTiff", "a.tif"}, {"PNG", "a.png"},
        {"HFA", "a.img"}, {"AAIGrid", "b.asc"}, {"EHdr", "c.bil"}, {"netCDF", "a.nc"}, {"XYZ", "a.xyz"},
        {"ENVI", "d.envi"}, {"SAGA", "e.sdat"}, {"RST", "f.rst"}, {"JP2OpenJPEG", "a.jp2"}, {"GPKG", "a.gpkg"}};
    for (const auto& [driver, name] : formats) {
        RasterFile raster = metric_hills();
        raster.type = std::string(driver) == "PNG"    ? GDT_UInt16
                      : std::string(driver) == "GPKG" ? GDT_Float32
                                                      : GDT_Int16;
        write_raster(folder / name, driver, raster);
    }
    const auto listing = [&folder] {
        std::vector<std::string> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            files.push_back(entry.path().string() + " " + std::to_string(entry.file_size()) + " " +
                            std::to_string(entry.last_write_time().time_since_epoch().count()));
        }
        std::ranges::sort(files);
        return files;
    };
    const std::vector<std::string> before = listing();
    for (const auto& [driver, name] : formats) {
        CAPTURE(name);
        const HeightSource source({folder / name});
        CHECK(source.count_voids() == 0);
        read_height_field(folder / name);
        CHECK(listing() == before);
    }
    {
        // A GeoPackage in the mode in which SQLite keeps a log beside it, by two bytes of its header.
        std::fstream header(folder / "a.gpkg", std::ios::binary | std::ios::in | std::ios::out);
        header.seekp(18);
        header.write("\2\2", 2);
    }
    const std::vector<std::string> with_log = listing();
    const HeightSource source({folder / "a.gpkg"});
    CHECK(source.count_voids() == 0);
    CHECK(listing() == with_log); // while it is open
}

TEST_CASE("a warning belongs to the session of its thread, others are silent") {
    const GdalSession session;
    std::thread([] {
        CPLError(CE_Warning, CPLE_AppDefined, "of nobody");
        const GdalSession other;
        CPLError(CE_Warning, CPLE_AppDefined, "of the other");
        CHECK(other.warnings() == std::vector<std::string>{"of the other"});
    }).join();
    CHECK(session.warnings().empty());
    CPLError(CE_Warning, CPLE_AppDefined, "of this");
    CHECK(session.warnings() == std::vector<std::string>{"of this"});
    CHECK(std::string(CPLGetConfigOption("GDAL_NUM_THREADS", "")) == "1"); // none of GDAL's own
}

TEST_CASE("libraries print nothing on any thread and warn once") {
    const path file = scratch_file("four.nc");
    CPLSetConfigOption("GDAL_NETCDF_ASSUME_LONGLAT", nullptr);
    RasterFile raster = small_map();
    write_raster(scratch_file("three.tif"), "GTiff", raster);
    {
        GDALAllRegister();
        const Dataset source(GDALOpen(scratch_file("gone").parent_path().append("three.tif").c_str(), GA_ReadOnly));
        REQUIRE(source);
        char** options = CSLSetNameValue(nullptr, "FORMAT", "NC4");
        const Dataset made(GDALCreateCopy(
            GDALGetDriverByName("netCDF"), file.c_str(), source.get(), FALSE, options, nullptr, nullptr));
        CSLDestroy(options);
        REQUIRE(made);
    }
    const path said = scratch_file("said.txt");
    std::fflush(stderr);
    const int before = ::dup(STDERR_FILENO);
    std::FILE* const to = std::fopen(said.c_str(), "w");
    ::dup2(::fileno(to), STDERR_FILENO);
    for (int i = 0; i < 2; ++i) {
        std::thread([&file] { read_height_field(file); }).join();
    }
    std::fflush(stderr);
    ::dup2(before, STDERR_FILENO);
    ::close(before);
    std::fclose(to);
    CHECK(std::filesystem::file_size(said) == 0);
    GdalSession session;
    session.note_warning("twice\nsaid");
    session.note_warning("twice\nsaid");
    CHECK(session.warnings() == std::vector<std::string>{"twice said"});
}
