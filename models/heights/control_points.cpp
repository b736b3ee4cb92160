#include "models/heights/control_points.h"

#include "models/heights/gdal_functions.h"
#include "sim/base/error.h"

#include <array>
#include <fmt/format.h>
#include <memory>
#include <new>

namespace octant::models::heights {

namespace {

/// Stands for no data where the source declares none; read_height_field takes it so, too.
constexpr double usual_no_data = -32768.0;

/// A list of one, which GDAL frees.
template <typename Number>
Number* list_of(Number value) {
    void* const memory = CPLMalloc(sizeof(Number));
    return new (memory) Number(value);
}

} // namespace

Dataset grid_by_control_points(
    const std::filesystem::path& file, void* source, int band, const GdalSession& gdal) {
    std::array<double, 6> transform = {};
    const int points = GDALGetGCPCount(source);
    if (points == 0 || GDALGetRasterCount(source) == 0 ||
        GDALGetGeoTransform(source, transform.data()) == CE_None) {
        return nullptr;
    }
    int declared = 0;
    const double value = GDALGetRasterNoDataValue(GDALGetRasterBand(source, band), &declared);
    const std::unique_ptr<GDALWarpOptions, void (*)(GDALWarpOptions*)> options(
        GDALCreateWarpOptions(), [](GDALWarpOptions* own) { GDALDestroyWarpOptions(own); });
    options->nBandCount = 1;
    options->panSrcBands = list_of(band);
    options->panDstBands = list_of(1);
    options->padfDstNoDataReal = list_of(declared != 0 ? value : usual_no_data);
    if (declared != 0) {
        options->padfSrcNoDataReal = list_of(value);
    }
    constexpr double exact = 0.0;
    const char* const system = GDALGetGCPProjection(source);
    Dataset grid(
        GDALAutoCreateWarpedVRT(source, system, system, GRA_Bilinear, exact, options.get()));
    if (!grid) {
        error_in(
            file,
            fmt::format(
                "expected control points that a grid fits, got {}: {}", points, gdal.reason(file)));
    }
    return grid;
}

} // namespace octant::models::heights
