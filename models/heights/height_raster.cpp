#include "models/heights/height_raster.h"

#include "models/heights/control_points.h"
#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/import_options.h"
#include "models/heights/raster_file.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::heights {

namespace {

using std::filesystem::path;
using GeoTransform = std::array<double, 6>;

/// Metres of a unit by its name; nothing for one that is no known length.
std::optional<double> metres_from_unit(std::string_view unit) {
    constexpr double survey_foot_m = 1200.0 / 3937.0;
    constexpr std::array<std::pair<std::string_view, double>, 26> known = {{
        {"m", 1.0},
        {"metre", 1.0},
        {"meter", 1.0},
        {"metres", 1.0},
        {"meters", 1.0},
        {"ft", 0.3048},
        {"foot", 0.3048},
        {"feet", 0.3048},
        {"international foot", 0.3048},
        {"international feet", 0.3048},
        {"us-ft", survey_foot_m},
        {"sfoot", survey_foot_m},
        {"ftUS", survey_foot_m},
        {"US survey foot", survey_foot_m},
        {"Foot_US", survey_foot_m},
        {"dm", 0.1},
        {"decimetre", 0.1},
        {"decimeter", 0.1},
        {"decimeters", 0.1},
        {"cm", 0.01},
        {"centimetre", 0.01},
        {"centimeter", 0.01},
        {"mm", 0.001},
        {"km", 1000.0},
        {"yard", 0.9144},
        {"fathom", 1.8288},
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

/// The unit of heights that a coordinate system names, in metres.
std::optional<double> vertical_unit_m(SystemHandle system) {
    if (system == nullptr || OSRGetAttrValue(system, "VERT_CS", 0) == nullptr) {
        return std::nullopt;
    }
    return OSRGetTargetLinearUnits(system, "VERT_CS", nullptr);
}

/// Metres a unit of the band: as it says, else as its system says, else as `given`, else 1.
double unit_m_of(const path& file, const OpenRaster& raster, const std::optional<double>& given) {
    std::string unit = GDALGetRasterUnitType(raster.band);
    if (unit == "unspecified" || unit == "unknown" || unit == "-") {
        unit.clear();
    }
    const auto named = unit.empty() ? vertical_unit_m(raster.system) : metres_from_unit(unit);
    if (named || given || unit.empty()) {
        return named ? *named : given.value_or(1.0);
    }
    error_in(
        file,
        fmt::format(
            "expected heights in metres or feet, got '{}': --height-scale says how many metres "
            "that is",
            printable(unit)));
}

/// Reads what describes the first band: no-data value, scale, offset and unit.
void take_first_band(
    const path& file, OpenRaster& raster, const std::optional<double>& height_scale) {
    GDALDatasetH dataset = raster.dataset.get();
    if (GDALGetRasterCount(dataset) < 1) {
        error_unreadable(file, "a height field", "no band");
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
    const double unit_m = unit_m_of(file, raster, height_scale);
    raster.no_data = declared_no_data(raster.band);
    raster.scale_m = GDALGetRasterScale(raster.band, nullptr) * unit_m;
    raster.offset_m = GDALGetRasterOffset(raster.band, nullptr) * unit_m;
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
    // What is left of a rotation by 0 or 180 degrees.
    t[2] = std::abs(t[2]) <= 1e-9 * std::abs(t[1]) ? 0.0 : t[2];
    t[4] = std::abs(t[4]) <= 1e-9 * std::abs(t[5]) ? 0.0 : t[4];
    const double area = t[1] * t[5] - t[2] * t[4];
    if (!std::isfinite(t[0]) || !std::isfinite(t[3]) || !std::isnormal(area)) {
        error_in(
            file, fmt::format("expected a cell size that is a number, got {} x {}", t[1], t[5]));
    }
    return t;
}

/// Turns an upright raster so that it runs from the south-west; a rotated one stays from the south.
void take_transform(const GeoTransform& t, OpenRaster& raster) {
    const bool upright = t[2] == 0.0 && t[4] == 0.0;
    raster.from_east = upright && t[1] < 0.0;
    raster.from_south = upright && t[5] > 0.0;
    const double first_line = raster.from_south ? 0.5 : raster.rows - 0.5;
    const double first_pixel = raster.from_east ? raster.columns - 0.5 : 0.5;
    const double right = raster.from_east ? -1.0 : 1.0;
    const double up = raster.from_south ? 1.0 : -1.0;
    raster.map = MapFromGrid{
        t[0] + first_pixel * t[1] + first_line * t[2],
        right * t[1],
        up * t[2],
        t[3] + first_pixel * t[4] + first_line * t[5],
        right * t[4],
        up * t[5]};
}

/// Reads a window into a buffer row after row from the south.
template <typename Number>
void read_window(
    const path& file,
    const OpenRaster& raster,
    const GridWindow& window,
    GDALDataType type,
    Number* numbers,
    const GdalSession& gdal) {
    const int line =
        raster.from_south ? window.first_row : raster.rows - window.first_row - window.rows;
    const int pixel = raster.from_east ? raster.columns - window.first_column - window.columns
                                       : window.first_column;
    const auto size = static_cast<GSpacing>(sizeof(Number));
    const GSpacing line_size = size * window.columns;
    Number* const start =
        numbers + (raster.from_east ? window.columns - 1 : 0) +
        (raster.from_south ? std::ptrdiff_t{0} : std::ptrdiff_t{window.rows - 1} * window.columns);
    const CPLErr result = GDALRasterIOEx(
        raster.band,
        GF_Read,
        pixel,
        line,
        window.columns,
        window.rows,
        start,
        window.columns,
        window.rows,
        type,
        raster.from_east ? -size : size,
        raster.from_south ? line_size : -line_size,
        nullptr);
    if (result != CE_None || gdal.failed()) {
        error_unreadable(file, "a height field", gdal.reason(file));
    }
}

} // namespace

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
                "expected heights from {:g} to {:g} m, got {:g} m: --height-scale says how many "
                "metres a unit is, where the file does not",
                lowest_import_m,
                highest_import_m,
                height_m));
    }
}

