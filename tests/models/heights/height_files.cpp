#include "tests/models/heights/height_files.h"

#include <catch2/catch.hpp>

#include <cpl_conv.h>
#include <cpl_error.h>
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

} // namespace octant::models::heights::test
