#include "tests/models/heights/sample_maps.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cstddef>
#include <ogr_srs_api.h>

namespace octant::models::heights::test {

void write_raster(const std::filesystem::path& path, const char* driver, const RasterFile& raster) {
    CPLSetConfigOption("GDAL_PAM_ENABLED", "NO"); // writes no sidecar
    GDALAllRegister();
    GDALDatasetH memory =
        GDALCreate(GDALGetDriverByName("MEM"), "", raster.columns, raster.rows, raster.bands, raster.type, nullptr);
    REQUIRE(memory != nullptr);
    if (!raster.transform.empty()) {
        std::vector<double> transform = raster.transform;
        GDALSetGeoTransform(memory, transform.data());
    }
    if (!raster.system.empty()) {
        const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
        REQUIRE(OSRSetFromUserInput(system, raster.system.c_str()) == OGRERR_NONE);
        GDALSetSpatialRef(memory, system);
        OSRRelease(system);
    }
    for (int i = 1; i <= raster.bands; ++i) {
        const GDALRasterBandH band = GDALGetRasterBand(memory, i);
        const auto pixels = static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows);
        const std::size_t first = raster.values.size() > pixels ? static_cast<std::size_t>(i - 1) * pixels : 0;
        std::vector<double> values(raster.values.begin() + static_cast<long>(first),
            raster.values.begin() + static_cast<long>(first + pixels));
        const CPLErr written = GDALRasterIO(band, GF_Write, 0, 0, raster.columns, raster.rows, values.data(),
            raster.columns, raster.rows, GDT_Float64, 0, 0);
        REQUIRE(written == CE_None);
        if (raster.no_data) { GDALSetRasterNoDataValue(band, *raster.no_data); }
        if (raster.bands >= 3) {
            GDALSetRasterColorInterpretation(band, static_cast<GDALColorInterp>(GCI_RedBand + i - 1));
        }
    }
    const GDALRasterBandH first = GDALGetRasterBand(memory, 1);
    GDALSetRasterUnitType(first, raster.unit.c_str());
    if (raster.scale != 1.0 || raster.offset != 0.0) {
        GDALSetRasterScale(first, raster.scale);
        GDALSetRasterOffset(first, raster.offset);
    }
    if (raster.has_palette) {
        const GDALColorTableH palette = GDALCreateColorTable(GPI_RGB);
        const GDALColorEntry red = {255, 0, 0, 255};
        GDALSetColorEntry(palette, 0, &red);
        GDALSetRasterColorTable(first, palette);
        GDALDestroyColorTable(palette);
    }
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDatasetH copy =
        GDALCreateCopy(GDALGetDriverByName(driver), path.c_str(), memory, FALSE, nullptr, nullptr, nullptr);
    CPLPopErrorHandler();
    REQUIRE(copy != nullptr);
    GDALClose(copy);
    GDALClose(memory);
    CPLSetConfigOption("GDAL_PAM_ENABLED", nullptr);
}

void truncate_file(const std::filesystem::path& path, std::uintmax_t bytes) {
    REQUIRE(std::filesystem::file_size(path) > bytes);
    std::filesystem::resize_file(path, bytes);
}

double hills_m(double x, double y) {
    return std::round(900.0 + 400.0 * std::sin(0.21 * x) * std::cos(0.17 * y) + 3.0 * x - 2.0 * y);
}

RasterFile hills(int columns, int rows) {
    RasterFile raster;
    raster.columns = columns;
    raster.rows = rows;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) { raster.values.push_back(hills_m(x, y)); }
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

RasterFile degree_hills(int columns, int rows, double west, double north) {
    constexpr double step = 1.0 / 400.0;
    RasterFile raster = hills(columns, rows);
    raster.transform = {west - 0.5 * step, step, 0.0, north + 0.5 * step, 0.0, -step};
    raster.system = "EPSG:4326";
    return raster;
}

RasterFile cut(const RasterFile& whole, int first_x, int first_y, int columns, int rows) {
    RasterFile part = whole;
    part.columns = columns;
    part.rows = rows;
    part.values.clear();
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            part.values.push_back(whole.values[static_cast<std::size_t>((first_y + y) * whole.columns + first_x + x)]);
        }
    }
    part.transform[0] += first_x * whole.transform[1];
    part.transform[3] += first_y * whole.transform[5];
    return part;
}

double max_apart_m(const HeightField& a, const HeightField& b) {
    REQUIRE(a.columns() == b.columns());
    REQUIRE(a.rows() == b.rows());
    double most = 0.0;
    for (int row = 0; row < a.rows(); ++row) {
        for (int column = 0; column < a.columns(); ++column) {
            most = std::max(most, std::abs(static_cast<double>(a.height_m(column, row) - b.height_m(column, row))));
        }
    }
    return most;
}

} // namespace octant::models::heights::test
