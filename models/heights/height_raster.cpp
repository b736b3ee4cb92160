#include "models/heights/height_raster.h"

#include "models/heights/import_options.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
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

namespace octant::models::heights {

namespace {

using std::filesystem::path;
using GeoTransform = std::array<double, 6>;

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

/// Reads what describes the first band: no-data value, scale, offset and unit.
void take_first_band(const path& file, OpenRaster& raster) {
    GDALDatasetH dataset = raster.dataset.get();
    if (GDALGetRasterCount(dataset) < 1) {
        error_unreadable(file, "no band");
    }
    raster.band = GDALGetRasterBand(dataset, 1);
    const GDALColorInterp colour = GDALGetRasterColorInterpretation(raster.band);
    if (GDALGetRasterColorTable(raster.band) != nullptr ||
        (colour != GCI_Undefined && colour != GCI_GrayIndex)) {
        error_in(file, "expected one band of heights, got a colour picture");
    }
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(raster.band)) != 0) {
        error_in(file, "expected real heights, got complex numbers");
    }
    const std::string unit = GDALGetRasterUnitType(raster.band);
    const auto metres = metres_from_unit(unit);
    if (!metres) {
        error_in(
            file, fmt::format("expected heights in metres or feet, got '{}'", printable(unit)));
    }
    raster.no_data = declared_no_data(raster.band);
    raster.scale_m = GDALGetRasterScale(raster.band, nullptr) * *metres;
    raster.offset_m = GDALGetRasterOffset(raster.band, nullptr) * *metres;
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

/// The height in metres of a raw number; NaN for one that stands for no data.
float height_from_raw(const path& file, double raw, const OpenRaster& band) {
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

GridFrame frame_from(const GeoTransform& t, const OpenRaster& grid) {
    const double first_x = t[0] + 0.5 * t[1];
    const double first_y = t[3] + 0.5 * t[5];
    return {
        t[1] > 0.0 ? first_x : first_x + (grid.columns - 1) * t[1],
        t[5] > 0.0 ? first_y : first_y + (grid.rows - 1) * t[5],
        std::abs(t[1]),
        std::abs(t[5])};
}

/// Reads rows, counted from the south, into a buffer row after row from the south.
template <typename Number>
void read_rows(
    const path& file,
    const OpenRaster& raster,
    RowBand rows,
    GDALDataType type,
    Number* numbers,
    const GdalSession& gdal) {
    const int line = raster.from_south ? rows.first : raster.rows - rows.first - rows.count;
    const auto size = static_cast<GSpacing>(sizeof(Number));
    const GSpacing line_size = size * raster.columns;
    Number* const start =
        numbers + (raster.from_east ? raster.columns - 1 : 0) +
        (raster.from_south ? std::ptrdiff_t{0} : std::ptrdiff_t{rows.count - 1} * raster.columns);
    const CPLErr result = GDALRasterIOEx(
        raster.band,
        GF_Read,
        0,
        line,
        raster.columns,
        rows.count,
        start,
        raster.columns,
        rows.count,
        type,
        raster.from_east ? -size : size,
        raster.from_south ? line_size : -line_size,
        nullptr);
    if (result != CE_None || gdal.failed()) {
        error_unreadable(file, gdal.reason(file));
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

OpenRaster open_height_raster(const path& file, double picture_scale, GdalSession& gdal) {
    OpenRaster raster;
    raster.dataset = open(file, gdal);
    GDALDatasetH dataset = raster.dataset.get();
    gdal.forget();
    raster.columns = GDALGetRasterXSize(dataset);
    raster.rows = GDALGetRasterYSize(dataset);
    take_first_band(file, raster);
    if (const auto transform = transform_of(file, dataset)) {
        raster.frame = frame_from(*transform, raster);
        raster.system = GDALGetSpatialRef(dataset);
        raster.from_east = (*transform)[1] < 0.0;
        raster.from_south = (*transform)[5] > 0.0;
    } else {
        raster.scale_m *= picture_scale;
        raster.offset_m *= picture_scale;
    }
    const GDALDataType type = GDALGetRasterDataType(raster.band);
    raster.whole_metres =
        (type == GDT_Byte || type == GDT_Int16) && raster.scale_m == 1.0 && raster.offset_m == 0.0;
    return raster;
}

void read_heights(
    const path& file,
    const OpenRaster& raster,
    RowBand rows,
    std::span<float> heights_m,
    const GdalSession& gdal) {
    const auto columns = static_cast<std::size_t>(raster.columns);
    assert(heights_m.size() == columns * static_cast<std::size_t>(rows.count));
    std::vector<double> line(columns);
    for (int line_in_file = 0; line_in_file < rows.count; ++line_in_file) {
        const int row = raster.from_south ? line_in_file : rows.count - 1 - line_in_file;
        read_rows(file, raster, {rows.first + row, 1}, GDT_Float64, line.data(), gdal);
        float* const out = heights_m.data() + static_cast<std::size_t>(row) * columns;
        for (std::size_t x = 0; x < columns; ++x) {
            out[x] = height_from_raw(file, line[x], raster);
        }
    }
}

void read_whole_metres(
    const path& file,
    const OpenRaster& raster,
    RowBand rows,
    std::span<std::int16_t> heights_m,
    const GdalSession& gdal) {
    assert(raster.whole_metres);
    read_rows(file, raster, rows, GDT_Int16, heights_m.data(), gdal);
    constexpr int nothing = 1 << 20;
    std::array<int, 3> voids = {void_metres, -32767, -9999};
    if (raster.no_data) {
        const double no_data = *raster.no_data;
        const bool whole = std::abs(no_data) <= 32768.0 && no_data == std::floor(no_data);
        voids.fill(whole ? static_cast<int>(no_data) : nothing);
    }
    std::int16_t lowest_m = 0;
    std::int16_t highest_m = 0;
    for (std::int16_t& height_m : heights_m) {
        const int metres = height_m;
        const bool is_void = metres == voids[0] || metres == voids[1] || metres == voids[2];
        const std::int16_t counted = is_void ? std::int16_t{0} : height_m;
        lowest_m = std::min(lowest_m, counted);
        highest_m = std::max(highest_m, counted);
        height_m = is_void ? void_metres : height_m;
    }
    check_height(file, lowest_m);
    check_height(file, highest_m);
}

HeightRaster read_height_raster(const path& file, double picture_scale, GdalSession& gdal) {
    OpenRaster open_raster = open_height_raster(file, picture_scale, gdal);
    check_import_size(file, open_raster.columns, open_raster.rows);
    HeightRaster raster;
    HeightGrid& grid = raster.grid;
    grid.columns = open_raster.columns;
    grid.rows = open_raster.rows;
    grid.heights_m.resize(
        static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    read_heights(file, open_raster, {0, grid.rows}, grid.heights_m, gdal);
    raster.dataset = std::move(open_raster.dataset);
    raster.frame = open_raster.frame;
    raster.system = open_raster.system;
    return raster;
}

} // namespace octant::models::heights