OpenRaster open_height_raster(const path& file, const ImportOptions& options, GdalSession& gdal) {
    OpenRaster raster;
    raster.dataset = open_raster_file(file, gdal);
    if (Dataset grid = grid_by_control_points(file, raster.dataset.get(), gdal)) {
        raster.behind = std::exchange(raster.dataset, std::move(grid));
    }
    GDALDatasetH dataset = raster.dataset.get();
    raster.columns = GDALGetRasterXSize(dataset);
    raster.rows = GDALGetRasterYSize(dataset);
    if (const auto transform = transform_of(file, dataset)) {
        take_transform(*transform, raster);
        raster.system = GDALGetSpatialRef(dataset);
        if (raster.system == nullptr && options.system) {
            raster.given_system = system_named(*options.system);
            raster.system = raster.given_system.get();
        }
    }
    take_first_band(file, raster, options.height_scale);
    const GDALDataType type = GDALGetRasterDataType(raster.band);
    raster.whole_metres =
        (type == GDT_Byte || type == GDT_Int16) && raster.scale_m == 1.0 && raster.offset_m == 0.0;
    gdal.forget();
    return raster;
}

void read_heights(
    const path& file,
    const OpenRaster& raster,
    const GridWindow& window,
    std::span<float> heights_m,
    const GdalSession& gdal) {
    const auto columns = static_cast<std::size_t>(window.columns);
    assert(heights_m.size() == columns * static_cast<std::size_t>(window.rows));
    std::vector<double> line(columns);
    for (int line_in_file = 0; line_in_file < window.rows; ++line_in_file) {
        const int row = raster.from_south ? line_in_file : window.rows - 1 - line_in_file;
        const GridWindow one{window.first_column, window.columns, window.first_row + row, 1};
        read_window(file, raster, one, GDT_Float64, line.data(), gdal);
        float* const out = heights_m.data() + static_cast<std::size_t>(row) * columns;
        for (std::size_t x = 0; x < columns; ++x) {
            out[x] = height_from_raw(file, line[x], raster);
        }
    }
}

void read_whole_metres(
    const path& file,
    const OpenRaster& raster,
    const GridWindow& window,
    std::span<std::int16_t> heights_m,
    const GdalSession& gdal) {
    assert(raster.whole_metres);
    read_window(file, raster, window, GDT_Int16, heights_m.data(), gdal);
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

} // namespace octant::models::heights
