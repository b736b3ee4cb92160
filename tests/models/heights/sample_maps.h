#pragma once

#include "models/heights/height_field.h"
#include "tests/models/heights/height_files.h"

namespace octant::models::heights::test {

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
