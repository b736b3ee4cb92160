#pragma once

#include "models/heights/height_field.h"
#include "tests/scratch.h"

#include <cstdint>
#include <filesystem>
#include <gdal.h>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights::test {

/// A raster to be written by GDAL, values row after row from the north.
struct RasterFile {
    int columns = 0;
    int rows = 0;
    std::vector<double> values;
    GDALDataType type = GDT_Float32;
    int bands = 1;                   ///< one behind the other in values, or each gets the same values
    std::vector<double> transform{}; ///< GDAL's six numbers, or none
    std::string system{};            ///< "EPSG:4326", PROJ text or none
    std::string unit{};
    std::optional<double> no_data{};
    double scale = 1.0;
    double offset = 0.0;
    bool has_palette = false;
};

using tests::scratch_file;

/// Writes with the GDAL driver of that name ("GTiff", "PNG", ...) and fails the test if it cannot.
void write_raster(const std::filesystem::path& path, const char* driver, const RasterFile& raster);

/// The first `bytes` of a file stay.
void truncate_file(const std::filesystem::path& path, std::uintmax_t bytes);

/// Hills that no two samples share.
double hills_m(double x, double y);

/// Whole metres of hills, without a place.
RasterFile hills(int columns, int rows);

/// Hills 30 m apart in UTM zone 10 north.
RasterFile metric_hills();

/// Degrees from (west, north), samples 1/400 degree apart, the first at the corner.
RasterFile degree_hills(int columns, int rows, double west, double north);

/// A part of a raster.
RasterFile cut(const RasterFile& whole, int first_x, int first_y, int columns, int rows);

/// The largest difference of two fields of the same size, metres.
double max_apart_m(const HeightField& a, const HeightField& b);

} // namespace octant::models::heights::test
