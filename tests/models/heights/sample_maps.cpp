#include "tests/models/heights/sample_maps.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::models::heights::test {

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
