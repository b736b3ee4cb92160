#include "models/height_raster.h"

#include "models/height_field_import.h"
#include "sim/base/error.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gdal.h>
#include <limits>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace octant::models {

namespace {

using std::filesystem::path;
using GeoTransform = std::array<double, 6>;

/// How the raw numbers of a band become metres.
struct Band {
    GDALRasterBandH handle = nullptr;
    std::optional<double> no_data;
    double scale_m = 1.0;
    double offset_m = 0.0;
};

[[noreturn]] void error_unreadable(const path& file, const std::string& got) {
    error_in(file, fmt::format("expected a height field that GDAL can read, got {}", got));
}

Dataset open(const path& file, const GdalSession& gdal) {
    constexpr std::array<const char*, 7> drivers = {
        "GTiff", "SRTMHGT", "USGSDEM", "PNG", "PNM", "AAIGrid", nullptr};
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    Dataset dataset(GDALOpenEx(file.c_str(), flags, drivers.data(), nullptr, nullptr));
    if (dataset) {
        return dataset;
    }
    if (gdal.names_no_format()) {
        error_unreadable(
            file,
            "another kind of file (GeoTIFF, SRTM .hgt, USGS DEM, PNG, PGM and ASCII grid are "
            "read)");
    }
    error_unreadable(file, gdal.reason(file));
}

/// Metres of the unit a band names; nothing for one that is no known length.
std::optional<double> metres_from_unit(std::string_view unit) {
    constexpr double survey_foot_m = 1200.0 / 3937.0;
    constexpr std::array<std::pair<std::string_view, double>, 14> known = {{
        {"", 1.0},
        {"m", 1.0},
        {"metre", 1.0},
        {"meter", 1.0},
        {"metres", 1.0},
        {"meters", 1.0},
        {"ft", 0.3048},
        {"foot", 0.3048},
        {"feet", 0.3048},
        {"international foot", 0.3048},
        {"us-ft", survey_foot_m},
        {"sfoot", survey_foot_m},
        {"ftUS", survey_foot_m},
        {"US survey foot", survey_foot_m},
    }};
    for (const auto& [name, metres] : known) {
        if (name == unit) {
            return metres;
        }
    }
    return std::nullopt;
}

std::optional<double> declared_no_data(GDALRasterBandH band) {
    int declared = 0;
    double value = 0.0;
    switch (GDALGetRasterDataType(band)) {
    case GDT_Int64:
        value = static_cast<double>(GDALGetRasterNoDataValueAsInt64(band, &declared));
        break;
    case GDT_UInt64:
        value = static_cast<double>(GDALGetRasterNoDataValueAsUInt64(band, &declared));
        break;
    default:
        value = GDALGetRasterNoDataValue(band, &declared);
    }
    return declared != 0 ? std::optional(value) : std::nullopt;
}

Band first_band(const path& file, GDALDatasetH dataset) {
    if (GDALGetRasterCount(dataset) < 1) {
        error_unreadable(file, "no band");
    }
    Band band;
    band.handle = GDALGetRasterBand(dataset, 1);
    const GDALColorInterp colour = GDALGetRasterColorInterpretation(band.handle);
    if (GDALGetRasterColorTable(band.handle) != nullptr ||
        (colour != GCI_Undefined && colour != GCI_GrayIndex)) {
        error_in(file, "expected one band of heights, got a colour picture");
    }
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band.handle)) != 0) {
        error_in(file, "expected real heights, got complex numbers");
    }
    const std::string unit = GDALGetRasterUnitType(band.handle);
    const auto metres = metres_from_unit(unit);
    if (!metres) {
        error_in(
            file, fmt::format("expected heights in metres or feet, got '{}'", printable(unit)));
    }
    band.no_data = declared_no_data(band.handle);
    band.scale_m = GDALGetRasterScale(band.handle, nullptr) * *metres;
    band.offset_m = GDALGetRasterOffset(band.handle, nullptr) * *metres;
    return band;
}

bool is_void(double raw, const std::optional<double>& no_data) {
    constexpr double absurd = 1e30;
    if (!std::isfinite(raw) || std::abs(raw) >= absurd) {
        return true;
    }
    if (no_data) {
        return std::abs(*no_data) < absurd &&
               static_cast<float>(raw) == static_cast<float>(*no_data);
    }
    return raw == -32768.0 || raw == -32767.0 || raw == -9999.0;
}

/// Raw numbers to metres, voids to NaN.
float height_from_raw(const path& file, double raw, const Band& band) {
    if (is_void(raw, band.no_data)) {
        return std::numeric_limits<float>::quiet_NaN();
    }
    const bool plain = band.scale_m == 1.0 && band.offset_m == 0.0;
    const double height_m = plain ? raw : raw * band.scale_m + band.offset_m;
    check_height(file, height_m);
    return static_cast<float>(height_m);
}

