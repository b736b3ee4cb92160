#pragma once

#include "models/heights/height_grid.h"

#include <filesystem>
#include <functional>

namespace octant::models::heights {

/// True for a file that starts as a plain (text) PGM, which GDAL cannot read.
bool is_plain_pgm(const std::filesystem::path& path);

/// Grey values of a plain PGM. Throws Error "path:line: expected ..., got ..."; `check_size` is
/// called with width and height before any value is read and may throw too.
HeightGrid
read_plain_pgm(const std::filesystem::path& path, const std::function<void(int, int)>& check_size);

} // namespace octant::models::heights
