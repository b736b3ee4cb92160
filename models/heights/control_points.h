#pragma once

#include "models/heights/gdal_session.h"

#include <filesystem>

namespace octant::models::heights {

/// A band of a raster that is placed by ground control points alone, laid by GDAL on a grid
/// of their coordinate system (bilinear; no data where it has none). The source must outlive the
/// grid. Null for any other raster. Throws Error for points that no grid fits.
Dataset grid_by_control_points(
    const std::filesystem::path& file, void* source, int band, const GdalSession& gdal);

} // namespace octant::models::heights
