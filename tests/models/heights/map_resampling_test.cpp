#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "tests/models/heights/sample_maps.h"
#include "tests/real_files.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <numbers>
#include <ogr_srs_api.h>
#include <random>
#include <utility>
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

// Tiles of one degree as one ground, and a map that needs no resampling, judged at 10,000 places by the raw numbers of
// the files and by PROJ, without the code that reads, joins and resamples maps.

namespace {

using std::filesystem::path;

constexpr int places = 10000;

/// Numbers row after row from the north, and where they lie.
struct Numbers {
    int columns = 0;
    int rows = 0;
    std::vector<double> values;
    double west = 0.0; ///< of the first number, in the units of x
    double north = 0.0;
    double step_x = 0.0;
    double step_y = 0.0;

    double at(int column, int row) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }

    double bilinear(double x, double y) const {
        const double c = std::clamp((x - west) / step_x, 0.0, columns - 1.001);
        const double r = std::clamp((north - y) / step_y, 0.0, rows - 1.001);
        const int i = static_cast<int>(c);
        const int j = static_cast<int>(r);
        const double u = c - i;
        const double v = r - j;
        return (1.0 - v) * ((1.0 - u) * at(i, j) + u * at(i + 1, j)) +
               v * ((1.0 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
    }
};

Numbers numbers_of(const RasterFile& raster) {
    const std::vector<double>& t = raster.transform;
    return {raster.columns, raster.rows, raster.values, t[0] + 0.5 * t[1], t[3] + 0.5 * t[5], t[1], -t[5]};
}

RasterFile raster_read(const path& file) {
    GDALAllRegister();
    GDALDatasetH dataset = GDALOpen(file.c_str(), GA_ReadOnly);
    REQUIRE(dataset != nullptr);
    RasterFile raster;
    raster.columns = GDALGetRasterXSize(dataset);
    raster.rows = GDALGetRasterYSize(dataset);
    raster.values.resize(static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
    raster.transform.resize(6);
    REQUIRE(GDALGetGeoTransform(dataset, raster.transform.data()) == CE_None);
    REQUIRE(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, 0, raster.columns, raster.rows,
                raster.values.data(), raster.columns, raster.rows, GDT_Float64, 0, 0) == CE_None);
    GDALClose(dataset);
    return raster;
}

/// A raster of one degree two tiles wide and three high, each the mirror image of its neighbours.
RasterFile mirrored(const RasterFile& tile, double west, double north) {
    RasterFile whole = tile;
    const int step = tile.columns - 1;
    whole.columns = 2 * step + 1;
    whole.rows = 3 * step + 1;
    whole.values.clear();
    const auto fold = [step](int k) { return (k / step) % 2 == 0 ? k % step : step - k % step; };
    for (int row = 0; row < whole.rows; ++row) {
        for (int column = 0; column < whole.columns; ++column) {
            whole.values.push_back(tile.values[static_cast<std::size_t>(fold(row) * tile.columns + fold(column))]);
        }
    }
    const double cell = 1.0 / step;
    whole.transform = {west - 0.5 * cell, cell, 0.0, north + 0.5 * cell, 0.0, -cell};
    whole.system = "EPSG:4326";
    return whole;
}

/// SRTM's own format: big-endian whole metres, row after row from the north, named by its corner.
void write_hgt(const path& folder, const RasterFile& tile, int south, int west) {
    char name[16];
    std::snprintf(name, sizeof name, "N%02dE%03d.hgt", south, west);
    std::ofstream out(folder / name, std::ios::binary);
    for (const double value : tile.values) {
        const auto number = static_cast<std::uint16_t>(static_cast<std::int16_t>(value));
        const char bytes[] = {static_cast<char>(number >> 8U), static_cast<char>(number & 255U)};
        out.write(bytes, 2);
    }
    REQUIRE(out.flush());
}

/// Random places in degrees, or in units of the file's own system, away from the rim.
class Places {
public:
    explicit Places(const Numbers& numbers) : numbers_(&numbers) {}

    std::pair<double, double> next() {
        const double x = numbers_->west + share() * (numbers_->columns - 1) * numbers_->step_x;
        const double y = numbers_->north - share() * (numbers_->rows - 1) * numbers_->step_y;
        return {x, y};
    }

private:
    double share() { return 0.02 + 0.96 * static_cast<double>(random_() >> 11U) * 0x1p-53; }

    const Numbers* numbers_;
    std::mt19937_64 random_{7};
};

/// How far a ground's heights lie from the raw numbers.
struct Apart {
    double worst_m = 0.0;
    double rms_m = 0.0;
};

using Ground = std::function<std::optional<double>(double x_m, double y_m)>;

/// At 10,000 places that the ground covers. `degrees`: the numbers lie on the globe.
Apart apart(const Numbers& numbers, const CoordinateSystem& system, bool degrees, const Ground& ground) {
    const std::unique_ptr<void, decltype(&OSRRelease)> globe(OSRNewSpatialReference(nullptr), OSRRelease);
    const std::unique_ptr<void, decltype(&OSRRelease)> local(OSRNewSpatialReference(system.wkt.c_str()), OSRRelease);
    REQUIRE(OSRImportFromEPSG(globe.get(), 4326) == OGRERR_NONE);
    OSRSetAxisMappingStrategy(globe.get(), OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(local.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<void, decltype(&OCTDestroyCoordinateTransformation)> to_local(
        OCTNewCoordinateTransformation(globe.get(), local.get()), OCTDestroyCoordinateTransformation);
    Apart found;
    Places random(numbers);
    int outside = 0;
    for (int inside = 0; inside < places;) {
        const auto [at_x, at_y] = random.next();
        double x = at_x;
        double y = at_y;
        if (degrees) { REQUIRE(OCTTransform(to_local.get(), 1, &x, &y, nullptr)); }
        const auto height_m = ground(x - system.centre_x, y - system.centre_y);
        if (!height_m) {
            REQUIRE(++outside < places / 10);
            continue;
        }
        ++inside;
        const double off_m = std::abs(*height_m - numbers.bilinear(at_x, at_y));
        found.worst_m = std::max(found.worst_m, off_m);
        found.rms_m += off_m * off_m / places;
    }
    found.rms_m = std::sqrt(found.rms_m);
    return found;
}

void check_tiles(const path& folder, const RasterFile& whole) {
    const std::vector<path> files = map_inputs({folder.string()});
    REQUIRE(files.size() == 6);
    const HeightSource source(files);
    const HeightField field = read_height_field(files);
    REQUIRE(field.system);
    CHECK(field.filled_voids == 0);
    const Numbers numbers = numbers_of(whole);
    const auto deviation = source.deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    REQUIRE(deviation);
    const Apart resampled =
        apart(numbers, *field.system, true, [&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    INFO("said " << deviation->worst_m << " m, got " << resampled.worst_m << " m");
    CHECK(resampled.worst_m <= deviation->worst_m + 0.1);
    CHECK(resampled.rms_m <= 1.2 * deviation->rms_m);
    const Apart own =
        apart(numbers, *field.system, true, [&source](double x_m, double y_m) { return source.height_at(x_m, y_m); });
    CHECK(own.worst_m <= 0.1);
}

/// Six tiles of a whole as files of their own.
template <typename Write>
void write_tiles(const RasterFile& whole, const Write& write) {
    const int step = (whole.columns - 1) / 2;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 2; ++i) { write(cut(whole, i * step, j * step, step + 1, step + 1), i, j); }
    }
}

void check_own_heights(const path& file) {
    const Numbers numbers = numbers_of(raster_read(file));
    const HeightField field = read_height_field(file);
    REQUIRE(field.system);
    const Apart found =
        apart(numbers, *field.system, false, [&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    CHECK(found.worst_m <= 0.1);
}

} // namespace

TEST_CASE("two by three degrees of made tiles are one ground within the deviation that it states") {
    const RasterFile whole = mirrored(hills(121, 121), 8.0, 50.0);
    const path folder = scratch_file("made_degrees");
    std::filesystem::create_directories(folder);
    write_tiles(whole, [&folder](const RasterFile& tile, int i, int j) {
        write_raster(folder / ("t" + std::to_string(3 * i + j) + ".tif"), "GTiff", tile);
    });
    check_tiles(folder, whole);
}

TEST_CASE("tiles at 70 degrees north and over the antimeridian are one ground as elsewhere") {
    const RasterFile whole = mirrored(hills(121, 121), 179.0, 72.0);
    const path folder = scratch_file("far_degrees");
    std::filesystem::create_directories(folder);
    write_tiles(whole, [&folder](RasterFile tile, int i, int j) {
        tile.transform[0] -= i == 1 ? 360.0 : 0.0;
        write_raster(folder / ("t" + std::to_string(3 * i + j) + ".tif"), "GTiff", tile);
    });
    check_tiles(folder, whole);
}

TEST_CASE("two by three degrees of SRTM tiles are one ground within the deviation that it states") {
    const auto real = tests::real_file("terrain/srtm3_N49W123.tif");
    if (!real) { return; }
    RasterFile tile = raster_read(*real);
    REQUIRE((tile.columns == 1201 && tile.rows == 1201));
    for (double& value : tile.values) {
        value = value < -500.0 ? 0.0 : value; // the sea
    }
    const RasterFile whole = mirrored(tile, 8.0, 50.0);
    const path folder = scratch_file("srtm_degrees");
    std::filesystem::create_directories(folder);
    write_tiles(whole, [&folder](const RasterFile& part, int i, int j) { write_hgt(folder, part, 49 - j, 8 + i); });
    check_tiles(folder, whole);
}

TEST_CASE("a made map that needs no resampling has its own heights between its samples") {
    write_raster(scratch_file("metric.tif"), "GTiff", metric_hills());
    check_own_heights(tests::scratch_folder() / "metric.tif");
}

TEST_CASE("a map that needs no resampling has its own heights between its samples") {
    if (const auto real = tests::real_file("terrain/vancouver_2049.tif")) { check_own_heights(*real); }
}