std::optional<GeoTransform> transform_of(const path& file, GDALDatasetH dataset) {
    GeoTransform t = {};
    if (GDALGetGeoTransform(dataset, t.data()) != CE_None) {
        return std::nullopt;
    }
    if (std::abs(t[2]) > 1e-9 * std::abs(t[1]) || std::abs(t[4]) > 1e-9 * std::abs(t[5])) {
        error_in(
            file, "expected columns that run north and rows that run east, got a rotated grid");
    }
    const bool sound =
        std::isfinite(t[0]) && std::isfinite(t[3]) && std::isnormal(t[1]) && std::isnormal(t[5]);
    if (!sound) {
        error_in(
            file, fmt::format("expected a cell size that is a number, got {} x {}", t[1], t[5]));
    }
    return t;
}

GridFrame frame_from(const GeoTransform& t, const HeightGrid& grid) {
    const double first_x = t[0] + 0.5 * t[1];
    const double first_y = t[3] + 0.5 * t[5];
    return {
        t[1] > 0.0 ? first_x : first_x + (grid.columns - 1) * t[1],
        t[5] > 0.0 ? first_y : first_y + (grid.rows - 1) * t[5],
        std::abs(t[1]),
        std::abs(t[5])};
}

/// Which way the file's lines run; GDAL's own order is from the north and the west.
struct Order {
    bool from_east = false;
    bool from_south = false;
};

void read_lines(
    const path& file, const Band& band, Order order, HeightGrid& grid, const GdalSession& gdal) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    std::vector<double> line(columns);
    for (int y = 0; y < grid.rows; ++y) {
        const CPLErr result = GDALRasterIO(
            band.handle,
            GF_Read,
            0,
            y,
            grid.columns,
            1,
            line.data(),
            grid.columns,
            1,
            GDT_Float64,
            0,
            0);
        if (result != CE_None || gdal.failed()) {
            error_unreadable(file, gdal.reason(file));
        }
        const int row = order.from_south ? y : grid.rows - 1 - y;
        for (std::size_t x = 0; x < columns; ++x) {
            const std::size_t column = order.from_east ? columns - 1 - x : x;
            grid.heights_m[grid.index(0, row) + column] = height_from_raw(file, line[x], band);
        }
    }
}

} // namespace

void check_local_file(const path& file) {
    if (file.string().starts_with("/vsi")) {
        error_in(file, "expected a file on this computer, got a virtual path of GDAL");
    }
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        const bool odd = code && code.value() != ENOENT;
        error_in(file, odd ? code.message() : "expected a file, found none");
    }
    if (std::filesystem::is_directory(status)) {
        error_in(file, "expected a file, got a folder");
    }
    if (!std::filesystem::is_regular_file(status)) {
        error_in(file, "expected a regular file, got a device or pipe");
    }
    if (::access(file.c_str(), R_OK) != 0) {
        error_in(file, fmt::format("cannot be opened for reading: {}", std::strerror(errno)));
    }
    if (std::filesystem::file_size(file, code) == 0) {
        error_unreadable(file, "an empty file");
    }
}

void check_import_size(const path& file, int columns, int rows) {
    const auto fits = [](int n) { return n >= 2 && n <= largest_import_samples; };
    if (!fits(columns) || !fits(rows)) {
        error_in(
            file,
            fmt::format(
                "expected 2 x 2 to {} x {} samples, got {} x {}",
                largest_import_samples,
                largest_import_samples,
                columns,
                rows));
    }
}

void check_height(const path& file, double height_m) {
    if (!(height_m >= lowest_import_m && height_m <= highest_import_m)) {
        error_in(
            file,
            fmt::format(
                "expected heights from {:g} to {:g} m, got {:g} m",
                lowest_import_m,
                highest_import_m,
                height_m));
    }
}

HeightRaster read_height_raster(const path& file, double picture_scale, GdalSession& gdal) {
    HeightRaster raster;
    raster.dataset = open(file, gdal);
    GDALDatasetH dataset = raster.dataset.get();
    gdal.forget();
    HeightGrid& grid = raster.grid;
    grid.columns = GDALGetRasterXSize(dataset);
    grid.rows = GDALGetRasterYSize(dataset);
    check_import_size(file, grid.columns, grid.rows);
    Band band = first_band(file, dataset);
    Order order;
    if (const auto transform = transform_of(file, dataset)) {
        raster.frame = frame_from(*transform, grid);
        raster.system = GDALGetSpatialRef(dataset);
        order = {(*transform)[1]<0.0, (*transform)[5]> 0.0};
    } else {
        band.scale_m *= picture_scale;
        band.offset_m *= picture_scale;
    }
    grid.heights_m.resize(
        static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    read_lines(file, band, order, grid, gdal);
    return raster;
}

} // namespace octant::models
